//! Light that reaches a texel straight from a source: closed forms times the visible share.

use alloc::vec::Vec;
use core::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::{ALL_QUARTERS, Texel, Texels, quarter};
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
    /// Irradiance / pi from one light for each texel, zero for those that are not valid.
    pub fn light(&self, light: &DirectLight, workers: &Workers, progress: &Progress) -> Result<Vec<Vec3>, Cancelled> {
        let count = self.texels.list.len();
        let shares =
            workers.map(count, 512, progress, |range| range.map(|index| self.first_look(light, index)).collect())?;
        let light_of = |index: usize| {
            let share = shares[index];
            if share == UNLIT && !self.has_lit_neighbor(index, &shares) {
                Vec3::ZERO
            } else if self.is_border(index, &shares) {
                self.second_look(light, index)
            } else {
                let Texel { position, normal, .. } = self.texels.list[index];
                light.irradiance(position, normal) * share.max(0.0)
            }
        };
        workers.map(count, 512, progress, |range| range.map(|index| light_of(index) / PI).collect())
    }

    /// The visible share of the light from the middle of a texel, by few rays, or [`UNLIT`].
    fn first_look(&self, light: &DirectLight, index: usize) -> f32 {
        let Texel { position, normal, .. } = self.texels.list[index];
        if !self.is_valid[index] || light.irradiance(position, normal) == Vec3::ZERO {
            return UNLIT;
        }
        let rays = if light.is_sharp() { 1 } else { self.rays.first };
        let sequence = Sobol::new(hash(self.seed, index as u32));
        self.share(light, index, rays, &sequence, |_| position)
    }

    /// Irradiance by many rays from all over a texel.
    fn second_look(&self, light: &DirectLight, index: usize) -> Vec3 {
        let texel = &self.texels.list[index];
        let points = Footprint::new(texel, self.texels, self.tracer);
        let sequence = Sobol::new(hash(self.seed, index as u32));
        if light.is_sharp() {
            let rays = self.rays.sharp;
            let lit = |k: u32| {
                let point = points.point(&sequence, k);
                let share = self.share(light, index, 1, &sequence, |_| point);
                light.irradiance(point, texel.normal) * share
            };
            return (0..rays).map(lit).sum::<Vec3>() / rays as f32;
        }
        let share = self.share(light, index, self.rays.penumbra, &sequence, |k| points.point(&sequence, k));
        light.irradiance(texel.position, texel.normal) * share
    }

    /// Visible share of the light: the weights of the rays that arrive over the weights of all.
    fn share(
        &self,
        light: &DirectLight,
        index: usize,
        rays: u32,
        sequence: &Sobol,
        point: impl Fn(u32) -> Vec3,
    ) -> f32 {
        let texel = &self.texels.list[index];
        let flat = self.tracer.world.normals[texel.triangle as usize];
        let (mut all, mut arrived) = (0.0, 0.0);
        for k in 0..rays {
            let from = point(k);
            let ray = light.shadow_ray(sequence.square(k), from, texel.normal);
            if ray.weight > 0.0 && ray.direction.dot(flat) > 0.0 {
                let visibility = self.tracer.visibility(&self.tracer.leave_for(texel.triangle, from, flat, &ray));
                arrived += ray.weight * visibility;
                self.tracer.count(1);
            }
            all += ray.weight.max(0.0);
        }
        if all > 0.0 { arrived / all } else { 0.0 }
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

/// The share of a texel's sides over which points lie: none lies in a wall on its border.
const INSIDE: f32 = 0.98;

/// The points of a texel from which light is looked for.
struct Footprint {
    position: Vec3,
    middle: Vec3,
    steps: [Vec3; 2],
    /// Centers of the visible quarters, as offsets from the middle of the texel.
    quarters: [Vec2; 4],
    visible: usize,
    /// Whether all of the texel is covered and nothing stands in it.
    is_whole: bool,
}

impl Footprint {
    fn new<O: Occluders>(texel: &Texel, texels: &Texels, tracer: &Tracer<O>) -> Self {
        let mut footprint = Self {
            position: texel.position,
            middle: texels.middle(tracer.world, texel),
            steps: texels.steps(tracer.world, texel.triangle),
            quarters: [Vec2::ZERO; 4],
            visible: 0,
            is_whole: texel.quarters == ALL_QUARTERS,
        };
        for k in (0..4).filter(|k| texel.quarters >> k & 1 == 1) {
            footprint.quarters[footprint.visible] = quarter(k) - Vec2::splat(0.5);
            footprint.visible += 1;
        }
        footprint
    }

    /// Point `k`: all over a texel that is whole, else one of the middles of its visible quarters, else its own.
    fn point(&self, sequence: &Sobol, k: u32) -> Vec3 {
        let offset = match self.visible {
            0 => return self.position,
            _ if self.is_whole => (Vec2::new(sequence.dimension(k, 2), sequence.dimension(k, 3)) - 0.5) * INSIDE,
            visible => self.quarters[k as usize % visible],
        };
        self.middle + self.steps[0] * offset.x + self.steps[1] * offset.y
    }
}
