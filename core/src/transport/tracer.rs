//! Rays through a scene, with what is transparent let through.

use core::sync::atomic::{AtomicUsize, Ordering};

use glam::Vec3;

use crate::geometry::{Hit, Occluders, Ray, hash};
use crate::scene::World;

/// Traces rays through a world.
pub struct Tracer<'a, O> {
    /// The triangles with their materials.
    pub world: &'a World<'a>,
    occluders: O,
    /// Rays start this far above surfaces: a share of the largest coordinate, above the rounding of positions.
    lift: f32,
    rays: AtomicUsize,
}

impl<'a, O: Occluders> Tracer<'a, O> {
    /// `occluders` holds the triangles of the world that block light.
    pub fn new(world: &'a World<'a>, occluders: O) -> Self {
        let (low, high) = world.bounds();
        let largest = low.abs().max(high.abs()).max_element();
        Self { world, occluders, lift: 5e-6 * largest.clamp(1e-6, 1e9), rays: AtomicUsize::new(0) }
    }

    /// How far above surfaces rays start, in meters.
    pub fn lift(&self) -> f32 {
        self.lift
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
        let slack = 4.0 * self.lift / ray.direction.length();
        self.occluders.first(ray, |hit| {
            let shows = hit.front || self.world.sides[hit.triangle as usize].both;
            self.blocks(hit, seed).then_some(if shows { hit.distance } else { hit.distance + slack })
        })
    }

    #[inline]
    fn blocks(&self, hit: &Hit, seed: u32) -> bool {
        self.world.sides[hit.triangle as usize].is_opaque || {
            let chance = hash(seed, hit.triangle) as f32 / 4_294_967_296.0;
            chance < self.world.opacity(hit)
        }
    }

    /// The share of light that passes along a ray, in `[0, 1]`.
    #[inline]
    pub fn visibility(&self, ray: &Ray) -> f32 {
        let mut passes = 1.0;
        let blocked = self.occluders.any(ray, |hit| {
            passes *= 1.0 - self.world.opacity(hit);
            passes <= 0.0
        });
        if blocked { 0.0 } else { passes }
    }

    /// A ray that starts just above a surface.
    #[inline]
    pub fn leave(&self, point: Vec3, normal: Vec3, direction: Vec3, end: f32) -> Ray {
        Ray { origin: point + normal * self.lift, direction, end }
    }
}
