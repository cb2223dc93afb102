//! The same curve with a higher degree, and nearly the same one with a lower degree.

use super::bezier::MAX_ORDER;
use super::control_point::check_degree;
use super::split::check_buffer;
use super::{BSpline, Bezier, ControlPoint, SplineError};
use crate::math::{Real, VectorSpace};

impl<P: ControlPoint> Bezier<'_, P> {
    /// Writes control points of the same curve with a higher degree, as high as the buffer is long.
    ///
    /// Forrest's rule, once for each degree: point `i` moves `i / (n + 1)` of the way back to the one before it. Farin,
    /// section 6.1.
    ///
    /// # Errors
    ///
    /// Where the buffer is shorter than the control points or longer than [`MAX_DEGREE`](super::MAX_DEGREE) allows.
    pub fn elevate(&self, elevated: &mut [P]) -> Result<(), SplineError> {
        check_degree(elevated.len())?;
        check_buffer(elevated.len(), elevated.len().max(self.points().len()))?;
        elevated[..self.points().len()].copy_from_slice(self.points());
        (self.points().len()..elevated.len()).for_each(|count| forrest(&mut elevated[..=count]));
        Ok(())
    }

    /// Writes control points of a curve of a degree lower by one; returns how far it is away at most.
    ///
    /// Both ends stay, except for a line, of which the middle is left. From each of them Forrest's rule is solved for the lower degree; the results meet in the middle.
    /// The distance is that of the control points after elevation, which bounds that of the curves; of rational curves
    /// it is measured in homogeneous coordinates. "The NURBS Book", section 5.6.
    ///
    /// # Errors
    ///
    /// Where the degree is 0, or the buffer is not shorter by one than the control points.
    pub fn reduce(&self, reduced: &mut [P]) -> Result<P::Scalar, SplineError> {
        let points = self.points();
        check_degree(self.degree())?;
        check_buffer(reduced.len(), self.degree())?;
        let n = self.degree();
        let share = |i: usize| P::Scalar::from_usize(i) / P::Scalar::from_usize(n);
        let middle = n / 2;
        reduced[0] = points[0];
        for i in 1..n - middle {
            reduced[i] = (points[i] - reduced[i - 1] * share(i)) / (P::Scalar::ONE - share(i));
        }
        let from_start = reduced[n - middle - 1];
        reduced[n - 1] = points[n];
        for i in (n - middle - usize::from(n % 2 == 1)..n - 1).rev() {
            reduced[i] = (points[i + 1] - reduced[i + 1] * (P::Scalar::ONE - share(i + 1))) / share(i + 1);
        }
        if n % 2 == 1 {
            reduced[middle] = (reduced[middle] + from_start) * P::Scalar::from_f64(0.5);
        }
        let mut again = [P::default(); MAX_ORDER];
        again[..n].copy_from_slice(reduced);
        forrest(&mut again[..=n]);
        Ok(again.iter().zip(points).map(|(&a, &b)| (a - b).length()).fold(P::Scalar::ZERO, Real::max))
    }
}

/// Raises the degree by one; the last point is there to be written.
fn forrest<V: VectorSpace>(points: &mut [V]) {
    let n = points.len() - 1;
    points[n] = points[n - 1];
    for i in (1..n).rev() {
        points[i] = points[i].lerp(points[i - 1], V::Scalar::from_usize(i) / V::Scalar::from_usize(n));
    }
}

impl<P: ControlPoint> BSpline<'_, P> {
    /// How many knots the same curve has with a degree higher by one; it has `degree + 2` control points less.
    pub fn elevated_knots(&self) -> usize {
        self.raised_knots().count()
    }

    /// Writes knots and control points of the same curve with a degree higher by one, as an open one.
    ///
    /// Each knot stands once more. Control point `i` is the mean of the blossoms at `degree + 1` knots, of which one
    /// is left out in turn. Ramshaw, "Blossoms are polar forms", 1989.
    ///
    /// # Errors
    ///
    /// Where the degree is the highest one, or a buffer is not as long as the result.
    pub fn elevate(&self, knots: &mut [P::Scalar], points: &mut [P]) -> Result<(), SplineError> {
        let degree = self.degree() + 1;
        check_degree(degree + 1)?;
        check_buffer(knots.len(), self.elevated_knots())?;
        check_buffer(points.len(), knots.len() - degree - 1)?;
        knots.iter_mut().zip(self.raised_knots()).for_each(|(to, from)| *to = from);
        for (i, point) in points.iter_mut().enumerate() {
            let span = self.span_of(knots, degree, i);
            let mut sum = P::default();
            for left_out in 0..degree {
                let mut arguments = [P::Scalar::ZERO; MAX_ORDER];
                let others = (0..degree).filter(|&k| k != left_out);
                arguments.iter_mut().zip(others).for_each(|(to, k)| *to = knots[i + 1 + k]);
                sum += self.blossom(span, &arguments[..degree - 1]);
            }
            *point = sum / P::Scalar::from_usize(degree);
        }
        Ok(())
    }

    /// Each knot once more, but those outside of the domain as often as before.
    fn raised_knots(&self) -> impl Iterator<Item = P::Scalar> {
        let [start, end] = self.knots().domain();
        let knots = self.knots().knots();
        knots.iter().enumerate().flat_map(move |(i, &knot)| {
            let is_last = knots.get(i + 1).is_none_or(|&next| next > knot);
            let twice = is_last && knot >= start && knot <= end;
            core::iter::repeat_n(knot, 1 + usize::from(twice))
        })
    }
}
