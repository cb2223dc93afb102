//! From a point to a polygon: Lambert's closed form, clipped at the horizon.

use glam::Vec3;

use crate::math::{Real, Vector};

/// Share of the power leaving `point` that lands on the front of a `polygon`, with nothing between.
///
/// `polygon` is planar, convex or not, and runs counter-clockwise seen from its front; `normal` has length 1. What lies
/// below the horizon of `point` does not count. In `[0, 1]`; 0 behind the polygon, in its plane up to rounding (so on
/// its edges and corners too) and for fewer than three corners or coordinates that are not finite. The absolute error
/// is a few roundings over the distance of the point from the boundary in sizes of the polygon, where that is below 1.
/// Lambert's formula `F = 1/2pi sum theta_i (n . G_i)`, as in Baum, Rushmeier and Winget 1989; it is the projection of
/// the spherical polygon onto the disc below it, which Nusselt drew.
pub fn point_to_polygon<V: Vector>(point: V, normal: V, polygon: &[V]) -> V::Scalar {
    match polygon.last() {
        Some(&last) if is_in_front(point, polygon) => {
            (-lambert_sum(point, normal, last, polygon.iter().copied())).clamp(V::Scalar::ZERO, V::Scalar::ONE)
        }
        _ => V::Scalar::ZERO,
    }
}

/// Share of the power leaving `point` that lands on a triangle, with nothing between.
///
/// The triangle counts from both sides; what lies below the horizon of `point` does not. `normal` has length 1.
/// In `[0, 1]`, with an absolute error below 1e-6 for triangles that are not seen edge-on at the point itself.
/// The formula is that of [`point_to_polygon`].
#[inline]
pub fn point_to_triangle(point: Vec3, normal: Vec3, triangle: &[Vec3; 3]) -> f32 {
    lambert_sum(point, normal, triangle[2], triangle.iter().copied()).abs().min(1.0)
}

/// Whether the point is on the side from which the polygon runs counter-clockwise, by more than rounding.
fn is_in_front<V: Vector>(point: V, polygon: &[V]) -> bool {
    let Some((&first, others)) = polygon.split_first() else { return false };
    let mut normal = V::default();
    let mut from = V::default();
    for &corner in others {
        let to = corner - first;
        normal += from.cross(to);
        from = to;
    }
    let to_point = point - first;
    let squared = normal.length_squared() * to_point.length_squared();
    to_point.dot(normal) > V::Scalar::from_f64(4.0) * V::Scalar::EPSILON * squared.sqrt()
}

/// `1/2pi` times the sum over the edges above the horizon of the angle they span times the height of the normal of
/// their plane. Negative for a polygon that runs counter-clockwise seen from the point.
///
/// The edges that close the polygon at the horizon lie on one line there, so that their angles add up to those of the
/// points where the boundary rises less those where it sets, in any order. `last` is the last one of the corners.
#[inline]
pub(super) fn lambert_sum<V: Vector>(point: V, normal: V, last: V, corners: impl Iterator<Item = V>) -> V::Scalar {
    let zero = V::Scalar::ZERO;
    let mut sum = zero;
    let mut crossing = None;
    let (mut previous, mut from) = (last, last - point);
    let mut from_height = from.dot(normal);
    for corner in corners {
        let (step, to) = (corner - previous, corner - point);
        let to_height = to.dot(normal);
        if from_height > zero && to_height > zero {
            sum += edge(from, step, normal);
        } else if (from_height > zero) != (to_height > zero) {
            let share = from_height / (from_height - to_height);
            let here = from + step * share;
            let azimuth = match crossing {
                Some(first) => azimuth(first, here, normal),
                None => zero,
            };
            crossing = crossing.or(Some(here));
            sum += if from_height > zero {
                edge(from, step * share, normal) - azimuth
            } else {
                edge(here, step * (V::Scalar::ONE - share), normal) + azimuth
            };
        }
        (previous, from, from_height) = (corner, to, to_height);
    }
    sum / (V::Scalar::PI + V::Scalar::PI)
}

/// The angle that the edge from `from` to `from + step` spans, times the height of the normal of its plane.
#[inline]
fn edge<V: Vector>(from: V, step: V, normal: V) -> V::Scalar {
    let cross = from.cross(step);
    let length = cross.length();
    if length > V::Scalar::ZERO {
        length.atan2(from.dot(from + step)) * cross.dot(normal) / length
    } else {
        V::Scalar::ZERO
    }
}

/// The angle around the normal from one direction in the horizon to another.
#[inline]
fn azimuth<V: Vector>(from: V, to: V, normal: V) -> V::Scalar {
    from.cross(to).dot(normal).atan2(from.dot(to))
}

#[cfg(test)]
mod tests {
    use core::f32::consts::TAU;

    use glam::DVec3;

    use super::*;
    use crate::math;

