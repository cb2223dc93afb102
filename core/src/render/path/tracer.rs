//! One path after the other.

use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use super::emitters::Emitters;
use super::numbers::Numbers;
use super::{Diffuse, Estimate, Optics};
use crate::geometry::{Hit, Occluders, Ray, hash, lift, normal_and_area, tangents};
use crate::light::{DirectLight, PlaneMirror, ShadowRay};
use crate::scatter::{Colored, Density, Lambert, Scatter};
use crate::scene::World;
use crate::transport::Tracer;

/// Paths whose mean is one value of an [`Estimate`]: so many are spread evenly, those of other values independently.
pub const PATHS: u32 = 16;
/// From so many bounces on a path may end.
const SURE: u32 = 3;
/// A path goes on with this probability at most.
const MOST_SURE: f32 = 0.95;

/// A lamp that no path can meet.
#[derive(Clone, Debug)]
pub struct PathLamp<S> {
    /// With strength 1 in all channels.
    pub light: DirectLight,
    /// In the unit of [`LightSource::strength`](crate::light::LightSource::strength).
    pub strength: S,
    /// The mirror behind which it stands, where it is the image of a lamp.
    pub mirror: Option<PlaneMirror>,
}

/// Follows paths of light through a scene.
pub struct PathTracer<S, O> {
    pub(super) optics: O,
    lamps: Vec<PathLamp<S>>,
    emitters: Emitters,
    sky_is_asked: bool,
}

/// A place on a surface, lit from the side of its normal.
struct Vertex<T> {
    point: Vec3,
    normal: Vec3,
    lift: f32,
    scatter: T,
    /// Towards the eye, in the frame of the surface.
    departure: Vec3,
}

impl<T> Vertex<T> {
    fn to_local(&self, direction: Vec3) -> Vec3 {
        let (tangent, bitangent) = tangents(self.normal);
        Vec3::new(direction.dot(tangent), direction.dot(bitangent), direction.dot(self.normal))
    }

    fn to_world(&self, direction: Vec3) -> Vec3 {
        let (tangent, bitangent) = tangents(self.normal);
        tangent * direction.x + bitangent * direction.y + self.normal * direction.z
    }

    /// A ray into the side that a direction shows to.
    fn leave(&self, direction: Vec3) -> Ray {
        let side = self.lift.copysign(direction.dot(self.normal));
        Ray { origin: self.point + self.normal * side, direction, end: f32::INFINITY }
    }

    /// A ray that ends just before a light.
    fn leave_for(&self, light: &ShadowRay) -> Ray {
        let ray = self.leave(light.direction);
        if light.end == f32::INFINITY {
            return ray;
        }
        let direction = self.point + light.direction - ray.origin;
        let slack = (2.0 * self.lift / direction.length()).max(1e-4);
        Ray { direction, end: light.end - slack, ..ray }
    }
}

impl<'a, O: Occluders> PathTracer<Vec3, Diffuse<'a, O>> {
    /// The scene of a world as its bake takes it, with all its lamps and what plane mirrors show of them; `occluders`
    /// holds the triangles that block light.
    pub fn diffuse(world: &'a World<'a>, occluders: O) -> Self {
        Self::new(Diffuse::new(Tracer::new(world, occluders)), lamps_of(world))
    }

    /// The same with the gloss that Bevy draws and no lightmap has.
    pub fn glossy(world: &'a World<'a>, occluders: O) -> Self {
        Self::new(Diffuse::with_gloss(Tracer::new(world, occluders)), lamps_of(world))
    }
}

/// All lamps of a world and what plane mirrors show of them.
fn lamps_of(world: &World) -> Vec<PathLamp<Vec3>> {
    let lamps = world.scene.lights.iter().flat_map(|light| {
        let (itself, strength) = ((&light.source.with_strength(Vec3::ONE)).into(), light.source.strength());
        let images = world.mirrors.iter().filter_map(|mirror| Some((mirror.image_of(&itself)?, Some(*mirror))));
        let all: Vec<_> = [(itself.clone(), None)].into_iter().chain(images).collect();
        all.into_iter().map(move |(light, mirror)| PathLamp { light, strength, mirror })
    });
    lamps.collect()
}

impl<S: Colored, O: Optics<S>> PathTracer<S, O> {
    /// Of surfaces, surroundings and lamps.
    pub fn new(optics: O, lamps: Vec<PathLamp<S>>) -> Self {
        let (emitters, sky_is_asked) = (Emitters::new(&optics), optics.toward_sky(Vec2::splat(0.5)).is_some());
        Self { optics, lamps, emitters, sky_is_asked }
    }

