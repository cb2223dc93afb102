//! Jacobi iteration accelerated by Chebyshev polynomials: what a bake uses.

use super::solver::Change;
use super::{Accuracy, FormFactors, Solution, Solver, Stop, System};
use crate::math::Real;
use crate::spectrum::Spectrum;

/// Solves by [`Chebyshev`] from the start given in `radiosity`; `scratch` has at least twice as many entries.
pub fn chebyshev<S: Spectrum, F: FormFactors<Scalar = S::Scalar>>(
    system: &System<S, F>,
    radiosity: &mut [S],
    scratch: &mut [S],
    stop: &Stop<S::Scalar>,
) -> Solution<S::Scalar> {
    Chebyshev::new(system, scratch).solve(system, radiosity, stop)
}

/// `x_(k+1) = x_(k-1) + w_(k+1) (e + rho F x_k - x_(k-1))` with `w_(k+1) = 1 / (1 - c^2 w_k / 4)`.
///
/// The eigenvalues of `rho F` are real and lie in `[-c, c]`, because reciprocity makes it similar to a symmetric
/// matrix. On this interval the Chebyshev semi-iteration is the best of all polynomials; it needs no scalar products, so
/// it runs in parallel without a meeting point, gives the same bits for any number of threads, and bands stay apart.
/// Golub and Varga 1961. The radiosities after a step are `e + rho F x_k`, for which the bound of Jacobi holds.
#[derive(Debug)]
pub struct Chebyshev<'a, S> {
    radius: S,
    omega: S,
    steps: usize,
    state: &'a mut [S],
    before: &'a mut [S],
}

impl<'a, S: Spectrum> Chebyshev<'a, S> {
    /// Before the first sweep; `scratch` has at least two entries for each patch.
    pub fn new<F: FormFactors<Scalar = S::Scalar>>(system: &System<S, F>, scratch: &'a mut [S]) -> Self {
        let count = system.exitance.len();
        let (state, rest) = scratch.split_at_mut(count);
        let (omega, before) = (S::splat(S::Scalar::ONE), &mut rest[..count]);
        Self { radius: system.decay.radius(), omega, steps: 0, state, before }
    }

    /// The weight of the next step; the first two are `1` and `1 / (1 - c^2 / 2)`.
    fn next_omega(&self) -> S {
        let share = S::Scalar::from_f64(if self.steps == 1 { 0.5 } else { 0.25 });
        let shrunk = self.radius * self.radius * self.omega * share;
        shrunk.zip(shrunk, |shrunk, _| S::Scalar::ONE / (S::Scalar::ONE - shrunk))
    }
}

impl<S: Spectrum, F: FormFactors<Scalar = S::Scalar>> Solver<S, F> for Chebyshev<'_, S> {
    fn step(&mut self, system: &System<S, F>, radiosity: &mut [S]) -> Accuracy<S> {
        let Self { state, before, .. } = self;
        if self.steps == 0 {
            state.copy_from_slice(radiosity);
            before.copy_from_slice(radiosity);
        }
        system.form_factors.receive_all(state, radiosity);
        let mut change = Change::default();
        for (i, radiosity) in radiosity.iter_mut().enumerate() {
            *radiosity = change.note(state[i], system.reflect(i, *radiosity));
            let next = before[i] + (*radiosity - before[i]) * self.omega;
            (before[i], state[i]) = (state[i], next);
        }
        self.steps += 1;
        self.omega = self.next_omega();
        change.after_bounce(&system.decay)
    }
}
