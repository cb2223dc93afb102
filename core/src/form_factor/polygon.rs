//! From a point to a polygon: Lambert's closed form, clipped at the horizon.

use core::f32::consts::TAU;

use glam::Vec3;

use crate::math;

/// Share of the power leaving `point` that lands on a triangle, with nothing between.
///
/// The triangle counts from both sides; what lies below the horizon of `point` does not. `normal` has length 1.
/// In `[0, 1]`, with an absolute error below 1e-6 for triangles that are not seen edge-on at the point itself.
/// Lambert's formula `F = 1/2pi sum theta_i (n . G_i)`, as in Baum, Rushmeier and Winget 1989; it is the projection of
/// the spherical triangle onto the disc below it, which Nusselt drew.
pub fn point_to_triangle(point: Vec3, normal: Vec3, triangle: &[Vec3; 3]) -> f32 {
    let corners = triangle.map(|corner| corner - point);
    let heights = corners.map(|corner| corner.dot(normal));
    let (polygon, count) = clip_at_horizon(&corners, &heights);
    lambert_sum(&polygon[..count], normal).abs().min(1.0)
}

/// Cuts off what lies below the horizon; a triangle becomes a polygon of up to four corners.
fn clip_at_horizon(corners: &[Vec3; 3], heights: &[f32; 3]) -> ([Vec3; 4], usize) {
    let mut polygon = [Vec3::ZERO; 4];
    let mut count = 0;
    let mut push = |corner| {
        polygon[count] = corner;
        count += 1;
    };
    for i in 0..3 {
        let j = (i + 1) % 3;
        if heights[i] > 0.0 {
            push(corners[i]);
        }
        if (heights[i] > 0.0) != (heights[j] > 0.0) {
            push(corners[i].lerp(corners[j], heights[i] / (heights[i] - heights[j])));
        }
    }
    (polygon, count)
}

/// `1/2pi` times the sum over the edges of the angle they span times the height of the normal of their plane.
fn lambert_sum(polygon: &[Vec3], normal: Vec3) -> f32 {
    let sum: f32 = (0..polygon.len()).map(|i| edge(polygon[i], polygon[(i + 1) % polygon.len()], normal)).sum();
    sum / TAU
}

fn edge(from: Vec3, to: Vec3, normal: Vec3) -> f32 {
    let cross = from.cross(to);
    let length = cross.length();
    if length == 0.0 {
        return 0.0;
    }
    math::atan2(length, from.dot(to)) * cross.dot(normal) / length
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
