//! The true error of a grid of texels, to be looked at.

use alloc::collections::BTreeMap;
use alloc::collections::btree_map::Entry;
use alloc::vec;
use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use super::PathTracer;
use crate::bake::Bake;
use crate::geometry::{Hit, hash, tree};
use crate::lightmap::TexelState;
use crate::math;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress, Stage};
use crate::render::view::lightmap_corners;
use crate::scene::{Scene, World};

/// Values of [`PATHS`](super::PATHS) paths for each texel.
const VALUES: u32 = 128;

/// A cell of the grid of an image and the part of a chart in it: image, chart, row, column.
type Cell = (u32, u32, u32, u32);

/// The texel of a cell that paths are followed from.
struct Chosen {
    /// Squared distance from the middle of the cell, in texels.
    off: f32,
    /// Index in its image.
    texel: usize,
    /// The point in its middle.
    hit: Hit,
}

/// The errors of a bake at so many texels, up to four times as many, one for each cell of a grid and each chart in it, for
/// [`Bake::true_errors`]: all texels of the cell and chart get its error. Where there are more charts than that, some have
/// none. The noise of the paths is part of it.
///
/// # Errors
///
/// Where the progress was told to cancel.
pub fn true_errors(scene: &Scene, bake: &Bake, texels: usize, progress: &Progress) -> Result<Vec<Vec<f32>>, Cancelled> {
    progress.enter(Stage::Paths);
    let world = World::new(scene);
    let tracer = PathTracer::diffuse(&world, tree(world.corners[..world.blockers].to_vec()));
    let side = side_of_cells(bake, texels);
    let all: Vec<(Cell, Chosen)> = cells(&world, bake, side).into_iter().collect();
    let every = (all.len() / (2 * texels.max(1))).max(1);
    let chosen: Vec<&(Cell, Chosen)> = all.iter().step_by(every).collect();
    let seed = hash(bake.report.seed as u32, 0x6a1d);
    let light = |index: usize| {
        let (_, Chosen { hit, .. }) = chosen[index];
        tracer.received(hit, world.shading_normal(hit), VALUES, hash(seed, index as u32)).mean
    };
    let workers = Workers::new(bake.report.threads);
    let truth: Vec<Vec3> = workers.map(chosen.len(), 4, progress, |range| range.map(light).collect())?;
    let floor = 0.1 * truth.iter().map(|light| light.element_sum() / 3.0).sum::<f32>() / truth.len().max(1) as f32;
    let error = |((cell, Chosen { texel, .. }), light): (&&(Cell, Chosen), &Vec3)| {
        let apart = (bake.images[cell.0 as usize].texels[*texel] - *light).abs();
        (*cell, (apart / (*light + floor).max(Vec3::splat(f32::MIN_POSITIVE))).element_sum() / 3.0)
    };
    let errors = chosen.iter().zip(&truth).map(error).collect();
    Ok((0..bake.images.len()).map(|image| of_image(bake, image as u32, side, &errors)).collect())
}

/// In texels, so that there are about as many cells as texels are wanted, or some more.
fn side_of_cells(bake: &Bake, texels: usize) -> u32 {
    let states = bake.images.iter().flat_map(|image| &image.states);
    let valid = states.filter(|state| **state == TexelState::Valid).count();
    (math::sqrt(valid as f32 / texels.max(1) as f32) as u32).max(1)
}

/// For each cell the valid texel that is nearest to its middle, of those whose middle lies on a triangle.
fn cells(world: &World, bake: &Bake, side: u32) -> BTreeMap<Cell, Chosen> {
    let mut cells = BTreeMap::new();
    for triangle in 0..world.blockers as u32 {
        let Some((placement, corners)) = lightmap_corners(world, bake, triangle) else { continue };
        let Some(image) = bake.images.get(placement.image) else { continue };
        let size = Vec2::new(image.width as f32, image.height as f32);
        let corners = corners.map(|corner| corner * size - 0.5);
        let low = corners[0].min(corners[1]).min(corners[2]).ceil().max(Vec2::ZERO).as_uvec2();
        let high = corners[0].max(corners[1]).max(corners[2]).floor().min(size - 1.0).max(-Vec2::ONE).as_ivec2();
        for (y, x) in (low.y as i32..=high.y).flat_map(|y| (low.x as i32..=high.x).map(move |x| (y as u32, x as u32))) {
            let texel = (y * image.width + x) as usize;
            let Some(barycentric) = inside(corners, Vec2::new(x as f32, y as f32)) else { continue };
            if image.states[texel] != TexelState::Valid {
                continue;
            }
            let middle = Vec2::new((x % side) as f32, (y % side) as f32) - 0.5 * (side - 1) as f32;
            let hit = Hit { triangle, distance: 0.0, barycentric, front: true };
            let chosen = Chosen { off: middle.length_squared(), texel, hit };
            match cells.entry((placement.image as u32, image.charts[texel], y / side, x / side)) {
                Entry::Vacant(cell) => drop(cell.insert(chosen)),
                Entry::Occupied(mut cell) if chosen.off < cell.get().off => drop(cell.insert(chosen)),
                Entry::Occupied(_) => {}
            }
        }
    }
    cells
}

/// Barycentric coordinates of a point of a triangle, nothing outside of it.
fn inside([a, b, c]: [Vec2; 3], point: Vec2) -> Option<Vec2> {
    let barycentric = Vec2::new((c - a).perp_dot(a - point), (b - a).perp_dot(point - a)) / (b - a).perp_dot(c - a);
    (barycentric.min_element() >= 0.0 && barycentric.element_sum() <= 1.0).then_some(barycentric)
}

fn of_image(bake: &Bake, image: u32, side: u32, errors: &BTreeMap<Cell, f32>) -> Vec<f32> {
    let lightmap = &bake.images[image as usize];
    let mut of_texels = vec![f32::NAN; lightmap.texels.len()];
    for (texel, error) in of_texels.iter_mut().enumerate() {
        let (x, y) = (texel as u32 % lightmap.width, texel as u32 / lightmap.width);
        let cell = (image, lightmap.charts[texel], y / side, x / side);
        if let (TexelState::Valid, Some(found)) = (lightmap.states[texel], errors.get(&cell)) {
            *error = *found;
        }
    }
    of_texels
}
