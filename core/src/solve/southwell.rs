//! Southwell relaxation, which computer graphics knows as shooting or progressive refinement.

use super::solver::larger;
use super::{Accuracy, FormFactors, Solution, Solver, Stop, System};
use crate::math::Real;
use crate::spectrum::Spectrum;

/// Solves by [`Southwell`] from the start given in `radiosity`; `areas` and `scratch` have at least as many entries.
/// Steps are shots.
pub fn southwell<S: Spectrum, F: FormFactors<Scalar = S::Scalar>>(
    system: &System<S, F>,
    areas: &[S::Scalar],
    radiosity: &mut [S],
    scratch: &mut [S],
    stop: &Stop<S::Scalar>,
) -> Solution<S::Scalar> {
    Southwell::new(system, areas, scratch).solve(system, radiosity, stop)
}

/// The patch with the most unshot power sends it to all others, one shot a step; of equal ones the first.
///
/// Progressive refinement, Cohen, Chen, Wallace and Greenberg 1988: `dB_j = rho_j dB_i F_ij A_i / A_j`. The column of
/// `F` comes from the row of the shooter by reciprocity `A_i F_ij = A_j F_ji`, so that a shot asks for a single row:
/// form factors may be computed when they are needed and forgotten. The first shots show most of the light.
///
/// The radiosities hold what is shot and what is not. They are a bounce further than what was shot, so that the bound
/// is `|b - b*| <= c / (1 - c) |unshot|`.
#[derive(Debug)]
pub struct Southwell<'a, S: Spectrum> {
    areas: &'a [S::Scalar],
    unshot: &'a mut [S],
    has_started: bool,
}

impl<'a, S: Spectrum> Southwell<'a, S> {
    /// Before the first shot; `areas` and `scratch` have at least one entry for each patch, the areas all of one unit.
    pub fn new<F>(system: &System<S, F>, areas: &'a [S::Scalar], scratch: &'a mut [S]) -> Self {
        let count = system.exitance.len();
        Self { areas: &areas[..count], unshot: &mut scratch[..count], has_started: false }
    }

    /// Radiosity that the patches have received or emitted, and not yet passed on; set by the first step.
    pub fn unshot(&self) -> &[S] {
        self.unshot
    }

    /// The irradiance that unshot light will bring to an average patch: show `b_i + rho_i ambient` while it is being
    /// shot. Zero where the patches absorb nothing.
    ///
    /// Cohen et al. 1988: `sum_i A_i dB_i / sum_i A_i / (1 - mean rho)`, as if each patch saw all others by their areas.
    pub fn ambient<F>(&self, system: &System<S, F>) -> S {
        let (mut power, mut absorption) = (S::default(), S::default());
        let one = S::splat(S::Scalar::ONE);
        for ((&unshot, &rho), &area) in self.unshot.iter().zip(system.reflectance).zip(self.areas) {
            power += unshot * area;
            absorption += (one - rho) * area;
        }
        power.zip(
            absorption,
            |power, absorption| {
                if absorption > S::Scalar::ZERO { power / absorption } else { S::Scalar::ZERO }
            },
        )
    }

    /// Makes the start, which counts as shot, known to all: a sweep, but for the start zero.
    fn start<F: FormFactors<Scalar = S::Scalar>>(&mut self, system: &System<S, F>, radiosity: &mut [S]) {
        self.unshot.copy_from_slice(system.exitance);
        if radiosity.iter().any(|&radiosity| radiosity != S::default()) {
            for (i, unshot) in self.unshot.iter_mut().enumerate() {
                *unshot = system.update(i, radiosity) - radiosity[i];
            }
        }
        radiosity.iter_mut().zip(self.unshot.iter()).for_each(|(radiosity, &unshot)| *radiosity += unshot);
        self.has_started = true;
    }

    /// The patch with the most unshot power in any band.
    fn brightest(&self) -> Option<usize> {
        let powers = self.unshot.iter().zip(self.areas).map(|(unshot, &area)| unshot.max_abs() * area);
        let first = (None, S::Scalar::ZERO);
        powers.enumerate().fold(first, |most, (i, power)| if power > most.1 { (Some(i), power) } else { most }).0
    }

    /// Sends the unshot radiosity of patch `i` to all patches.
    fn shoot<F: FormFactors<Scalar = S::Scalar>>(&mut self, i: usize, system: &System<S, F>, radiosity: &mut [S]) {
        let power = core::mem::take(&mut self.unshot[i]) * self.areas[i];
        system.form_factors.row(i, |j, factor| {
            if self.areas[j] > S::Scalar::ZERO {
                let gained = system.reflectance[j] * power * (factor / self.areas[j]);
                radiosity[j] += gained;
                self.unshot[j] += gained;
            }
        });
    }
}

impl<S: Spectrum, F: FormFactors<Scalar = S::Scalar>> Solver<S, F> for Southwell<'_, S> {
    fn step(&mut self, system: &System<S, F>, radiosity: &mut [S]) -> Accuracy<S> {
        if !self.has_started {
            self.start(system, radiosity);
        }
        if let Some(i) = self.brightest() {
            self.shoot(i, system, radiosity);
        }
        let unshot = self.unshot.iter().copied().fold(S::default(), larger);
        let largest = radiosity.iter().copied().fold(S::default(), larger);
        Accuracy::new(unshot * system.decay.per_bounce, largest, &system.decay)
    }
}
