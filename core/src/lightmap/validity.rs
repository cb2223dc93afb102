//! Where in its square a texel looks from, and whether it lies inside geometry.

use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use super::links::{Links, Place, is_free, is_open};
use super::{CROSSED, Texel, Texels, quarter};
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
/// From the middle of a texel to where its border is nearly reached, in texels.
const HALF: f32 = 0.49;
/// Points keep this distance from walls, in texels.
const CLEARANCE: f32 = 0.05;

/// Moves texels whose middle is hidden to the middle of what is visible of them, finds the walls between texels, and
/// tells which texels are valid: those that do not lie inside geometry.
///
/// A wall that crosses a texel crosses one of its diagonals. Only where it does, more rays find out what is visible.
pub fn check<O: Occluders>(
    texels: &mut Texels,
    tracer: &Tracer<O>,
    workers: &Workers,
    seed: u32,
    progress: &Progress,
) -> Result<Vec<bool>, Cancelled> {
    let found = workers.map(texels.list.len(), 256, progress, |range| {
        range.map(|index| Square::new(texels, tracer, index, hash(seed, index as u32)).look()).collect()
    })?;
    let mut is_valid = Vec::with_capacity(found.len());
    for (texel, (placed, valid)) in texels.list.iter_mut().zip(found) {
        *texel = placed;
        is_valid.push(valid);
    }
    texels.links = Links::new(texels, &is_valid, tracer, workers, progress)?;
    Ok(is_valid)
}

/// The square of a texel on its surface.
struct Square<'a, O> {
    tracer: &'a Tracer<'a, O>,
    texel: Texel,
    /// The point of the surface at the middle of the square, whether it is covered or not.
    middle: Vec3,
    /// To the next texel on the right, and to the next one below.
    steps: [Vec3; 2],
    flat: Vec3,
    seed: u32,
}

impl<'a, O: Occluders> Square<'a, O> {
    fn new(texels: &Texels, tracer: &'a Tracer<'a, O>, index: usize, seed: u32) -> Self {
        let texel = texels.list[index];
        Self {
            tracer,
            texel,
            middle: texels.middle(tracer.world, &texel),
            steps: texels.steps(tracer.world, texel.triangle),
            flat: tracer.world.normals[texel.triangle as usize],
            seed,
        }
    }

    /// The texel at its final place, and whether it is valid.
    fn look(mut self) -> (Texel, bool) {
        if self.steps == [Vec3::ZERO; 2] || !self.is_crossed() {
            return (self.texel, self.sees_fronts(self.texel.position));
        }
        self.texel.position = self.pushed_out();
        let mut is_valid = self.sees_fronts(self.texel.position);
        if !is_valid {
            let visible = self.quarters().map(|(_, at)| at).find(|&at| self.sees_fronts(at));
            is_valid = visible.is_some();
            self.texel.position = visible.unwrap_or(self.texel.position);
        }
        let from = self.place(self.texel.position);
        let hidden = self.quarters().filter(|&(_, at)| !is_open(self.tracer, &from, &self.place(at)));
        let hidden: u8 = hidden.map(|(k, _)| 1 << k).sum();
        self.texel.quarters = self.texel.quarters & !hidden | CROSSED;
        (self.texel, is_valid)
    }

    fn place(&self, position: Vec3) -> Place {
        Place::new(self.tracer, self.texel.triangle, position)
    }

    fn lifted(&self, position: Vec3) -> Vec3 {
        position + self.flat * self.tracer.world.lift(self.texel.triangle)
    }

    /// The covered quarters, each with the point at its middle.
    fn quarters(&self) -> impl Iterator<Item = (usize, Vec3)> + '_ {
        (0..4).filter(|k| self.texel.quarters >> k & 1 == 1).map(|k| (k, self.at(quarter(k) - Vec2::splat(0.5))))
    }

    /// The point so many texels right of the middle and below.
    fn at(&self, offset: Vec2) -> Vec3 {
        self.middle + self.steps[0] * offset.x + self.steps[1] * offset.y
    }

    /// Whether something stands on one of the diagonals.
    fn is_crossed(&self) -> bool {
        let is_blocked = |way: Vec2| !is_free(self.tracer, self.lifted(self.at(-way)), self.lifted(self.at(way)));
        is_blocked(Vec2::new(HALF, HALF)) || is_blocked(Vec2::new(HALF, -HALF))
    }

    /// Out of what hides the point: a ray along the surface that meets the back of a one-sided wall shows that it lies
    /// behind, and the point goes to the middle of what is free beyond, as Bakery does. A point too close to a wall goes
    /// away from it.
    fn pushed_out(&self) -> Vec3 {
        let position = self.texel.position;
        let arms = [self.steps[0], -self.steps[0], self.steps[1], -self.steps[1]];
        let hits = arms.map(|arm| self.meet(position, arm, HALF));
        let backs = arms.iter().zip(hits).filter_map(|(&arm, (distance, is_back))| is_back.then_some((arm, distance)));
        let beyond = backs.map(|(arm, distance)| (arm, distance, self.beyond(arm, distance)));
        let nearest = beyond.min_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((arm, distance, end)) = nearest {
            return position + arm * (0.5 * (distance + end));
        }
        [0, 1].into_iter().fold(position, |position, axis| {
            let step = self.steps[axis] * CLEARANCE;
            let is_clear = is_free(self.tracer, self.lifted(position - step), self.lifted(position + step));
            let (ahead, behind) = (hits[2 * axis].0, hits[2 * axis + 1].0);
            if is_clear || ahead.min(behind) > 2.0 * CLEARANCE && ahead < HALF {
                position
            } else if ahead < behind {
                position - step
            } else {
                position + step
            }
        })
    }

    /// What an arm meets: how far away, and whether that is the back of a one-sided surface.
    fn meet(&self, position: Vec3, arm: Vec3, end: f32) -> (f32, bool) {
        self.tracer.count(1);
        let ray = self.tracer.leave(self.texel.triangle, position, self.flat, arm, end);
        match self.tracer.nearest(&ray, 0) {
            Some(hit) => (hit.distance, !hit.front && !self.tracer.world.sides[hit.triangle as usize].both),
            None => (end, false),
        }
    }

    /// Where an arm that leaves through a wall meets the next one, or the border of the texel.
    fn beyond(&self, arm: Vec3, distance: f32) -> f32 {
        let start = distance + 4.0 * self.tracer.world.lift(self.texel.triangle) / arm.length();
        let rest = (HALF - start).max(0.0);
        start + self.meet(self.texel.position + arm * start, arm, rest).0.min(rest)
    }

    fn sees_fronts(&self, position: Vec3) -> bool {
        let backs_in = |rays: core::ops::Range<u32>| {
            self.tracer.count(rays.len());
            rays.filter(|&index| self.meets_back(position, index)).count() as f32
        };
        let first = backs_in(0..FIRST_RAYS);
        first == 0.0 || first + backs_in(FIRST_RAYS..ALL_RAYS) <= BACK_FACE_TOLERANCE * ALL_RAYS as f32
    }

    fn meets_back(&self, position: Vec3, index: u32) -> bool {
        let direction = cosine_direction(Sobol::new(self.seed).square(index), self.flat);
        let ray = self.tracer.leave(self.texel.triangle, position, self.flat, direction, f32::INFINITY);
        let hit = self.tracer.nearest(&ray, hash(self.seed, index));
        hit.is_some_and(|hit| !hit.front && !self.tracer.world.sides[hit.triangle as usize].both)
    }
}
