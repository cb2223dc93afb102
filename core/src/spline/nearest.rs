//! The point of a curve that is nearest to another point.

use super::bernstein::PASCAL;
use super::bezier::MAX_ORDER;
use super::split::halve;
use super::{BSpline, Bezier, ControlPoint};
use crate::math::{Real, VectorSpace};

/// A point of a curve and its distance from another point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Nearest<V: VectorSpace> {
    /// Its parameter on the curve.
    pub parameter: V::Scalar,
    /// Where it lies.
    pub point: V,
    /// How far away it is.
    pub distance: V::Scalar,
}

/// How often a curve is cut in halves: bounds are off by the square of the length of the pieces.
const DEEPEST: usize = 28;
/// How many pieces are looked at: far more than a curve needs that does not run around the point.
const MOST: usize = 1 << 13;

impl<P: ControlPoint> Bezier<'_, P> {
    /// The point nearest to another one; of several, one of them.
    ///
    /// The nearest one of all, not only of its surroundings: branch and bound. In Bernstein form no value of the squared
    /// distance is below its smallest coefficient, so that parts of the curve that cannot be nearer are left out. Known to
    /// be the nearest one after at most 8192 parts. The
    /// distance is right to rounding, the parameter to the square root of it where the curve runs around the point.
    pub fn nearest(&self, to: P::Point) -> Nearest<P::Point> {
        let far = Nearest { distance: P::Scalar::INFINITY, ..Nearest::default() };
        self.nearer(to, far)
    }

    /// The point nearest to another one, or the one known before if that one is.
    fn nearer(&self, to: P::Point, best: Nearest<P::Point>) -> Nearest<P::Point> {
        let mut search = Search { curve: *self, to, best, pieces: 0 };
        let mut points = [P::default(); MAX_ORDER];
        points[..=self.degree()].copy_from_slice(self.points());
        let [start, end] = [P::Scalar::ZERO, P::Scalar::ONE];
        search.improve(start);
        search.improve(end);
        search.within(&mut points[..=self.degree()], [start, end], 0);
        search.best
    }
}

impl<P: ControlPoint> BSpline<'_, P> {
    /// The point nearest to another one; of several, one of them. As that of all its Bezier pieces.
    pub fn nearest(&self, to: P::Point) -> Nearest<P::Point> {
        let mut nearest = Nearest { distance: P::Scalar::INFINITY, ..Nearest::default() };
        let ends = |span: usize| [0, 1].map(|i| self.knots().knots()[span + i]);
        // A near point that is known early spares most pieces.
        for [start, end] in self.knots().spans().map(ends) {
            let parameter = (start + end) * P::Scalar::from_f64(0.5);
            let point = self.point(parameter);
            let distance = (point - to).length();
            if distance < nearest.distance {
                nearest = Nearest { parameter, point, distance };
            }
        }
        let mut points = [P::default(); MAX_ORDER];
        let points = &mut points[..=self.degree()];
        for span in self.knots().spans() {
            if self.bezier(span, points).is_err() {
                continue;
            }
            let [start, end] = ends(span);
            let candidate = Bezier::trusted(points).nearer(to, nearest);
            if candidate.distance < nearest.distance {
                nearest = Nearest { parameter: start + (end - start) * candidate.parameter, ..candidate };
            }
        }
        nearest
    }
}

struct Search<'a, P: ControlPoint> {
    curve: Bezier<'a, P>,
    to: P::Point,
    best: Nearest<P::Point>,
    pieces: usize,
}

impl<P: ControlPoint> Search<'_, P> {
    /// Looks for a nearer point in the part of the curve with these control points.
    fn within(&mut self, points: &mut [P], [from, to]: [P::Scalar; 2], depth: usize) {
        if depth == DEEPEST || self.pieces == MOST || !self.may_be_nearer(points) {
            return;
        }
        self.pieces += 1;
        let half = P::Scalar::from_f64(0.5);
        let middle = (from + to) * half;
        self.improve(self.newton(middle, [from, to]));
        let mut before = [P::default(); MAX_ORDER];
        let before = &mut before[..points.len()];
        halve(points, half, before);
        self.within(before, [from, middle], depth + 1);
        self.within(points, [middle, to], depth + 1);
    }

    fn improve(&mut self, t: P::Scalar) {
        let point = self.curve.point(t);
        let distance = (point - self.to).length();
        if distance < self.best.distance {
            self.best = Nearest { parameter: t, point, distance };
        }
    }

    /// Whether `|weight (c - p)|^2 - (weight best)^2` has a negative coefficient: where it has none, no point is nearer.
    fn may_be_nearer(&self, points: &[P]) -> bool {
        let n = points.len() - 1;
        let mut offsets = [P::Point::default(); MAX_ORDER];
        for (offset, point) in offsets.iter_mut().zip(points) {
            *offset = (point.project() - self.to) * point.weight();
        }
        let best = self.best.distance * self.best.distance;
        let known = best * (P::Scalar::ONE - P::Scalar::EPSILON * P::Scalar::from_f64(32.0));
        (0..=2 * n).any(|k| {
            let pairs = k.saturating_sub(n)..=k.min(n);
            let sum = pairs.map(|i| {
                let j = k - i;
                let excess = offsets[i].dot(offsets[j]) - points[i].weight() * points[j].weight() * known;
                excess * P::Scalar::from_f64(PASCAL[n][i] * PASCAL[n][j])
            });
            sum.sum::<P::Scalar>() < P::Scalar::ZERO
        })
    }

    /// A few steps towards `(c - p) c' = 0`, held in the interval.
    fn newton(&self, mut t: P::Scalar, [from, to]: [P::Scalar; 2]) -> P::Scalar {
        for _ in 0..4 {
            let jet = self.curve.at(t);
            let offset = jet.point - self.to;
            let bend = jet.first.length_squared() + offset.dot(jet.second);
            if bend <= P::Scalar::ZERO {
                return t;
            }
            t = (t - offset.dot(jet.first) / bend).clamp(from, to);
        }
        t
    }
}
