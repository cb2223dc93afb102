//! Light that goes on: reflected in mirrors, straight through glass.

use core::cell::Cell;

use glam::{Vec3, Vec3A};

use super::{LARGEST_REFLECTANCE, Tracer, through};
use crate::geometry::{Hit, Occluders, Ray, hash};
use crate::light::{PlaneMirror, ShadowRay};

/// After so many mirrors a ray counts as absorbed. What is lost is at most the product of their reflectances.
const MOST_MIRRORS: u32 = 64;
/// A ray that keeps less than this in each channel counts as absorbed.
const LEAST_TINT: f32 = 1.0 / 256.0;

/// A ray that goes by way of mirrors and glass counts in so many parts.
pub const PARTS: u32 = 8;

/// What a ray comes to in the end, by way of mirrors and glass.
///
/// A ray that meets a mirror goes on reflected; one that meets glass, or passes what is blended, goes straight on. Each
/// time it keeps the share of its light that the [`material`](crate::material) says. What that takes is absorbed, and
/// counted as such. After 64 mirrors, of which each keeps at most 98 %, or with less than 1/256 of its light in each
/// channel, the rest counts as absorbed too.
///
/// Left out of a bake are
/// - refraction: glass of any shape casts a straight colored shadow and no caustic;
/// - the few percent of light that clear glass and varnish reflect, and what rough metal reflects at all;
/// - that matt glass scatters what it lets through: it is taken for clear;
/// - lamps in curved mirrors, in mirrors with less than a 64th of the area of all, and by way of several mirrors: a lamp
///   lights by way of one [`PlaneMirror`]. The light of all bounces, of the sky, and of emissive surfaces that are no
///   lamps because they are a quarter of all surfaces, comes by way of all mirrors.
///
/// [`scatter`](crate::scatter) has surfaces that refract and shine, which the paths of light of `render::path` follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// What it meets; the distance is that along all of its way.
    pub hit: Option<Hit>,
    /// The share of the light that is left, for each channel.
    pub tint: Vec3A,
    /// Where it goes in the end.
    pub direction: Vec3,
    /// Mirrors on the way.
    pub mirrors: u32,
}

impl Arrival {
    /// The columns, of so many, on which the [`PARTS`] of a ray end that sees a column: each part keeps a channel whole or
    /// not at all, as many of them as the share that is left, by a number in `[0, 1)`.
    pub fn columns(&self, column: u32, [columns, black]: [u32; 2], number: f32) -> impl Iterator<Item = u32> + use<> {
        let tint = self.tint;
        (0..PARTS).map(move |part| match tint.cmpgt(Vec3A::splat((part as f32 + number) / PARTS as f32)).bitmask() {
            0 => black,
            channels => through(channels, column, columns),
        })
    }
}

/// What glass makes of light along a straight line. The order in which it is met does not matter.
struct Passed {
    tint: Vec3,
    /// Optical depth in bodies of glass, where light that is inside at the end is counted from its start.
    depth: Vec3,
    /// Absorption of the bodies that were entered and not left.
    inside: Vec3,
}

impl Passed {
    const ALL: Self = Self { tint: Vec3::ONE, depth: Vec3::ZERO, inside: Vec3::ZERO };

    /// Crosses the border of a body, at a distance in meters.
    fn cross(&mut self, absorption: Vec3, distance: f32, enters: bool) {
        let sign = if enters { 1.0 } else { -1.0 };
        self.inside += absorption * sign;
        self.depth -= absorption * (sign * distance);
    }

    /// The share of the light that is left after a way of this length in meters.
    fn share(&self, distance: f32) -> Vec3 {
        let inside = if distance.is_finite() { self.inside.max(Vec3::ZERO) * distance } else { Vec3::ZERO };
        let depth = (self.depth + inside).max(Vec3::ZERO);
        if depth == Vec3::ZERO { self.tint } else { self.tint * depth.map(|depth| crate::math::exp(-depth)) }
    }
}

