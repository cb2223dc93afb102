//! Smooth glass.

use glam::Vec3;

use super::{Colored, Density, Scatter, Scattered, mirrored};
use crate::math;

/// The smooth border of something clear: light is reflected or refracted, and absorbed behind the surface.
///
/// The front of the surface is in air. Both parts are Dirac deltas, so that a lamp without extent, which no refracted ray
/// can meet, leaves the shadow of a solid body; what emits with an area shines through and makes caustics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glass<S> {
    /// Of what is behind the surface, above 0; 1.5 is usual.
    pub index: f32,
    /// Behind the surface, in 1/m: `exp(-absorption distance)` of the light is left.
    pub absorption: S,
}

/// The share of unpolarized light that a smooth border reflects, in `[0, 1]`, and the cosine on the other side.
///
/// `cos` is that of the light to the normal, in `[0, 1]`; `ratio` is the index of refraction on the side of the light over
/// that on the other. Fresnel's equations; all light is reflected where none can pass.
pub fn fresnel(cos: f32, ratio: f32) -> (f32, f32) {
    let squared = 1.0 - ratio * ratio * (1.0 - cos * cos);
    if squared <= 0.0 {
        return (1.0, 0.0);
    }
    let beyond = math::sqrt(squared);
    let across = (ratio * cos - beyond) / (ratio * cos + beyond);
    let along = (cos - ratio * beyond) / (cos + ratio * beyond);
    (0.5 * (across * across + along * along), beyond)
}

impl<S: Colored> Scatter<S> for Glass<S> {
    fn evaluate(&self, _: Vec3, _: Vec3) -> S {
        S::default()
    }

    fn density(&self, _: Vec3, _: Vec3) -> f32 {
        0.0
    }

    fn sample(&self, departure: Vec3, numbers: Vec3) -> Option<Scattered<S>> {
        let ratio = if departure.z > 0.0 { 1.0 / self.index } else { self.index };
        let (reflected, beyond) = fresnel(departure.z.abs().min(1.0), ratio);
        let arrival = if numbers.z < reflected {
            mirrored(departure)
        } else {
            Vec3::new(-ratio * departure.x, -ratio * departure.y, -beyond * departure.z.signum())
        };
        Some(Scattered { arrival, weight: S::splat(1.0), density: Density::Dirac })
    }

    fn transmittance(&self, distance: f32) -> S {
        self.absorption.zip(S::default(), |absorption, _| math::exp(-absorption * distance))
    }
}
