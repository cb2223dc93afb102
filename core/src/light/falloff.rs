//! How light from a point, a cone and far away arrives at a surface.

use glam::Vec3;

use super::{Cone, DirectionalLight, Emission, PointLight, SpotLight};
use crate::math;

/// Nearer than this, in meters, intensity grows no further.
const NEAREST: f32 = 0.01;

/// The window that fades a light to zero at its range: `(1 - (d / range)^4)^2`.
pub fn range_window(distance_squared: f32, range: f32) -> f32 {
    let ratio = distance_squared / (range * range);
    let rest = (1.0 - ratio * ratio).max(0.0);
    rest * rest
}

impl PointLight {
    /// Irradiance in lux at a point with this normal of length 1: `I cos / d^2`, windowed.
    pub fn irradiance(&self, point: Vec3, normal: Vec3) -> Vec3 {
        let to_light = self.position - point;
        let squared = to_light.length_squared();
        let cos = to_light.dot(normal) / math::sqrt(squared).max(f32::MIN_POSITIVE);
        self.intensity * (cos.max(0.0) * range_window(squared, self.range) / squared.max(NEAREST * NEAREST))
    }

    /// Where light leaves it into these directions, times this strength per channel.
    pub(super) fn emission(&self, strength: Vec3, axes: Cone) -> Emission {
        let intensity = (self.intensity * strength).element_sum() / 3.0;
        Emission {
            low: self.position,
            high: self.position,
            axes,
            cos_beyond: 1.0,
            intensity,
            most: intensity / (NEAREST * NEAREST),
            range: self.range,
        }
    }
}

impl SpotLight {
    /// Irradiance in lux at a point with this normal of length 1.
    pub fn irradiance(&self, point: Vec3, normal: Vec3) -> Vec3 {
        let away = (point - self.point.position).normalize_or_zero();
        let (inner, outer) = (math::cos(self.inner_angle), math::cos(self.outer_angle));
        let cone = ((away.dot(self.direction) - outer) / (inner - outer).max(1e-4)).clamp(0.0, 1.0);
        self.point.irradiance(point, normal) * (cone * cone)
    }
}

impl DirectionalLight {
    /// Irradiance in lux on a surface with this normal of length 1.
    pub fn irradiance(&self, normal: Vec3) -> Vec3 {
        self.illuminance * (-self.direction.dot(normal)).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lamp(range: f32) -> PointLight {
        PointLight { position: Vec3::new(0.0, 3.0, 4.0), intensity: Vec3::splat(100.0), range, radius: 0.0 }
    }

    /// 100 cd at 5 m under 53 degrees: 100 / 25 x 0.6 lx.
    #[test]
    fn inverse_square_and_cosine() {
        let at = |range| lamp(range).irradiance(Vec3::ZERO, Vec3::Y).x;
        assert!((at(f32::INFINITY) - 2.4).abs() < 1e-5);
        assert!((at(10.0) - 2.4 * 0.9375 * 0.9375).abs() < 1e-5);
        assert_eq!(at(5.0), 0.0);
        assert_eq!(lamp(10.0).irradiance(Vec3::ZERO, Vec3::NEG_Y), Vec3::ZERO);
    }

    #[test]
    fn a_cone_is_whole_inside_and_dark_outside() {
        let spot = |degrees: f32| {
            let (sin, cos) = math::sin_cos(degrees.to_radians());
            let direction = Vec3::new(0.0, -0.6, -0.8);
            let (inner_angle, outer_angle) = (20.0_f32.to_radians(), 30.0_f32.to_radians());
            let turned = direction * cos + Vec3::X * sin;
            SpotLight { point: lamp(f32::INFINITY), direction: turned, inner_angle, outer_angle }
        };
        let whole = lamp(f32::INFINITY).irradiance(Vec3::ZERO, Vec3::Y);
        assert!((spot(15.0).irradiance(Vec3::ZERO, Vec3::Y) - whole).length() < 1e-4);
        assert_eq!(spot(31.0).irradiance(Vec3::ZERO, Vec3::Y), Vec3::ZERO);
    }
}
