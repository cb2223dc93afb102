//! Between rectangles, and from a point to one, in closed form.
//!
//! Lengths are positive and finite; all functions depend on their ratios only. The forms between two rectangles are
//! sums of terms that nearly cancel, so they are computed in `f64` whatever the precision of their arguments.

use super::quadrature::GAUSS_16;
use crate::math::Real;

/// A rectangle with its sides along the axes of its plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds<R> {
    /// From the lower to the higher end along the first axis.
    pub x: [R; 2],
    /// From the lower to the higher end along the second axis.
    pub y: [R; 2],
}

impl<R: Real> Bounds<R> {
    fn to_f64(self) -> Bounds<f64> {
        Bounds { x: self.x.map(R::to_f64), y: self.y.map(R::to_f64) }
    }
}

impl Bounds<f64> {
    fn area(&self) -> f64 {
        (self.x[1] - self.x[0]) * (self.y[1] - self.y[0])
    }
}

/// From a point to a parallel rectangle that it faces, with one corner of the rectangle on the normal at `distance`.
///
/// In `[0, 1/4]`, to a few roundings. Howell's catalogue B-3.
pub fn point_to_parallel_rectangle<R: Real>(width: R, height: R, distance: R) -> R {
    let slant = |side: R| (side * side + distance * distance).sqrt();
    let (over_width, over_height) = (slant(width), slant(height));
    let sum = width / over_width * (height / over_width).atan() + height / over_height * (width / over_height).atan();
    sum / (R::PI + R::PI)
}

/// From a point to a rectangle in a plane parallel to the normal, at `distance`: its base of length `width` lies in the
/// plane of the point, with one end at the foot of the perpendicular, and its sides of length `height` rise from there.
///
/// In `[0, 1/4]`, with an absolute error of a few roundings. Howell's catalogue B-4.
pub fn point_to_perpendicular_rectangle<R: Real>(width: R, height: R, distance: R) -> R {
    let slant = (height * height + distance * distance).sqrt();
    let difference = width.atan2(distance) - distance / slant * width.atan2(slant);
    difference.max(R::ZERO) / (R::PI + R::PI)
}

/// Between two equal parallel rectangles that face each other.
///
/// In `[0, 1]`, with an absolute error of a few roundings. Howell's catalogue C-11.
pub fn parallel_rectangles<R: Real>(width: R, height: R, distance: R) -> R {
    let (x, y) = (width.to_f64() / distance.to_f64(), height.to_f64() / distance.to_f64());
    let (over_x, over_y) = (Real::sqrt(1.0 + x * x), Real::sqrt(1.0 + y * y));
    // The logarithm of (1 + x^2) (1 + y^2) / (1 + x^2 + y^2), which is 1 + x^2 y^2 / (1 + x^2 + y^2).
    let ln = 0.5 * Real::ln_1p(x * x * (y * y / (1.0 + x * x + y * y)));
    let of_x = x * (over_y * Real::atan(x / over_y) - Real::atan(x));
    let of_y = y * (over_x * Real::atan(y / over_x) - Real::atan(y));
    rounded((ln + of_x + of_y) * 2.0 / (core::f64::consts::PI * x * y))
}

/// From a rectangle to one in a parallel plane at `distance` that faces it, both with sides along the same axes.
///
/// In `[0, 1]`. The absolute error is `1e-15 d^2 / A_a` for the largest distance `d` between points of both.
/// Ehlert and Smith 1993; Howell's catalogue C-13.
pub fn parallel_rectangles_offset<R: Real>(a: Bounds<R>, b: Bounds<R>, distance: R) -> R {
    let (a, b, z) = (a.to_f64(), b.to_f64(), distance.to_f64());
    let sum = over_corners(a, b, |x, y, other_x, other_y| {
        let (u, v) = (x - other_x, y - other_y);
        let (over_u, over_v) = (Real::sqrt(u * u + z * z), Real::sqrt(v * v + z * z));
        let angles = v * over_u * Real::atan2(v, over_u) + u * over_v * Real::atan2(u, over_v);
        angles - 0.5 * z * z * Real::ln(u * u + v * v + z * z)
    });
    rounded(sum / (core::f64::consts::TAU * a.area()))
}

