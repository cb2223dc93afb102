//! Rays through a scene, with what is transparent let through.

use core::sync::atomic::{AtomicUsize, Ordering};

use glam::Vec3;

use crate::geometry::{Hit, Occluders, Ray, hash};
use crate::light::ShadowRay;
use crate::scene::World;

/// Traces rays through a world.
pub struct Tracer<'a, O> {
    /// The triangles with their materials.
    pub world: &'a World<'a>,
    /// Whether nothing is a mirror or changes the color of light that passes.
    pub is_plain: bool,
    pub(super) occluders: O,
    /// Whether anything changes the color of light that passes.
    pub(super) filters: bool,
    rays: AtomicUsize,
}

impl<'a, O: Occluders> Tracer<'a, O> {
    /// `occluders` holds the triangles of the world that block light.
    pub fn new(world: &'a World<'a>, occluders: O) -> Self {
        let filters = world.sides[..world.blockers].iter().any(|side| side.filters);
        Self { world, is_plain: world.is_plain(), occluders, filters, rays: AtomicUsize::new(0) }
    }

    /// Counts rays that were traced.
    pub fn count(&self, rays: usize) {
        self.rays.fetch_add(rays, Ordering::Relaxed);
    }

    /// The rays counted since the last call.
    pub fn take_count(&self) -> u64 {
        self.rays.swap(0, Ordering::Relaxed) as u64
    }

    /// The nearest hit. A surface that lets a share of the light through is met with the rest as probability, decided
    /// by `seed`. Where two one-sided surfaces lie back to back, the one that faces the ray is met.
    #[inline]
    pub fn nearest(&self, ray: &Ray, seed: u32) -> Option<Hit> {
        self.nearest_but(ray, seed, |_| ())
    }

    /// The same; `pass` gets hits that let the light pass, in any order, and some beyond.
    #[inline]
    pub(super) fn nearest_but(&self, ray: &Ray, seed: u32, pass: impl Fn(&Hit)) -> Option<Hit> {
        self.occluders.first(ray, |hit| {
            let shows = hit.front || self.world.sides[hit.triangle as usize].both;
            let slack = if shows { 0.0 } else { 4.0 * self.world.lift(hit.triangle) / ray.direction.length() };
            let blocks = self.blocks(hit, seed);
            if !blocks {
                pass(hit);
            }
            blocks.then_some(hit.distance + slack)
        })
    }

    #[inline]
    fn blocks(&self, hit: &Hit, seed: u32) -> bool {
        self.world.sides[hit.triangle as usize].is_opaque || {
            let chance = hash(seed, hit.triangle) as f32 / 4_294_967_296.0;
            chance < self.world.opacity(hit)
        }
    }

    /// The share of light that passes along a ray, in `[0, 1]`, whatever its color.
    #[inline]
    pub fn visibility(&self, ray: &Ray) -> f32 {
        let mut passes = 1.0;
        let blocked = self.occluders.any(ray, |hit| {
            passes *= 1.0 - self.world.opacity(hit);
            passes <= 0.0
        });
        if blocked { 0.0 } else { passes }
    }

    /// A ray that starts at a point of a triangle, just above it on the side of `normal`.
    #[inline]
    pub fn leave(&self, triangle: u32, point: Vec3, normal: Vec3, direction: Vec3, end: f32) -> Ray {
        Ray { origin: point + normal * self.world.lift(triangle), direction, end }
    }

    /// A ray from a point of a triangle, just above it on the side of `normal`, to a point of a light. It ends before
    /// the light, which may be a surface: by a ten-thousandth of the way, or by what points are lifted where that is
    /// more.
    pub fn leave_for(&self, triangle: u32, point: Vec3, normal: Vec3, light: &ShadowRay) -> Ray {
        if light.end == f32::INFINITY {
            return self.leave(triangle, point, normal, light.direction, light.end);
        }
        let lift = self.world.lift(triangle);
        let direction = light.direction - normal * lift;
        let slack = (2.0 * lift / direction.length()).max(1e-4);
        Ray { origin: point + normal * lift, direction, end: light.end - slack }
    }
}
