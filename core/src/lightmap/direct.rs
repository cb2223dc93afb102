//! Light that reaches a texel straight from a source: closed forms times the visible share.

use alloc::vec::Vec;
use core::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::samples::Samples;
use super::{Texel, Texels, quarter};
use crate::geometry::{Occluders, Sobol, hash};
use crate::light::DirectLight;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::transport::Tracer;

/// How many shadow rays a texel gets for one light. Powers of two are best.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShadowRays {
    /// For every texel, for a light with an extent; a light without needs one.
    pub first: u32,
    /// Where those, or those of a neighbor, disagree: at the border of shadows, for a light without extent.
    pub sharp: u32,
    /// The same for a light with an extent: in penumbrae.
    pub penumbra: u32,
}

/// The light arrives from below the surface: no shadow ray was sent.
const UNLIT: f32 = -1.0;
/// No texel gets more shadow rays than this for one light.
const MOST_RAYS: u32 = 1024;

/// Direct light of a texel, and how far it may be off.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DirectTexel {
    /// Irradiance / pi, in cd/m2.
    pub irradiance: Vec3,
    /// How far that may be off.
    pub error: DirectError,
}

/// How far the direct light of a texel may be off. Irradiance / pi is meant, the mean of its channels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DirectError {
    /// Variance of the value that was found around the mean over the texel, because rays are few: penumbrae.
    pub noise: f32,
    /// Variance of the light within the texel, because an edge of a shadow crosses it: what a lookup at a random point
    /// of the texel misses. No rays make it smaller, only more texels.
    pub spread: f32,
    /// The least light within the texel: with the mean `m` the light is about this in a share `spread / (spread +
    /// (m - darkest)^2)` of the texel and `m + spread / (m - darkest)` in the rest.
    pub darkest: f32,
}

impl DirectTexel {
    /// The same light from a lamp of another strength.
    pub fn times(&self, strength: Vec3) -> Self {
        let irradiance = self.irradiance * strength;
        let level = self.irradiance.element_sum();
        let factor = if level > 0.0 { irradiance.element_sum() / level } else { 0.0 };
        let DirectError { noise, spread, darkest } = self.error;
        let squared = factor * factor;
        let error = DirectError { noise: noise * squared, spread: spread * squared, darkest: darkest * factor };
        Self { irradiance, error }
    }
}

impl core::ops::AddAssign for DirectError {
    /// Errors of different lamps do not depend on each other; edges of their shadows lie in different places.
    fn add_assign(&mut self, other: Self) {
        self.noise += other.noise;
        self.spread += other.spread;
        self.darkest += other.darkest;
    }
}

/// All that direct light needs to know.
pub struct Direct<'a, O> {
    /// The receivers.
    pub texels: &'a Texels,
    /// Which texels count.
    pub is_valid: &'a [bool],
    /// Asks for visibility.
    pub tracer: &'a Tracer<'a, O>,
    /// How often.
    pub rays: ShadowRays,
    /// Of all random decisions.
    pub seed: u32,
}

