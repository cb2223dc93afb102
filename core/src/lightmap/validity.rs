//! Texels behind walls are pushed out, texels inside geometry are found.

use alloc::vec::Vec;

use glam::Vec3;

use super::{Texel, Texels};
use crate::geometry::{Occluders, Sobol, cosine_direction, hash};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::transport::Tracer;

/// Texels that see more than this share of back faces lie inside geometry.
const BACK_FACE_TOLERANCE: f32 = 0.25;
/// Rays that suffice where none of them meets a back face.
const FIRST_RAYS: u32 = 4;
/// Rays that decide where one of the first does.
const ALL_RAYS: u32 = 32;

/// Moves the sample points of texels out from behind walls that stand within them, and tells which texels are valid.
///
/// A ray from a texel along the surface that meets the back of a one-sided wall within the texel shows that the point
/// lies behind it; the point is moved through to the visible side, as Bakery does.
pub fn check<O: Occluders>(
    texels: &mut Texels,
    tracer: &Tracer<O>,
    workers: &Workers,
    seed: u32,
    progress: &Progress,
) -> Result<Vec<bool>, Cancelled> {
    let found = workers.map(texels.list.len(), 256, progress, |range| {
        range
            .map(|index| {
                let texel = &texels.list[index];
                let position = pushed_out(texel, texels, tracer);
                (position, sees_fronts(&Texel { position, ..*texel }, tracer, hash(seed, index as u32)))
            })
            .collect()
    })?;
    Ok(texels
        .list
        .iter_mut()
        .zip(found)
        .map(|(texel, (position, is_valid))| {
            texel.position = position;
            is_valid
        })
        .collect())
}

fn pushed_out<O: Occluders>(texel: &Texel, texels: &Texels, tracer: &Tracer<O>) -> Vec3 {
    let [right, down] = texels.steps(tracer.world, texel.triangle);
    let normal = tracer.world.normals[texel.triangle as usize];
    tracer.count(4);
    [right, -right, down, -down]
        .into_iter()
        .filter(|step| *step != Vec3::ZERO)
        .find_map(|step| {
            let hit = tracer.nearest(&tracer.leave(texel.triangle, texel.position, normal, step, 0.5), 0)?;
            let is_back = !hit.front && !tracer.world.sides[hit.triangle as usize].both;
            is_back.then(|| {
                texel.position + step * hit.distance + step.normalize() * (4.0 * tracer.world.lift(texel.triangle))
            })
        })
        .unwrap_or(texel.position)
}

fn sees_fronts<O: Occluders>(texel: &Texel, tracer: &Tracer<O>, seed: u32) -> bool {
    let backs_in = |rays: core::ops::Range<u32>| {
        tracer.count(rays.len());
        rays.filter(|&index| meets_back(texel, tracer, seed, index)).count() as f32
    };
    let first = backs_in(0..FIRST_RAYS);
    first == 0.0 || first + backs_in(FIRST_RAYS..ALL_RAYS) <= BACK_FACE_TOLERANCE * ALL_RAYS as f32
}

fn meets_back<O: Occluders>(texel: &Texel, tracer: &Tracer<O>, seed: u32, index: u32) -> bool {
    let normal = tracer.world.normals[texel.triangle as usize];
    let direction = cosine_direction(Sobol::new(seed).square(index), normal);
    let hit = tracer
        .nearest(&tracer.leave(texel.triangle, texel.position, normal, direction, f32::INFINITY), hash(seed, index));
    hit.is_some_and(|hit| !hit.front && !tracer.world.sides[hit.triangle as usize].both)
}
