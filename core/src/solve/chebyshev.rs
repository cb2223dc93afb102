//! Jacobi iteration accelerated by Chebyshev polynomials: what a bake uses.

use super::{FormFactors, System};
use crate::math::Real;
use crate::spectrum::Spectrum;

/// Solves from the start given in `radiosity`; stops and returns as [`super::jacobi`] does.
///
/// `scratch` has at least twice as many entries as `radiosity`. The eigenvalues of `rho F` lie in
/// `[-rho_max, rho_max]`, because `F` is similar to a symmetric matrix (reciprocity) with rows that sum to at most 1;
/// on this interval the Chebyshev semi-iteration is the best of all polynomials, needs no scalar products, and so gives
/// the same bits for any number of threads. Golub and Varga 1961; `w_(k+1) = 1 / (1 - rho^2 w_k / 4)`.
pub fn chebyshev<S: Spectrum, F: FormFactors<Scalar = S::Scalar>>(
    system: &System<S, F>,
    radiosity: &mut [S],
    scratch: &mut [S],
    tolerance: S::Scalar,
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
pub struct Chebyshev<R> {
    rho: R,
    omega: R,
    sweeps: usize,
}

impl<R: Real> Chebyshev<R> {
    /// Before the first sweep.
    pub fn new<S: Spectrum<Scalar = R>, F: FormFactors<Scalar = R>>(system: &System<S, F>) -> Self {
        Self { rho: system.largest_reflectance(), omega: R::ONE, sweeps: 0 }
    }

    /// One sweep, with the same slices each time. Tells whether the solution is as close as `tolerance` asks.
    pub fn sweep<S: Spectrum<Scalar = R>, F: FormFactors<Scalar = R>>(
        &mut self,
        system: &System<S, F>,
        radiosity: &mut [S],
        scratch: &mut [S],
        tolerance: R,
    ) -> bool {
        let Self { rho, omega, sweeps } = *self;
        let (before, next) = scratch[..2 * radiosity.len()].split_at_mut(radiosity.len());
        if sweeps == 0 {
            before.copy_from_slice(radiosity);
        }
        let (mut residual, mut largest) = (R::ZERO, R::ZERO);
        for i in 0..radiosity.len() {
            let jacobi = system.update(i, radiosity);
            residual = residual.max((jacobi - radiosity[i]).max_abs());
            largest = largest.max(jacobi.max_abs());
            next[i] = before[i] + (jacobi - before[i]) * omega;
        }
        before.copy_from_slice(radiosity);
        radiosity.copy_from_slice(next);
        self.sweeps += 1;
        let share = rho * rho / R::from_f64(if sweeps == 0 { 2.0 } else { 4.0 });
        self.omega = R::ONE / (R::ONE - share * omega);
        residual <= tolerance * largest * (R::ONE - rho)
    }
}