impl<O: Occluders> Direct<'_, O> {
    /// Light from one lamp for each texel, zero for those that are not valid.
    pub fn light(
        &self,
        light: &DirectLight,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<Vec<DirectTexel>, Cancelled> {
        let count = self.texels.list.len();
        let shares =
            workers.map(count, 512, progress, |range| range.map(|index| self.first_look(light, index)).collect())?;
        let light_of = |index: usize| {
            let share = shares[index];
            if share == UNLIT && !self.has_lit_neighbor(index, &shares) {
                DirectTexel::default()
            } else if self.is_border(index, &shares) {
                self.second_look(light, index)
            } else {
                let Texel { position, normal, .. } = self.texels.list[index];
                certain(light.irradiance(position, normal) * share.max(0.0))
            }
        };
        workers.map(count, 512, progress, |range| range.map(light_of).collect())
    }

    /// The visible share of the light from the middle of a texel, by few rays, or [`UNLIT`].
    fn first_look(&self, light: &DirectLight, index: usize) -> f32 {
        let Texel { position, normal, .. } = self.texels.list[index];
        if !self.is_valid[index] || light.irradiance(position, normal) == Vec3::ZERO {
            return UNLIT;
        }
        let rays = if light.is_sharp() { 1 } else { self.rays.first };
        let sequence = Sobol::new(hash(self.seed, index as u32));
        self.samples(light, index, rays, &sequence, |_| position).mean()
    }

    /// Light by many rays from all over a texel.
    fn second_look(&self, light: &DirectLight, index: usize) -> DirectTexel {
        let texel = &self.texels.list[index];
        let points = Footprint::new(texel, self.texels, self.tracer);
        let sequence = Sobol::new(hash(self.seed, index as u32));
        if light.is_sharp() {
            self.sharp(light, index, &points, &sequence)
        } else {
            let place = |k| points.point(&sequence, k, 2);
            let samples = self.samples(light, index, self.rays.penumbra.min(MOST_RAYS), &sequence, place);
            let DirectTexel { irradiance, .. } = certain(light.irradiance(texel.position, texel.normal));
            let (share, level) = (samples.mean(), irradiance.element_sum() / 3.0);
            let error = DirectError { noise: level * level * samples.variance(), spread: 0.0, darkest: level * share };
            DirectTexel { irradiance: irradiance * share, error }
        }
    }

    /// Light from a lamp without extent, by rays from all over a texel.
    fn sharp(&self, light: &DirectLight, index: usize, points: &Footprint, sequence: &Sobol) -> DirectTexel {
        let texel = &self.texels.list[index];
        let rays = self.rays.sharp.min(MOST_RAYS);
        let (mut sum, mut levels) = (Vec3::ZERO, Samples::new(rays));
        for k in 0..rays {
            let point = points.point(sequence, k, 0);
            let share = self.samples(light, index, 1, sequence, |_| point).mean();
            let lit = light.irradiance(point, texel.normal) * (share / PI);
            sum += lit;
            levels.put(sequence.square(k), 1.0, lit.element_sum() / 3.0);
        }
        let error = DirectError { noise: levels.variance(), spread: levels.spread(), darkest: levels.least() };
        DirectTexel { irradiance: sum / rays as f32, error }
    }

    /// What rays to points of the light find, each with its weight.
    fn samples(
        &self,
        light: &DirectLight,
        index: usize,
        rays: u32,
        sequence: &Sobol,
        point: impl Fn(u32) -> Vec3,
    ) -> Samples {
        let texel = &self.texels.list[index];
        let flat = self.tracer.world.normals[texel.triangle as usize];
        let mut samples = Samples::new(rays);
        for k in 0..rays {
            let (from, square) = (point(k), sequence.square(k));
            let ray = light.shadow_ray(square, from, texel.normal);
            let weight = ray.weight.max(0.0);
            let is_above = weight > 0.0 && ray.direction.dot(flat) > 0.0;
            let visibility = if is_above {
                self.tracer.count(1);
                self.tracer.visibility(&self.tracer.leave_for(texel.triangle, from, flat, &ray))
            } else {
                0.0
            };
            samples.put(square, weight, weight * visibility);
        }
        samples
    }

    /// Whether a shadow ends in or beside this texel.
    fn is_border(&self, index: usize, shares: &[f32]) -> bool {
        let own = shares[index];
        (own > 0.0 && own < 1.0) || self.neighbors(index).any(|other| shares[other] != own)
    }

    fn has_lit_neighbor(&self, index: usize, shares: &[f32]) -> bool {
        self.is_valid[index] && self.neighbors(index).any(|other| shares[other] != UNLIT)
    }

    /// The valid texels of the same chart among the eight around a texel.
    fn neighbors(&self, index: usize) -> impl Iterator<Item = usize> + '_ {
        let Texel { pixel: [x, y], image, chart, .. } = self.texels.list[index];
        (0..9).filter(|&k| k != 4).filter_map(move |k| {
            let (x, y) = (i32::from(x) + k % 3 - 1, i32::from(y) + k / 3 - 1);
            let other = self.texels.at_pixel(u32::from(image), x, y)? as usize;
            (self.texels.list[other].chart == chart && self.is_valid[other]).then_some(other)
        })
    }
}

/// Light without doubt.
fn certain(irradiance: Vec3) -> DirectTexel {
    let irradiance = irradiance / PI;
    let error = DirectError { darkest: irradiance.element_sum() / 3.0, ..DirectError::default() };
    DirectTexel { irradiance, error }
}

/// The points of a texel from which light is looked for.
struct Footprint {
    center: Vec3,
    steps: [Vec3; 2],
    /// Centers of the covered quarters, as offsets from the center of the texel.
    quarters: [Vec2; 4],
    covered: usize,
}

impl Footprint {
    fn new<O: Occluders>(texel: &Texel, texels: &Texels, tracer: &Tracer<O>) -> Self {
        let mut footprint = Self {
            center: texel.position,
            steps: texels.steps(tracer.world, texel.triangle),
            quarters: [Vec2::ZERO; 4],
            covered: 0,
        };
        for k in (0..4).filter(|k| texel.quarters >> k & 1 == 1) {
            footprint.quarters[footprint.covered] = quarter(k) - Vec2::splat(0.5);
            footprint.covered += 1;
        }
        footprint
    }

    /// Point `k`: all over a texel that is covered, else one of the middles of its covered quarters, else its own.
    /// Two dimensions of the sequence are used, from `dimension` on.
    fn point(&self, sequence: &Sobol, k: u32, dimension: usize) -> Vec3 {
        let offset = match self.covered {
            4 => Vec2::new(sequence.dimension(k, dimension), sequence.dimension(k, dimension + 1)) - Vec2::splat(0.5),
            0 => Vec2::ZERO,
            covered => self.quarters[k as usize % covered],
        };
        self.center + self.steps[0] * offset.x + self.steps[1] * offset.y
    }
}
