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
        let mut sweep = GaussSeidelSweep::default();
        sweep.advance(system, radiosity, radiosity.len());
        sweep.change.after_bounce(&system.decay)
    }
}

/// A sweep of [`GaussSeidel`] in pieces of bounded work, for firmware that has deadlines and pages that stay alive.
///
/// ```
/// use radiosity::solve::{Dense, GaussSeidelSweep, System};
///
/// let form_factors = Dense { count: 2, factors: &[0.0, 0.4, 0.4, 0.0] };
/// let system = System::new(&[1.0, 0.0], &[0.5, 0.5], &form_factors);
/// let (mut sweep, mut radiosity) = (GaussSeidelSweep::default(), [0.0; 2]);
/// // Other work may be done between the patches.
/// assert!(sweep.step(&system, &mut radiosity, 1).is_none());
/// let accuracy = sweep.step(&system, &mut radiosity, 1).expect("all patches have had their turn");
/// assert!(accuracy.error > 0.0);
/// ```
#[derive(Clone, Copy, Default)]
pub struct GaussSeidelSweep<S> {
    /// The next patch.
    next: usize,
    change: Change<S>,
}

impl<S: Spectrum> GaussSeidelSweep<S> {
    /// Updates up to `most` patches. At the end of the sweep it tells how good the radiosities are and starts anew.
    ///
    /// The work is that of `most` rows. The bits are those of whole sweeps, if nobody else changes the radiosities.
    pub fn step<F: FormFactors<Scalar = S::Scalar>>(
        &mut self,
        system: &System<S, F>,
        radiosity: &mut [S],
        most: usize,
    ) -> Option<Accuracy<S>> {
        self.advance(system, radiosity, most);
        let is_over = self.next >= radiosity.len();
        is_over.then(|| core::mem::take(self).change.after_bounce(&system.decay))
    }

    fn advance<F: FormFactors<Scalar = S::Scalar>>(&mut self, system: &System<S, F>, radiosity: &mut [S], most: usize) {
        for _ in 0..most {
            let Some(&before) = radiosity.get(self.next) else { return };
            let after = self.change.note(before, system.update(self.next, radiosity));
            if let Some(radiosity) = radiosity.get_mut(self.next) {
                *radiosity = after;
            }
            self.next += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::Dense;

    /// Sweeps in pieces of any size give the bits and the bounds of whole ones.
    #[test]
    fn pieces_of_a_sweep() {
        let factors: [f64; 25] = core::array::from_fn(|k| if k % 6 == 0 { 0.0 } else { (k % 5 + k / 5) as f64 / 25.0 });
        let form_factors = Dense { count: 5, factors: &factors };
        let system = System::new(&[1.0, 0.0, 0.5, 0.0, 0.1], &[0.7; 5], &form_factors);
        for most in 1..=6 {
            let (mut whole, mut pieces) = ([0.0; 5], [0.0; 5]);
            let mut sweep = GaussSeidelSweep::default();
            for _ in 0..3 {
                let expected = GaussSeidel.step(&system, &mut whole);
                let accuracy = core::iter::from_fn(|| Some(sweep.step(&system, &mut pieces, most))).flatten().next();
                assert_eq!((accuracy, pieces), (Some(expected), whole));
            }
        }
    }
}
