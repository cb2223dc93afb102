//! The point of a curve that is nearest to another point.

use super::bernstein::PASCAL;
use super::bezier::MAX_ORDER;
use super::nearest_cubic::nearer_of_cubic;
use super::split::halve;
use super::{BSpline, Bezier, ControlPoint, Curve, Parameter};
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
/// Steps of Newton's method.
const STEPS: usize = 8;
/// As many coefficients as the squared distance has.
const COEFFICIENTS: usize = 2 * MAX_ORDER - 1;
/// One over the binomial coefficients `C(2 n, k)`.
static SHARES: [[f64; COEFFICIENTS]; MAX_ORDER] = shares();

const fn shares() -> [[f64; COEFFICIENTS]; MAX_ORDER] {
    let mut rows = [[1.0; COEFFICIENTS]; MAX_ORDER];
    let mut n = 0;
    while n < MAX_ORDER {
        let mut k = 0;
        while k < 2 * n {
            rows[n][k + 1] = rows[n][k] * (k + 1) as f64 / (2 * n - k) as f64;
            k += 1;
        }
        n += 1;
    }
    rows
}

impl<P: ControlPoint> Bezier<'_, P> {
    /// The point nearest to another one; of several, one of them.
    ///
    /// The nearest one of all, not only of its surroundings. For a cubic without weights it is a root of a quintic. For all
    /// others branch and bound: in Bernstein form no value of the squared distance is below its smallest coefficient, so
    /// that parts of the curve that cannot be nearer are left out; where the coefficients are convex, the part holds one
    /// minimum, which Newton's method finds. Known to be the nearest one after at most 8192 parts. The distance is right to
    /// rounding, the parameter to the square root of it where the curve runs around the point.
    pub fn nearest(&self, to: P::Point) -> Nearest<P::Point> {
        let far = Nearest { distance: P::Scalar::INFINITY, ..Nearest::default() };
        self.nearer(to, far)
    }

    /// The point nearest to another one, or the one known before if that one is.
    fn nearer(&self, to: P::Point, best: Nearest<P::Point>) -> Nearest<P::Point> {
        if let (&[a, b, c, d], true) = (self.points(), P::DIMENSION == P::Point::DIMENSION) {
            return nearer_of_cubic([a, b, c, d].map(P::project), to, best);
        }
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
    /// The point nearest to another one; of several, one of them.
    ///
    /// As that of all Bezier pieces but those whose control points lie further away, seen from the point, than what
    /// Newton's method finds from the nearest middle of a piece.
    pub fn nearest(&self, to: P::Point) -> Nearest<P::Point> {
        let mut nearest = Nearest { distance: P::Scalar::INFINITY, ..Nearest::default() };
        let ends = |span: usize| [0, 1].map(|i| self.knots().knots()[span + i]);
        let (mut interval, half) = (self.knots().domain(), P::Scalar::from_f64(0.5));
        // A near point that is known early spares most pieces.
        for [start, end] in self.knots().spans().map(ends) {
            let parameter = (start + end) * half;
            let point = self.point(parameter);
            let distance = (point - to).length_squared();
            if distance < nearest.distance {
                (nearest, interval) = (Nearest { parameter, point, distance }, [start, end]);
            }
        }
        nearest.distance = nearest.distance.sqrt();
        let (parameter, _) = newton(self, to, nearest.parameter, interval);
        let point = self.point(parameter);
        if (point - to).length() < nearest.distance {
            nearest = Nearest { parameter, point, distance: (point - to).length() };
        }
        let mut points = [P::default(); MAX_ORDER];
        let points = &mut points[..=self.degree()];
        for span in self.knots().spans() {
            if self.is_farther(span, to, nearest.distance) || self.bezier(span, points).is_err() {
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

    /// Whether all control points of a piece lie beyond a plane that is not nearer than a distance.
    fn is_farther(&self, span: usize, to: P::Point, distance: P::Scalar) -> bool {
        let points = (span - self.degree()..=span).map(|i| self.control(i).project() - to);
        let direction = points.clone().fold(P::Point::default(), |sum, offset| sum + offset);
        let bound = distance * direction.length();
        points.into_iter().all(|offset| offset.dot(direction) >= bound)
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
        if depth == DEEPEST || self.pieces == MOST {
            return;
        }
        self.pieces += 1;
        let mut coefficients = [P::Scalar::ZERO; COEFFICIENTS];
        let coefficients = &mut coefficients[..2 * points.len() - 1];
        self.excess(points, coefficients);
        let Some(lowest) = lowest(coefficients) else { return };
        let share = P::Scalar::from_usize(lowest) / P::Scalar::from_usize((coefficients.len() - 1).max(1));
        let known = self.best.distance;
        let (nearest, is_still) = newton(&self.curve, self.to, from + (to - from) * share, [from, to]);
        self.improve(nearest);
        if self.best.distance < known {
            self.excess(points, coefficients);
        }
        // The one minimum of a convex excess over the distance to it, or to a nearer point, is not negative.
        if (is_still && is_convex(coefficients)) || self::lowest(coefficients).is_none() {
            return;
        }
        let half = P::Scalar::from_f64(0.5);
        let middle = (from + to) * half;
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

    /// The coefficients of `|weight (c - p)|^2 - (weight best)^2`, which is negative where a point is nearer.
    fn excess(&self, points: &[P], coefficients: &mut [P::Scalar]) {
        let n = points.len() - 1;
        let mut offsets = [P::Point::default(); MAX_ORDER];
        for (offset, point) in offsets.iter_mut().zip(points) {
            *offset = (point.project() - self.to) * point.weight();
        }
        let best = self.best.distance * self.best.distance;
        let known = best * (P::Scalar::ONE - P::Scalar::EPSILON * P::Scalar::from_f64(32.0));
        coefficients.fill(P::Scalar::ZERO);
        for i in 0..=n {
            for j in i..=n {
                let excess = offsets[i].dot(offsets[j]) - points[i].weight() * points[j].weight() * known;
                let twice = if i == j { 1.0 } else { 2.0 };
                let share = twice * PASCAL[n][i] * PASCAL[n][j] * SHARES[n][i + j];
                coefficients[i + j] += excess * P::Scalar::from_f64(share);
            }
        }
    }
}

/// The lowest coefficient, if one is negative.
fn lowest<R: Real>(coefficients: &[R]) -> Option<usize> {
    let lower = |best: usize, i: usize| if coefficients[i] < coefficients[best] { i } else { best };
    let lowest = (1..coefficients.len()).fold(0, lower);
    (coefficients[lowest] < R::ZERO).then_some(lowest)
}

/// Whether the polynomial with these coefficients bends upwards everywhere.
fn is_convex<R: Real>(coefficients: &[R]) -> bool {
    coefficients.windows(3).all(|c| (c[2] - c[1]) >= (c[1] - c[0]))
}

/// Where steps towards `(c - p) c' = 0`, held in the interval, lead, and whether they came to rest.
fn newton<C: Curve>(
    curve: &C,
    to: C::Point,
    mut t: Parameter<C>,
    [from, end]: [Parameter<C>; 2],
) -> (Parameter<C>, bool) {
    for _ in 0..STEPS {
        let jet = curve.at(t);
        let offset = jet.point - to;
        let speed = jet.first.length_squared();
        let bend = speed + offset.dot(jet.second);
        // Where the distance does not bend upwards, the steps of Gauss lead downhill.
        let bend = if bend > Parameter::<C>::ZERO { bend } else { speed };
        if bend <= Parameter::<C>::ZERO {
            break;
        }
        let next = (t - offset.dot(jet.first) / bend).clamp(from, end);
        let is_still = (next - t).abs() <= Parameter::<C>::EPSILON * Parameter::<C>::from_f64(4.0) * (end - from);
        t = next;
        if is_still {
            return (t, true);
        }
    }
    (t, false)
}
