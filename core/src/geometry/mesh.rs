//! Indexed triangles with what their vertices carry.

use alloc::string::String;
use alloc::vec::Vec;

use glam::{Vec2, Vec3, Vec4};

/// Indexed triangles, counter-clockwise seen from the front.
///
/// Every list but `positions` and `triangles` may be empty; otherwise it has one entry for each vertex.
/// Vertices may be NaN and triangles degenerate: the bake leaves those triangles out.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// For messages.
    pub name: String,
    /// In meters, in the space of the mesh.
    pub positions: Vec<Vec3>,
    /// Of any length but zero; empty: the triangles are flat.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, `v` down.
    pub uv_0: Vec<Vec2>,
    /// The second set: lightmap coordinates if they are usable.
    pub uv_1: Vec<Vec2>,
    /// Linear RGBA that multiplies the base color.
    pub colors: Vec<Vec4>,
    /// Indices into the vertices.
    pub triangles: Vec<[u32; 3]>,
    /// Whether a texture of a material is looked up by `uv_1`, so that the bake must not replace it.
    pub uv_1_in_use: bool,
}
