//! Discs on one axis with a third between them: a radial integral over closed forms.
//!
//! Seen from a point of the first disc the shadow of the blocker on the plane of the second is a disc again, and what
//! it hides is a lens. The point factor of a lens in a parallel plane is a contour integral over two arcs, each with
//! an elementary antiderivative.

use crate::math::Real;

use super::Estimate;

/// Halvings of the step of the radial integral.
const MOST_LEVELS: u32 = 9;

/// Share of the power leaving a disc that lands on another one with the same axis, which faces it at `distance`, past a
/// disc of `blocker_radius` on the same axis at `blocker_distance` from the first, in `(0, distance)`.
///
/// Lengths are positive. `accuracy` is the absolute error to aim for. In `[0, 1]`. `F = 2/r_a^2 int f(r) r dr` with the
/// exact factor `f` from the points at distance `r` of the axis, split where the rims of shadow and disc touch, by the
/// tanh-sinh rule (Takahasi and Mori 1974), which bears the roots there.
pub fn visible_coaxial_discs<R: Real>(
    radius_a: R,
    radius_b: R,
    distance: R,
    blocker_radius: R,
    blocker_distance: R,
    accuracy: R,
) -> Estimate<R> {
    let scale = distance / blocker_distance;
    let shadow_radius = blocker_radius * scale;
    let visible = |r: R| {
        let whole = arc(r, radius_b, distance, R::PI);
        whole - lens([r, r * scale], [radius_b, shadow_radius], distance)
    };
    let touch = |gap: R| (gap.abs() / (scale - R::ONE)).min(radius_a);
    let bounds = [R::ZERO, touch(radius_b - shadow_radius), touch(radius_b + shadow_radius), radius_a];
    let mut sum = Estimate { value: R::ZERO, error: R::ZERO };
    for (&low, &high) in bounds.iter().zip(&bounds[1..]) {
        let part = tanh_sinh(low, high, accuracy, |r| visible(r) * r / (radius_a * radius_a));
        sum.value += part.value + part.value;
        sum.error += part.error + part.error;
    }
    Estimate { value: sum.value.max(R::ZERO), ..sum }
}

/// Point factor of what two discs in a plane at `height` have in common; their centers lie on one ray from the foot of
/// the point, the second one not nearer than the first.
fn lens<R: Real>(centers: [R; 2], radii: [R; 2], height: R) -> R {
    let apart = (centers[1] - centers[0]).max(R::EPSILON * radii[0]);
    // Half the angle that each arc spans; an arc ends where the circles meet.
    let half = |own: R, other: R| {
        let cos = (apart * apart + own * own - other * other) / (apart * own + apart * own);
        cos.clamp(-R::ONE, R::ONE).acos()
    };
    let near = arc(centers[0], radii[0], height, half(radii[0], radii[1]));
    let far = arc(-centers[1], radii[1], height, half(radii[1], radii[0]));
    near + far
}

/// `1/2pi int (x dy - y dx) / (x^2 + y^2 + height^2)` along the arc `(center + radius cos t, radius sin t)` for `t` from
/// `-half` to `half`, with `half` in `[0, pi]`.
fn arc<R: Real>(center: R, radius: R, height: R, half: R) -> R {
    let two = R::ONE + R::ONE;
    let rise = height * height;
    let far = (center + radius) * (center + radius) + rise;
    let near = (center - radius) * (center - radius) + rise;
    let (sin, cos) = ((half / two).sin(), (half / two).cos());
    let angle = (sin * near.sqrt()).atan2(cos * far.sqrt());
    let factor = (radius * radius - center * center - rise) / (near * far).sqrt();
    (half + two * factor * angle) / (two * R::PI)
}

/// An integral whose integrand may have roots at the ends; the error is the difference of the last two levels.
fn tanh_sinh<R: Real>(low: R, high: R, accuracy: R, f: impl Fn(R) -> R) -> Estimate<R> {
    let mut sum = Estimate { value: R::ZERO, error: R::ZERO };
    if high <= low {
        return sum;
    }
    let accuracy = accuracy.max(R::from_f64(8.0) * R::EPSILON);
    let width = high - low;
    // The weight at the place `t`, and the share of the interval below it.
    let term = |t: f64| {
        let t = R::from_f64(t);
        let grown = (R::PI * (t.exp() - (-t).exp()) / R::from_f64(2.0)).exp();
        let share = grown / (R::ONE + grown);
        let slope = R::PI * (t.exp() + (-t).exp()) / R::from_f64(2.0);
        f(low + width * share) * slope * share / (R::ONE + grown)
    };
    let (mut total, mut step) = (R::ZERO, 1.0);
    for level in 0..MOST_LEVELS {
        let stride = if level == 0 { 1 } else { 2 };
        let most = (3.0 / step) as i32;
        total += (-most..=most).filter(|k| stride == 1 || k % 2 != 0).map(|k| term(f64::from(k) * step)).sum();
        let value = total * width * R::from_f64(step);
        sum = Estimate { value, error: (value - sum.value).abs() };
        if level > 2 && sum.error <= accuracy {
            break;
        }
        step *= 0.5;
    }
    sum
}
