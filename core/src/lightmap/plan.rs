//! Which rectangle every surface gets at a density, and the density that gives the texels asked for.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec2;

use super::atlas::{self, Place};
use super::chart::{Charts, KeptUv};
use super::tile::{GUTTER, Tile, whole_texels};
use crate::progress::{Cancelled, Progress};

/// Lightmap coordinates of a mesh, as far as the density does not matter.
pub(super) enum Shape {
    /// They were there.
    Kept(KeptUv),
    /// Made by unwrapping, at the size of the smallest surface that uses the mesh.
    Unwrapped(Charts),
}

/// A surface that gets a lightmap.
pub(super) struct Item {
    /// Index into the surfaces of the scene.
    pub surface: usize,
    /// Index into the meshes of the scene.
    pub mesh: usize,
    /// How large it is.
    pub extent: Extent,
}

/// How large the rectangle of a surface is.
#[derive(Clone, Copy)]
pub(super) enum Extent {
    /// Meters from 0 to 1 along `u` and `v`, times the density of the receiver.
    Meters(Vec2),
    /// Multiple of the size of the charts, at least 1.
    Scale(f32),
}

/// Everything at its place.
pub(super) struct Plan {
    /// For each mesh its charts in a rectangle, if it was unwrapped.
    pub tiles: Vec<Option<Tile>>,
    /// For each item its rectangle.
    pub rects: Vec<Rect>,
    /// For each item where its block lies.
    pub places: Vec<Place>,
    /// Width and height of each image.
    pub images: Vec<[u32; 2]>,
}

/// The rectangle of a surface in texels.
#[derive(Clone, Copy)]
pub(super) struct Rect {
    /// What it takes up with its gutter, in multiples of 4.
    block: [u32; 2],
    /// Empty texels at its left and upper border that do not belong to the rectangle.
    pub inset: u32,
    /// Width and height of the rectangle.
    pub size: [u32; 2],
    /// Its density as a share of the one asked for, less than 1 if it was too large.
    pub share: f32,
}

/// Why there is no plan.
pub(super) enum NoPlan {
    /// The charts of this mesh do not fit into the largest image, even with one texel each.
    TooManyCharts(usize),
    /// The rectangles do not fit into the one image.
    OneImage,
    /// Told to stop.
    Cancelled,
}

