//! The charts of one mesh at a density of texels, packed into one rectangle.

use alloc::vec::Vec;

use glam::Vec2;

use super::atlas;
use super::chart::Charts;
use crate::math;
use crate::progress::{Cancelled, Progress};

/// Empty texels around every chart.
pub(super) const GUTTER: u32 = 2;
/// How far the density may be off so that a chart ends on a border of texels.
const TOLERANCE: f32 = 0.04;

/// The charts of a mesh in one rectangle of texels, each with its gutter.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tile {
    /// Width and height in texels.
    pub size: [u32; 2],
    /// For each chart the upper left corner of its gutter.
    corners: Vec<[u32; 2]>,
    /// For each chart its width and height in texels without gutter, before it is turned.
    texels: Vec<[u32; 2]>,
}

/// Whole texels for a length in texels: the nearest number if it is near enough, else the next greater.
pub(super) fn whole_texels(length: f32) -> u32 {
    let nearest = math::round(length);
    let fits = nearest >= 1.0 && (nearest - length).abs() <= TOLERANCE * length;
    let whole = if fits { nearest } else { math::ceil(length) };
    (whole as u32).max(1)
}

impl Tile {
    /// Lays out charts with so many texels per meter in a rectangle with sides of at most `max` texels, if they fit.
    pub fn new(charts: &Charts, density: f32, max: u32, progress: &Progress) -> Result<Option<Self>, Cancelled> {
        let texels: Vec<[u32; 2]> =
            charts.sizes.iter().map(|size| [whole_texels(size.x * density), whole_texels(size.y * density)]).collect();
        let longest = texels.as_flattened().iter().max().copied().unwrap_or(0);
        if longest > max.saturating_sub(2 * GUTTER) {
            return Ok(None);
        }
        let padded: Vec<[u32; 2]> =
            texels.iter().map(|&[w, h]| [w.max(h) + 2 * GUTTER, w.min(h) + 2 * GUTTER]).collect();
        let packed = atlas::pack(&padded, max, progress)?;
        Ok(packed.map(|packed| Self { size: packed.size, corners: packed.corners, texels }))
    }

    /// For each vertex of the charts its place in the rectangle, in `0..1`.
    pub fn coordinates(&self, charts: &Charts) -> Vec<Vec2> {
        let place = |(&chart, &point): (&u32, &Vec2)| {
            let chart = chart as usize;
            let size = charts.sizes[chart];
            let [width, height] = self.texels[chart].map(|texels| texels as f32);
            let x = if size.x > 0.0 { point.x / size.x * width } else { 0.5 * width };
            let y = if size.y > 0.0 { point.y / size.y * height } else { 0.5 * height };
            let turned = if height > width { Vec2::new(y, width - x) } else { Vec2::new(x, y) };
            let corner = Vec2::from(self.corners[chart].map(|texel| (texel + GUTTER) as f32));
            (corner + turned) / Vec2::from(self.size.map(|texels| texels as f32))
        };
        charts.vertex_charts.iter().zip(&charts.points).map(place).collect()
    }
}
