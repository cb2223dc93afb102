//! How light dies out from bounce to bounce: what turns a residual into a bound of the error.

use super::FormFactors;
use super::solver::{Change, larger};
use crate::math::Real;
use crate::spectrum::Spectrum;

/// How light dies out, band by band, in the maximum norm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decay<S> {
    /// `c = max_i rho_i sum_j F_ij`, at least `|rho F|`: what a bounce leaves of light that is everywhere the same.
    /// Below 1 in an open scene even where `rho` is 1.
    pub per_bounce: S,
    /// At least `|(I - rho F)^-1|`: an error is at most so many times the residual. Infinite where it is not known
    /// that light dies out.
    pub amplification: S,
}

impl<S: Spectrum> Decay<S> {
    /// `1 / (1 - c)`.
    pub(super) fn of_one_bounce<F: FormFactors<Scalar = S::Scalar>>(reflectance: &[S], form_factors: &F) -> Self {
        let mut per_bounce = S::default();
        for (i, &rho) in reflectance.iter().enumerate() {
            per_bounce = larger(per_bounce, rho * form_factors.row_sum(i));
        }
        let slack = S::Scalar::EPSILON * S::Scalar::from_usize(16);
        let amplification = per_bounce.zip(per_bounce, |c, _| {
            let lost = S::Scalar::ONE - c;
            if lost > slack { S::Scalar::ONE / lost } else { S::Scalar::INFINITY }
        });
        Self { per_bounce, amplification }
    }

    /// For `T = rho F`, all of it positive, and any `w > 0` with `v = w - T w > 0`, `|(I - T)^-1| <= max w / min v`:
    /// `I - T` is an M-matrix. `w = 1` gives `1 / (1 - c)`. Here `w` goes by Gauss-Seidel from 1 towards
    /// `w = 1 + T w`, until a sweep changes it by so little, `d`, that `v >= 1 - c d >= 1/2`.
    pub(super) fn of_many_bounces<F: FormFactors<Scalar = S::Scalar>>(
        self,
        reflectance: &[S],
        form_factors: &F,
        scratch: &mut [S],
        most_sweeps: usize,
    ) -> Self {
        let one = S::splat(S::Scalar::ONE);
        let half = S::Scalar::from_f64(0.5);
        let weights = &mut scratch[..reflectance.len()];
        weights.fill(one);
        let mut amplification = self.amplification;
        for _ in 0..most_sweeps {
            let mut change = Change::default();
            for (i, &rho) in reflectance.iter().enumerate() {
                weights[i] = change.note(weights[i], one + rho * form_factors.receive(i, weights));
            }
            let rest = self.per_bounce * change.step;
            let bound = change.largest.zip(rest, |largest, rest| {
                if rest <= half { largest / (S::Scalar::ONE - rest) } else { S::Scalar::INFINITY }
            });
            amplification = amplification.zip(bound, |a, b| a.min(b));
            if rest.zip(rest, |rest, _| rest - rest.min(half)) == S::default() {
                break;
            }
        }
        Self { amplification, ..self }
    }

    /// A bound of the spectral radius of `rho F`, in `[0, 1]`: `max (T w)_i / w_i <= 1 - min v / max w` by Collatz and
    /// Wielandt, which is `c` for a single bounce.
    pub(super) fn radius(&self) -> S {
        self.amplification.zip(S::default(), |a, _| S::Scalar::ONE - S::Scalar::ONE / a)
    }
}
