//! Rays in all directions and rays to bright pieces of surface, sharing the work.
//!
//! Each finds a bright piece with a known density, and counts by its share of both: multiple importance sampling with
//! the power heuristic, Veach and Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering",
//! SIGGRAPH 1995. Near pieces are left to rays in all directions, small ones far away to those that look for them.

use core::f32::consts::PI;

use glam::{Vec3, Vec3A};

use super::{Chances, Gather, Seen, Texel};
use crate::geometry::{Hit, Occluders, Sobol};
use crate::light::ShadowRay;
use crate::math;
use crate::transport::Arrival;

/// So many rays in all directions for each to a bright piece.
const RAYS_PER_LOOK: u32 = 4;

/// Squares of distances below this, in square meters, are rounding.
const NEAREST: f32 = 1e-9;

/// From where half of the rays of a node start, and how they share the work.
pub(super) struct Station<'a> {
    texel: &'a Texel,
    /// Normal of its triangle.
    pub flat: Vec3,
    chances: Chances,
    /// Rays in all directions.
    rays: f32,
    /// Rays to bright pieces.
    looks: u32,
}

impl Station<'_> {
    /// The share of a piece that each ray in any direction brings, by the densities with which both ways find the piece,
    /// per square meter.
    fn share_of_rays(&self, by_rays: f32, by_looks: f32) -> f32 {
        let [rays, looks] = [self.rays * by_rays, self.looks as f32 * by_looks];
        if rays > 0.0 && looks > 0.0 { 1.0 / (1.0 + (looks / rays) * (looks / rays)) } else { 1.0 }
    }

    /// The same of all rays to bright pieces, over the density with which one of them finds the piece.
    fn share_of_looks(&self, by_rays: f32, by_looks: f32) -> f32 {
        let [rays, looks] = [self.rays * by_rays, self.looks as f32 * by_looks];
        1.0 / (looks * (1.0 + (rays / looks) * (rays / looks)))
    }

    /// How likely a direction is, where those below the plane of the triangle are mirrored to above: `cos / pi`.
    fn density(&self, direction: Vec3) -> f32 {
        let height = direction.dot(self.flat);
        if height <= 0.0 {
            return 0.0;
        }
        let mirrored = direction - self.flat * (2.0 * height);
        (direction.dot(self.texel.normal).max(0.0) + mirrored.dot(self.texel.normal).max(0.0)) * (1.0 / PI)
    }
}

impl<O: Occluders, C: Fn(Vec3, Option<&Hit>) -> Seen + Sync> Gather<'_, O, C> {
    /// A texel from which so many rays go in all directions.
    pub(super) fn station<'a>(&self, texel: &'a Texel, rays: u32) -> Station<'a> {
        let flat = self.tracer.world.normals[texel.triangle as usize];
        let chances = self.reflectors.chances(texel.position, texel.normal);
        let looks = if chances.is_empty() { 0 } else { (rays / RAYS_PER_LOOK).max(1) };
        Station { texel, flat, chances, rays: rays as f32, looks }
    }

    /// The radiance that a ray in any direction meets: all of what is usual, and its share of what is looked for.
    #[inline]
    pub(super) fn met(&self, from: &Station, (direction, hit): &(Vec3, Option<Hit>), seen: Seen) -> Vec3A {
        let usual = self.radiance[seen.column as usize];
        match hit {
            Some(hit) if self.reflectors.holds(seen.texel) => self.met_bright(from, *direction, hit, seen),
            _ => usual,
        }
    }

    /// The same of a ray that went by way of mirrors and glass. What is bright in a mirror is not looked for: chance must
    /// find it.
    pub(super) fn met_by_way(&self, from: &Station, end: &(Vec3, Option<Hit>), seen: Seen, way: &Arrival) -> Vec3A {
        let met = match way.mirrors {
            0 => self.met(from, end, seen),
            _ if self.reflectors.holds(seen.texel) => self.all_of_bright(seen),
            _ => self.radiance[seen.column as usize],
        };
        met * way.tint
    }

    /// The radiance of a bright texel, whose share of wider columns is taken away from them.
    fn all_of_bright(&self, Seen { column, texel }: Seen) -> Vec3A {
        let own = self.reflectors.column(texel);
        let usual = if own == column { Vec3A::ZERO } else { self.radiance[column as usize] };
        usual + self.radiance[own as usize]
    }

    fn met_bright(&self, from: &Station, direction: Vec3, hit: &Hit, Seen { column, texel }: Seen) -> Vec3A {
        let own = self.reflectors.column(texel);
        let bright = self.radiance[own as usize];
        let usual = if own == column { Vec3A::ZERO } else { self.radiance[column as usize] };
        let away = -direction.dot(self.tracer.world.normals[hit.triangle as usize]);
        let by_rays = from.density(direction) * away / (hit.distance * hit.distance).max(NEAREST);
        let by_looks = self.reflectors.density(&from.chances, texel, bright);
        usual + bright * from.share_of_rays(by_rays, by_looks)
    }

    /// What rays to bright pieces bring: irradiance / pi.
    pub(super) fn looked_for(&self, from: &Station, sequence: &Sobol, place: u32) -> Vec3A {
        let looks = place * from.looks..(place + 1) * from.looks;
        looks.map(|k| self.look_for(from, self.reflectors.choose(&from.chances, sequence.dimension(k, 2)))).sum()
    }

    fn look_for(&self, from: &Station, target: u32) -> Vec3A {
        let Station { texel, flat, .. } = *from;
        let to = &self.texels.list[target as usize];
        let offset = to.position - texel.position;
        let squared = offset.length_squared().max(NEAREST);
        let direction = offset / math::sqrt(squared);
        let away = -direction.dot(self.tracer.world.normals[to.triangle as usize]);
        let by_rays = from.density(direction) * away / squared;
        if by_rays <= 0.0 {
            return Vec3A::ZERO;
        }
        let bright = self.radiance[self.reflectors.column(target) as usize];
        let by_looks = self.reflectors.density(&from.chances, target, bright);
        if by_looks <= 0.0 {
            return Vec3A::ZERO;
        }
        let shadow = ShadowRay { direction: offset, end: 1.0, weight: 1.0 };
        self.tracer.count(1);
        let ray = self.tracer.leave_for(texel.triangle, texel.position, flat, &shadow);
        let share = by_rays * from.share_of_looks(by_rays, by_looks);
        if self.tracer.is_plain {
            return bright * (self.tracer.visibility(&ray) * share);
        }
        bright * Vec3A::from(self.tracer.transmittance(&ray)) * share
    }
}
