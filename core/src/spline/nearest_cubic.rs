//! The nearest point of a cubic: roots of a quintic.

use super::Nearest;
use super::bernstein::bernstein_sum;
use crate::math::{Real, VectorSpace};

/// How often the interval is cut in halves before what is left counts as one place.
const DEEPEST: usize = 26;
/// Steps to a root, far more than are taken.
const STEPS: usize = 64;

/// Coefficients in Bernstein form.
type Quintic<R> = [R; 6];

/// The point of a cubic Bezier curve that is nearest to another one, or the one known before if that one is.
///
/// A third of half the derivative of the squared distance, `(c - p) c' / 3`, is a quintic. Where its coefficients in
/// Bernstein form change sign once, from below zero to above, there is one minimum; where they do not, or from above to
/// below, there is none; all else is cut in halves. Halving does not add changes, so that there are never more than five
/// parts to look at (Descartes' rule).
pub(super) fn nearer_of_cubic<V: VectorSpace>(points: [V; 4], to: V, best: Nearest<V>) -> Nearest<V> {
    let offsets = points.map(|point| point - to);
    let mut search = Search { offsets, parameter: best.parameter, squared: V::Scalar::INFINITY };
    let [zero, one] = [V::Scalar::ZERO, V::Scalar::ONE];
    search.improve(zero);
    search.improve(one);
    search.within(&quintic(offsets), [zero, one], DEEPEST);
    let distance = search.squared.sqrt();
    if distance < best.distance {
        let parameter = search.parameter;
        return Nearest { parameter, point: bernstein_sum(&points, parameter), distance };
    }
    best
}

/// `(c - p) c' / 3` for a curve whose control points have these offsets from the point.
#[inline]
fn quintic<V: VectorSpace>([a, b, c, d]: [V; 4]) -> Quintic<V::Scalar> {
    let [ab, bc, cd] = [b - a, c - b, d - c];
    let of = V::Scalar::from_f64;
    let [fifth, tenth, three, six] = [of(0.2), of(0.1), of(3.0), of(6.0)];
    [
        a.dot(ab),
        (b.dot(ab) * three + a.dot(bc + bc)) * fifth,
        (c.dot(ab) * three + b.dot(bc) * six + a.dot(cd)) * tenth,
        (b.dot(cd) * three + c.dot(bc) * six + d.dot(ab)) * tenth,
        (c.dot(cd) * three + d.dot(bc + bc)) * fifth,
        d.dot(cd),
    ]
}

struct Search<V: VectorSpace> {
    /// Of the control points from the point.
    offsets: [V; 4],
    parameter: V::Scalar,
    /// The squared distance there.
    squared: V::Scalar,
}

impl<V: VectorSpace> Search<V> {
    fn improve(&mut self, t: V::Scalar) {
        let squared = bernstein_sum(&self.offsets, t).length_squared();
        if squared < self.squared {
            (self.parameter, self.squared) = (t, squared);
        }
    }

    /// Looks at the minima in a part of the curve.
    fn within(&mut self, quintic: &Quintic<V::Scalar>, [from, to]: [V::Scalar; 2], depth: usize) {
        let signs = (0..6).fold(0_u32, |signs, k| signs | (u32::from(quintic[k] > V::Scalar::ZERO) << k));
        let changes = ((signs ^ (signs >> 1)) & 0b1_1111).count_ones();
        let half = V::Scalar::from_f64(0.5);
        match changes {
            0 => {}
            1 if signs & 1 == 1 => {}
            1 => self.improve(from + (to - from) * rising_root(quintic, signs.trailing_zeros() as usize)),
            _ if depth == 0 => self.improve((from + to) * half),
            _ => {
                let ([before, after], middle) = (halves(quintic), (from + to) * half);
                self.within(&before, [from, middle], depth - 1);
                self.within(&after, [middle, to], depth - 1);
            }
        }
    }
}

/// De Casteljau's construction in the middle.
fn halves<R: Real>(quintic: &Quintic<R>) -> [Quintic<R>; 2] {
    let (mut before, mut after) = ([R::ZERO; 6], *quintic);
    for (k, left) in before.iter_mut().enumerate() {
        *left = after[0];
        (0..5 - k).for_each(|i| after[i] = (after[i] + after[i + 1]) * R::from_f64(0.5));
    }
    [before, after]
}

/// The only root of a quintic whose coefficients are above zero from index `above` on, and not before.
///
/// Newton's method from where the control polygon crosses zero, held between signs.
fn rising_root<R: Real>(bernstein: &Quintic<R>, above: usize) -> R {
    let [low, high] = [bernstein[above - 1], bernstein[above]];
    let mut t = (R::from_usize(above) - high / (high - low)) * R::from_f64(0.2);
    let powers = to_powers(bernstein);
    let [mut low, mut high] = [R::ZERO, R::ONE];
    for _ in 0..STEPS {
        let [value, slope] = value_and_slope(&powers, t);
        if value > R::ZERO {
            high = t
        } else {
            low = t
        }
        let newton = t - value / slope;
        let next = if newton >= low && newton <= high { newton } else { (low + high) * R::from_f64(0.5) };
        let step = next - t;
        t = next;
        // The next step would be as the square of this one.
        if step * step <= R::EPSILON * R::EPSILON.sqrt() {
            break;
        }
    }
    t
}

/// From Bernstein form: the differences of all orders times binomial coefficients.
fn to_powers<R: Real>(bernstein: &Quintic<R>) -> [R; 6] {
    let mut powers = *bernstein;
    for k in 1..6 {
        (k..6).rev().for_each(|i| powers[i] -= powers[i - 1]);
    }
    let [five, ten] = [5.0, 10.0].map(R::from_f64);
    [powers[0], powers[1] * five, powers[2] * ten, powers[3] * ten, powers[4] * five, powers[5]]
}

/// Both by pairs of powers, which do not wait for each other.
#[inline]
fn value_and_slope<R: Real>(&[a, b, c, d, e, f]: &[R; 6], t: R) -> [R; 2] {
    let [tt, of] = [t * t, t + t];
    let value = (a + b * t) + tt * ((c + d * t) + tt * (e + f * t));
    let slope = (b + c * of) + tt * ((d + d + d + e * (of + of)) + tt * (f * R::from_f64(5.0)));
    [value, slope]
}
