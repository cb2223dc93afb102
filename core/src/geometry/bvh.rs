//! The bounding volume hierarchy of obvhs: eight children a node, compressed.

use alloc::vec::Vec;
use core::time::Duration;

use glam::Vec3;
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh;
use obvhs::{Boundable, BvhBuildParams};

use super::occluders::is_before;
use super::triangle::ShearedRay;
use super::{Hit, Occluders, Ray};

/// Triangles in a tree. Memory: about 70 bytes a triangle.
pub struct Bvh {
    tree: CwBvh,
    /// In the order of the leaves, each with its index in the caller's list.
    leaves: Vec<([Vec3; 3], u32)>,
}

/// What a bake asks for hits.
pub fn tree(triangles: Vec<[Vec3; 3]>) -> Bvh {
    Bvh::new(&triangles)
}

/// A triangle with a box a little too large, so that rounding inside the tree loses no hit.
struct Padded<'a>(&'a [Vec3; 3]);

impl Boundable for Padded<'_> {
    fn aabb(&self) -> Aabb {
        let [a, b, c] = *self.0;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let padding = Vec3::splat(low.abs().max(high.abs()).max_element() * 2e-6);
        Aabb::new((low - padding).to_array().into(), (high + padding).to_array().into())
    }
}

impl Bvh {
    /// Builds a tree over finite triangles.
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        let padded: Vec<_> = triangles.iter().map(Padded).collect();
        let tree = build_cwbvh(&padded, BvhBuildParams::medium_build(), &mut Duration::default());
        let leaves = tree.primitive_indices.iter().map(|&index| (triangles[index as usize], index)).collect();
        Self { tree, leaves }
    }

    fn traversal(ray: &Ray) -> obvhs::ray::Ray {
        // The tree takes -0 for a negative direction in one place and for a positive one in another.
        let direction = ray.direction + Vec3::ZERO;
        obvhs::ray::Ray::new(ray.origin.to_array().into(), direction.to_array().into(), 0.0, ray.end)
    }
}

impl Occluders for Bvh {
    fn first(&self, ray: &Ray, place: impl Fn(&Hit) -> Option<f32>) -> Option<Hit> {
        let sheared = ShearedRay::new(ray);
        let mut first: Option<(f32, Hit)> = None;
        let mut end = ray.end;
        self.tree.ray_traverse(Self::traversal(ray), &mut obvhs::ray::RayHit::none(), |_, leaf| {
            let (corners, index) = &self.leaves[leaf];
            let Some(hit) = sheared.hit(corners, *index, end) else { return f32::INFINITY };
            let Some(placed) = place(&hit).map(|place| (place, hit)) else { return f32::INFINITY };
            if first.is_some_and(|known| !is_before(&placed, &known)) {
                return f32::INFINITY;
            }
            first = Some(placed);
            end = placed.0.min(ray.end);
            // The tree must still visit what lies at the same place.
            end * (1.0 + 1e-6)
        });
        first.map(|(_, hit)| hit)
    }

    fn any(&self, ray: &Ray, mut stop: impl FnMut(&Hit) -> bool) -> bool {
        let sheared = ShearedRay::new(ray);
        let missed = self.tree.ray_traverse_miss(Self::traversal(ray), |_, leaf| {
            let (corners, index) = &self.leaves[leaf];
            match sheared.hit(corners, *index, ray.end) {
                Some(hit) if stop(&hit) => f32::NEG_INFINITY,
                _ => f32::INFINITY,
            }
        });
        !missed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{BruteForce, Sobol, cosine_direction};

    fn cloud(count: u32) -> Vec<[Vec3; 3]> {
        let point = |index: u32, seed: u32| {
            let sequence = Sobol::new(seed);
            Vec3::new(sequence.dimension(index, 0), sequence.dimension(index, 1), sequence.dimension(index, 2))
        };
        (0..count).map(|i| [0, 1, 2].map(|corner| point(i, 11) + 0.2 * point(i, 20 + corner))).collect()
    }

    #[test]
    fn tree_and_brute_force_agree() {
        let triangles = cloud(500);
        let (tree, all) = (Bvh::new(&triangles), BruteForce(&triangles));
        for index in 0..4000 {
            let sequence = Sobol::new(index);
            let origin = Vec3::new(sequence.dimension(0, 0), sequence.dimension(0, 1), sequence.dimension(0, 2));
            let direction = cosine_direction(sequence.square(1), Vec3::Z);
            let ray = Ray { origin, direction, end: if index % 3 == 0 { 0.2 } else { f32::INFINITY } };
            assert_eq!(tree.nearest(&ray), all.nearest(&ray));
            let odd = |hit: &Hit| hit.triangle % 2 == 1;
            let fronts_first = |hit: &Hit| odd(hit).then_some(hit.distance + if hit.front { 0.0 } else { 0.1 });
            assert_eq!(tree.first(&ray, fronts_first), all.first(&ray, fronts_first));
            assert_eq!(tree.any(&ray, odd), all.any(&ray, odd));
        }
    }

    /// Rays along an axis, with zeros of either sign, find what lies there.
    #[test]
    fn axis_parallel_rays() {
        let square = |y: f32| {
            let [a, b, c, d] = [[-2.0, y, 2.0], [2.0, y, 2.0], [2.0, y, -2.0], [-2.0, y, -2.0]].map(Vec3::from_array);
            [[a, b, c], [a, c, d]]
        };
        let triangles: Vec<_> = [0.0, 1.0, 2.0, 3.0].into_iter().flat_map(square).collect();
        let tree = Bvh::new(&triangles);
        for (x, z) in [(-0.0, -0.0), (0.0, -0.0), (-0.0, 0.0), (0.0, 0.0)] {
            for up in [1.0, -1.0] {
                let ray = Ray { origin: Vec3::new(-1.7, 0.5, 1.9), direction: Vec3::new(x, up, z), end: 9.0 };
                let mut met = 0;
                tree.any(&ray, |_| {
                    met += 1;
                    false
                });
                assert_eq!(met, if up > 0.0 { 3 } else { 1 }, "{x} {z} {up}");
            }
        }
    }

    #[test]
    fn lowest_index_wins_at_the_same_distance() {
        let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let tree = Bvh::new(&[triangle; 40]);
        let ray = Ray { origin: Vec3::new(0.2, 0.2, 1.0), direction: Vec3::NEG_Z, end: 2.0 };
        assert_eq!(tree.nearest(&ray).map(|hit| hit.triangle), Some(0));
    }
}
