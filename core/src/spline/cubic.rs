//! Cubic pieces in all bases: powers, Bezier, Hermite, uniform B-spline, and exact ways between them.

use super::arc_length::{cubic_length, integrate};
use super::control_point::check_finite;
use super::curve::evaluated_by_itself;
use super::{ControlPoint, Curve, Jet, SplineError};
use crate::math::{Real, VectorSpace};

/// The cubic `a + b t + c t^2 + d t^3`: the form that is evaluated fastest.
///
/// Forms are converted by 4 x 4 matrices whose entries are fractions; there and back gives the same points, to
/// rounding. Farin, "Curves and Surfaces for CAGD", sections 7.5 and 9.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cubic<P>(pub [P; 4]);

impl<P: ControlPoint> Cubic<P> {
    /// From the control points of a Bezier curve.
    #[inline]
    pub fn from_bezier([p, q, r, s]: [P; 4]) -> Self {
        let three = number::<P>(3.0);
        let (pq, qr, rs) = (q - p, r - q, s - r);
        Self([p, pq * three, (qr - pq) * three, (rs - qr) - (qr - pq)])
    }

    /// The control points of the same Bezier curve.
    pub fn to_bezier(self) -> [P; 4] {
        let three = number::<P>(3.0);
        let [a, b, c, d] = self.0;
        [a, a + b / three, a + (b * number::<P>(2.0) + c) / three, a + b + c + d]
    }

    /// From both ends and the derivatives there.
    pub fn from_hermite([p, q]: [P; 2], [from, to]: [P; 2]) -> Self {
        let (two, three) = (number::<P>(2.0), number::<P>(3.0));
        let chord = q - p;
        Self([p, from, chord * three - from * two - to, from + to - chord * two])
    }

    /// Both ends, and the derivatives there.
    pub fn to_hermite(self) -> [[P; 2]; 2] {
        let [a, b, c, d] = self.0;
        [[a, a + b + c + d], [b, b + c * number::<P>(2.0) + d * number::<P>(3.0)]]
    }

    /// From four control points of a uniform B-spline: the piece between the second and the third knot from the middle.
    #[inline]
    pub fn from_bspline([p, q, r, s]: [P; 4]) -> Self {
        let (sixth, half) = (number::<P>(1.0 / 6.0), number::<P>(0.5));
        let second = (p - q) + (r - q);
        Self([q + second * sixth, (r - p) * half, second * half, ((q - r) * number::<P>(3.0) + (s - p)) * sixth])
    }

    /// The control points of the uniform B-spline that has this piece.
    pub fn to_bspline(self) -> [P; 4] {
        let [a, b, c, d] = self.0;
        let q = a - c / number::<P>(3.0);
        let (p, r) = (q + c - b, q + c + b);
        let s = d * number::<P>(6.0) + p + (r - q) * number::<P>(3.0);
        [p, q, r, s]
    }

    /// The point at `t`, in `[0, 1]` on the piece.
    #[inline]
    pub fn point(&self, t: P::Scalar) -> P::Point {
        let [a, b, c, d] = self.0;
        (((d * t + c) * t + b) * t + a).project()
    }

    /// The point at `t` with its derivatives.
    #[inline]
    pub fn at(&self, t: P::Scalar) -> Jet<P::Point> {
        let [a, b, c, d] = self.0;
        let (two, three) = (number::<P>(2.0), number::<P>(3.0));
        let (cc, ddd) = (c * two, d * three);
        P::project_jet(Jet {
            point: ((d * t + c) * t + b) * t + a,
            first: (ddd * t + cc) * t + b,
            second: ddd * (t * two) + cc,
        })
    }
}

impl<P: ControlPoint> Curve for Cubic<P> {
    type Point = P::Point;

    fn domain(&self) -> [P::Scalar; 2] {
        [P::Scalar::ZERO, P::Scalar::ONE]
    }
    evaluated_by_itself!();
    #[inline]
    fn piece_length(&self, interval: [P::Scalar; 2], tolerance: P::Scalar) -> P::Scalar {
        if P::DIMENSION > P::Point::DIMENSION {
            return integrate(self, interval, tolerance);
        }
        let [_, b, c, d] = self.0;
        cubic_length([b, c * number::<P>(2.0), d * number::<P>(3.0)], interval, tolerance)
    }
}

/// Cubics in a row on borrowed memory; piece `i` has the parameters from `i` to `i + 1`.
///
/// What a uniform B-spline, a Hermite spline or Bezier curves in a row are turned into where speed counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cubics<'a, P>(&'a [Cubic<P>]);

impl<'a, P: ControlPoint> Cubics<'a, P> {
    /// At least one piece.
    ///
    /// # Errors
    ///
    /// Where there is none, or a coordinate is not finite.
    pub fn new(pieces: &'a [Cubic<P>]) -> Result<Self, SplineError> {
        if pieces.is_empty() {
            return Err(SplineError::Empty);
        }
        match pieces.iter().position(|piece| check_finite(&piece.0).is_err()) {
            Some(index) => Err(SplineError::NotFinite { index }),
            None => Ok(Self(pieces)),
        }
    }

    /// The point at `t`; outside of the domain, on the continuation of the first or the last piece.
    #[inline]
    pub fn point(&self, t: P::Scalar) -> P::Point {
        let (piece, t) = self.piece(t);
        piece.point(t)
    }

    /// The point at `t` with its derivatives.
    #[inline]
    pub fn at(&self, t: P::Scalar) -> Jet<P::Point> {
        let (piece, t) = self.piece(t);
        piece.at(t)
    }

    /// The piece at a parameter, and its own parameter.
    #[inline]
    fn piece(&self, t: P::Scalar) -> (&'a Cubic<P>, P::Scalar) {
        let index = t.to_usize().min(self.0.len() - 1);
        (&self.0[index], t - P::Scalar::from_usize(index))
    }
}

impl<P: ControlPoint> Curve for Cubics<'_, P> {
    type Point = P::Point;

    fn domain(&self) -> [P::Scalar; 2] {
        [P::Scalar::ZERO, P::Scalar::from_usize(self.0.len())]
    }
    evaluated_by_itself!();
    fn piece_length(&self, [from, to]: [P::Scalar; 2], tolerance: P::Scalar) -> P::Scalar {
        let (piece, start) = self.piece(from);
        piece.piece_length([start, start + (to - from)], tolerance)
    }
    fn next_break(&self, t: P::Scalar) -> P::Scalar {
        P::Scalar::from_usize((t.to_usize() + usize::from(t >= P::Scalar::ZERO)).min(self.0.len()))
    }
}

#[inline(always)]
fn number<P: VectorSpace>(x: f64) -> P::Scalar {
    P::Scalar::from_f64(x)
}
