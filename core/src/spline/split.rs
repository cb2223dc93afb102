//! Cutting a Bezier curve: split, segment, hodograph, bounds.

use super::bezier::{MAX_ORDER, construct};
use super::{Bezier, ControlPoint, SplineError};
use crate::math::{Real, VectorSpace};

impl<P: ControlPoint> Bezier<'_, P> {
    /// Writes the control points of the parts before and after `t` in `[0, 1]`.
    ///
    /// They are the first and the last points of the rounds of de Casteljau's construction.
    ///
    /// # Errors
    ///
    /// Where the parameter lies outside, or a buffer is not as long as the control points.
    pub fn split(&self, t: P::Scalar, before: &mut [P], after: &mut [P]) -> Result<(), SplineError> {
        check_inside(t)?;
        check_buffer(before.len(), self.points().len())?;
        check_buffer(after.len(), self.points().len())?;
        after.copy_from_slice(self.points());
        halve(after, t, before);
        Ok(())
    }

    /// Writes the control points of the part from one parameter to another, both in `[0, 1]`; backwards if they descend.
    ///
    /// Point `i` is the blossom of the curve with `i` times the second parameter and else the first one. Farin,
    /// section 5.4.
    ///
    /// # Errors
    ///
    /// Where a parameter lies outside, or the buffer is not as long as the control points.
    pub fn segment(&self, [from, to]: [P::Scalar; 2], segment: &mut [P]) -> Result<(), SplineError> {
        check_inside(from)?;
        check_inside(to)?;
        check_buffer(segment.len(), self.points().len())?;
        for (i, point) in segment.iter_mut().enumerate() {
            let mut scratch = [P::default(); MAX_ORDER];
            scratch[..self.points().len()].copy_from_slice(self.points());
            for count in (2..=self.points().len()).rev() {
                let t = if self.points().len() - count < i { to } else { from };
                construct(&mut scratch[..count], t);
            }
            *point = scratch[0];
        }
        Ok(())
    }

    /// The smallest and the largest coordinates of the curve, to rounding.
    ///
    /// The curve lies in the hull of its control points. It is cut in halves; those whose hull lies inside what is
    /// known of the curve are left out, so that only the surroundings of extreme points are cut further.
    pub fn bounds(&self) -> [P::Point; 2] {
        let [first, last] = [0, self.degree()].map(|i| self.points()[i].project());
        let mut bounds = [lesser(first, last), -lesser(-first, -last)];
        let mut points = [P::default(); MAX_ORDER];
        points[..=self.degree()].copy_from_slice(self.points());
        grow(&points[..=self.degree()], &mut bounds, DEEPEST);
        bounds
    }
}

impl<P: ControlPoint<Point = P>> Bezier<'_, P> {
    /// Writes the control points of the derivative, a Bezier curve of a degree lower by one.
    ///
    /// Not for rational curves, whose derivative has twice the degree: [`at`](Self::at) finds it.
    ///
    /// # Errors
    ///
    /// Where the buffer is not shorter by one than the control points.
    pub fn hodograph(&self, derivative: &mut [P]) -> Result<(), SplineError> {
        check_buffer(derivative.len(), self.degree())?;
        let n = P::Scalar::from_usize(self.degree());
        derivative.iter_mut().zip(self.points().windows(2)).for_each(|(to, pair)| *to = (pair[1] - pair[0]) * n);
        Ok(())
    }

    /// Whether the coordinate along an axis never turns back, as far as the control points tell.
    ///
    /// Control points in order are enough for it (variation diminishing), not needed.
    pub fn is_monotone(&self, axis: usize) -> bool {
        let steps = || self.points().windows(2).map(|pair| pair[1].coordinate(axis) - pair[0].coordinate(axis));
        let zero = P::Scalar::ZERO;
        steps().all(|step| step >= zero) || steps().all(|step| step <= zero)
    }
}

/// How often a curve is cut in search of its bounds: hulls shrink to a quarter with each cut.
const DEEPEST: usize = 26;

/// From the points of a curve to those of the part after `t`; those before are written to `before`.
pub(super) fn halve<P: VectorSpace>(points: &mut [P], t: P::Scalar, before: &mut [P]) {
    for (i, count) in (1..=points.len()).rev().enumerate() {
        before[i] = points[0];
        construct(&mut points[..count], t);
    }
}

fn grow<P: ControlPoint>(points: &[P], bounds: &mut [P::Point; 2], depth: usize) {
    let hull = hull(points);
    let scale = bounds[0].length() + bounds[1].length() + hull[0].length() + hull[1].length();
    let slack = scale * P::Scalar::EPSILON;
    let is_known = (0..P::Point::DIMENSION).all(|axis| {
        let of = |point: P::Point| point.coordinate(axis);
        of(hull[0]) >= of(bounds[0]) - slack && of(hull[1]) <= of(bounds[1]) + slack
    });
    if is_known || depth == 0 {
        return;
    }
    let (mut before, mut after) = ([P::default(); MAX_ORDER], [P::default(); MAX_ORDER]);
    let count = points.len();
    after[..count].copy_from_slice(points);
    halve(&mut after[..count], P::Scalar::from_f64(0.5), &mut before[..count]);
    let middle = after[0].project();
    *bounds = [lesser(bounds[0], middle), -lesser(-bounds[1], -middle)];
    grow(&before[..count], bounds, depth - 1);
    grow(&after[..count], bounds, depth - 1);
}

/// The smallest and the largest coordinates of points.
pub(super) fn hull<P: ControlPoint>(points: &[P]) -> [P::Point; 2] {
    let first = points.first().map_or(P::Point::default(), |point| point.project());
    points.iter().fold([first; 2], |[low, high], point| {
        let point = point.project();
        [lesser(low, point), -lesser(-high, -point)]
    })
}

/// The smaller coordinates of two points.
fn lesser<V: VectorSpace>(a: V, b: V) -> V {
    V::from_fn(|axis| a.coordinate(axis).min(b.coordinate(axis)))
}

pub(super) fn check_inside<R: Real>(t: R) -> Result<(), SplineError> {
    if t >= R::ZERO && t <= R::ONE {
        Ok(())
    } else {
        Err(SplineError::Parameter { parameter: t.to_f64(), domain: [0.0, 1.0] })
    }
}

pub(super) fn check_buffer(length: usize, wanted: usize) -> Result<(), SplineError> {
    if length == wanted { Ok(()) } else { Err(SplineError::Buffer { length, wanted }) }
}
