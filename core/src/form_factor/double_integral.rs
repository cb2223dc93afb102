//! From polygon to polygon by the double area integral, with an error estimate.

use glam::DVec3;

use super::boundary::Plane;
use super::cubature::Cubature;
use super::polygon::lambert_sum;
use super::{Estimate, point_to_point};
use crate::math::{Real, Vector};

/// Most triangles of `a` that are looked at.
const MOST_TRIANGLES: u32 = 1 << 16;
/// Most triangles of `b` that [`double_integral_of_points`] looks at, for all points of `a` together.
const MOST_TRIANGLES_OF_B: u32 = 1 << 20;

/// Share of the power leaving the front of polygon `a` that lands on the front of polygon `b`, with nothing between:
/// `F = 1 / A_a int int cos a cos b / (pi r^2) dA_b dA_a`, refined until the estimated error is below `accuracy`.
///
/// The integral over the larger polygon is Lambert's closed form, that over the smaller one an adaptive cubature, so
/// that polygons that touch or share an edge are no harder than others. Both are planar and convex and run counter-
/// clockwise seen from their front; what lies behind the plane of the other one neither sends nor receives. The value
/// lies in `[0, 1]`; 0 where a polygon has no finite area. The error is an estimate from above of the absolute one, but
/// slivers a thousand times as long as wide may escape it; it may stay larger than `accuracy` after 65536 triangles.
/// Accuracies below some roundings count as those. Computed in `f64`.
/// The definition of the form factor, as in Goral et al. 1984; Baum, Rushmeier and Winget 1989 for the inner integral.
pub fn double_integral<V: Vector>(a: &[V], b: &[V], accuracy: V::Scalar) -> Estimate<V::Scalar> {
    over_smaller(a, b, accuracy, |a, b, accuracy| {
        let last = b.last().map_or(DVec3::ZERO, |corner| corner.to_dvec3());
        integral(a, b, accuracy, |pair, p| {
            -lambert_sum(p, pair.a.normal, last, b.iter().map(|corner| corner.to_dvec3()))
        })
    })
}

/// The same integral with nothing in closed form: adaptive cubature of the point formula over `b` for each point of an
/// adaptive cubature over `a`.
///
/// The textbook definition, to check all others by; slower than [`double_integral`] by orders of magnitude, most of all
/// where the polygons touch: then the work ends after a million triangles, with a larger error.
pub fn double_integral_of_points<V: Vector>(a: &[V], b: &[V], accuracy: V::Scalar) -> Estimate<V::Scalar> {
    over_smaller(a, b, accuracy, |a, b, accuracy| {
        let inner = 0.25 * floor(accuracy);
        let mut budget = MOST_TRIANGLES_OF_B;
        let mut worst = 0.0;
        let outer = integral(a, b, accuracy * V::Scalar::from_f64(0.5), |pair, p| {
            let over_b = |each: &mut dyn FnMut([DVec3; 3])| fan(&pair.a, b, each);
            let point = |q| point_to_point(p, pair.a.normal, q, pair.b.normal, 1.0);
            let found = Cubature::integral(inner, &mut budget, over_b, point);
            worst = Real::max(worst, found.error);
            found.value
        });
        Estimate { error: (outer.error + V::Scalar::from_f64(worst)).min(V::Scalar::ONE), ..outer }
    })
}

/// The outer integral over the smaller polygon, where the integrand is smoother, by `A_a F_ab = A_b F_ba`.
fn over_smaller<V: Vector>(
    a: &[V],
    b: &[V],
    accuracy: V::Scalar,
    method: impl Fn(&[V], &[V], V::Scalar) -> Estimate<V::Scalar>,
) -> Estimate<V::Scalar> {
    let area = |polygon: &[V]| Plane::of(polygon).map_or(0.0, |plane| plane.area);
    let ratio = V::Scalar::from_f64(area(b) / area(a));
    if ratio > V::Scalar::ZERO && ratio < V::Scalar::ONE {
        let back = method(b, a, accuracy / ratio);
        Estimate { value: back.value * ratio, error: back.error * ratio }
    } else {
        method(a, b, accuracy)
    }
}

