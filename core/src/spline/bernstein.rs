//! Bernstein polynomials `B_i^n(t) = C(n, i) t^i (1 - t)^(n - i)`, the basis of Bezier curves.

use super::MAX_DEGREE;
use crate::math::{Real, VectorSpace};

/// Writes the value of the Bernstein polynomial `i` of degree `values.len() - 1` at `t` to `values[i]`.
///
/// They sum to 1 everywhere and lie in `[0, 1]` for `t` in `[0, 1]`. The triangle of Pascal, whose steps only add what
/// is positive: Piegl and Tiller, "The NURBS Book", algorithm A1.3.
pub fn bernstein<R: Real>(values: &mut [R], t: R) {
    let s = R::ONE - t;
    for j in 0..values.len() {
        let mut saved = if j == 0 { R::ONE } else { R::ZERO };
        for value in &mut values[..j] {
            let before = *value;
            *value = saved + s * before;
            saved = t * before;
        }
        values[j] = saved;
    }
}

/// The sum of all `points[i] B_i^n(t)` for at most [`MAX_DEGREE`] + 1 points; zero without points.
///
/// In as many steps as there are points: Horner's scheme on the powers of `t` that multiplies with `1 - t` in each step;
/// for `t` in `[0, 1]` all terms have factors that are not negative, so that nothing is lost to cancellation. Farin,
/// "Curves and Surfaces for CAGD", section 5.6.
#[inline(always)]
pub(super) fn bernstein_sum<V: VectorSpace>(points: &[V], t: V::Scalar) -> V {
    let s = V::Scalar::ONE - t;
    // The usual one is asked for first.
    if let [a, b, c, d] = *points {
        let (ss, three) = (s * s, V::Scalar::from_f64(3.0));
        return a * (ss * s) + (b * (ss * three) + (c * (s * three) + d * t) * t) * t;
    }
    match *points {
        [] => V::default(),
        [a] => a,
        [a, b] => a * s + b * t,
        [a, b, c] => a * (s * s) + b * ((s + s) * t) + c * (t * t),
        _ => horner(points, t),
    }
}

fn horner<V: VectorSpace>(points: &[V], t: V::Scalar) -> V {
    let [first, inner @ .., last] = points else { return V::default() };
    let s = V::Scalar::ONE - t;
    let (mut sum, mut power) = (*first * s, t);
    let binomials = &PASCAL[(inner.len() + 1).min(MAX_DEGREE)][1..];
    for (&point, &binomial) in inner.iter().zip(binomials) {
        sum = (sum + point * (power * V::Scalar::from_f64(binomial))) * s;
        power *= t;
    }
    sum + *last * power
}

/// The binomial coefficients `C(n, i)`.
pub(super) static PASCAL: [[f64; MAX_DEGREE + 1]; MAX_DEGREE + 1] = pascal();

const fn pascal() -> [[f64; MAX_DEGREE + 1]; MAX_DEGREE + 1] {
    let mut rows = [[0.0; MAX_DEGREE + 1]; MAX_DEGREE + 1];
    let mut n = 0;
    while n <= MAX_DEGREE {
        rows[n][0] = 1.0;
        let mut i = 1;
        while i <= n {
            rows[n][i] = rows[n - 1][i - 1] + rows[n - 1][i];
            i += 1;
        }
        n += 1;
    }
    rows
}
