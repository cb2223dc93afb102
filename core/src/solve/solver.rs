//! What all solvers share: step by step, when to stop, and what comes out.

use core::cmp::Ordering;

use super::{Decay, System};
use crate::math::Real;
use crate::spectrum::Spectrum;

/// An iteration that can be looked at after each step.
///
/// Use a new one for each solve: it remembers. Between its steps nobody else may change the radiosities.
pub trait Solver<S: Spectrum, F> {
    /// One sweep over all patches; of [`Southwell`](super::Southwell), one shot. The first step takes any start.
    fn step(&mut self, system: &System<S, F>, radiosity: &mut [S]) -> Accuracy<S>;

    /// Steps until the solution is as close as `stop` asks, or its steps are used up.
    fn solve(&mut self, system: &System<S, F>, radiosity: &mut [S], stop: &Stop<S::Scalar>) -> Solution<S::Scalar> {
        let mut solution = Solution { steps: 0, bound: S::Scalar::INFINITY, is_converged: false };
        while solution.steps < stop.most_steps && !solution.is_converged {
            let accuracy = self.step(system, radiosity);
            solution = Solution {
                steps: solution.steps + 1,
                bound: accuracy.error.max_abs(),
                is_converged: accuracy.is_within(stop.tolerance),
            };
        }
        solution
    }
}

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop<R> {
    /// The largest error of any patch, as a share of the brightest one, in each band on its own. Typically 1e-4 for a
    /// picture. Some 10 units of rounding divided by `1 - rho` are the least that can be had.
    pub tolerance: R,
    /// A sweep is a bounce at least, so hundreds see off reflectances up to 0.98. For shooting, so many shots.
    pub most_steps: usize,
}

/// What came out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution<R> {
    /// Sweeps, or shots, that were done.
    pub steps: usize,
    /// `max_i |b_i - b*_i|` is at most this in each band, but for rounding; in the unit of `b`. Infinite where it is
    /// not known that light dies out (see [`System::look_ahead`]), and where the system holds what is not a number.
    pub bound: R,
    /// Whether the tolerance was reached. If not, there were too few steps, or there is no solution to be had.
    pub is_converged: bool,
}

/// How good the radiosities are after a step, band by band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy<S> {
    /// `max_i |b_i - b*_i|` is at most this.
    pub error: S,
    /// `max_i |b_i|`
    pub largest: S,
}

impl<S: Spectrum> Accuracy<S> {
    /// `|b - b*| <= |(I - rho F)^-1| |r|`, with a bound of the residual `r = e + rho F b - b`.
    pub(super) fn new(residual: S, largest: S, decay: &Decay<S>) -> Self {
        let error = residual.zip(decay.amplification, |residual, amplification| {
            let error = residual * amplification;
            if error >= S::Scalar::ZERO { error } else { S::Scalar::INFINITY }
        });
        Self { error, largest }
    }

    /// Whether the error is at most `tolerance` times the brightest patch, in each band.
    pub fn is_within(&self, tolerance: S::Scalar) -> bool {
        let (met, missed) = (S::Scalar::ZERO, S::Scalar::ONE);
        let misses = |error, most| if error <= most && error < S::Scalar::INFINITY { met } else { missed };
        self.error.zip(self.largest * tolerance, misses) == S::default()
    }
}

/// What a sweep does, in the maximum norm.
#[derive(Clone, Copy, Default)]
pub(super) struct Change<S> {
    /// `max |after - before|`
    pub step: S,
    /// `max |after|`
    pub largest: S,
}

impl<S: Spectrum> Change<S> {
    /// Notes one entry and gives it back.
    pub fn note(&mut self, before: S, after: S) -> S {
        self.step = larger(self.step, after - before);
        self.largest = larger(self.largest, after);
        after
    }

    /// The state that a whole bounce `b' = e + rho F b` leaves has the residual `rho F (b' - b)`.
    pub fn after_bounce(&self, decay: &Decay<S>) -> Accuracy<S> {
        Accuracy::new(self.step * decay.per_bounce, self.largest, decay)
    }
}

/// The larger magnitude, band by band; once it is no number, it stays none.
pub(super) fn larger<S: Spectrum>(largest: S, other: S) -> S {
    largest.zip(other, |largest, other| match largest.partial_cmp(&other.abs()) {
        Some(Ordering::Less) => other.abs(),
        Some(_) => largest,
        None => largest + other,
    })
}