/// Between rectangles at a right angle that share an edge of the given `length`: from the one that reaches `width` away
/// from it to the one that reaches `height` away.
///
/// In `[0, 1/2]`, with an absolute error of a few roundings times the larger of 1 and `length / width`.
/// Howell's catalogue C-14.
pub fn perpendicular_rectangles<R: Real>(length: R, width: R, height: R) -> R {
    let (w, h) = (width.to_f64() / length.to_f64(), height.to_f64() / length.to_f64());
    let (ww, hh) = (w * w, h * h);
    let slant = Real::sqrt(ww + hh);
    let inverse = |x: f64| x * Real::atan2(1.0, x);
    let ln = Real::ln_1p(ww * hh / (1.0 + ww + hh))
        + ww * Real::ln_1p(-hh / ((1.0 + ww) * (ww + hh)))
        + hh * Real::ln_1p(-ww / ((1.0 + hh) * (ww + hh)));
    rounded((inverse(w) + inverse(h) - inverse(slant) + 0.25 * ln) / (core::f64::consts::PI * w))
}

/// From a rectangle to one in a plane at a right angle. `x` is the distance from the line where the planes meet and `y`
/// the place along it, for both; what lies beyond that line, at negative `x`, neither sends nor receives.
///
/// In `[0, 1/2]`. The absolute error is `1e-15 d^2 / A_a` for the largest distance `d` between points of both.
/// Ehlert and Smith 1993; Howell's catalogue C-15.
pub fn perpendicular_rectangles_offset<R: Real>(a: Bounds<R>, b: Bounds<R>) -> R {
    let front = |bounds: Bounds<f64>| Bounds { x: bounds.x.map(|x| Real::max(x, 0.0)), ..bounds };
    let (a, b) = (a.to_f64(), b.to_f64());
    let sum = over_corners(front(a), front(b), |x, y, other_x, other_y| {
        let (squared, v) = (x * x + other_x * other_x, y - other_y);
        let slant = Real::sqrt(squared);
        let all = squared + v * v;
        let ln = if all > 0.0 { Real::ln(all) } else { 0.0 };
        v * slant * Real::atan2(v, slant) - 0.25 * (squared - v * v) * ln
    });
    rounded(sum / (core::f64::consts::TAU * a.area()))
}

/// From a rectangle that reaches `width_a` away from an edge of the given `length` to one that reaches `width_b` away
/// from the same edge, with an included `angle` in `(0, pi)`.
///
/// In `[0, 1]`, with an absolute error below 1e-12 for widths up to 100 lengths and angles above 1e-3.
/// Feingold 1966, whose last term is an integral, here a Gauss sum; Howell's catalogue C-16.
pub fn tilted_rectangles<R: Real>(length: R, width_a: R, width_b: R, angle: R) -> R {
    const PI: f64 = core::f64::consts::PI;
    let (length, angle) = (length.to_f64(), angle.to_f64());
    let (a, b) = (width_b.to_f64() / length, width_a.to_f64() / length);
    let (sin, cos) = (Real::sin(angle), Real::cos(angle));
    let (aa, bb) = (a * a, b * b);
    let c = (a - b * cos) * (a - b * cos) + bb * sin * sin;
    let angles = a * b * sin
        + (0.5 * PI - angle) * (aa + bb)
        + bb * Real::atan2(a - b * cos, b * sin)
        + aa * Real::atan2(b - a * cos, a * sin);
    let (ln_a, ln_b, ln_c) = (Real::ln_1p(aa), Real::ln_1p(bb), Real::ln_1p(c));
    let cos_2 = cos * cos - sin * sin;
    let lns = (2.0 - sin * sin) * (ln_a + ln_b - ln_c)
        + sin * sin * bb * (Real::ln(bb / c) + ln_c - ln_b)
        + sin * sin * aa * (Real::ln(aa / c) + cos_2 * (ln_a - ln_c));
    let inverse = |x: f64| x * Real::atan2(1.0, x);
    let slant = Real::sqrt(1.0 + aa * sin * sin);
    let ends = a * slant * (Real::atan2(a * cos, slant) + Real::atan2(b - a * cos, slant));
    let sum = -0.5 * sin * cos * angles + 0.25 * lns + inverse(b) + inverse(a) - inverse(Real::sqrt(c))
        + sin * sin * cos * ends
        + cos * feingold_integral(a, b, sin, cos);
    rounded(sum / (PI * b))
}