impl From<Cancelled> for NoPlan {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// Trials of a density; each brings it nearer by at least half.
const TRIALS: usize = 12;

/// At a fixed number of texels per meter, in images of at most `max` texels.
pub(super) fn at_density(
    shapes: &[Option<Shape>],
    items: &[Item],
    density: f32,
    max: u32,
    progress: &Progress,
) -> Result<Plan, NoPlan> {
    let (tiles, rects) = rectangles(shapes, items, density, max, progress)?;
    let blocks: Vec<[u32; 2]> = rects.iter().map(|rect| rect.block).collect();
    let (places, images) = atlas::pack_images(&blocks, max, progress)?;
    Ok(Plan { tiles, rects, places, images })
}

/// At the density between 1 and 64 texels per meter whose images have about so many texels together.
pub(super) fn for_texels(
    shapes: &[Option<Shape>],
    items: &[Item],
    texels: u32,
    [area, max]: [f32; 2],
    progress: &Progress,
) -> Result<(Plan, f32), NoPlan> {
    let clamp = |density: f32| density.clamp(1.0, 64.0);
    let wanted = texels as f32;
    let mut density = clamp(crate::math::sqrt(wanted / area));
    let mut best: Option<(f32, Plan, f32)> = None;
    for _ in 0..TRIALS {
        let plan = at_density(shapes, items, density, max as u32, progress)?;
        let have = plan.images.iter().map(|&[w, h]| w as f32 * h as f32).sum::<f32>();
        let off = (have / wanted).max(wanted / have);
        let next = clamp(density * crate::math::sqrt(wanted / have));
        if best.as_ref().is_none_or(|best| off < best.0) {
            best = Some((off, plan, density));
        }
        if off < 1.02 || (next - density).abs() < 1e-3 * density {
            break;
        }
        density = next;
    }
    best.map(|(_, plan, density)| (plan, density)).ok_or(NoPlan::Cancelled)
}

/// At the highest density at which everything fits into one square image.
pub(super) fn for_image(
    shapes: &[Option<Shape>],
    items: &[Item],
    side: u32,
    area: f32,
    progress: &Progress,
) -> Result<(Plan, f32), NoPlan> {
    let trial = |density: f32| -> Result<Option<(Plan, f32)>, NoPlan> {
        let (tiles, rects) = match rectangles(shapes, items, density, side, progress) {
            Err(NoPlan::TooManyCharts(_)) => return Ok(None),
            other => other?,
        };
        let blocks: Vec<[u32; 2]> = rects.iter().map(|rect| rect.block).collect();
        let packed = atlas::pack_into(&blocks, [side; 2], progress)?;
        let whole = rects.iter().all(|rect| rect.share == 1.0);
        Ok(packed.filter(|_| whole).map(|packed| {
            let places = packed.corners.into_iter().map(|corner| Place { image: 0, corner }).collect();
            (Plan { tiles, rects, places, images: vec![[side; 2]] }, density)
        }))
    };
    let mut high = side as f32 / crate::math::sqrt(area);
    let mut low = high;
    let mut best = None;
    for _ in 0..2 * TRIALS {
        low *= 0.7;
        best = trial(low)?;
        if best.is_some() {
            break;
        }
        high = low;
    }
    let mut best = best.ok_or(NoPlan::OneImage)?;
    while high > best.1 * 1.005 {
        let middle = crate::math::sqrt(best.1 * high);
        match trial(middle)? {
            Some(found) => best = found,
            None => high = middle,
        }
    }
    Ok(best)
}

type Rectangles = (Vec<Option<Tile>>, Vec<Rect>);

fn rectangles(
    shapes: &[Option<Shape>],
    items: &[Item],
    density: f32,
    max: u32,
    progress: &Progress,
) -> Result<Rectangles, NoPlan> {
    let mut tiles = Vec::with_capacity(shapes.len());
    for (mesh, shape) in shapes.iter().enumerate() {
        tiles.push(match shape {
            Some(Shape::Unwrapped(charts)) => {
                Some(largest_tile(charts, density, max, progress)?.ok_or(NoPlan::TooManyCharts(mesh))?)
            }
            _ => None,
        });
    }
    let rects = items
        .iter()
        .map(|item| match (item.extent, &tiles[item.mesh]) {
            (Extent::Scale(scale), Some((tile, share))) => scaled(tile, *share, scale, max),
            (Extent::Meters(meters), _) => stretched(meters * density, max),
            (Extent::Scale(_), None) => stretched(Vec2::ONE, max),
        })
        .collect();
    Ok((tiles.into_iter().map(|tile| tile.map(|(tile, _)| tile)).collect(), rects))
}

/// Charts at the density, or at the highest share of it at which they fit; with that share.
fn largest_tile(
    charts: &Charts,
    density: f32,
    max: u32,
    progress: &Progress,
) -> Result<Option<(Tile, f32)>, Cancelled> {
    let longest = charts.sizes.iter().fold(0.0f32, |longest, size| longest.max(size.max_element()));
    let area: f32 = charts.sizes.iter().map(|size| size.x * size.y).sum();
    let room = (max.saturating_sub(2 * GUTTER)) as f32;
    let by_length = room / (longest * density);
    let by_area = room / (crate::math::sqrt(area) * density);
    let mut share = by_length.min(by_area).min(1.0);
    loop {
        if let Some(tile) = Tile::new(charts, density * share, max, progress)? {
            return Ok(Some((tile, share)));
        }
        if longest * density * share < 1.0 {
            return Ok(None);
        }
        share *= 0.97;
    }
}

/// The rectangle of a surface whose charts are larger than those of the tile, gutters included.
fn scaled(tile: &Tile, share: f32, scale: f32, max: u32) -> Rect {
    let longest = tile.size[0].max(tile.size[1]) as f32;
    let held = scale.min((max as f32 / longest).max(1.0));
    let size = tile.size.map(|side| (crate::math::ceil(side as f32 * held - 1e-3) as u32).clamp(side, max));
    Rect { block: size.map(|side| side.next_multiple_of(4)), inset: 0, size, share: share * (held / scale) }
}

/// The rectangle of a surface whose coordinates fill it from border to border.
fn stretched(texels: Vec2, max: u32) -> Rect {
    let room = (max - 2 * GUTTER) as f32;
    let share = (room / texels.max_element()).min(1.0);
    let size = (texels * share).to_array().map(|length| whole_texels(length).min(max - 2 * GUTTER));
    let block = size.map(|side| (side + 2 * GUTTER).next_multiple_of(4));
    Rect { block, inset: GUTTER, size, share }
}
