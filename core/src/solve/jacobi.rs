//! Jacobi iteration: every patch gathers from the last state of all others; one sweep is one bounce.

use super::{FormFactors, System};
use crate::math::Real;
use crate::spectrum::Spectrum;

/// Solves from the start given in `radiosity` until `|b - b*| <= tolerance x max b` is certain; returns the sweeps done.
///
/// `scratch` has at least as many entries as `radiosity`. The bound is `|b - b*| <= rho / (1 - rho) |b_k - b_(k-1)|`
/// in the maximum norm.
pub fn jacobi<S: Spectrum, F: FormFactors<Scalar = S::Scalar>>(
    system: &System<S, F>,
    radiosity: &mut [S],
    scratch: &mut [S],
    tolerance: S::Scalar,
    max_sweeps: usize,
) -> usize {
    let rho = system.largest_reflectance();
    for sweep in 1..=max_sweeps {
        let (mut change, mut largest) = (S::Scalar::ZERO, S::Scalar::ZERO);
        for (i, next) in scratch[..radiosity.len()].iter_mut().enumerate() {
            *next = system.update(i, radiosity);
            change = change.max((*next - radiosity[i]).max_abs());
            largest = largest.max(next.max_abs());
        }
        radiosity.copy_from_slice(&scratch[..radiosity.len()]);
        if change * rho <= tolerance * largest * (S::Scalar::ONE - rho) {
            return sweep;
        }
    }
    max_sweeps
}