impl<O: Occluders> Tracer<'_, O> {
    /// What a ray comes to by way of mirrors and glass; `seed` decides what it meets of what lets a share of light pass.
    pub fn follow(&self, ray: &Ray, seed: u32) -> Arrival {
        let (mut ray, mut tint, mut way) = (*ray, Vec3::ONE, 0.0);
        for mirrors in 0..MOST_MIRRORS {
            let (hit, passed) = self.nearest_tinted(&ray, hash(seed, mirrors));
            tint *= passed;
            let arrival = |hit| Arrival { hit, tint: tint.into(), direction: ray.direction, mirrors };
            let Some(hit) = hit else { return arrival(None) };
            let whole = Hit { distance: way + hit.distance, ..hit };
            let Some(reflected) = self.world.mirror(&hit) else { return arrival(Some(whole)) };
            tint *= reflected.min(Vec3::splat(LARGEST_REFLECTANCE));
            if tint.max_element() < LEAST_TINT {
                break;
            }
            way += hit.distance;
            ray = self.world.reflected(&ray, &hit);
        }
        Arrival { hit: None, tint: Vec3A::ZERO, direction: ray.direction, mirrors: MOST_MIRRORS }
    }

    /// The nearest hit, see [`Tracer::nearest`], and what light that gets there keeps of the light that passes.
    pub fn nearest_tinted(&self, ray: &Ray, seed: u32) -> (Option<Hit>, Vec3) {
        let passes = Cell::new(false);
        let hit = self
            .nearest_but(ray, seed, |hit| passes.set(passes.get() | self.world.sides[hit.triangle as usize].filters));
        let end = hit.map_or(ray.end, |hit| hit.distance);
        let tint = if passes.get() { self.tint(&Ray { end, ..*ray }, hit) } else { Vec3::ONE };
        (hit, tint)
    }

    /// What light keeps that passes all that lies on a ray, given that it passes.
    fn tint(&self, ray: &Ray, end: Option<Hit>) -> Vec3 {
        let (mut passed, length) = (Passed::ALL, ray.direction.length());
        self.occluders.any(ray, |hit| {
            if end.is_none_or(|end| end.triangle != hit.triangle) && self.world.sides[hit.triangle as usize].filters {
                self.pass(&mut passed, hit, length);
                passed.tint /= (1.0 - self.world.opacity(hit)).max(f32::MIN_POSITIVE);
            }
            false
        });
        passed.share(ray.end * length).min(Vec3::ONE)
    }

    fn pass(&self, passed: &mut Passed, hit: &Hit, length: f32) {
        passed.tint *= self.world.filter(hit);
        if let Some(absorption) = self.world.absorption(hit) {
            passed.cross(absorption, hit.distance * length, hit.front);
        }
    }

    /// The share of light that passes along a ray straight on, for each channel, in `[0, 1]`.
    pub fn transmittance(&self, ray: &Ray) -> Vec3 {
        if !self.filters {
            return Vec3::splat(self.visibility(ray));
        }
        let (mut passed, length) = (Passed::ALL, ray.direction.length());
        let blocked = self.occluders.any(ray, |hit| {
            self.pass(&mut passed, hit, length);
            passed.tint == Vec3::ZERO
        });
        if blocked { Vec3::ZERO } else { passed.share(ray.end * length) }
    }

    /// The share of light that gets from a light to a point of a triangle, for each channel, in `[0, 1]`: straight, or by
    /// way of the mirror behind which the light is seen.
    pub fn arriving(
        &self,
        (triangle, point, normal): (u32, Vec3, Vec3),
        light: &ShadowRay,
        mirror: Option<&PlaneMirror>,
    ) -> Vec3 {
        match mirror {
            None => self.transmittance(&self.leave_for(triangle, point, normal, light)),
            Some(mirror) => self.shown_by(mirror, &self.leave(triangle, point, normal, light.direction, light.end)),
        }
    }

    /// The share that arrives of light at the end of a ray, where that is the image of a light behind a mirror.
    pub fn shown_by(&self, mirror: &PlaneMirror, ray: &Ray) -> Vec3 {
        self.by_way_of(mirror, ray).unwrap_or(Vec3::ZERO)
    }

    /// Nothing where the mirror does not show the light.
    fn by_way_of(&self, mirror: &PlaneMirror, ray: &Ray) -> Option<Vec3> {
        let along = mirror.height(ray.origin) / -ray.direction.dot(mirror.normal);
        let at = ray.origin + ray.direction * along;
        // The light lies behind the mirror, the point before it.
        let slack = Vec3::splat(1e-3);
        let is_in_box = at.cmpge(mirror.low - slack).all() && at.cmple(mirror.high + slack).all();
        if !(mirror.height(ray.origin) > 0.0 && along > 0.0 && along < ray.end && is_in_box) {
            return None;
        }
        let (tint, hit) = self.onto(mirror, &Ray { end: along, ..*ray })?;
        let rest = ShadowRay {
            direction: mirror.image_of_direction(ray.direction)
                * if ray.end.is_finite() { ray.end - along } else { 1.0 },
            end: if ray.end.is_finite() { 1.0 } else { f32::INFINITY },
            weight: 1.0,
        };
        Some(tint * self.transmittance(&self.leave_for(hit.triangle, at, mirror.normal, &rest)))
    }

    /// What is left of light that a mirror sends along a ray to its start, and where on the mirror it comes from.
    fn onto(&self, mirror: &PlaneMirror, ray: &Ray) -> Option<(Vec3, Hit)> {
        let slack = 1e-3 / ray.direction.length();
        let (mut passed, mut met, length) = (Passed::ALL, None, ray.direction.length());
        let blocked = self.occluders.any(&Ray { end: ray.end + slack, ..*ray }, |hit| {
            let is_of_mirror = self.world.mirror_of.get(hit.triangle as usize) == Some(&mirror.number);
            match self.world.mirror(hit).filter(|_| is_of_mirror) {
                Some(tint) => met = Some((tint * self.world.opacity(hit), *hit)),
                None if hit.distance < ray.end - slack => self.pass(&mut passed, hit, length),
                None => {}
            }
            passed.tint == Vec3::ZERO
        });
        let (tint, hit) = met.filter(|_| !blocked)?;
        Some((tint.min(Vec3::splat(LARGEST_REFLECTANCE)) * passed.share(ray.end * length), hit))
    }
}
