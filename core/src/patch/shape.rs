//! What can be cut: parametric surfaces with a material.

use crate::math::{Real, Vector};
use crate::spline::BezierSurface;

/// A parametric surface. Its front is the side from which `u` to `v` is a turn to the left, which is the side from
/// which the corners run counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Patch<'a, V> {
    /// Over the triangle `u, v >= 0`, `u + v <= 1`.
    Triangle([V; 3]),
    /// The bilinear surface through four corners over the unit square; they need not lie in a plane.
    Quad([V; 4]),
    /// Over the unit square.
    Spline(BezierSurface<'a, V>),
}

/// Patches that join smoothly, of one material. A block has six shapes, a sphere may have eight patches and one shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape<'a, V, S> {
    /// Patches with common edges have their common corners at the same places.
    pub patches: &'a [Patch<'a, V>],
    /// Reflectance, in `[0, 1)`.
    pub reflectance: S,
    /// Exitance, or radiance as well: what leaves the elements comes out in the same unit.
    pub exitance: S,
}

impl<V: Vector> Patch<'_, V> {
    /// The corners of the domain, counter-clockwise.
    pub fn domain(&self) -> &'static [[u8; 2]] {
        match self {
            Self::Triangle(_) => &[[0, 0], [1, 0], [0, 1]],
            _ => &[[0, 0], [1, 0], [1, 1], [0, 1]],
        }
    }

    /// The point at `(u, v)` of the domain.
    pub fn point(&self, [u, v]: [V::Scalar; 2]) -> V {
        let one = V::Scalar::ONE;
        match self {
            Self::Triangle([a, b, c]) => *a * (one - u - v) + *b * u + *c * v,
            Self::Quad([a, b, c, d]) => (*a * (one - u) + *b * u) * (one - v) + (*d * (one - u) + *c * u) * v,
            Self::Spline(surface) => surface.at(u, v).point,
        }
    }

    /// The normal of length 1 at `(u, v)` of the domain; zero where there is none.
    pub fn normal(&self, [u, v]: [V::Scalar; 2]) -> V {
        let one = V::Scalar::ONE;
        match self {
            Self::Triangle([a, b, c]) => (*b - *a).cross(*c - *a).normalize_or_zero(),
            Self::Quad([a, b, c, d]) => {
                let du = (*b - *a) * (one - v) + (*c - *d) * v;
                let dv = (*d - *a) * (one - u) + (*c - *b) * u;
                du.cross(dv).normalize_or_zero()
            }
            Self::Spline(surface) => surface.normal(u, v),
        }
    }
}

/// Cuts a convex planar polygon into quads, and a triangle where its number of corners is odd.
///
/// Less than three corners give nothing.
pub fn polygon<'a, V: Vector>(corners: &'a [V]) -> impl Iterator<Item = Patch<'static, V>> + 'a {
    (1..corners.len().saturating_sub(1)).step_by(2).filter_map(|k| match corners[k..] {
        [b, c, d, ..] => Some(Patch::Quad([corners[0], b, c, d])),
        [b, c] => Some(Patch::Triangle([corners[0], b, c])),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, Vec3};

    #[test]
    fn corners_of_the_domain_are_corners_of_the_patch() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 2.0, 0.5), DVec3::Y];
        let at = |patch: Patch<DVec3>, k: usize| patch.point(patch.domain()[k].map(f64::from));
        let spline = [corners[0], corners[1], corners[3], corners[2]];
        for (k, &corner) in corners.iter().enumerate() {
            assert_eq!(at(Patch::Quad(corners), k), corner);
            assert_eq!(at(Patch::Spline(BezierSurface::new(&spline, 2).unwrap()), k), corner);
        }
        let triangle = [corners[0], corners[1], corners[3]];
        (0..3).for_each(|k| assert_eq!(at(Patch::Triangle(triangle), k), triangle[k]));
    }

    /// A bilinear patch is a Bezier surface of degree one in each direction.
    #[test]
    fn a_quad_is_the_lowest_spline() {
        let [a, b, c, d] = [Vec3::ZERO, Vec3::new(2.0, 0.1, 0.0), Vec3::new(1.5, 1.0, 1.0), Vec3::new(0.0, 1.0, -0.5)];
        let points = [a, b, d, c];
        let (quad, spline) = (Patch::Quad([a, b, c, d]), Patch::Spline(BezierSurface::new(&points, 2).unwrap()));
        for place in [[0.0, 0.0], [0.3, 0.9], [0.5, 0.5], [1.0, 0.2]] {
            assert!(quad.point(place).abs_diff_eq(spline.point(place), 1e-6));
            assert!(quad.normal(place).abs_diff_eq(spline.normal(place), 1e-6));
        }
    }

    /// The pieces of a regular polygon have its area: `n / 2 sin(2 pi / n)`.
    #[test]
    fn a_polygon_in_pieces() {
        let corner = |k: usize, n: usize| {
            let (sin, cos) = (k as f64 * core::f64::consts::TAU / n as f64).sin_cos();
            DVec3::new(cos, sin, 0.0)
        };
        for n in 3..=8 {
            let corners: [DVec3; 8] = core::array::from_fn(|k| corner(k, n));
            let area: f64 = polygon(&corners[..n])
                .map(|patch| match patch {
                    Patch::Triangle([a, b, c]) => 0.5 * (b - a).cross(c - a).length(),
                    Patch::Quad([a, b, c, d]) => 0.5 * (c - a).cross(d - b).length(),
                    Patch::Spline(_) => 0.0,
                })
                .sum();
            assert!((area - n as f64 / 2.0 * (core::f64::consts::TAU / n as f64).sin()).abs() < 1e-12);
            assert_eq!(polygon(&corners[..n]).count(), (n - 1) / 2);
        }
        assert_eq!(polygon(&[Vec3::X, Vec3::Y]).count(), 0);
    }
}
