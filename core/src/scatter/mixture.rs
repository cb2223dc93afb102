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
        density_of([&self.first, &self.second], self.share, arrival, departure)
    }

    fn sample(&self, departure: Vec3, numbers: Vec3) -> Option<Scattered<S>> {
        let (is_first, numbers) = choose(self.share, numbers);
        let chosen: &dyn Scatter<S> = if is_first { &self.first } else { &self.second };
        let scattered = chosen.sample(departure, numbers)?;
        // Of those that have one direction only its share chooses just as many.
        let is_dirac = scattered.density == Density::Dirac;
        Some(if is_dirac { scattered } else { weigh(self, scattered.arrival, departure) })
    }

    fn transmittance(&self, distance: f32) -> S {
        self.first.transmittance(distance) * self.share + self.second.transmittance(distance) * (1.0 - self.share)
    }
}

/// Whether the first of two is chosen, and numbers for it.
pub(super) fn choose(chance: f32, numbers: Vec3) -> (bool, Vec3) {
    match numbers.z < chance {
        true => (true, numbers.with_z(numbers.z / chance)),
        false => (false, numbers.with_z((numbers.z - chance) / (1.0 - chance))),
    }
}

/// The density of directions of which the first of two chooses so many.
pub(super) fn density_of<S: Colored>(
    [first, second]: [&dyn Scatter<S>; 2],
    chance: f32,
    arrival: Vec3,
    departure: Vec3,
) -> f32 {
    first.density(arrival, departure) * chance + second.density(arrival, departure) * (1.0 - chance)
}

/// A direction of a surface without Dirac parts, with its weight.
pub(super) fn weigh<S: Colored>(surface: &impl Scatter<S>, arrival: Vec3, departure: Vec3) -> Scattered<S> {
    let density = surface.density(arrival, departure);
    let weight = surface.evaluate(arrival, departure) * (arrival.z.abs() / density);
    Scattered { arrival, weight, density: Density::PerSteradian(density) }
}
