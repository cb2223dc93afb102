//! Two ways to scatter, each with its share.

use glam::Vec3;

use super::{Colored, Density, Scatter, Scattered};

/// A share of the surface is one thing, the rest another, finer than can be seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mixture<A, B> {
    /// What has the share.
    pub first: A,
    /// What has the rest.
    pub second: B,
    /// Of the first, in `[0, 1]`.
    pub share: f32,
}

impl<S: Colored, A: Scatter<S>, B: Scatter<S>> Scatter<S> for Mixture<A, B> {
    fn evaluate(&self, arrival: Vec3, departure: Vec3) -> S {
        self.first.evaluate(arrival, departure) * self.share
            + self.second.evaluate(arrival, departure) * (1.0 - self.share)
    }

    fn density(&self, arrival: Vec3, departure: Vec3) -> f32 {
        self.first.density(arrival, departure) * self.share
            + self.second.density(arrival, departure) * (1.0 - self.share)
    }

    fn sample(&self, departure: Vec3, numbers: Vec3) -> Option<Scattered<S>> {
        let scattered = if numbers.z < self.share {
            self.first.sample(departure, numbers.with_z(numbers.z / self.share))
        } else {
            self.second.sample(departure, numbers.with_z((numbers.z - self.share) / (1.0 - self.share)))
        }?;
        let Density::PerSteradian(_) = scattered.density else { return Some(scattered) };
        let arrival = scattered.arrival;
        let density = self.density(arrival, departure);
        let weight = self.evaluate(arrival, departure) * (arrival.z.abs() / density);
        Some(Scattered { arrival, weight, density: Density::PerSteradian(density) })
    }

    fn transmittance(&self, distance: f32) -> S {
        self.first.transmittance(distance) * self.share + self.second.transmittance(distance) * (1.0 - self.share)
    }
}
