//! Curves that own their knots and points: what surfaces are built from.

use alloc::vec;
use alloc::vec::Vec;

use crate::math::{Real, VectorSpace};
use crate::spline::{BSpline, ControlPoint, KnotVector};

/// A B-spline curve that owns its knots and control points, from the first to the last one.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnedCurve<P: VectorSpace> {
    /// In non-decreasing order, the first and the last `degree + 1` times.
    pub(super) knots: Vec<P::Scalar>,
    pub(super) degree: usize,
    pub(super) points: Vec<P>,
}

impl<P: ControlPoint> OwnedCurve<P> {
    /// A copy of a curve that begins and ends at control points.
    pub fn new(curve: &BSpline<P>) -> Self {
        let (knots, points) = (curve.knots(), curve.points());
        let all = (0..knots.count()).map(|i| points[i % points.len()]).collect();
        let own = Self { knots: knots.knots().to_vec(), degree: knots.degree(), points: all };
        let clamped = own.clamped_knots();
        if clamped == own.knots { own } else { own.with_knots(clamped) }
    }

    /// To evaluate it.
    pub fn curve(&self) -> BSpline<'_, P> {
        BSpline::trusted(self.knot_vector(), &self.points)
    }

    /// The control points.
    pub fn points(&self) -> &[P] {
        &self.points
    }

    /// The knots with the degree.
    pub fn knot_vector(&self) -> KnotVector<'_, P::Scalar> {
        KnotVector::trusted(&self.knots, self.degree)
    }

    /// The same curve over `[0, 1]`.
    pub(super) fn over_unit(mut self) -> Self {
        let [start, end] = self.knot_vector().domain();
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
    pub(super) fn elevated(&self) -> Self {
        let degree = self.degree + 1;
        let mut knots = vec![P::Scalar::ZERO; self.curve().elevated_knots()];
        let mut points = vec![P::default(); knots.len() - degree - 1];
        match self.curve().elevate(&mut knots, &mut points) {
            Ok(()) => Self { knots, degree, points },
            Err(_) => self.clone(),
        }
    }

    fn clamped_knots(&self) -> Vec<P::Scalar> {
        let [start, end] = self.knot_vector().domain();
        let mut knots = vec![start; self.degree + 1];
        knots.extend(self.knots.iter().filter(|&&knot| start < knot && knot < end));
        knots.extend(vec![end; self.degree + 1]);
        knots
    }
}

/// Curves over `[0, 1]` with the same degree and the same knots.
pub(super) fn compatible<P: ControlPoint>(curves: Vec<OwnedCurve<P>>) -> Vec<OwnedCurve<P>> {
    let degree = curves.iter().map(|curve| curve.degree).max().unwrap_or(0);
    let raised = |curve: OwnedCurve<P>| {
        let mut curve = curve.over_unit();
        while curve.degree < degree {
            curve = curve.elevated();
        }
        curve
    };
    let curves: Vec<OwnedCurve<P>> = curves.into_iter().map(raised).collect();
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
