//! Where the eye is and what it sees of the scene.

use glam::{Affine3A, Vec2, Vec3};

use crate::geometry::Ray;
use crate::math;

/// A pinhole camera that looks along its own `-z`, with `y` up, as in glTF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// From the camera to the world.
    pub transform: Affine3A,
    /// Vertical field of view in radians, between 0 and pi.
    pub fov_y: f32,
}

impl Camera {
    /// A camera at a place; `transform` goes from the camera to the world, `fov_y` is in radians.
    pub fn perspective(transform: Affine3A, fov_y: f32) -> Self {
        Self { transform, fov_y }
    }

    /// A camera at `eye` that has `target` in the middle of its picture and `y` upwards.
    ///
    /// The two points differ by more than a vertical.
    pub fn looking_at(eye: Vec3, target: Vec3, fov_y: f32) -> Self {
        Self::perspective(Affine3A::look_at_rh(eye, target, Vec3::Y).inverse(), fov_y)
    }

    /// The ray through a point of the picture, `(0, 0)` in its upper left corner and `(1, 1)` in its lower right one.
    ///
    /// `aspect` is width over height. Along the ray, distance is depth: the part along the axis of the camera.
    pub fn ray(&self, point: Vec2, aspect: f32) -> Ray {
        let half_height = math::tan(0.5 * self.fov_y);
        let x = (2.0 * point.x - 1.0) * half_height * aspect;
        let y = (1.0 - 2.0 * point.y) * half_height;
        let direction = self.transform.transform_vector3(Vec3::new(x, y, -1.0));
        Ray { origin: self.transform.translation.into(), direction, end: f32::INFINITY }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f32::consts::FRAC_PI_2;

    /// With 90 degrees the upper and lower border are seen under 45 degrees.
    #[test]
    fn rays_through_the_corners() {
        let camera = Camera::perspective(Affine3A::IDENTITY, FRAC_PI_2);
        for (point, expected) in [
            (Vec2::new(0.5, 0.5), Vec3::new(0.0, 0.0, -1.0)),
            (Vec2::new(0.0, 0.0), Vec3::new(-2.0, 1.0, -1.0)),
            (Vec2::new(1.0, 0.0), Vec3::new(2.0, 1.0, -1.0)),
            (Vec2::new(1.0, 1.0), Vec3::new(2.0, -1.0, -1.0)),
        ] {
            let direction = camera.ray(point, 2.0).direction;
            assert!(direction.abs_diff_eq(expected, 1e-6), "{point}: {direction}");
        }
    }

    #[test]
    fn the_target_is_in_the_middle() {
        let (eye, target) = (Vec3::new(3.0, 4.0, -5.0), Vec3::new(1.0, 0.0, 2.0));
        let ray = Camera::looking_at(eye, target, 1.0).ray(Vec2::splat(0.5), 1.5);
        assert!(ray.origin.abs_diff_eq(eye, 1e-5));
        assert!(ray.direction.abs_diff_eq((target - eye).normalize(), 1e-6));
    }

    /// What is higher in the world is higher in the picture, and the picture is not mirrored.
    #[test]
    fn up_is_up_and_right_is_right() {
        let camera = Camera::looking_at(Vec3::Z, Vec3::ZERO, 1.0);
        assert!(camera.ray(Vec2::new(0.5, 0.1), 1.0).direction.y > 0.0);
        assert!(camera.ray(Vec2::new(0.9, 0.5), 1.0).direction.x > 0.0);
    }
}