    /// Irradiance / pi that a point of a triangle receives on the side of a normal of length 1, from so many values of
    /// [`PATHS`] paths each.
    pub fn received(&self, hit: &Hit, normal: Vec3, values: u32, seed: u32) -> Estimate<S> {
        let corners = self.optics.corners()[hit.triangle as usize];
        let (scatter, departure) = (Lambert { reflectance: S::splat(1.0) }, Vec3::Z);
        let at = Vertex { point: hit.interpolate(corners), normal, lift: lift(&corners), scatter, departure };
        let mut estimate = Estimate::default();
        for value in 0..values {
            estimate.add(self.mean(hash(seed, value), |numbers, _| self.scattered(&at, numbers)));
        }
        estimate
    }

    /// The mean of [`PATHS`] paths.
    pub(super) fn mean(&self, seed: u32, path: impl Fn(&mut Numbers, u32) -> S) -> S {
        let mut sum = S::default();
        (0..PATHS).for_each(|index| sum += path(&mut Numbers::new(seed, index), index));
        sum * (1.0 / PATHS as f32)
    }

    /// Radiance that arrives along a ray from the eye, which sees through the backs of what has only a front.
    pub(super) fn seen(&self, mut ray: Ray, numbers: &mut Numbers) -> S {
        let mut left = S::splat(1.0);
        loop {
            let (hit, passed) = self.optics.nearest(&ray, numbers.seed());
            left = left * passed;
            let Some(hit) = hit else { return left * self.optics.sky(ray.direction) };
            let at = self.vertex(&hit, ray.direction);
            let shows = at.departure.z > 0.0 || at.scatter.sample(at.departure, Vec3::splat(0.5)).is_some();
            if shows {
                return left * (self.emitted(&hit) + self.scattered(&at, numbers));
            }
            ray = at.leave(ray.direction);
        }
    }

    /// Where a ray meets a surface; the normal is that of the back where the back is as the front.
    fn vertex(&self, hit: &Hit, direction: Vec3) -> Vertex<O::Scatter> {
        let (front, scatter) = self.optics.surface(hit);
        let turned = !hit.front && self.optics.both_sides(hit.triangle);
        let corners = &self.optics.corners()[hit.triangle as usize];
        // Where a smooth normal looks away from a side that is seen, the flat one counts.
        let looks_away = (front.dot(direction) > 0.0) == hit.front;
        let front = normal_and_area(corners).filter(|_| looks_away).map_or(front, |(flat, _)| flat);
        let normal = if turned { -front } else { front };
        let (point, lift, departure) = (hit.interpolate(*corners), lift(corners), Vec3::ZERO);
        let at = Vertex { point, normal, lift, scatter, departure };
        Vertex { departure: at.to_local(-direction.normalize()), ..at }
    }

    /// What a surface emits at a hit towards where the ray came from.
    fn emitted(&self, hit: &Hit) -> S {
        if hit.front || self.optics.both_sides(hit.triangle) { self.optics.emission(hit) } else { S::default() }
    }

    /// Radiance that leaves a surface, without what it emits.
    fn scattered<T: Scatter<S>>(&self, at: &Vertex<T>, numbers: &mut Numbers) -> S {
        let mut sum = self.asked_for(at, numbers);
        let Some((mut step, mut next)) = self.go_on(at, S::splat(1.0), numbers, &mut sum) else { return sum };
        for bounce in 1.. {
            sum += step * self.asked_for(&next, numbers);
            let sure = if bounce < SURE { 1.0 } else { step.max_abs().min(MOST_SURE) };
            if numbers.next().1 >= sure {
                break;
            }
            let Some(further) = self.go_on(&next, step * (1.0 / sure), numbers, &mut sum) else { break };
            (step, next) = further;
        }
        sum
    }

    /// Light from a lamp, a point of what emits, and a direction of the sky.
    fn asked_for<T: Scatter<S>>(&self, at: &Vertex<T>, numbers: &mut Numbers) -> S {
        self.of_lamps(at, numbers) + self.of_emitters(at, numbers) + self.of_sky(at, numbers)
    }

    /// The next place of a path and what light from there is multiplied by; adds what is emitted there, or the sky.
    fn go_on<T: Scatter<S>>(
        &self,
        at: &Vertex<T>,
        weight: S,
        numbers: &mut Numbers,
        sum: &mut S,
    ) -> Option<(S, Vertex<O::Scatter>)> {
        let scattered = at.scatter.sample(at.departure, numbers.next().0)?;
        let direction = at.to_world(scattered.arrival).normalize();
        let mut weight = weight * scattered.weight;
        let (hit, passed) = self.optics.nearest(&at.leave(direction), numbers.seed());
        weight = weight * passed;
        let Some(hit) = hit else {
            let share = share_of_both(scattered.density, || self.optics.density_of_sky(direction));
            *sum += weight * self.optics.sky(direction) * share;
            return None;
        };
        let next = self.vertex(&hit, direction);
        if next.departure.z < 0.0 {
            weight = weight * next.scatter.transmittance(hit.distance);
        }
        let share = share_of_both(scattered.density, || self.density_of_emitters(&hit, at.point, direction));
        *sum += weight * self.emitted(&hit) * share;
        Some((weight, next))
    }

