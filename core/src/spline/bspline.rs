//! B-spline curves: pieces of polynomials that join smoothly.

use super::basis::{cox_de_boor, cox_de_boor_derivative, cox_de_boor_orders};
use super::bezier::MAX_ORDER;
use super::control_point::check_points;
use super::curve::evaluated_by_itself;
use super::{ControlPoint, Curve, Homogeneous, Jet, KnotVector, SplineError};
use crate::math::{Real, VectorSpace};

/// A B-spline curve on borrowed knots and control points, open or closed.
///
/// Control point `i` acts between knots `i` and `i + degree + 1`. A closed curve comes back to its first control points
/// after the last one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BSpline<'a, P: VectorSpace> {
    knots: KnotVector<'a, P::Scalar>,
    points: &'a [P],
}

/// A B-spline curve with weights: non-uniform rational B-splines, which hold conics too.
pub type Nurbs<'a, V> = BSpline<'a, Homogeneous<V>>;

impl<'a, P: ControlPoint> BSpline<'a, P> {
    /// An open curve.
    ///
    /// # Errors
    ///
    /// Where there are not [`count`](KnotVector::count) points, a coordinate is not finite or a weight not positive.
    pub fn new(knots: KnotVector<'a, P::Scalar>, points: &'a [P]) -> Result<Self, SplineError> {
        Self::checked(knots, points, knots.count())
    }

    /// A closed curve, that goes through its domain again and again: all parameters are valid.
    ///
    /// # Errors
    ///
    /// As for an open one, but with `degree` points less, which are those at the beginning again; also where the
    /// distances of the first `2 degree + 1` knots do not repeat themselves at the end.
    pub fn closed(knots: KnotVector<'a, P::Scalar>, points: &'a [P]) -> Result<Self, SplineError> {
        Self::checked(knots, points, knots.period()?)
    }

    fn checked(knots: KnotVector<'a, P::Scalar>, points: &'a [P], wanted: usize) -> Result<Self, SplineError> {
        if points.len() != wanted {
            return Err(SplineError::PointCount { points: points.len(), wanted });
        }
        check_points(points)?;
        Ok(Self { knots, points })
    }

    /// An open curve of knots and points that were checked before, or computed from such.
    pub(super) fn trusted(knots: KnotVector<'a, P::Scalar>, points: &'a [P]) -> Self {
        Self { knots, points }
    }

