//! Light from flat emitters: what they give unoccluded in closed form, and points on them for shadow rays.

use alloc::vec::Vec;
use core::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::RectLight;
use super::falloff::range_window;
use crate::form_factor::point_to_triangle;
use crate::geometry::normal_and_area;
use crate::math;

/// Triangles that emit diffusely, each from the side its winding shows or from both.
#[derive(Clone, Debug)]
pub struct AreaLight {
    /// Emitted radiance in cd/m2.
    pub radiance: Vec3,
    /// The light fades to zero here, by [`range_window`]; infinite: no window.
    pub range: f32,
    /// Whether the backs of the triangles emit too.
    pub both_sides: bool,
    triangles: Vec<Emitter>,
}

/// A triangle with its share of the area of the light, all shares before it included.
#[derive(Clone, Copy, Debug)]
struct Emitter {
    corners: [Vec3; 3],
    normal: Vec3,
    share_end: f32,
}

/// A point on a light.
#[derive(Clone, Copy, Debug)]
pub struct LightPoint {
    /// Where it is.
    pub position: Vec3,
    /// Away from the surface that emits, length 1.
    pub normal: Vec3,
}

impl AreaLight {
    /// A light of these triangles; degenerate ones are left out. It has no triangles where all are degenerate.
    pub fn new(triangles: impl Iterator<Item = [Vec3; 3]>, radiance: Vec3, both_sides: bool) -> Self {
        let mut area_so_far = 0.0;
        let mut emitters: Vec<Emitter> = triangles
            .filter_map(|corners| {
                let (normal, area) = normal_and_area(&corners)?;
                area_so_far += area;
                Some(Emitter { corners, normal, share_end: area_so_far })
            })
            .collect();
        emitters.iter_mut().for_each(|emitter| emitter.share_end /= area_so_far);
        Self { radiance, range: f32::INFINITY, both_sides, triangles: emitters }
    }

    /// Irradiance in lux at a point with this normal of length 1, with nothing between: `pi L F`, windowed.
    pub fn irradiance(&self, point: Vec3, normal: Vec3) -> Vec3 {
        let form_factor: f32 = self
            .triangles
            .iter()
            .filter(|emitter| self.both_sides || (point - emitter.corners[0]).dot(emitter.normal) > 0.0)
            .map(|emitter| point_to_triangle(point, normal, &emitter.corners))
            .sum();
        if form_factor == 0.0 {
            return Vec3::ZERO;
        }
        self.radiance * (PI * form_factor * self.window(point))
    }

    /// The point of the light that belongs to a point of the unit square, uniform in area.
    pub fn point(&self, square: Vec2) -> LightPoint {
        let last = self.triangles.len() - 1;
        let index = self.triangles.partition_point(|emitter| emitter.share_end <= square.x).min(last);
        let start = if index == 0 { 0.0 } else { self.triangles[index - 1].share_end };
        let Emitter { corners: [a, b, c], normal, share_end } = self.triangles[index];
        let stretched = ((square.x - start) / (share_end - start).max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
        let root = math::sqrt(stretched);
        let position = a * (1.0 - root) + b * (root * (1.0 - square.y)) + c * (root * square.y);
        LightPoint { position, normal }
    }

    /// The weight of a shadow ray to a point of the light: `cos cos' / r^2`, zero behind either surface.
    pub fn weight(&self, light: &LightPoint, point: Vec3, normal: Vec3) -> f32 {
        let to_light = light.position - point;
        let squared = to_light.length_squared();
        let cos = to_light.dot(normal).max(0.0);
        let cos_light = -to_light.dot(light.normal);
        let cos_light = if self.both_sides { cos_light.abs() } else { cos_light.max(0.0) };
        cos * cos_light / (squared * squared).max(f32::MIN_POSITIVE)
    }

    fn window(&self, point: Vec3) -> f32 {
        if self.range.is_infinite() {
            return 1.0;
        }
        let [a, b, c] = self.triangles[0].corners;
        let center =
            if let [_, other] = &self.triangles[..] { (a + other.corners[1]) * 0.5 } else { (a + b + c) / 3.0 };
        range_window(center.distance_squared(point), self.range)
    }

    /// Whether the light has no area.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }
}

impl From<&RectLight> for AreaLight {
    fn from(light: &RectLight) -> Self {
        let corner = |u: f32, v: f32| light.center + light.half_width * u + light.half_height * v;
        let [a, b, c, d] = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        Self { range: light.range, ..Self::new([[a, b, c], [a, c, d]].into_iter(), light.radiance, false) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Sobol;

    fn panel() -> AreaLight {
        AreaLight::from(&RectLight {
            center: Vec3::new(0.3, 2.0, -0.2),
            half_width: Vec3::X,
            half_height: Vec3::Z * 0.5,
            radiance: Vec3::splat(10.0),
            range: f32::INFINITY,
        })
    }

    /// The closed form is the mean of the weights of uniform points, times the area.
    #[test]
    fn closed_form_is_the_integral_over_the_light() {
        let (light, point, normal) = (panel(), Vec3::new(0.1, 0.0, 0.4), Vec3::new(0.36, 0.8, 0.48));
        let sequence = Sobol::new(4);
        let sum: f32 = (0..65536).map(|i| light.weight(&light.point(sequence.square(i)), point, normal)).sum();
        let (estimate, exact) = (10.0 * 2.0 * sum / 65536.0, light.irradiance(point, normal).x);
        assert!((estimate - exact).abs() < 1e-3 * exact, "{estimate} {exact}");
    }

    #[test]
    fn backs_are_dark() {
        assert_eq!(panel().irradiance(Vec3::new(0.0, 5.0, 0.0), Vec3::NEG_Y), Vec3::ZERO);
    }
}
