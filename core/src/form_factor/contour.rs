//! From polygon to polygon by the double contour integral, which the theorem of Stokes makes of the double area
//! integral.

use glam::DVec3;

use super::boundary::Plane;
use super::edge_pair::edge_pair;
use super::quadrature::{GAUSS_4, GAUSS_6, Gauss};
use crate::math::{Real, Vector};

/// Share of the power leaving the front of polygon `a` that lands on the front of polygon `b`, with nothing between:
/// `F = 1 / (2 pi A_a) int int ln |p - q| dp . dq` along both boundaries.
///
/// Both are planar, convex or not, and run counter-clockwise seen from their front. What lies behind the plane of the
/// other one neither sends nor receives. In `[0, 1]`; 0 where a polygon has no finite area. The absolute error is below
/// 1e-12 for sizes and distances within a factor of 1000 of each other, for polygons that touch, share an edge or cut
/// each other too; between polygons that are small against their distance the relative error is below 1e-9. Computed
/// in `f64`; for `f32` the error is that of the rounded corners and result. `A_a F_ab = A_b F_ba` holds to rounding.
///
/// Sparrow 1963 for the integral. Parallel and touching edges are closed forms (see Schroeder and Hanrahan 1993 for all
/// others, which are Gauss sums here); polygons that are far from each other are sums over both boundaries with all
/// terms taken out that cancel.
pub fn polygon_to_polygon<V: Vector>(a: &[V], b: &[V]) -> V::Scalar {
    let (Some(plane_a), Some(plane_b)) = (Plane::of(a), Plane::of(b)) else { return V::Scalar::ZERO };
    let apart = Far::new(&plane_a, &plane_b);
    let reach = plane_a.radius + plane_b.radius;
    let mut sum = 0.0;
    plane_b.edges_in_front(a, |p0, p1| {
        plane_a.edges_in_front(b, |q0, q1| {
            sum += match &apart {
                Some(far) => far.edge_pair([p0, p1], [q0, q1]),
                None => edge_pair([p0, p1], [q0, q1], reach),
            };
        });
    });
    V::Scalar::from_f64((sum / (core::f64::consts::TAU * plane_a.area)).clamp(0.0, 1.0))
}

/// Two polygons at least six times as far from each other as they are large.
#[derive(Clone, Copy, Debug)]
struct Far {
    centers: [DVec3; 2],
    /// From the second center to the first, and the square of its length.
    between: DVec3,
    squared: f64,
    rule: Gauss,
}

impl Far {
    fn new(a: &Plane, b: &Plane) -> Option<Self> {
        let between = a.center - b.center;
        let squared = between.length_squared();
        let (distance, reach) = (Real::sqrt(squared), a.radius + b.radius);
        let rule = if distance > 12.0 * reach { GAUSS_4 } else { GAUSS_6 };
        (distance > 6.0 * reach).then_some(Self { centers: [a.center, b.center], between, squared, rule })
    }

    /// `int int f dp . dq` along two edges, where `f` is `ln |p - q|` less what cancels around both boundaries: all
    /// that depends on one of `p`, `q` only. With `|p - q|^2 = D^2 (1 + z)` and the offsets `x`, `y` of the points from
    /// the centers, `f = (ln(1 + z) - z) / 2 - x . y / D^2`.
    fn edge_pair(&self, p: [DVec3; 2], q: [DVec3; 2]) -> f64 {
        let (u, v) = (p[1] - p[0], q[1] - q[0]);
        let cos = u.dot(v);
        if cos == 0.0 {
            return 0.0;
        }
        let (from, to) = (p[0] - self.centers[0], q[0] - self.centers[1]);
        let inverse = 1.0 / self.squared;
        let mean = self.rule.mean(|s| {
            let x = from + u * s;
            self.rule.mean(|t| {
                let y = to + v * t;
                let step = x - y;
                let z = (2.0 * self.between + step).dot(step) * inverse;
                0.5 * ln_1p_less_linear(z) - x.dot(y) * inverse
            })
        });
        cos * mean
    }
}

/// `ln(1 + z) - z` for `|z| <= 0.37`, to full relative precision: the series of `2 atanh w` with `w = z / (2 + z)`.
#[inline]
fn ln_1p_less_linear(z: f64) -> f64 {
    const INVERSE_ODD: [f64; 10] = [
        1.0 / 21.0,
        1.0 / 19.0,
        1.0 / 17.0,
        1.0 / 15.0,
        1.0 / 13.0,
        1.0 / 11.0,
        1.0 / 9.0,
        1.0 / 7.0,
        1.0 / 5.0,
        1.0 / 3.0,
    ];
    let w = z / (2.0 + z);
    let squared = w * w;
    let sum = INVERSE_ODD.iter().fold(0.0, |sum, coefficient| sum * squared + coefficient);
    w * (2.0 * squared * sum - z)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    fn square(corner: DVec3, u: DVec3, v: DVec3) -> [DVec3; 4] {
        [corner, corner + u, corner + u + v, corner + v]
    }

    #[test]
    fn logarithms_near_one() {
        for k in -300..300 {
            let z = f64::from(k) / 1000.0;
            let exact = Real::ln(1.0 + z) - z;
            assert!((ln_1p_less_linear(z) - exact).abs() < 2e-16);
        }
        assert!((ln_1p_less_linear(1e-9) / -0.5e-18 - 1.0).abs() < 1e-8);
    }

    /// Howell's catalogue C-11.
    #[test]
    fn parallel_squares() {
        let floor = square(DVec3::ZERO, DVec3::X, DVec3::Y);
        for (distance, expected) in
            [(0.1, 0.826_994_522_397_3), (1.0, 0.199_824_895_698_4), (10.0, 0.003_162_056_838_755)]
        {
            let roof = square(DVec3::Z * distance, DVec3::Y, DVec3::X);
            let factor = polygon_to_polygon(&floor, &roof);
            assert!((factor - expected).abs() < 1e-13, "{distance}: {factor}");
        }
    }

    #[test]
    fn squares_that_share_an_edge() {
        let floor = square(DVec3::ZERO, DVec3::X, DVec3::Y);
        let wall = square(DVec3::ZERO, DVec3::Y, DVec3::Z);
        assert!((polygon_to_polygon(&floor, &wall) - 0.200_043_776_075_4).abs() < 1e-13);
        assert!(
            (polygon_to_polygon(&floor.map(|p| p.as_vec3()), &wall.map(|p| p.as_vec3())) - 0.200_043_78).abs() < 1e-7
        );
    }

    #[test]
    fn backs_and_nothing() {
        let floor = square(DVec3::ZERO, DVec3::X, DVec3::Y);
        let mut roof = square(DVec3::Z, DVec3::X, DVec3::Y);
        assert_eq!(polygon_to_polygon(&floor, &roof), 0.0);
        assert_eq!(polygon_to_polygon(&floor, &floor), 0.0);
        assert_eq!(polygon_to_polygon(&floor, &roof[..2]), 0.0);
        roof.reverse();
        roof[1].x = f64::NAN;
        assert_eq!(polygon_to_polygon(&floor, &roof), 0.0);
        assert_eq!(polygon_to_polygon::<Vec3>(&[], &[]), 0.0);
    }
}
