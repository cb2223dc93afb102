//! The diffuse surface, of which radiosity knows alone.

use core::f32::consts::FRAC_1_PI;

use glam::Vec3;

use super::{Colored, Density, Scatter, Scattered, is_reflected};
use crate::geometry::cosine_direction;

/// Equally bright from all directions on its front: `reflectance / pi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lambert<S> {
    /// In `[0, 1]`.
    pub reflectance: S,
}

impl<S: Colored> Scatter<S> for Lambert<S> {
    fn evaluate(&self, arrival: Vec3, departure: Vec3) -> S {
        if is_reflected(arrival, departure) { self.reflectance * FRAC_1_PI } else { S::default() }
    }

    fn density(&self, arrival: Vec3, departure: Vec3) -> f32 {
        if is_reflected(arrival, departure) { arrival.z * FRAC_1_PI } else { 0.0 }
    }

    fn sample(&self, departure: Vec3, numbers: Vec3) -> Option<Scattered<S>> {
        let arrival = cosine_direction(numbers.truncate(), Vec3::Z);
        let density = self.density(arrival, departure);
        (density > 0.0).then_some(Scattered {
            arrival,
            weight: self.reflectance,
            density: Density::PerSteradian(density),
        })
    }
}
