//! Gauss-Seidel iteration: every patch gathers from the newest state of all others.

use super::{FormFactors, System};
use crate::math::Real;
use crate::spectrum::Spectrum;

/// Solves in place from the start given in `radiosity`; stops and returns as [`super::jacobi`] does.
pub fn gauss_seidel<S: Spectrum, F: FormFactors<Scalar = S::Scalar>>(
    system: &System<S, F>,
    radiosity: &mut [S],
    tolerance: S::Scalar,
    max_sweeps: usize,
) -> usize {
    let rho = system.largest_reflectance();
    for sweep in 1..=max_sweeps {
        let (mut change, mut largest) = (S::Scalar::ZERO, S::Scalar::ZERO);
        for i in 0..radiosity.len() {
            let next = system.update(i, radiosity);
            change = change.max((next - radiosity[i]).max_abs());
            largest = largest.max(next.max_abs());
            radiosity[i] = next;
        }
        if change * rho <= tolerance * largest * (S::Scalar::ONE - rho) {
            return sweep;
        }
    }
    max_sweeps
}
