//! From one small patch to another: the point formula `cos a cos b A / (pi r^2)`, and how wrong it can be.

use crate::math::{Real, Vector};

/// Share of the power leaving a small patch at `p` that lands on a flat patch of `area_q` around `q`, with nothing
/// between: `cos a cos b area_q / (pi r^2)`.
///
/// Both normals have length 1; 0 where either patch faces away or where `p` is `q`. Not negative, but not bounded by 1:
/// the formula is meant for patches that are small against their distance; [`point_to_point_error`] says how small.
/// Goral, Torrance, Greenberg and Battaile 1984.
pub fn point_to_point<V: Vector>(p: V, normal_p: V, q: V, normal_q: V, area_q: V::Scalar) -> V::Scalar {
    let to_q = q - p;
    let squared = to_q.length_squared();
    let (cos_p, cos_q) = (to_q.dot(normal_p), -to_q.dot(normal_q));
    if cos_p > V::Scalar::ZERO && cos_q > V::Scalar::ZERO {
        cos_p / squared * (cos_q / squared) * area_q / V::Scalar::PI
    } else {
        V::Scalar::ZERO
    }
}

/// A small flat patch, for [`point_to_point_error`].
#[derive(Clone, Copy, Debug)]
pub struct SmallPatch<V: Vector> {
    /// Its centroid.
    pub center: V,
    /// Of length 1, on the side that sends and receives.
    pub normal: V,
    /// From the centroid to the farthest point; 0 for a point.
    pub radius: V::Scalar,
    /// Its area; that of the sender does not matter.
    pub area: V::Scalar,
}

/// A bound of `|point_to_point - F|` for the exact form factor `F` between flat patches of any shape.
///
/// With `d = (radius_p + radius_q) / r < 1` and both patches above the horizon of each other it is
/// `(10 cos a cos b + 4 cos a + 4 cos b + d) d^2 / (1 - d)^6 * area_q / (pi r^2)`: relative to the point formula it
/// falls with the square of size over distance. Where a horizon may cut a patch it is `(cos a + d) (cos b + d) /
/// (1 - d)^4 * area_q / (pi r^2)`, because then only the first order falls off. Never above 1, or above the point
/// formula where that exceeds 1.
///
/// Proof: with `v = (x - w) / r` for the offsets `x`, `w` of two points from the centroids, the integrand is
/// `(cos a + n.x/r) (cos b + m.w/r) g(v)`, `g(v) = |e + v|^-4`. The offsets have mean 0 and do not depend on each
/// other, so that all terms of first order vanish; `|g - 1| <= 4 d / (1 - d)^5`, and the remainder of second order of
/// `g` is at most `10 d^2 / (1 - d)^6`.
pub fn point_to_point_error<V: Vector>(p: &SmallPatch<V>, q: &SmallPatch<V>) -> V::Scalar {
    let (zero, one) = (V::Scalar::ZERO, V::Scalar::ONE);
    let number = V::Scalar::from_f64;
    let to_q = q.center - p.center;
    let r = to_q.length();
    let most = point_to_point(p.center, p.normal, q.center, q.normal, q.area).max(one);
    let d = (p.radius + q.radius) / r;
    if !(d < one) {
        return most;
    }
    let (cos_p, cos_q) = (to_q.dot(p.normal) / r, -to_q.dot(q.normal) / r);
    let near = one - d;
    let fourth = near * near * near * near;
    let share = if cos_p > d && cos_q > d {
        let second = number(10.0) * cos_p * cos_q + number(4.0) * (cos_p + cos_q) + d;
        second * d * d / (fourth * near * near)
    } else {
        (cos_p + d).max(zero) * (cos_q + d).max(zero) / fourth
    };
    (share * q.area / (V::Scalar::PI * r * r)).min(most)
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};

    use super::*;

    #[test]
    fn facing_patches() {
        let factor = point_to_point(Vec3::ZERO, Vec3::Z, Vec3::Z * 2.0, Vec3::NEG_Z, 0.1);
        assert!((factor - 0.1 / (4.0 * core::f32::consts::PI)).abs() < 1e-8);
        assert_eq!(point_to_point(Vec3::ZERO, Vec3::Z, Vec3::Z * 2.0, Vec3::Z, 0.1), 0.0);
        assert_eq!(point_to_point(Vec3::ZERO, Vec3::NEG_Z, Vec3::Z * 2.0, Vec3::NEG_Z, 0.1), 0.0);
        assert_eq!(point_to_point(Vec3::ZERO, Vec3::Z, Vec3::ZERO, Vec3::NEG_Z, 0.1), 0.0);
    }

    /// A disc of radius R that faces the point has `F = R^2 / (R^2 + r^2)`, the point formula gives `R^2 / r^2`.
    #[test]
    fn the_error_falls_with_the_square_of_the_distance() {
        let radius = 0.3;
        let p = SmallPatch { center: DVec3::ZERO, normal: DVec3::Z, radius: 0.0, area: 0.0 };
        let mut last = 0.0;
        for r in [0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0] {
            let area = core::f64::consts::PI * radius * radius;
            let q = SmallPatch { center: DVec3::Z * r, normal: DVec3::NEG_Z, radius, area };
            let factor = point_to_point(p.center, p.normal, q.center, q.normal, area);
            let exact = radius * radius / (radius * radius + r * r);
            let relative = (factor - exact) / exact;
            assert!((relative / (radius * radius / (r * r)) - 1.0).abs() < 1e-9);
            assert!(factor - exact <= point_to_point_error(&p, &q));
            last = point_to_point_error(&p, &q) / factor;
        }
        assert!(last < 20.0 * radius * radius / 1024.0);
    }

    #[test]
    fn near_patches_have_no_useful_bound() {
        let p = SmallPatch { center: Vec3::ZERO, normal: Vec3::Z, radius: 1.0, area: 1.0 };
        let q = SmallPatch { center: Vec3::Z, normal: Vec3::NEG_Z, ..p };
        assert_eq!(point_to_point_error(&p, &q), 1.0);
        assert_eq!(point_to_point_error(&p, &p), 1.0);
    }
}
