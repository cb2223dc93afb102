//! A surface with a lobe over it.

use glam::Vec3;

use super::mixture::{choose, density_of, weigh};
use super::{Colored, Density, Scatter, Scattered};

/// What a coat scatters and what lies below it, added, as the lobes of Bevy's `StandardMaterial` are. The coat takes nothing
/// from the base: whoever sets the base leaves out what the coat reflects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coated<A, B> {
    /// The lobe above.
    pub coat: A,
    /// What lies below.
    pub base: B,
    /// How likely directions are chosen by the coat, between 0 and 1.
    pub chance: f32,
}

impl<S: Colored, A: Scatter<S>, B: Scatter<S>> Scatter<S> for Coated<A, B> {
    fn evaluate(&self, arrival: Vec3, departure: Vec3) -> S {
        self.coat.evaluate(arrival, departure) + self.base.evaluate(arrival, departure)
    }

    fn density(&self, arrival: Vec3, departure: Vec3) -> f32 {
        density_of([&self.coat, &self.base], self.chance, arrival, departure)
    }

    fn sample(&self, departure: Vec3, numbers: Vec3) -> Option<Scattered<S>> {
        let (is_coat, numbers) = choose(self.chance, numbers);
        let chosen: &dyn Scatter<S> = if is_coat { &self.coat } else { &self.base };
        let scattered = chosen.sample(departure, numbers)?;
        if scattered.density == Density::Dirac {
            let chance = if is_coat { self.chance } else { 1.0 - self.chance };
            return Some(Scattered { weight: scattered.weight * (1.0 / chance), ..scattered });
        }
        Some(weigh(self, scattered.arrival, departure))
    }
}
