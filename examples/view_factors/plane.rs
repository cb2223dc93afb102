//! Surfaces that are given in a plane of their own, by azimuth and tilt (`F 3a`).

use glam::DVec3;

/// How a surface is described within its plane.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// By width and height, from its lower left corner.
    Rectangle,
    /// By this many corners, each right and up from the origin of the plane.
    Polygon(usize),
}

impl Shape {
    /// How many numbers describe the plane and the shape.
    pub fn numbers(self) -> usize {
        match self {
            Shape::Rectangle => 5 + 2,
            Shape::Polygon(corners) => 5 + 2 * corners,
        }
    }
}

/// The corners in space, from `x y z azimuth tilt` and the numbers of the shape.
///
/// The front faces the azimuth, in degrees clockwise from +y as seen from above, and is tilted by 0 degrees when it
/// faces up (+z), by 90 when it is a wall, by 180 when it faces down. Right and up are as seen from the front.
pub fn corners_in_plane(shape: Shape, numbers: &[f64]) -> Vec<DVec3> {
    let origin = DVec3::from_slice(numbers);
    let (sin_azimuth, cos_azimuth) = sin_cos_of_degrees(numbers[3]);
    let (sin_tilt, cos_tilt) = sin_cos_of_degrees(numbers[4]);
    let front = DVec3::new(sin_tilt * sin_azimuth, sin_tilt * cos_azimuth, cos_tilt);
    let right = DVec3::new(-cos_azimuth, sin_azimuth, 0.0);
    let up = front.cross(right);
    let at = |right_by: f64, up_by: f64| origin + right * right_by + up * up_by;
    match (shape, &numbers[5..]) {
        (Shape::Rectangle, rest) => {
            let (width, height) = (rest[0], rest[1]);
            vec![at(0.0, 0.0), at(width, 0.0), at(width, height), at(0.0, height)]
        }
        (Shape::Polygon(count), rest) => rest.chunks(2).take(count).map(|corner| at(corner[0], corner[1])).collect(),
    }
}

/// Exact at whole quarter turns, so that the walls of a room meet in the same vertices.
fn sin_cos_of_degrees(degrees: f64) -> (f64, f64) {
    let (sin, cos) = degrees.to_radians().sin_cos();
    if degrees % 90.0 == 0.0 { (sin.round(), cos.round()) } else { (sin, cos) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wall of width 3 and height 2 that faces south (azimuth 180) at y = 1: right, seen from the front, is +x.
    #[test]
    fn a_wall_that_faces_south() {
        let corners = corners_in_plane(Shape::Rectangle, &[5.0, 1.0, 0.0, 180.0, 90.0, 3.0, 2.0]);
        assert_eq!(corners[1], DVec3::new(8.0, 1.0, 0.0));
        assert_eq!(corners[2], DVec3::new(8.0, 1.0, 2.0));
        assert_eq!(normal(&corners), DVec3::NEG_Y);
    }

    /// Any plane: the normal of the corners is the direction that azimuth and tilt give.
    #[test]
    fn the_front_faces_azimuth_and_tilt() {
        let (azimuth, tilt) = (33.0_f64, 71.0_f64);
        let corners =
            corners_in_plane(Shape::Polygon(3), &[1.0, 2.0, 3.0, azimuth, tilt, 0.0, 0.0, 2.0, 0.5, 1.0, 3.0]);
        let (a, t) = (azimuth.to_radians(), tilt.to_radians());
        let front = DVec3::new(t.sin() * a.sin(), t.sin() * a.cos(), t.cos());
        assert!(normal(&corners).distance(front) < 1e-15);
    }

    fn normal(corners: &[DVec3]) -> DVec3 {
        (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize()
    }
}
