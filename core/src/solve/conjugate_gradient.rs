//! Conjugate gradients on the symmetrized system.

use super::solver::Change;
use super::{Accuracy, FormFactors, Solution, Solver, Stop, System};
use crate::math::Real;
use crate::spectrum::Spectrum;

/// Solves by [`ConjugateGradient`] from the start given in `radiosity`; `scratch` has at least three times as many
/// entries, `areas` as many.
pub fn conjugate_gradient<S: Spectrum, F: FormFactors<Scalar = S::Scalar>>(
    system: &System<S, F>,
    areas: &[S::Scalar],
    radiosity: &mut [S],
    scratch: &mut [S],
    stop: &Stop<S::Scalar>,
) -> Solution<S::Scalar> {
    ConjugateGradient::new(system, areas, scratch).solve(system, radiosity, stop)
}

/// Conjugate gradients on `(A / rho - A F) b = A e / rho`, which reciprocity `A_i F_ij = A_j F_ji` makes symmetric and
/// positive definite. Hestenes and Stiefel 1952.
///
/// Written without the division, this is the iteration for `b - rho F b = e` with the scalar product
/// `sum_i A_i / rho_i u_i v_i`. All residuals and directions are multiples of `rho`, so that a patch without
/// reflectance has no part in them: its radiosity is `e`. That holds from zero, from `e` and from all starts
/// `e + rho (any light)`; others converge too, but later where `rho` is small and not zero.
///
/// No other iteration of one sweep a step comes closer, but it needs two sums over all patches in each step, and form
/// factors that obey reciprocity: those from rays do only up to noise, and so the iteration may stall. The residual is
/// carried along and not measured again; in single precision both part by a few units of rounding.
#[derive(Debug)]
pub struct ConjugateGradient<'a, S: Spectrum> {
    areas: &'a [S::Scalar],
    residual: &'a mut [S],
    direction: &'a mut [S],
    received: &'a mut [S],
    /// The square of the residual, once there is one.
    square: Option<S>,
}

impl<'a, S: Spectrum> ConjugateGradient<'a, S> {
    /// Before the first sweep; `scratch` has at least three entries for each patch, `areas` one, all of one unit.
    pub fn new<F>(system: &System<S, F>, areas: &'a [S::Scalar], scratch: &'a mut [S]) -> Self {
        let count = system.exitance.len();
        let (residual, rest) = scratch.split_at_mut(count);
        let (direction, rest) = rest.split_at_mut(count);
        Self { areas, residual, direction, received: &mut rest[..count], square: None }
    }

    /// Measures the residual; the radiosities become those of a bounce further.
    fn start<F: FormFactors<Scalar = S::Scalar>>(&mut self, system: &System<S, F>, radiosity: &mut [S]) -> Change<S> {
        for (i, radiosity) in radiosity.iter_mut().enumerate() {
            let (zero, rho) = (S::Scalar::ZERO, system.reflectance[i]);
            let of_black = rho.zip(system.exitance[i], |rho, exitance| if rho > zero { zero } else { exitance });
            *radiosity = of_black + rho.zip(*radiosity, |rho, start| if rho > zero { start } else { zero });
        }
        system.form_factors.receive_all(radiosity, self.received);
        let mut change = Change::default();
        for (i, radiosity) in radiosity.iter_mut().enumerate() {
            let next = change.note(*radiosity, system.reflect(i, self.received[i]));
            self.residual[i] = next - *radiosity;
            self.direction[i] = self.residual[i];
            *radiosity = next;
        }
        change
    }

    /// Goes along the direction to where the residual is orthogonal to it. `x + r`, the state a bounce further, is
    /// what the radiosities hold: it moves by `alpha rho F d`.
    fn descend<F: FormFactors<Scalar = S::Scalar>>(
        &mut self,
        system: &System<S, F>,
        radiosity: &mut [S],
        square: S,
    ) -> Change<S> {
        system.form_factors.receive_all(self.direction, self.received);
        let mut slope = S::default();
        for (i, &direction) in self.direction.iter().enumerate() {
            self.received[i] = system.reflectance[i] * self.received[i];
            slope += self.product(system, i, direction, direction - self.received[i]);
        }
        let alpha = ratio(square, slope);
        let mut change = Change::default();
        for (i, radiosity) in radiosity.iter_mut().enumerate() {
            *radiosity += alpha * self.received[i];
            self.residual[i] = self.residual[i] - alpha * (self.direction[i] - self.received[i]);
            change.note(*radiosity - self.residual[i], *radiosity);
        }
        change
    }

    /// The term of patch `i` in the scalar product.
    fn product<F>(&self, system: &System<S, F>, i: usize, u: S, v: S) -> S {
        ratio(u, system.reflectance[i]) * v * self.areas[i]
    }
}

impl<S: Spectrum, F: FormFactors<Scalar = S::Scalar>> Solver<S, F> for ConjugateGradient<'_, S> {
    fn step(&mut self, system: &System<S, F>, radiosity: &mut [S]) -> Accuracy<S> {
        let change = match self.square {
            None => self.start(system, radiosity),
            Some(square) => self.descend(system, radiosity, square),
        };
        let mut square = S::default();
        for (i, &residual) in self.residual.iter().enumerate() {
            square += self.product(system, i, residual, residual);
        }
        if let Some(before) = self.square {
            let beta = ratio(square, before);
            for (direction, &residual) in self.direction.iter_mut().zip(self.residual.iter()) {
                *direction = residual + beta * *direction;
            }
        }
        self.square = Some(square);
        change.after_bounce(&system.decay)
    }
}

/// `a / b` band by band, and zero where `b` is not positive.
fn ratio<S: Spectrum>(a: S, b: S) -> S {
    a.zip(b, |a, b| if b > S::Scalar::ZERO { a / b } else { S::Scalar::ZERO })
}
