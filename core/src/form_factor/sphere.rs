//! Spheres: from a point to one at any tilt, from one to other shapes, between two, and the sky.

use super::quadrature::tanh_sinh;
use crate::math::{Real, Vector};

/// Share of the power leaving `point` that lands on a sphere, with nothing between.
///
/// `normal` has length 1. What lies below the horizon of `point` does not count. In `[0, 1]`, to a few roundings; 0
/// inside the sphere, whose surface looks outside. Howell's catalogue B-38 for the sphere that the horizon cuts.
pub fn point_to_sphere<V: Vector>(point: V, normal: V, center: V, radius: V::Scalar) -> V::Scalar {
    let to_center = center - point;
    let distance = to_center.length();
    ball(distance / radius, to_center.dot(normal) / distance)
}

/// To a sphere of radius 1 at `distance`, at least 1, under the given cosine.
fn ball<R: Real>(distance: R, cos: R) -> R {
    let height = distance * cos;
    let is_seen = distance >= R::ONE && height > -R::ONE;
    if !is_seen {
        return R::ZERO;
    }
    let squared = distance * distance;
    if height >= R::ONE {
        return (cos / squared).min(R::ONE);
    }
    let tangent = ((distance - R::ONE) * (distance + R::ONE)).sqrt();
    let cut = ((R::ONE - height) * (R::ONE + height)).sqrt();
    let share = cut.atan2(tangent) + (cos * cut.atan2(-tangent * cos) - tangent * cut) / squared;
    (share / R::PI).clamp(R::ZERO, R::ONE)
}

/// Share of the sky, a hemisphere around `up` at infinity, that a surface with the given normal sees:
/// `(1 + cos tilt) / 2`. Both have length 1. In `[0, 1]`, to a rounding.
pub fn point_to_sky<V: Vector>(normal: V, up: V) -> V::Scalar {
    ((V::Scalar::ONE + normal.dot(up)) / V::Scalar::from_f64(2.0)).clamp(V::Scalar::ZERO, V::Scalar::ONE)
}

/// From a sphere to a disc that faces its center at `distance`: the share of all directions that meet the disc.
///
/// The size of the sphere does not matter as long as it does not meet the plane of the disc. In `[0, 1/2]`, to a few
/// roundings. Feingold and Gupta 1970.
pub fn sphere_to_disc<R: Real>(radius: R, distance: R) -> R {
    let slant = (radius * radius + distance * distance).sqrt();
    radius / slant * (radius / (slant + distance)) / R::from_f64(2.0)
}

/// From a sphere to a rectangle with one corner at `distance` straight in front of the center, and sides `width` and
/// `height`: the share of all directions that meet the rectangle.
///
/// The size of the sphere does not matter as long as it does not meet the plane of the rectangle. In `[0, 1/8]`, to a
/// few roundings. Howell's catalogue C-132; the solid angle of a pyramid.
pub fn sphere_to_rectangle<R: Real>(width: R, height: R, distance: R) -> R {
    let slant = (width * width + height * height + distance * distance).sqrt();
    (width * height).atan2(distance * slant) / (R::from_f64(4.0) * R::PI)
}

/// From the inside of a sphere to any part of it of this area: the same from everywhere, `area / (4 pi radius^2)`.
///
/// In `[0, 1]`, to a rounding. The integrating sphere of Ulbricht.
pub fn inside_sphere<R: Real>(area: R, radius: R) -> R {
    area / (R::from_f64(4.0) * R::PI * radius * radius)
}

/// From the outer of two concentric spheres to the inner one, `(inner / outer)^2`; what is left of 1 goes to itself,
/// and all that leaves the inner one goes to the outer one. In `[0, 1]` for `inner <= outer`, to a rounding.
pub fn outer_sphere_to_inner<R: Real>(inner: R, outer: R) -> R {
    let ratio = inner / outer;
    ratio * ratio
}

