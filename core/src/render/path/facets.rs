//! Triangles in lists, of any matter and with any bands.

use glam::{Vec2, Vec3};

use super::Optics;
use crate::geometry::{Hit, Occluders, Ray, normal_and_area};
use crate::light::SkyImage;
use crate::scatter::{Colored, Matter};

/// A material of facets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet<S> {
    /// What it does with light.
    pub matter: Matter<S>,
    /// Emitted radiance of the front in cd/m2, not negative.
    pub emission: S,
}

/// What surrounds facets: a function of the direction, or a [`SkyImage`] where that is worth asking for light.
pub trait Surroundings<S>: Sync {
    /// See [`Optics::sky`].
    fn radiance(&self, direction: Vec3) -> S;

    /// See [`Optics::toward_sky`].
    fn toward(&self, _numbers: Vec2) -> Option<Vec3> {
        None
    }

    /// See [`Optics::density_of_sky`].
    fn density(&self, _direction: Vec3) -> f32 {
        0.0
    }
}

impl<S, F: Fn(Vec3) -> S + Sync> Surroundings<S> for F {
    fn radiance(&self, direction: Vec3) -> S {
        self(direction)
    }
}

impl Surroundings<Vec3> for SkyImage {
    fn radiance(&self, direction: Vec3) -> Vec3 {
        self.radiance(direction)
    }

    fn toward(&self, numbers: Vec2) -> Option<Vec3> {
        self.sample(numbers)
    }

    fn density(&self, direction: Vec3) -> f32 {
        self.density(direction)
    }
}

/// Flat triangles, opaque and one-sided but for glass, and what surrounds them.
pub struct Facets<'a, S, O, F> {
    /// Corners, counter-clockwise seen from the front.
    pub corners: &'a [[Vec3; 3]],
    /// The materials.
    pub materials: &'a [Facet<S>],
    /// For each triangle the index of its material.
    pub of_triangle: &'a [u32],
    /// The same triangles, to trace rays.
    pub occluders: O,
    /// Radiance in cd/m2 of the surroundings in a direction of any length.
    pub sky: F,
}

impl<S, O, F> Facets<'_, S, O, F> {
    fn material(&self, triangle: u32) -> &Facet<S> {
        &self.materials[self.of_triangle[triangle as usize] as usize]
    }
}

impl<S: Colored, O: Occluders, F: Surroundings<S>> Optics<S> for Facets<'_, S, O, F> {
    type Scatter = Matter<S>;

    fn corners(&self) -> &[[Vec3; 3]] {
        self.corners
    }

    fn nearest(&self, ray: &Ray, _: u32) -> (Option<Hit>, S) {
        (self.occluders.nearest(ray), S::splat(1.0))
    }

    fn visibility(&self, ray: &Ray) -> S {
        S::splat(if self.occluders.any(ray, |_| true) { 0.0 } else { 1.0 })
    }

    fn opacity(&self, _: &Hit) -> f32 {
        1.0
    }

    fn surface(&self, hit: &Hit) -> (Vec3, Matter<S>) {
        let normal = normal_and_area(&self.corners[hit.triangle as usize]).map_or(Vec3::Z, |(normal, _)| normal);
        (normal, self.material(hit.triangle).matter)
    }

    fn emission(&self, hit: &Hit) -> S {
        self.material(hit.triangle).emission
    }

    fn both_sides(&self, _: u32) -> bool {
        false
    }

    fn sky(&self, direction: Vec3) -> S {
        self.sky.radiance(direction)
    }

    fn toward_sky(&self, numbers: Vec2) -> Option<Vec3> {
        self.sky.toward(numbers)
    }

    fn density_of_sky(&self, direction: Vec3) -> f32 {
        self.sky.density(direction)
    }
}
