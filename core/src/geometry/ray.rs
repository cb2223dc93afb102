//! A ray, and what it meets.

use glam::{Vec2, Vec3};

/// A straight line of limited length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3,
    /// Where it goes, of any length but zero.
    pub direction: Vec3,
    /// Where it ends, in multiples of `direction`; may be infinite.
    pub end: f32,
}

/// Where a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the triangle.
    pub triangle: u32,
    /// Along the ray, in multiples of its direction.
    pub distance: f32,
    /// Weights of the second and the third vertex, each in `[0, 1]`.
    pub barycentric: Vec2,
    /// Whether the ray meets the side from which the vertices run counter-clockwise.
    pub front: bool,
}

impl Hit {
    /// Interpolates what the three vertices carry.
    pub fn interpolate<T: core::ops::Mul<f32, Output = T> + core::ops::Add<Output = T>>(&self, corners: [T; 3]) -> T {
        let [a, b, c] = corners;
        let Vec2 { x: u, y: v } = self.barycentric;
        a * (1.0 - u - v) + b * u + c * v
    }
}