    /// The density, in 1/sr, with which emitters are asked in the direction of a hit.
    fn density_of_emitters(&self, hit: &Hit, point: Vec3, direction: Vec3) -> f32 {
        let corners = self.optics.corners()[hit.triangle as usize];
        let density = self.emitters.density(hit.triangle);
        let Some((normal, _)) = normal_and_area(&corners).filter(|_| density > 0.0) else { return 0.0 };
        let squared = hit.interpolate(corners).distance_squared(point);
        density * squared / normal.dot(direction).abs().max(f32::MIN_POSITIVE)
    }

    /// Light from a point of what emits, weighed against that which the surface would have met by itself.
    fn of_emitters<T: Scatter<S>>(&self, at: &Vertex<T>, numbers: &mut Numbers) -> S {
        let Some(mut hit) = self.emitters.point(numbers.next().0) else { return S::default() };
        let corners = self.optics.corners()[hit.triangle as usize];
        let Some((normal, _)) = normal_and_area(&corners) else { return S::default() };
        let way = hit.interpolate(corners) - at.point;
        let direction = way.normalize_or_zero();
        hit.front = normal.dot(direction) < 0.0;
        let arrival = at.to_local(direction);
        let light = self.emitted(&hit) * at.scatter.evaluate(arrival, at.departure);
        if light.max_abs() == 0.0 {
            return S::default();
        }
        let ray = at.leave_for(&ShadowRay { direction: way, end: 1.0, weight: 1.0 });
        let passes = self.optics.visibility(&ray) * self.optics.opacity(&hit);
        let density = self.density_of_emitters(&hit, at.point, direction);
        light * passes * (arrival.z.abs() / (density + at.scatter.density(arrival, at.departure)))
    }

    /// Light from a direction of the sky, weighed against that which the surface would have met by itself.
    fn of_sky<T: Scatter<S>>(&self, at: &Vertex<T>, numbers: &mut Numbers) -> S {
        let Some(direction) = self.sky_is_asked.then(|| self.optics.toward_sky(numbers.next().0.truncate())).flatten()
        else {
            return S::default();
        };
        let arrival = at.to_local(direction);
        let light = self.optics.sky(direction) * at.scatter.evaluate(arrival, at.departure);
        if light.max_abs() == 0.0 {
            return S::default();
        }
        let density = self.optics.density_of_sky(direction) + at.scatter.density(arrival, at.departure);
        light * self.optics.visibility(&at.leave(direction)) * (arrival.z.abs() / density)
    }

    /// Light from one lamp, chosen by what all of them would give with nothing between.
    fn of_lamps<T: Scatter<S>>(&self, at: &Vertex<T>, numbers: &mut Numbers) -> S {
        if self.lamps.is_empty() || at.departure.z <= 0.0 {
            return S::default();
        }
        let level = |lamp: &PathLamp<S>| lamp.light.irradiance(at.point, at.normal).x * lamp.strength.max_abs();
        let whole: f32 = self.lamps.iter().map(level).sum();
        let (numbers, number) = numbers.next();
        let mut rest = number * whole;
        let mut levels = self.lamps.iter().map(|lamp| (lamp, level(lamp))).filter(|(_, level)| *level > 0.0);
        let chosen = levels.find(|(_, level)| {
            rest -= level;
            rest < 0.0
        });
        let Some((lamp, level)) = chosen else { return S::default() };
        let (ray, irradiance) = lamp.light.shadow_sample(numbers, at.point, at.normal);
        let arrival = at.to_local(ray.direction.normalize_or_zero());
        let scattered = at.scatter.evaluate(arrival, at.departure) * (irradiance.x * whole / level);
        if scattered.max_abs() == 0.0 {
            return S::default();
        }
        lamp.strength
            * scattered
            * match &lamp.mirror {
                None => self.optics.visibility(&at.leave_for(&ray)),
                Some(mirror) => self.optics.shown_by(mirror, &Ray { end: ray.end, ..at.leave(ray.direction) }),
            }
    }
}

/// The share of light that a surface meets by itself, where it could have been asked for with another density: the balance
/// heuristic. A mirror meets all of it.
fn share_of_both(density: Density, other: impl FnOnce() -> f32) -> f32 {
    match density {
        Density::Dirac => 1.0,
        Density::PerSteradian(density) => density / (density + other()),
    }
}
