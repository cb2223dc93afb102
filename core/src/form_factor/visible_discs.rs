//! Discs on one axis with a third between them: a radial integral over closed forms.
//!
//! Seen from a point of the first disc the shadow of the blocker on the plane of the second is a disc again, and what
//! it hides is a lens. The point factor of a lens in a parallel plane is a contour integral over two arcs, each with
//! an elementary antiderivative.

use core::f64::consts::PI;

use crate::math::Real;

use super::point_to_parallel_disc;
use super::quadrature::tanh_sinh;

/// Share of the power leaving a disc that lands on another one with the same axis, which faces it at `distance`, past a
/// disc of `blocker_radius` on the same axis at `blocker_distance` from the first, in `(0, distance)`.
///
/// Lengths are positive. In `[0, 1]`. `F = 2/r_a^2 int f(r) r dr` with the exact factor `f` from the points at distance
/// `r` of the axis, split where the rims of shadow and disc touch. `f` is the contour integral of Sparrow (Journal
/// of Heat Transfer 1963; Siegel and Howell, Thermal Radiation Heat Transfer) around what is seen, whose arcs have an
/// antiderivative (Gradshteyn and Ryzhik, 2.553.3). Computed in `f64`; the error is below 1e-12 for
/// lengths within a factor of 100 of each other, and that of the result's rounding in `f32`.
pub fn visible_coaxial_discs<R: Real>(
    radius_a: R,
    radius_b: R,
    distance: R,
    blocker_radius: R,
    blocker_distance: R,
) -> R {
    let [radius_a, radius_b, distance, blocker_radius, blocker_distance] =
        [radius_a, radius_b, distance, blocker_radius, blocker_distance].map(R::to_f64);
    let scale = distance / blocker_distance;
    let shadow_radius = blocker_radius * scale;
    let visible = |r: f64| {
        point_to_parallel_disc(radius_b, distance, r) - lens([r, r * scale], [radius_b, shadow_radius], distance)
    };
    let touch = |gap: f64| (gap.abs() / (scale - 1.0)).min(radius_a);
    let bounds = [0.0, touch(radius_b - shadow_radius), touch(radius_b + shadow_radius), radius_a];
    let part = |pair: &[f64]| tanh_sinh(pair[0], pair[1], |r| visible(r) * r);
    let sum: f64 = bounds.windows(2).map(part).sum();
    R::from_f64((2.0 * sum / (radius_a * radius_a)).clamp(0.0, 1.0))
}

/// Point factor of what two discs in a plane at `height` have in common; their centers lie on one ray from the foot of
/// the point, the second one not nearer than the first.
fn lens(centers: [f64; 2], radii: [f64; 2], height: f64) -> f64 {
    let apart = (centers[1] - centers[0]).max(f64::EPSILON * radii[0]);
    // Half the angle that each arc spans; an arc ends where the circles meet.
    let half = |own: f64, other: f64| {
        let cos = (apart * apart + own * own - other * other) / (2.0 * apart * own);
        Real::acos(cos.clamp(-1.0, 1.0))
    };
    let near = arc(centers[0], radii[0], height, half(radii[0], radii[1]));
    let far = arc(-centers[1], radii[1], height, half(radii[1], radii[0]));
    near + far
}

/// `1/2pi int (x dy - y dx) / (x^2 + y^2 + height^2)` along the arc `(center + radius cos t, radius sin t)` for `t` from
/// `-half` to `half`, with `half` in `[0, pi]`.
fn arc(center: f64, radius: f64, height: f64, half: f64) -> f64 {
    let rise = height * height;
    let far = (center + radius) * (center + radius) + rise;
    let near = (center - radius) * (center - radius) + rise;
    let (sin, cos) = (Real::sin(0.5 * half), Real::cos(0.5 * half));
    let angle = Real::atan2(sin * Real::sqrt(near), cos * Real::sqrt(far));
    let factor = (radius * radius - center * center - rise) / Real::sqrt(near * far);
    (half + 2.0 * factor * angle) / (2.0 * PI)
}
