//! The perfect mirror.

use glam::Vec3;

use super::{Colored, Density, Scatter, Scattered, mirrored};

/// Sends light on in one direction: `reflectance δ(arrival - mirrored departure) / cos`, on its front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror<S> {
    /// In `[0, 1]`, the same for all directions.
    pub reflectance: S,
}

impl<S: Colored> Scatter<S> for Mirror<S> {
    fn evaluate(&self, _: Vec3, _: Vec3) -> S {
        S::default()
    }

    fn density(&self, _: Vec3, _: Vec3) -> f32 {
        0.0
    }

    fn sample(&self, departure: Vec3, _: Vec3) -> Option<Scattered<S>> {
        let arrival = mirrored(departure);
        (departure.z > 0.0).then_some(Scattered { arrival, weight: self.reflectance, density: Density::Dirac })
    }
}