/// Two polygons, measured.
#[derive(Clone, Copy, Debug)]
struct Pair {
    a: Plane,
    b: Plane,
}

/// The mean over `a` of a function of its points in front of `b`.
fn integral<V: Vector>(
    a: &[V],
    b: &[V],
    accuracy: V::Scalar,
    mut to_b: impl FnMut(&Pair, DVec3) -> f64,
) -> Estimate<V::Scalar> {
    let (Some(plane_a), Some(plane_b)) = (Plane::of(a), Plane::of(b)) else { return Estimate::default() };
    let pair = Pair { a: plane_a, b: plane_b };
    let over_a = |each: &mut dyn FnMut([DVec3; 3])| fan(&plane_b, a, each);
    let mut budget = MOST_TRIANGLES;
    let sum = Cubature::integral(floor(accuracy) * plane_a.area, &mut budget, over_a, |p| to_b(&pair, p));
    let rounding = 4.0 * V::Scalar::EPSILON.to_f64();
    Estimate {
        value: V::Scalar::from_f64((sum.value / plane_a.area).clamp(0.0, 1.0)),
        error: V::Scalar::from_f64(Real::min(sum.error / plane_a.area + rounding, 1.0)),
    }
}

/// An accuracy that is not finer than the roundings of a sum.
fn floor<R: Real>(accuracy: R) -> f64 {
    accuracy.max(R::from_f64(64.0) * R::EPSILON).to_f64()
}

/// The triangles between the first corner of the part of a convex polygon in front of a plane and its edges.
fn fan<V: Vector>(plane: &Plane, polygon: &[V], each: &mut dyn FnMut([DVec3; 3])) {
    let mut first = None;
    plane.edges_in_front(polygon, |from, to| {
        let apex = *first.get_or_insert(from);
        if apex != from && apex != to {
            each([apex, from, to]);
        }
    });
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    const FLOOR: [DVec3; 4] = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
    const WALL: [DVec3; 4] = [DVec3::ZERO, DVec3::Y, DVec3::new(0.0, 1.0, 1.0), DVec3::Z];

    fn roof(height: f64) -> [DVec3; 4] {
        let up = DVec3::Z * height;
        [up, up + DVec3::Y, up + DVec3::new(1.0, 1.0, 0.0), up + DVec3::X]
    }

    fn check(found: Estimate<f64>, expected: f64, accuracy: f64) {
        assert!(found.error <= accuracy && (found.value - expected).abs() <= found.error, "{found:?} {expected}");
    }

    /// Howell's catalogue C-11 and C-14.
    #[test]
    fn accuracy_is_kept() {
        for accuracy in [1e-3, 1e-6, 1e-9, 1e-11] {
            check(double_integral(&FLOOR, &roof(1.0), accuracy), 0.199_824_895_698_387_4, accuracy);
            check(double_integral(&FLOOR, &roof(0.1), accuracy), 0.826_994_522_397_3, accuracy);
            check(double_integral(&FLOOR, &WALL, accuracy), 0.200_043_776_075_403_3, accuracy);
        }
    }

    #[test]
    fn the_definition() {
        for accuracy in [1e-2, 1e-4] {
            check(double_integral_of_points(&FLOOR, &roof(1.0), accuracy), 0.199_824_895_698_387_4, accuracy);
            check(double_integral_of_points(&FLOOR, &WALL, accuracy), 0.200_043_776_075_403_3, accuracy);
        }
        check(double_integral_of_points(&FLOOR, &roof(1.0), 1e-7), 0.199_824_895_698_387_4, 1e-7);
    }

    #[test]
    fn nothing_to_see() {
        assert_eq!(double_integral::<Vec3>(&[], &[], 1e-3), Estimate::default());
        assert_eq!(double_integral(&FLOOR, &FLOOR, 1e-3).value, 0.0);
        let mut back = roof(1.0);
        back.reverse();
        assert_eq!(double_integral(&FLOOR, &back, 1e-3).value, 0.0);
        assert!(double_integral(&FLOOR, &roof(1.0), f64::NAN).error < 1e-12);
    }
}
