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

impl LightmapImage {
    /// The same picture with half as many texels in each direction, for a look at it: each is the mean of those of four
    /// that know most of their light. Where one of the four is invalid, so is it. A side of one texel stays.
    pub fn halved(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let (right, down) = ((self.width > 1) as usize, if self.height > 1 { self.width as usize } else { 0 });
        let mut half = Self { width, height, ..Self::default() };
        for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
            let corner = (2 * y * self.width + 2 * x) as usize;
            let four = [0, right, down, right + down].map(|step| corner + step);
            let rank = |&at: &usize| match self.states[at] {
                TexelState::Empty => 0,
                TexelState::Gutter => 1,
                TexelState::Invalid => 2,
                TexelState::Valid => 3,
            };
            let [first, ..] = four;
            let best = four.into_iter().skip(1).fold(first, |best, at| if rank(&at) > rank(&best) { at } else { best });
            let alike = || four.into_iter().filter(|at| self.states[*at] == self.states[best]);
            let share = 1.0 / alike().count() as f32;
            half.texels.push(alike().map(|at| self.texels[at]).sum::<Vec3>() * share);
            half.errors.push(alike().map(|at| self.errors[at]).sum::<f32>() * share);
            let is_invalid = four.into_iter().any(|at| self.states[at] == TexelState::Invalid);
            half.states.push(if is_invalid { TexelState::Invalid } else { self.states[best] });
            half.charts.push(self.charts[best]);
            half.patches.push(self.patches[best]);
        }
        half
    }
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
    /// It lies inside geometry, or reaches through a wall into darkness, and was filled from its neighbors.
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

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    /// Of four texels only those count that know most of their light; invalid ones are not forgotten.
    #[test]
    fn half_an_image() {
        use TexelState::{Empty, Gutter, Invalid, Valid};
        let image = LightmapImage {
            width: 4,
            height: 2,
            texels: (0..8).map(|k| Vec3::splat(k as f32)).collect(),
            states: vec![Empty, Valid, Gutter, Empty, Invalid, Valid, Empty, Gutter],
            charts: (0..8).collect(),
            patches: (10..18).collect(),
            errors: vec![0.0, 0.2, 0.0, 0.0, 0.0, 0.4, 0.0, 0.0],
        };
        let half = image.halved();
        assert_eq!((half.width, half.height), (2, 1));
        assert_eq!(half.texels, [Vec3::splat(3.0), Vec3::splat(4.5)]);
        assert_eq!((half.states, half.charts), (vec![Invalid, Gutter], vec![1, 2]));
        assert_eq!(half.patches, [11, 12]);
        assert!((half.errors[0] - 0.3).abs() < 1e-6 && half.errors[1] == 0.0);
    }
}
