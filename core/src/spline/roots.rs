//! Where polynomials in Bernstein form vanish, and where plane curves meet lines.

use heapless::Vec;

use super::bernstein::bernstein_sum;
use super::bezier::MAX_ORDER;
use super::split::halve;
use super::{Bezier, ControlPoint, MAX_DEGREE};
use crate::math::{Real, VectorSpace};

/// Parameters in ascending order.
pub type Roots<R> = Vec<R, MAX_DEGREE>;

/// How often an interval is cut in halves before what is left counts as one root.
const DEEPEST: usize = 48;

impl<P: ControlPoint<Scalar = R>, R: Real + VectorSpace<Scalar = R>> Bezier<'_, P> {
    /// The parameters in `[0, 1]` at which the curve crosses the plane through `origin` at right angles to `normal`; in
    /// two dimensions, a line.
    ///
    /// At most as many as the degree; none for a curve that lies in the plane. Roots nearer to each other than
    /// rounding errors are one.
    pub fn crossings(&self, origin: P::Point, normal: P::Point) -> Roots<R> {
        let mut distances = [R::ZERO; MAX_ORDER];
        let count = self.points().len();
        for (distance, point) in distances.iter_mut().zip(self.points()) {
            *distance = (point.project() - origin).dot(normal) * point.weight();
        }
        bernstein_roots(&distances[..count])
    }
}

impl<P: ControlPoint<Point = P, Scalar = R>, R: Real + VectorSpace<Scalar = R>> Bezier<'_, P> {
    /// The parameters in `[0, 1]` at which a coordinate of the curve turns back, the ends of its monotone parts.
    pub fn turning_points(&self, axis: usize) -> Roots<R> {
        let mut steps = [R::ZERO; MAX_ORDER];
        for (step, pair) in steps.iter_mut().zip(self.points().windows(2)) {
            *step = pair[1].coordinate(axis) - pair[0].coordinate(axis);
        }
        bernstein_roots(&steps[..self.degree()])
    }
}

/// The roots in `[0, 1]` of the polynomial with these coefficients in Bernstein form, in ascending order.
///
/// A polynomial has at most as many roots as its coefficients change sign (Descartes' rule for Bernstein polynomials).
/// Intervals with several changes are cut in halves; the one with a single change is found by Newton's method, held in
/// the interval. At most [`MAX_DEGREE`] + 1 coefficients; of longer ones none.
pub fn bernstein_roots<R: Real + VectorSpace<Scalar = R>>(coefficients: &[R]) -> Roots<R> {
    let mut scratch = [R::ZERO; MAX_ORDER];
    let largest = coefficients.iter().fold(R::ZERO, |largest, c| largest.max(c.abs()));
    if coefficients.len() > MAX_ORDER || !(largest > R::ZERO && largest < R::INFINITY) {
        return Vec::new();
    }
    scratch[..coefficients.len()].copy_from_slice(coefficients);
    let mut search =
        Search { roots: Vec::new(), noise: largest * R::EPSILON * R::from_usize(coefficients.len()), blur: R::ZERO };
    search.within(&mut scratch[..coefficients.len()], [R::ZERO, R::ONE], DEEPEST);
    search.roots
}

struct Search<R> {
    roots: Roots<R>,
    /// Coefficients below this are rounding errors.
    noise: R,
    /// How well the root found last is known.
    blur: R,
}

impl<R: Real + VectorSpace<Scalar = R>> Search<R> {
    fn within(&mut self, coefficients: &mut [R], [from, to]: [R; 2], depth: usize) {
        let last = coefficients.len() - 1;
        let [starts, ends] = [coefficients[0], coefficients[last]].map(|c| c.abs() <= self.noise);
        if starts {
            self.found(from, R::ZERO);
        }
        let half = R::from_f64(0.5);
        let is_noise = coefficients.iter().all(|c| c.abs() <= self.noise);
        match self.sign_changes(coefficients) {
            0 => {}
            1 if !starts && !ends => {
                self.found(from + (to - from) * single(coefficients), R::ZERO);
            }
            _ if depth == 0 || is_noise => self.found((from + to) * half, to - from),
            _ => {
                let (mut before, middle) = ([R::ZERO; MAX_ORDER], (from + to) * half);
                halve(coefficients, half, &mut before);
                self.within(&mut before[..=last], [from, middle], depth - 1);
                self.within(coefficients, [middle, to], depth - 1);
            }
        }
        if ends && to == R::ONE {
            self.found(to, R::ZERO);
        }
    }

    /// Of coefficients that are more than rounding errors.
    fn sign_changes(&self, coefficients: &[R]) -> usize {
        let signs = coefficients.iter().filter(|&&c| c.abs() > self.noise).map(|&c| c > R::ZERO);
        signs.clone().zip(signs.skip(1)).filter(|(a, b)| a != b).count()
    }

    /// A root known to `width`, if it is not the one found last.
    fn found(&mut self, root: R, width: R) {
        self.blur = self.blur.max(width);
        let slack = R::EPSILON * R::from_f64(64.0) + self.blur + self.blur;
        if self.roots.last().is_none_or(|&last| root - last > slack) {
            // A full list cannot be: there are at most as many roots as the degree.
            let _ = self.roots.push(root);
        }
    }
}

/// The only root of a polynomial that has other signs at 0 and 1.
fn single<R: Real + VectorSpace<Scalar = R>>(coefficients: &[R]) -> R {
    let n = R::from_usize(coefficients.len() - 1);
    let mut steps = [R::ZERO; MAX_ORDER];
    coefficients.windows(2).zip(&mut steps).for_each(|(pair, step)| *step = (pair[1] - pair[0]) * n);
    let rises = coefficients[0] < R::ZERO;
    let (mut low, mut high) = (R::ZERO, R::ONE);
    let mut t = coefficients[0] / (coefficients[0] - coefficients[coefficients.len() - 1]);
    for _ in 0..64 {
        let value = bernstein_sum(coefficients, t);
        if (value < R::ZERO) == rises {
            low = t
        } else {
            high = t
        }
        let newton = t - value / bernstein_sum(&steps[..coefficients.len() - 1], t);
        let next = if newton > low && newton < high { newton } else { (low + high) * R::from_f64(0.5) };
        if (next - t).abs() <= R::EPSILON * next || value == R::ZERO {
            return next;
        }
        t = next;
    }
    t
}
