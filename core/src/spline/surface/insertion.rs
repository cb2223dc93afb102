//! The same surface with one knot more, and one of its curves, in the memory of the caller.

use super::{BSplineSurface, Direction, Scalar, SurfacePoint};
use crate::math::Real;
use crate::spline::SplineError;
use crate::spline::split::check_buffer;

impl<P: SurfacePoint> BSplineSurface<'_, P> {
    /// Writes the knots along a direction and the control points of the same surface with one knot more along it.
    ///
    /// All rows or all columns get it, as curves do from [`insert`](crate::spline::BSpline::insert). `knots` is longer by
    /// one than those along the direction; `points` has one column or one row more than those of the surface.
    ///
    /// # Errors
    ///
    /// Where the parameter lies outside of the domain or is a knot with full multiplicity, or a buffer does not fit.
    pub fn insert(
        &self,
        direction: Direction,
        t: Scalar<P>,
        knots: &mut [Scalar<P>],
        points: &mut [P],
    ) -> Result<(), SplineError> {
        let (along, columns, rows) = (self.knots(direction), self.columns(), self.knots(Direction::V).count());
        let wider = columns + usize::from(direction == Direction::U);
        let higher = rows + usize::from(direction == Direction::V);
        check_buffer(points.len(), wider * higher)?;
        let span = along.insert(t, knots)?;
        let old = self.points();
        for (index, point) in points.iter_mut().enumerate() {
            let (i, j) = (index % wider, index / wider);
            *point = match direction {
                Direction::U => along.boehm(span, t, i, |k| old[j * columns + k]),
                Direction::V => along.boehm(span, t, j, |k| old[k * columns + i]),
            };
        }
        Ok(())
    }

    /// Writes the control points of the curve on the surface along a direction, where the other parameter is `t`, held
    /// within the domain. Its knots are those [along](Self::knots) the direction.
    ///
    /// Each is a point of the curve whose control points are those of the surface across the direction. "The NURBS Book",
    /// section 4.4.
    ///
    /// # Errors
    ///
    /// Where the buffer does not have one point for each column, along `u`, or each row, along `v`.
    pub fn isocurve(&self, along: Direction, t: Scalar<P>, points: &mut [P]) -> Result<(), SplineError> {
        check_buffer(points.len(), self.knots(along).count())?;
        let columns = self.columns();
        let (across, step, stride) = match along {
            Direction::U => (self.knots(Direction::V), 1, columns),
            Direction::V => (self.knots(Direction::U), columns, 1),
        };
        let [low, high] = across.domain();
        let t = t.clamp(low, high);
        let span = across.span(t);
        let (first, weights) = (span - across.degree(), across.basis(span, t));
        for (index, point) in points.iter_mut().enumerate() {
            let terms = (first..=span).zip(&weights);
            *point = terms.fold(P::default(), |mut sum, (k, &weight)| {
                sum += self.points()[index * step + k * stride] * weight;
                sum
            });
        }
        Ok(())
    }
}