/// From the outside of a sphere of radius `from` to that of one of radius `to`, with their centers `distance` apart.
///
/// In `[0, 1/2]`, with an absolute error below 1e-12; 0 where they overlap. There is no closed form: this is the mean
/// over the first sphere of [`point_to_sphere`], in closed form where the horizon does not cut the other sphere and an
/// integral over the polar angle elsewhere. Computed in `f64`. Juul 1976.
pub fn sphere_to_sphere<R: Real>(from: R, to: R, distance: R) -> R {
    let (from, to, distance) = (from.to_f64(), to.to_f64(), distance.to_f64());
    let is_apart = distance >= from + to;
    if !is_apart {
        return R::ZERO;
    }
    let (large, small) = (Real::max(from, to), Real::min(from, to));
    let ratio = small / from;
    R::from_f64(larger_to_smaller(large, small, distance) * (large / small * ratio) * (large / small * ratio))
}

/// The mean over the sphere of radius `r` of the factor to one of radius `s`, where `mu` is the cosine of the polar
/// angle toward it and `d` the distance of a point from the other center.
fn larger_to_smaller(r: f64, s: f64, distance: f64) -> f64 {
    let squared = |mu: f64| distance * distance + r * r - 2.0 * distance * r * mu;
    let cut = tanh_sinh((r - s) / distance, (r + s) / distance, |mu| {
        let d = Real::max(Real::sqrt(squared(mu)), s);
        ball(d / s, (distance * mu - r) / d)
    });
    let last = Real::sqrt(squared((r + s) / distance));
    let whole = 2.0 * distance - (distance - r) * (distance + r) / last - last;
    0.5 * (cut + whole * (s / r) * (s / r) / (2.0 * distance))
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};

    use super::*;

    /// The element on the sphere sees half a sky; there is no jump where the horizon starts to cut.
    #[test]
    fn limits() {
        for cos in [-0.9_f64, -0.3, 0.0, 0.5, 1.0] {
            assert!((ball(1.0, cos) - 0.5 * (1.0 + cos)).abs() < 1e-15);
        }
        assert!((ball(2.0, 0.5 - 1e-9) - 0.125).abs() < 1e-9);
        assert!(ball(2.0, -0.5 + 1e-9) < 1e-12);
        assert_eq!(ball(0.5, 1.0), 0.0);
        assert_eq!(point_to_sphere(Vec3::ZERO, Vec3::Z, Vec3::NAN, 1.0), 0.0);
    }

    #[test]
    fn single_precision_is_kept_at_the_horizon() {
        for k in 0..100 {
            let cos = f64::from(k) * 4e-4 - 0.02;
            let (single, double) = (ball(30.0, cos as f32), ball(30.0, f64::from(cos as f32)));
            assert!((f64::from(single) - double).abs() < 1e-7, "{cos}: {single} {double}");
        }
    }

    /// Above all of a sphere the factor is linear in the normal, `n . c / |c|^3`.
    #[test]
    fn a_sphere_above_the_horizon() {
        let (normal, center) = (DVec3::new(0.48, -0.6, 0.64), DVec3::new(2.0, -3.0, 4.0));
        let length = Real::sqrt(center.length_squared());
        let expected = 0.25 * normal.dot(center) / (length * length * length);
        assert!((point_to_sphere(DVec3::ZERO, normal, center, 0.5) - expected).abs() < 1e-16);
    }

    /// `A_1 F_12 = A_2 F_21`, far spheres are `(r / 2d)^2`, and spheres that touch are no exception.
    #[test]
    fn two_spheres() {
        let (there, back) = (sphere_to_sphere(1.0, 2.0, 5.0), sphere_to_sphere(2.0, 1.0, 5.0));
        assert!((there - 4.0 * back).abs() < 1e-15);
        assert!((sphere_to_sphere(3.0, 1.0, 1000.0) / 0.25e-6 - 1.0).abs() < 1e-5);
        assert_eq!(sphere_to_sphere(1.0, 1.0, 1.9), 0.0);
        let touching: [f64; 2] = [sphere_to_sphere(1.0, 1.0, 2.0), sphere_to_sphere(1.0, 1.0, 2.0 + 1e-9)];
        assert!((touching[0] - touching[1]).abs() < 1e-7, "{touching:?}");
    }
}
