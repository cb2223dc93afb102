//! Jacobi iteration accelerated by Chebyshev polynomials: what a bake uses.

use super::{FormFactors, System};
use crate::spectrum::Spectrum;

/// Solves from the start given in `radiosity`; stops and returns as [`super::jacobi`] does.
///
/// `scratch` has at least twice as many entries as `radiosity`. The eigenvalues of `rho F` lie in
/// `[-rho_max, rho_max]`, because `F` is similar to a symmetric matrix (reciprocity) with rows that sum to at most 1;
/// on this interval the Chebyshev semi-iteration is the best of all polynomials, needs no scalar products, and so gives
/// the same bits for any number of threads. Golub and Varga 1961; `w_(k+1) = 1 / (1 - rho^2 w_k / 4)`.
pub fn chebyshev<S: Spectrum, F: FormFactors>(
    system: &System<S, F>,
    radiosity: &mut [S],
    scratch: &mut [S],
    tolerance: f32,
    max_sweeps: usize,
) -> usize {
    let mut sweeps = Chebyshev::new(system);
    for sweep in 1..=max_sweeps {
        if sweeps.sweep(system, radiosity, scratch, tolerance) {
            return sweep;
        }
    }
    max_sweeps
}

/// The iteration of [`chebyshev`] sweep by sweep, for callers who have to look at something else in between.
#[derive(Clone, Copy, Debug)]
pub struct Chebyshev {
    rho: f32,
    omega: f32,
    sweeps: usize,
}

impl Chebyshev {
    /// Before the first sweep.
    pub fn new<S: Spectrum, F: FormFactors>(system: &System<S, F>) -> Self {
        Self { rho: system.largest_reflectance(), omega: 1.0, sweeps: 0 }
    }

    /// One sweep, with the same slices each time. Tells whether the solution is as close as `tolerance` asks.
    pub fn sweep<S: Spectrum, F: FormFactors>(
        &mut self,
        system: &System<S, F>,
        radiosity: &mut [S],
        scratch: &mut [S],
        tolerance: f32,
    ) -> bool {
        let Self { rho, omega, sweeps } = *self;
        let (before, next) = scratch[..2 * radiosity.len()].split_at_mut(radiosity.len());
        if sweeps == 0 {
            before.copy_from_slice(radiosity);
        }
        let (mut residual, mut largest) = (0.0_f32, 0.0_f32);
        for i in 0..radiosity.len() {
            let jacobi = system.update(i, radiosity);
            residual = residual.max((jacobi - radiosity[i]).max_abs());
            largest = largest.max(jacobi.max_abs());
            next[i] = before[i] + (jacobi - before[i]) * omega;
        }
        before.copy_from_slice(radiosity);
        radiosity.copy_from_slice(next);
        self.sweeps += 1;
        self.omega = if sweeps == 0 { 2.0 / (2.0 - rho * rho) } else { 1.0 / (1.0 - 0.25 * rho * rho * omega) };
        residual <= tolerance * largest * (1.0 - rho)
    }
}