    fn quad(corners: [[f32; 3]; 4]) -> f32 {
        let [a, b, c, d] = corners.map(Vec3::from_array);
        point_to_triangle(Vec3::ZERO, Vec3::Z, &[a, b, c]) + point_to_triangle(Vec3::ZERO, Vec3::Z, &[a, c, d])
    }

    /// Howell's catalogue B-3: a rectangle parallel to the element, one corner above it.
    #[test]
    fn parallel_rectangle() {
        let square = quad([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 1.0]]);
        assert!((square - 0.138_531_61).abs() < 1e-6);
    }

    /// Howell's catalogue B-4: a rectangle perpendicular to the element, one corner at distance c:
    /// F = 1/2pi (atan(b/c) - c / sqrt(a^2 + c^2) atan(b / sqrt(a^2 + c^2))) for height a and width b.
    #[test]
    fn perpendicular_rectangle() {
        let (a, b, c) = (2.0_f32, 1.5_f32, 0.7_f32);
        let wall = quad([[0.0, c, 0.0], [b, c, 0.0], [b, c, a], [0.0, c, a]]);
        let slant = math::sqrt(a * a + c * c);
        let exact = (math::atan2(b, c) - c / slant * math::atan2(b, slant)) / TAU;
        assert!((wall - exact).abs() < 1e-6);
    }

    /// The walls of a box around the element catch everything; the floor is the horizon itself.
    #[test]
    fn a_closed_box_catches_all() {
        let (low, high) = (Vec3::new(-0.3, -1.2, -0.5), Vec3::new(2.0, 0.4, 1.5));
        let corner = |x: bool, y: bool, z: bool| {
            let pick = |axis: usize, is_high: bool| if is_high { high[axis] } else { low[axis] };
            [pick(0, x), pick(1, y), pick(2, z)]
        };
        let mut sum = 0.0;
        for side in [false, true] {
            let (f, t) = (false, true);
            sum += quad([corner(side, f, f), corner(side, t, f), corner(side, t, t), corner(side, f, t)]);
            sum += quad([corner(f, side, f), corner(t, side, f), corner(t, side, t), corner(f, side, t)]);
            sum += quad([corner(f, f, side), corner(t, f, side), corner(t, t, side), corner(f, t, side)]);
        }
        assert!((sum - 1.0).abs() < 1e-5, "{sum}");
    }

    /// Two triangles are their square, and a polygon may be concave or cut by the horizon twice.
    #[test]
    fn parts_add_up() {
        let (point, normal) = (DVec3::new(0.1, -0.2, 0.3), DVec3::new(0.6, 0.0, 0.8));
        let at = |x: f64, y: f64| DVec3::new(x, y, 2.0 - 0.5 * x);
        let arms = [
            at(-9.0, 0.0),
            at(-9.0, 1.0),
            at(4.0, 1.0),
            at(4.0, 2.0),
            at(-9.0, 2.0),
            at(-9.0, 3.0),
            at(6.0, 3.0),
            at(6.0, 0.0),
        ];
        let parts = [
            [at(-9.0, 0.0), at(-9.0, 1.0), at(4.0, 1.0), at(4.0, 0.0)],
            [at(-9.0, 2.0), at(-9.0, 3.0), at(4.0, 3.0), at(4.0, 2.0)],
            [at(4.0, 0.0), at(4.0, 3.0), at(6.0, 3.0), at(6.0, 0.0)],
        ];
        let whole = point_to_polygon(point, normal, &arms);
        let sum: f64 = parts.iter().map(|part| point_to_polygon(point, normal, part)).sum();
        assert!(whole > 0.1 && (whole - sum).abs() < 1e-15, "{whole} {sum}");
    }

    #[test]
    fn the_front_only() {
        let square = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
        let middle = Vec3::new(0.5, 0.5, 0.0);
        assert_eq!(point_to_polygon(middle - Vec3::Z, Vec3::Z, &square), 0.0);
        assert!(point_to_polygon(middle + Vec3::Z, Vec3::NEG_Z, &square) > 0.2);
        assert_eq!(point_to_polygon(middle + Vec3::Z, Vec3::Z, &square), 0.0);
        for point in [middle, Vec3::ZERO, Vec3::X * 0.5, Vec3::X * 2.0] {
            for normal in [Vec3::NEG_Z, Vec3::Z, Vec3::X, Vec3::new(0.6, 0.0, -0.8)] {
                assert_eq!(point_to_polygon(point, normal, &square), 0.0);
            }
        }
        assert!((point_to_polygon(middle + Vec3::Z * 1e-5, Vec3::NEG_Z, &square) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn nothing_to_see() {
        assert_eq!(point_to_polygon::<DVec3>(DVec3::ZERO, DVec3::Z, &[]), 0.0);
        assert_eq!(point_to_polygon(DVec3::ZERO, DVec3::Z, &[DVec3::Z, DVec3::X]), 0.0);
        assert_eq!(point_to_polygon(DVec3::ZERO, DVec3::Z, &[DVec3::Z, DVec3::X, DVec3::NAN]), 0.0);
    }
}
