//! The finished lightmaps.

use alloc::vec::Vec;

use glam::{Vec2, Vec3};

/// One lightmap. Row 0 is on top; all lists have `width x height` entries, row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightmapImage {
    /// Texels in a row, a multiple of 4.
    pub width: u32,
    /// Rows, a multiple of 4.
    pub height: u32,
    /// Irradiance / pi in cd/m2 per linear RGB channel: what a white diffuse surface would radiate.
    pub texels: Vec<Vec3>,
    /// How each texel came by its light.
    pub states: Vec<TexelState>,
    /// The chart that covers each texel, counted through the whole bake; [`NONE`] where there is none.
    pub charts: Vec<u32>,
    /// The patch that each texel belongs to; [`NONE`] where there is none.
    pub patches: Vec<u32>,
    /// Estimated standard error of each valid texel, relative to its light plus a tenth of the mean light of the bake;
    /// zero elsewhere.
    pub errors: Vec<f32>,
}

/// In a list of indices: there is none.
pub const NONE: u32 = u32::MAX;

/// How a texel came by its light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TexelState {
    /// No surface covers it.
    #[default]
    Empty,
    /// No surface covers it; it repeats its neighbors so that filtering finds no dark edge.
    Gutter,
    /// Its own light was computed.
    Valid,
    /// It lies inside geometry and was filled from its neighbors.
    Invalid,
}

/// Where the lightmap of a surface lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Index into the images of the bake.
    pub image: usize,
    /// Upper left corner in `0..1`; a texel is found at `min + uv_1 * (max - min)`.
    pub min: Vec2,
    /// Lower right corner in `0..1`, greater than `min` in both coordinates.
    pub max: Vec2,
}

/// Lightmap coordinates of a mesh, over vertices that may have been split.
#[derive(Clone, Debug, PartialEq)]
pub struct LightmapUv {
    /// Whether the coordinates were there before or are new.
    pub origin: UvOrigin,
    /// For each new vertex, the vertex of the mesh whose attributes it repeats.
    pub sources: Vec<u32>,
    /// For each new vertex, its coordinates in `0..1` of the rectangle of a surface, `v` down.
    ///
    /// Kept ones reach 0 and 1 in both directions, unless a texture uses them too: then they are as they were.
    /// New ones leave the gutter of 2 texels at the border free.
    pub uv_1: Vec<Vec2>,
    /// As many triangles as the mesh has, in the same order, over the new vertices.
    pub triangles: Vec<[u32; 3]>,
}

/// Where lightmap coordinates come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UvOrigin {
    /// The mesh brought them along; vertices and triangles are as they were.
    Kept,
    /// They were made by unwrapping; vertices may have been split.
    Unwrapped,
}
