//! The glossy lobe of Phong, without gain.

use core::f32::consts::{FRAC_1_PI, TAU};

use glam::Vec3;

use super::{Colored, Density, Scatter, Scattered, is_reflected, mirrored};
use crate::geometry::tangents;
use crate::math;

/// A lobe around the mirrored direction: `reflectance (n + 2) / 2 pi cos^n`, where the cosine is measured to that
/// direction.
///
/// Lafortune and Willems, "Using the modified Phong reflectance model for physically based rendering", 1994. Light that
/// leaves along the normal is reflected whole; at other angles the part of the lobe below the surface is lost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phong<S> {
    /// Along the normal, in `[0, 1]`.
    pub reflectance: S,
    /// `n`, not negative: 0 is almost diffuse, 1000 almost a mirror.
    pub exponent: f32,
}

impl<S: Colored> Phong<S> {
    /// The `n`-th power of the cosine to the mirrored direction.
    fn power(&self, arrival: Vec3, departure: Vec3) -> f32 {
        match mirrored(departure).dot(arrival) {
            cos if cos > 0.0 && is_reflected(arrival, departure) => math::powf(cos.min(1.0), self.exponent),
            _ => 0.0,
        }
    }
}

impl<S: Colored> Scatter<S> for Phong<S> {
    fn evaluate(&self, arrival: Vec3, departure: Vec3) -> S {
        self.reflectance * ((self.exponent + 2.0) * 0.5 * FRAC_1_PI * self.power(arrival, departure))
    }

    fn density(&self, arrival: Vec3, departure: Vec3) -> f32 {
        (self.exponent + 1.0) * 0.5 * FRAC_1_PI * self.power(arrival, departure)
    }

    fn sample(&self, departure: Vec3, numbers: Vec3) -> Option<Scattered<S>> {
        let cos = math::powf(1.0 - numbers.y, 1.0 / (self.exponent + 1.0));
        let sin = math::sqrt((1.0 - cos * cos).max(0.0));
        let (s, c) = math::sin_cos(TAU * numbers.x);
        let axis = mirrored(departure);
        let (tangent, bitangent) = tangents(axis);
        let arrival = (tangent * c + bitangent * s) * sin + axis * cos;
        let density = self.density(arrival, departure);
        let weight = self.reflectance * ((self.exponent + 2.0) / (self.exponent + 1.0) * arrival.z);
        (density > 0.0).then_some(Scattered { arrival, weight, density: Density::PerSteradian(density) })
    }
}
