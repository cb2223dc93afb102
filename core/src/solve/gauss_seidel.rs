//! Gauss-Seidel iteration: every patch gathers from the newest state of all others.

use super::solver::Change;
use super::{Accuracy, FormFactors, Solution, Solver, Stop, System};
use crate::spectrum::Spectrum;

/// Solves by [`GaussSeidel`] in place, from the start given in `radiosity`.
pub fn gauss_seidel<S: Spectrum, F: FormFactors<Scalar = S::Scalar>>(
    system: &System<S, F>,
    radiosity: &mut [S],
    stop: &Stop<S::Scalar>,
) -> Solution<S::Scalar> {
    GaussSeidel.solve(system, radiosity, stop)
}

/// `b_i <- e_i + rho_i sum_j F_ij b_j`, one patch after the other, each from what the others have just become.
///
/// A sweep is worth about two of Jacobi, and needs no memory besides the solution; but it has an order, so it does not
/// run in parallel. After a sweep `r_i = rho_i sum_(j >= i) F_ij (b_j - b_j before)`, which gives the bound of Jacobi.
#[derive(Clone, Copy, Debug, Default)]
pub struct GaussSeidel;

impl<S: Spectrum, F: FormFactors<Scalar = S::Scalar>> Solver<S, F> for GaussSeidel {
    fn step(&mut self, system: &System<S, F>, radiosity: &mut [S]) -> Accuracy<S> {
        let mut change = Change::default();
        for i in 0..radiosity.len() {
            radiosity[i] = change.note(radiosity[i], system.update(i, radiosity));
        }
        change.after_bounce(&system.decay)
    }
}
