//! What a bake does without the feature `bvh`: every triangle is tried.

use alloc::vec::Vec;

use glam::Vec3;

use super::BruteForce;

/// What a bake asks for hits.
pub fn tree(triangles: Vec<[Vec3; 3]>) -> BruteForce<Vec<[Vec3; 3]>> {
    BruteForce(triangles)
}