/// `int_0^b sqrt(1 + x^2 sin^2) (atan(x cos / ..) + atan((a - x cos) / ..)) dx` over the same root, in steps that grow.
fn feingold_integral(a: f64, b: f64, sin: f64, cos: f64) -> f64 {
    let (mut sum, mut from) = (0.0, 0.0);
    while from < b {
        let to = Real::min(b, 2.0 * from + 0.5);
        let mean = GAUSS_16.mean(|share| {
            let x = from + (to - from) * share;
            let slant = Real::sqrt(1.0 + x * x * sin * sin);
            slant * (Real::atan2(x * cos, slant) + Real::atan2(a - x * cos, slant))
        });
        sum += (to - from) * mean;
        from = to;
    }
    sum
}

/// The sum over one corner of each rectangle, with the sign of Ehlert and Smith.
fn over_corners(a: Bounds<f64>, b: Bounds<f64>, term: impl Fn(f64, f64, f64, f64) -> f64) -> f64 {
    let mut sum = 0.0;
    for index in 0..16 {
        let [i, j, k, l] = [index & 1, (index >> 1) & 1, (index >> 2) & 1, index >> 3];
        let sign = if (i + j + k + l) % 2 == 0 { 1.0 } else { -1.0 };
        sum += sign * term(a.x[i], a.y[j], b.x[k], b.y[l]);
    }
    sum
}

fn rounded<R: Real>(factor: f64) -> R {
    R::from_f64(factor.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }

    /// The forms with offsets are those without where there is none.
    #[test]
    fn offsets_of_zero() {
        let a = Bounds { x: [0.0, 2.0], y: [-1.0, 0.5] };
        close(parallel_rectangles_offset(a, a, 0.7), parallel_rectangles(2.0, 1.5, 0.7));
        let b = Bounds { x: [0.0, 0.4], ..a };
        close(perpendicular_rectangles_offset(a, b), perpendicular_rectangles(1.5, 2.0, 0.4));
    }

    #[test]
    fn a_right_angle_is_one_of_all_angles() {
        for (length, width, height) in [(1.0, 1.0, 1.0), (3.0, 0.2, 5.0), (0.1, 2.0, 1.0)] {
            let right = tilted_rectangles(length, width, height, core::f64::consts::FRAC_PI_2);
            close(right, perpendicular_rectangles(length, width, height));
        }
    }

    /// `A_a F_ab = A_b F_ba`, and parts of the sender add up.
    #[test]
    fn reciprocity_and_parts() {
        let forward = 2.0 * tilted_rectangles(1.0, 2.0, 0.7, 0.6);
        close(forward, 0.7 * tilted_rectangles(1.0, 0.7, 2.0, 0.6));
        let (a, b) = (Bounds { x: [-1.0, 2.0], y: [0.0, 1.0] }, Bounds { x: [0.5, 1.5], y: [0.25, 3.0] });
        let front = Bounds { x: [0.0, 2.0], ..a };
        close(3.0 * perpendicular_rectangles_offset(a, b), 2.0 * perpendicular_rectangles_offset(front, b));
    }

    /// Far away the form factor tends to the point formula; nothing is lost on the way.
    #[test]
    fn small_against_the_distance() {
        let far = parallel_rectangles(1e-5, 2e-5, 1.0);
        assert!((far / (2e-10 / core::f64::consts::PI) - 1.0).abs() < 1e-5, "{far}");
        let single = parallel_rectangles(0.01_f32, 0.02, 1.0);
        assert!((f64::from(single) / parallel_rectangles(0.01, 0.02, 1.0) - 1.0).abs() < 1e-6);
    }
}
