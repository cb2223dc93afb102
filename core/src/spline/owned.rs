//! Curves that own their knots and control points.

use alloc::vec;
use alloc::vec::Vec;

use super::control_point::check_highest;
use super::interpolation::band;
use super::{
    BSpline, Bezier, ControlPoint, Homogeneous, KnotVector, SplineError, averaged_knots, bezier_knots, chord_times,
    fit, interpolate,
};
use crate::math::{Real, VectorSpace};

/// A [`BSpline`] with knots and control points of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnedBSpline<P: VectorSpace> {
    pub(super) knots: Vec<P::Scalar>,
    pub(super) degree: usize,
    pub(super) points: Vec<P>,
}

/// A NURBS curve with knots and control points of its own.
pub type OwnedNurbs<V> = OwnedBSpline<Homogeneous<V>>;

impl<P: ControlPoint> OwnedBSpline<P> {
    /// An open curve, or a closed one where `degree` points less are given; see [`BSpline::new`] and
    /// [`BSpline::closed`].
    ///
    /// # Errors
    ///
    /// As these.
    pub fn new(knots: Vec<P::Scalar>, degree: usize, points: Vec<P>) -> Result<Self, SplineError> {
        let vector = KnotVector::new(&knots, degree)?;
        match points.len() < vector.count() {
            true => BSpline::closed(vector, &points)?,
            false => BSpline::new(vector, &points)?,
        };
        Ok(Self { knots, degree, points })
    }

    /// Bezier curves in a row, of one degree: the breaks are their ends, one more than there are curves.
    ///
    /// `points` are those of the curves one after the other, without the first one of each but the first.
    ///
    /// # Errors
    ///
    /// As [`bezier_knots`] and [`new`](Self::new).
    pub fn from_beziers(breaks: &[P::Scalar], degree: usize, points: Vec<P>) -> Result<Self, SplineError> {
        check_highest(degree)?;
        let mut knots = vec![P::Scalar::ZERO; degree * breaks.len() + 2];
        bezier_knots(breaks, degree, &mut knots)?;
        Self::new(knots, degree, points)
    }

    /// The curve, which is where all that can be asked is found.
    pub fn curve(&self) -> BSpline<'_, P> {
        BSpline::trusted(KnotVector::trusted(&self.knots, self.degree), &self.points)
    }

    /// The same curve with one knot more; an open one, as in all that follows.
    ///
    /// # Errors
    ///
    /// As [`BSpline::insert`].
    pub fn inserted(&self, knot: P::Scalar) -> Result<Self, SplineError> {
        let mut other = Self::zero(self.knots.len() + 1, self.degree);
        self.curve().insert(knot, &mut other.knots, &mut other.points)?;
        Ok(other)
    }

    /// A curve with one knot less, and how far it is away at most.
    ///
    /// # Errors
    ///
    /// As [`BSpline::remove`].
    pub fn removed(&self, knot: P::Scalar) -> Result<(Self, P::Scalar), SplineError> {
        let mut other = Self::zero(self.knots.len() - 1, self.degree);
        let distance = self.curve().remove(knot, &mut other.knots, &mut other.points)?;
        Ok((other, distance))
    }

    /// The same curve with a degree higher by one.
    ///
    /// # Errors
    ///
    /// As [`BSpline::elevate`].
    pub fn elevated(&self) -> Result<Self, SplineError> {
        let mut other = Self::zero(self.curve().elevated_knots(), self.degree + 1);
        self.curve().elevate(&mut other.knots, &mut other.points)?;
        Ok(other)
    }

    /// The Bezier pieces, each with its interval of the domain.
    pub fn beziers(&self) -> Vec<([P::Scalar; 2], OwnedBezier<P>)> {
        let piece = |span: usize| {
            let mut points = vec![P::default(); self.degree + 1];
            // The buffer fits.
            let _ = self.curve().bezier(span, &mut points);
            ([self.knots[span], self.knots[span + 1]], OwnedBezier(points))
        };
        self.curve().knots().spans().map(piece).collect()
    }

    /// Nothing yet, but of the right size.
    fn zero(knots: usize, degree: usize) -> Self {
        let points = vec![P::default(); knots.saturating_sub(degree + 1)];
        Self { knots: vec![P::Scalar::ZERO; knots], degree, points }
    }
}

impl<V: ControlPoint<Point = V>> OwnedBSpline<V> {
    /// The curve of a degree through points, at parameters in proportion to their distances.
    ///
    /// # Errors
    ///
    /// As [`averaged_knots`], [`KnotVector::new`] and [`interpolate`].
    pub fn through(points: &[V], degree: usize) -> Result<Self, SplineError> {
        check_highest(degree)?;
        let mut parameters = vec![V::Scalar::ZERO; points.len()];
        chord_times(points, V::Scalar::ONE, &mut parameters)?;
        let mut curve = Self::zero(points.len() + degree + 1, degree);
        averaged_knots(&parameters, degree, &mut curve.knots)?;
        let knots = KnotVector::new(&curve.knots, degree)?;
        let mut scratch = vec![V::Scalar::ZERO; band(points.len(), degree)];
        interpolate(knots, &parameters, points, &mut scratch, &mut curve.points)?;
        Ok(curve)
    }

    /// The curve of given knots nearest to points at given parameters, and the root of the mean of the squared
    /// distances.
    ///
    /// # Errors
    ///
    /// As [`KnotVector::new`] and [`fit`].
    pub fn near(
        knots: Vec<V::Scalar>,
        degree: usize,
        parameters: &[V::Scalar],
        points: &[V],
    ) -> Result<(Self, V::Scalar), SplineError> {
        let vector = KnotVector::new(&knots, degree)?;
        let mut control_points = vec![V::default(); vector.count()];
        let mut scratch = vec![V::Scalar::ZERO; band(vector.count(), degree)];
        let distance = fit(vector, parameters, points, &mut scratch, &mut control_points)?;
        Ok((Self { knots, degree, points: control_points }, distance))
    }
}

/// A [`Bezier`] curve with control points of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnedBezier<P>(Vec<P>);

impl<P: ControlPoint> OwnedBezier<P> {
    /// A curve from the first point to the last one.
    ///
    /// # Errors
    ///
    /// As [`Bezier::new`].
    pub fn new(points: Vec<P>) -> Result<Self, SplineError> {
        Bezier::new(&points)?;
        Ok(Self(points))
    }

    /// The curve, which is where all that can be asked is found.
    pub fn curve(&self) -> Bezier<'_, P> {
        Bezier::trusted(&self.0)
    }
}