    /// The knots.
    pub fn knots(&self) -> KnotVector<'a, P::Scalar> {
        self.knots
    }

    /// The control points.
    pub fn points(&self) -> &'a [P] {
        self.points
    }

    /// The degree of its pieces.
    pub fn degree(&self) -> usize {
        self.knots.degree()
    }

    /// Whether its end is its beginning.
    pub fn is_closed(&self) -> bool {
        self.points.len() < self.knots.count()
    }

    /// The point at `t`.
    ///
    /// Outside of the domain it lies on the continuation of the first or the last piece; a closed curve goes round.
    #[inline]
    pub fn point(&self, t: P::Scalar) -> P::Point {
        let t = self.wrapped(t);
        self.point_in(self.knots.span(t), t)
    }

    /// The points at many parameters, which is fastest where they ascend.
    ///
    /// As many as both slices have.
    pub fn sample(&self, parameters: &[P::Scalar], points: &mut [P::Point]) {
        let mut span = self.knots.degree();
        for (&t, point) in parameters.iter().zip(points) {
            let t = self.wrapped(t);
            span = self.knots.span_near(t, span);
            *point = self.point_in(span, t);
        }
    }

    /// The point at `t` with its derivatives; at a knot those of the piece after it.
    #[inline]
    pub fn at(&self, t: P::Scalar) -> Jet<P::Point> {
        let t = self.wrapped(t);
        let span = self.knots.span(t);
        P::project_jet(match self.degree() {
            2 => self.jet_of::<3>(2, span, t),
            3 => self.jet_of::<4>(3, span, t),
            degree => self.jet_of::<MAX_ORDER>(degree, span, t),
        })
    }

    /// Writes the derivatives of order 0, 1, 2 ... at `t` to `derivatives`, up to order
    /// [`MAX_DEGREE`](super::MAX_DEGREE); zero above.
    ///
    /// At a knot they are those of the piece after it. "The NURBS Book", algorithms A3.2 and A4.2.
    pub fn derivatives(&self, t: P::Scalar, derivatives: &mut [P::Point]) {
        let t = self.wrapped(t);
        let (degree, span) = (self.degree(), self.knots.span(t));
        let mut homogeneous = [P::default(); MAX_ORDER];
        for (k, derivative) in homogeneous.iter_mut().enumerate().take(derivatives.len()) {
            let basis = cox_de_boor_derivative(self.knots.around(span), degree, k, t);
            *derivative = self.weighted::<MAX_ORDER>(span, degree, &basis);
        }
        derivatives.iter_mut().for_each(|derivative| *derivative = P::Point::default());
        P::project_derivatives(&homogeneous, derivatives);
    }

    /// Control point `index` of an open curve with the same knots; `index` is below [`count`](KnotVector::count).
    #[inline]
    pub(super) fn control(&self, index: usize) -> P {
        self.points[if index < self.points.len() { index } else { index % self.points.len() }]
    }

    /// The parameter in the domain of a closed curve; itself for an open one.
    #[inline]
    fn wrapped(&self, t: P::Scalar) -> P::Scalar {
        if !self.is_closed() {
            return t;
        }
        let [start, end] = self.knots.domain();
        let turns = ((t - start) / (end - start)).floor();
        t - turns * (end - start)
    }

    #[inline]
    fn point_in(&self, span: usize, t: P::Scalar) -> P::Point {
        let sum = match self.degree() {
            1 => self.point_of::<2>(1, span, t),
            2 => self.point_of::<3>(2, span, t),
            3 => self.point_of::<4>(3, span, t),
            degree => self.point_of::<MAX_ORDER>(degree, span, t),
        };
        sum.project()
    }

    #[inline(always)]
    fn point_of<const N: usize>(&self, degree: usize, span: usize, t: P::Scalar) -> P {
        self.weighted::<N>(span, degree, &cox_de_boor(self.knots.around(span), degree, t))
    }

    #[inline(always)]
    fn jet_of<const N: usize>(&self, degree: usize, span: usize, t: P::Scalar) -> Jet<P> {
        let rows = cox_de_boor_orders::<_, N, 3>(self.knots.around(span), degree, t);
        let [point, first, second] = rows.map(|row| self.weighted::<N>(span, degree, &row));
        Jet { point, first, second }
    }

    /// The sum of the control points of a span times `factors`.
    #[inline(always)]
    fn weighted<const N: usize>(&self, span: usize, degree: usize, factors: &[P::Scalar; N]) -> P {
        let first = span - degree;
        match self.points.get(first..first + degree + 1) {
            Some(points) => {
                let terms = points.iter().zip(factors).map(|(&point, &factor)| point * factor);
                terms.reduce(|sum, term| sum + term).unwrap_or_default()
            }
            None => (0..degree + 1).fold(P::default(), |sum, i| sum + self.control(first + i) * factors[i]),
        }
    }
}

impl<P: ControlPoint> Curve for BSpline<'_, P> {
    type Point = P::Point;

    fn domain(&self) -> [P::Scalar; 2] {
        self.knots.domain()
    }
    evaluated_by_itself!();
    fn speed(&self, t: P::Scalar) -> P::Scalar {
        let t = self.wrapped(t);
        let span = self.knots.span(t);
        let jet = match self.degree() {
            2 => self.jet_of::<3>(2, span, t),
            3 => self.jet_of::<4>(3, span, t),
            degree => self.jet_of::<MAX_ORDER>(degree, span, t),
        };
        P::project_jet(Jet { second: P::default(), ..jet }).first.length()
    }
    fn next_break(&self, t: P::Scalar) -> P::Scalar {
        self.knots.next_break(t)
    }
}
