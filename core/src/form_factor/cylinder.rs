//! Inside a closed cylinder, and between two coaxial ones of equal height, in closed form.

use crate::math::Real;

/// From a base of a closed cylinder to its side: `2 h / (h + sqrt(4 + h^2))` for the height over the radius, `h`.
///
/// In `[0, 1]`, to a few roundings; what is left of 1 goes to the other base. Howell's catalogue C-79.
pub fn cylinder_base_to_side<R: Real>(radius: R, height: R) -> R {
    (height + height) / (height + diagonal(radius, height))
}

/// From the side of a closed cylinder to one of its bases. In `[0, 1/2]`, to a few roundings. Howell's catalogue C-79.
pub fn cylinder_side_to_base<R: Real>(radius: R, height: R) -> R {
    radius / (height + diagonal(radius, height))
}

/// From the side of a closed cylinder to itself. In `[0, 1]`, to a few roundings. Howell's catalogue C-78.
pub fn cylinder_side_to_itself<R: Real>(radius: R, height: R) -> R {
    // 1 - 2 r / (h + d) with d^2 = h^2 + 4 r^2, without cancellation.
    let diagonal = diagonal(radius, height);
    let over = diagonal + radius + radius;
    height / (height + diagonal) * (R::ONE + height / over)
}

fn diagonal<R: Real>(radius: R, height: R) -> R {
    let diameter = radius + radius;
    (diameter * diameter + height * height).sqrt()
}

/// From the outside of a cylinder to the inside of a wider one around it of the same height; the rest leaves at the
/// ends.
///
/// In `[0, 1]`, with an absolute error of a few roundings times the larger of 1 and the ratio of the height to the
/// inner radius or its inverse. Computed in `f64`. Howell's catalogue C-91.
pub fn inner_cylinder_to_outer<R: Real>(inner: R, outer: R, height: R) -> R {
    let (r, h) = (outer.to_f64() / inner.to_f64(), height.to_f64() / inner.to_f64());
    let (a, b) = (h * h + (r - 1.0) * (r + 1.0), h * h - (r - 1.0) * (r + 1.0));
    let slant = Real::sqrt((a + 2.0 - 2.0 * r) * (a + 2.0 + 2.0 * r));
    let ends = slant * acos(b / (r * a)) + b * Real::asin(1.0 / r) - core::f64::consts::FRAC_PI_2 * a;
    let lost = (acos(b / a) - ends / (2.0 * h)) / core::f64::consts::PI;
    R::from_f64((1.0 - lost).clamp(0.0, 1.0))
}

/// From the inside of the wider of two coaxial cylinders of the same height to the outside of the other one.
/// Range, error and source as for [`inner_cylinder_to_outer`].
pub fn outer_cylinder_to_inner<R: Real>(inner: R, outer: R, height: R) -> R {
    inner_cylinder_to_outer(inner, outer, height) * (inner / outer)
}

/// From the inside of the wider of two coaxial cylinders of the same height to itself, past the other one.
///
/// In `[0, 1]`; error as for [`inner_cylinder_to_outer`]. Computed in `f64`. Howell's catalogue C-93.
pub fn outer_cylinder_to_itself<R: Real>(inner: R, outer: R, height: R) -> R {
    let (r, h) = (outer.to_f64() / inner.to_f64(), height.to_f64() / inner.to_f64());
    let (rr, hh) = (r * r, h * h);
    let ring = (r - 1.0) * (r + 1.0);
    let slant = Real::sqrt(4.0 * rr + hh) / h;
    let first = slant * asin((4.0 * ring + hh / rr * (rr - 2.0)) / (hh + 4.0 * ring));
    let curved = first - asin((rr - 2.0) / rr) + core::f64::consts::FRAC_PI_2 * (slant - 1.0);
    let flat = 2.0 / core::f64::consts::PI * Real::atan2(2.0 * Real::sqrt(ring), h);
    R::from_f64((1.0 - 1.0 / r + flat / r - h / (core::f64::consts::TAU * r) * curved).clamp(0.0, 1.0))
}

fn acos(x: f64) -> f64 {
    Real::acos(x.clamp(-1.0, 1.0))
}

fn asin(x: f64) -> f64 {
    Real::asin(x.clamp(-1.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form_factor::coaxial_discs;

    #[test]
    fn a_closed_cylinder() {
        for height in [1e-6, 0.1, 1.0, 7.0, 1e6] {
            let base = cylinder_base_to_side(2.0, height) + coaxial_discs(2.0, 2.0, height);
            let side = cylinder_side_to_itself(2.0, height) + 2.0 * cylinder_side_to_base(2.0, height);
            assert!((base - 1.0_f64).abs() < 1e-15 && (side - 1.0_f64).abs() < 1e-15, "{height}: {base} {side}");
            let (area, bases) = (2.0 * height * cylinder_side_to_base(2.0, height), cylinder_base_to_side(2.0, height));
            assert!((2.0 * area / 4.0 - bases).abs() < 1e-14 * bases.max(1e-3));
        }
    }

    /// Tall cylinders lose nothing at their ends; a thin one inside leaves the outer one as it is.
    #[test]
    fn limits_of_coaxial_cylinders() {
        assert!((inner_cylinder_to_outer(1.0, 2.0, 1e5) - 1.0_f64).abs() < 1e-4);
        let tall = outer_cylinder_to_itself(1.0, 2.0, 1e5) + outer_cylinder_to_inner(1.0, 2.0, 1e5);
        assert!((tall - 1.0_f64).abs() < 1e-4);
        let alone: f64 = cylinder_side_to_itself(2.0, 3.0);
        assert!((outer_cylinder_to_itself(1e-6, 2.0, 3.0) - alone).abs() < 1e-5);
    }
}
