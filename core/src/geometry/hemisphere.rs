//! Directions around a normal, and on discs and cones.

use core::f32::consts::TAU;

use glam::{Vec2, Vec3};

use crate::math;

/// Two vectors of length 1 that are orthogonal to `normal` and to each other, in a right-handed system.
///
/// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
pub fn tangents(normal: Vec3) -> (Vec3, Vec3) {
    let sign = if normal.z < 0.0 { -1.0 } else { 1.0 };
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    let tangent = Vec3::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    let bitangent = Vec3::new(b, sign + normal.y * normal.y * a, -normal.y);
    (tangent, bitangent)
}

/// A point of the unit square carried to the unit disc, equal areas to equal areas.
pub fn disc(square: Vec2) -> Vec2 {
    let (sin, cos) = math::sin_cos(TAU * square.x);
    Vec2::new(cos, sin) * math::sqrt(square.y)
}

/// A direction of length 1 around `normal`, with density `cos / pi`, from a point of the unit square.
///
/// The inverse of Nusselt's projection: the disc is lifted onto the hemisphere (Malley's method).
pub fn cosine_direction(square: Vec2, normal: Vec3) -> Vec3 {
    let foot = disc(square);
    let (tangent, bitangent) = tangents(normal);
    tangent * foot.x + bitangent * foot.y + normal * math::sqrt((1.0 - foot.length_squared()).max(0.0))
}

/// A direction of length 1 inside the cone around `axis` with this half angle, uniform in solid angle.
pub fn cone_direction(square: Vec2, axis: Vec3, cos_half_angle: f32) -> Vec3 {
    let cos = 1.0 - square.y * (1.0 - cos_half_angle);
    let sin = math::sqrt((1.0 - cos * cos).max(0.0));
    let (s, c) = math::sin_cos(TAU * square.x);
    let (tangent, bitangent) = tangents(axis);
    (tangent * c + bitangent * s) * sin + axis * cos
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Sobol;

    /// The mean of cos^n over the cosine-weighted hemisphere is 2 / (n + 2).
    #[test]
    fn cosine_moments() {
        let normal = Vec3::new(0.6, -0.48, 0.64);
        let sequence = Sobol::new(3);
        for power in 1..5 {
            let sum: f32 =
                (0..4096).map(|i| cosine_direction(sequence.square(i), normal).dot(normal).powi(power)).sum();
            assert!((sum / 4096.0 - 2.0 / (power as f32 + 2.0)).abs() < 2e-3);
        }
    }

    #[test]
    fn directions_have_length_one() {
        for (i, normal) in [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Z, Vec3::Z].into_iter().enumerate() {
            let square = Sobol::new(9).square(i as u32);
            assert!((cosine_direction(square, normal).length() - 1.0).abs() < 1e-6);
            let inside = cone_direction(square, normal, 0.9);
            assert!((inside.length() - 1.0).abs() < 1e-6 && inside.dot(normal) >= 0.9 - 1e-6);
        }
    }
}
