//! Jacobi iteration: every patch gathers from the last state of all others; one sweep is one bounce.

use super::solver::Change;
use super::{Accuracy, FormFactors, Solution, Solver, Stop, System};
use crate::spectrum::Spectrum;

/// Solves by [`Jacobi`] from the start given in `radiosity`; `scratch` has at least as many entries.
pub fn jacobi<S: Spectrum, F: FormFactors<Scalar = S::Scalar>>(
    system: &System<S, F>,
    radiosity: &mut [S],
    scratch: &mut [S],
    stop: &Stop<S::Scalar>,
) -> Solution<S::Scalar> {
    Jacobi::new(scratch).solve(system, radiosity, stop)
}

/// `b <- e + rho F b`, for all patches at once: what a sweep adds is the next bounce.
///
/// After `k` sweeps from zero `k - 1` bounces are in, and the error falls as `c^k`. The bound is
/// `|b_k - b*| <= c / (1 - c) |b_k - b_(k-1)|`.
#[derive(Debug)]
pub struct Jacobi<'a, S> {
    received: &'a mut [S],
}

impl<'a, S> Jacobi<'a, S> {
    /// Before the first sweep; `scratch` has at least one entry for each patch.
    pub fn new(scratch: &'a mut [S]) -> Self {
        Self { received: scratch }
    }
}

impl<S: Spectrum, F: FormFactors<Scalar = S::Scalar>> Solver<S, F> for Jacobi<'_, S> {
    fn step(&mut self, system: &System<S, F>, radiosity: &mut [S]) -> Accuracy<S> {
        let received = &mut self.received[..radiosity.len()];
        system.form_factors.receive_all(radiosity, received);
        let mut change = Change::default();
        for (i, radiosity) in radiosity.iter_mut().enumerate() {
            *radiosity = change.note(*radiosity, system.reflect(i, received[i]));
        }
        change.after_bounce(&system.decay)
    }
}
