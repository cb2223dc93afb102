//! Curves with the same degree and the same knots: what surfaces are built from.

use alloc::vec;
use alloc::vec::Vec;

use crate::math::Real;
use crate::spline::{BSpline, ControlPoint, KnotVector, OwnedBSpline};

impl<P: ControlPoint> OwnedBSpline<P> {
    /// A copy of a curve that begins and ends at its first and its last control point.
    pub fn clamped(curve: &BSpline<P>) -> Self {
        let (knots, points) = (curve.knots(), curve.points());
        let all = (0..knots.count()).map(|i| points[i % points.len()]).collect();
        let own = Self { knots: knots.knots().to_vec(), degree: knots.degree(), points: all };
        let clamped = own.clamped_knots();
        if clamped == own.knots { own } else { own.with_knots(clamped) }
    }

    /// The same curve over `[0, 1]`.
    pub(super) fn over_unit(mut self) -> Self {
        let [start, end] = self.curve().knots().domain();
        self.knots.iter_mut().for_each(|knot| *knot = (*knot - start) / (end - start));
        self
    }

    /// The same curve with more knots, given in non-decreasing order within its domain.
    pub(super) fn with_inserted(&self, inserted: &[P::Scalar]) -> Self {
        self.with_knots(merged(&self.knots, inserted))
    }

    /// The knots with more of them.
    pub(super) fn with_inserted_knots(&self, inserted: &[P::Scalar]) -> Vec<P::Scalar> {
        merged(&self.knots, inserted)
    }

    /// The part before (0) or after (1) a parameter inside of the domain.
    pub(super) fn part(&self, t: P::Scalar, part: usize) -> Self {
        let p = self.degree;
        let mut knots = self.clamped_knots();
        knots.retain(|&knot| if part == 0 { knot < t } else { knot > t });
        let ends = vec![t; p + 1];
        self.with_knots(if part == 0 { [knots, ends].concat() } else { [ends, knots].concat() })
    }

    /// The same curve with other knots, among which are all that there were inside of the domain.
    pub(super) fn with_knots(&self, knots: Vec<P::Scalar>) -> Self {
        let finer = KnotVector::trusted(&knots, self.degree);
        let mut points = vec![P::default(); finer.count()];
        match self.curve().refine(finer, &mut points) {
            Ok(()) => Self { knots, degree: self.degree, points },
            Err(_) => self.clone(),
        }
    }

    /// The same curve with a degree higher by one; the highest degree stays.
    pub(super) fn raised(&self) -> Self {
        self.elevated().unwrap_or_else(|_| self.clone())
    }

    fn clamped_knots(&self) -> Vec<P::Scalar> {
        let [start, end] = self.curve().knots().domain();
        let mut knots = vec![start; self.degree + 1];
        knots.extend(self.knots.iter().filter(|&&knot| start < knot && knot < end));
        knots.extend(vec![end; self.degree + 1]);
        knots
    }
}

/// Curves over `[0, 1]` with the same degree and the same knots.
pub(super) fn compatible<P: ControlPoint>(curves: Vec<OwnedBSpline<P>>) -> Vec<OwnedBSpline<P>> {
    let degree = curves.iter().map(|curve| curve.degree).max().unwrap_or(0);
    let raised = |curve: OwnedBSpline<P>| {
        let mut curve = curve.over_unit();
        while curve.degree < degree {
            curve = curve.raised();
        }
        curve
    };
    let curves: Vec<OwnedBSpline<P>> = curves.into_iter().map(raised).collect();
    let all = curves.iter().fold(Vec::new(), |all, curve| united(&all, &curve.knots));
    curves.iter().map(|curve| if curve.knots == all { curve.clone() } else { curve.with_knots(all.clone()) }).collect()
}

/// Each knot as often as in the list that has it more often.
fn united<R: Real>(a: &[R], b: &[R]) -> Vec<R> {
    let missing: Vec<R> = b
        .chunk_by(|a, b| a == b)
        .flat_map(|equal| {
            let there = a.iter().filter(|&&knot| knot == equal[0]).count();
            equal.iter().copied().skip(there)
        })
        .collect();
    merged(a, &missing)
}

/// Two lists in order as one.
fn merged<R: Real>(a: &[R], b: &[R]) -> Vec<R> {
    let mut all = a.to_vec();
    for &knot in b {
        all.insert(all.partition_point(|&other| other <= knot), knot);
    }
    all
}
