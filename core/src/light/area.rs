//! Light from flat emitters: what they give unoccluded in closed form, and points on them for shadow rays.

use alloc::vec::Vec;
use core::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::falloff::range_window;
use super::{Cone, Emission, PlaneMirror, RectLight};
use crate::form_factor::point_to_triangle;
use crate::geometry::{Sobol, normal_and_area};
use crate::math;

/// With more triangles than this the irradiance is a sum over points instead of closed forms.
const MOST_CLOSED_FORMS: usize = 256;
/// So many points.
const POINTS: u32 = 512;

/// Triangles that emit diffusely, each from the side its winding shows or from both.
#[derive(Clone, Debug)]
pub struct AreaLight {
    /// The light fades to zero here, by [`range_window`]; infinite: no window.
    pub range: f32,
    /// Whether the backs of the triangles emit too.
    pub both_sides: bool,
    triangles: Vec<Emitter>,
    /// Area times level of all triangles.
    power: f32,
    /// From here the range is measured.
    center: Vec3,
}

/// A triangle with its share of the power of the light, all shares before it included.
#[derive(Clone, Copy, Debug)]
struct Emitter {
    corners: [Vec3; 3],
    normal: Vec3,
    radiance: Vec3,
    share_end: f32,
}

/// A point on a light.
#[derive(Clone, Copy, Debug)]
pub struct LightPoint {
    /// Where it is.
    pub position: Vec3,
    /// Away from the surface that emits, length 1.
    pub normal: Vec3,
    /// Radiance over its mean of the channels.
    color: Vec3,
}

impl AreaLight {
    /// A light of these triangles, each with its radiance in cd/m2; those without area or light are left out, so that
    /// the light may be empty.
    pub fn new(triangles: impl Iterator<Item = ([Vec3; 3], Vec3)>, both_sides: bool) -> Self {
        let mut power = 0.0;
        let mut emitters: Vec<Emitter> = triangles
            .filter(|(_, radiance)| radiance.max_element() > 0.0)
            .filter_map(|(corners, radiance)| {
                let (normal, area) = normal_and_area(&corners)?;
                power += area * level(radiance);
                Some(Emitter { corners, normal, radiance, share_end: power })
            })
            .collect();
        emitters.iter_mut().for_each(|emitter| emitter.share_end /= power);
        let center = match &emitters[..] {
            [] => Vec3::ZERO,
            [Emitter { corners: [a, ..], .. }, other] => (*a + other.corners[1]) * 0.5,
            [Emitter { corners: [a, b, c], .. }, ..] => (*a + *b + *c) / 3.0,
        };
        Self { range: f32::INFINITY, both_sides, triangles: emitters, power, center }
    }

    /// Irradiance in lux at a point with this normal of length 1, with nothing between: `pi L F`, windowed.
    ///
    /// Of more than 256 triangles it is summed over 512 points of the light, the same for all lit points. Before a ball
    /// that is within 2 % from twice its radius on; nearer, where few of the points count, it is off by up to a third.
    pub fn irradiance(&self, point: Vec3, normal: Vec3) -> Vec3 {
        let sum = if self.triangles.len() > MOST_CLOSED_FORMS {
            self.sum_over_points(point, normal)
        } else {
            self.sum_of_closed_forms(point, normal)
        };
        if sum == Vec3::ZERO { sum } else { sum * self.window(point) }
    }

    fn sum_of_closed_forms(&self, point: Vec3, normal: Vec3) -> Vec3 {
        let shows = |emitter: &&Emitter| self.both_sides || (point - emitter.corners[0]).dot(emitter.normal) > 0.0;
        let from = |emitter: &Emitter| emitter.radiance * (PI * point_to_triangle(point, normal, &emitter.corners));
        self.triangles.iter().filter(shows).map(from).sum()
    }

    fn sum_over_points(&self, point: Vec3, normal: Vec3) -> Vec3 {
        let sequence = Sobol::new(0);
        let points = (0..POINTS).map(|index| self.point(sequence.square(index)));
        let sum: Vec3 = points.map(|light| light.color * self.weight(&light, point, normal)).sum();
        sum * (self.power / POINTS as f32)
    }

    /// The point of the light that belongs to a point of the unit square, uniform in power.
    pub fn point(&self, square: Vec2) -> LightPoint {
        let last = self.triangles.len() - 1;
        let index = self.triangles.partition_point(|emitter| emitter.share_end <= square.x).min(last);
        let start = if index == 0 { 0.0 } else { self.triangles[index - 1].share_end };
        let Emitter { corners: [a, b, c], normal, radiance, share_end } = self.triangles[index];
        let stretched = ((square.x - start) / (share_end - start).max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
        let root = math::sqrt(stretched);
        let position = a * (1.0 - root) + b * (root * (1.0 - square.y)) + c * (root * square.y);
        LightPoint { position, normal, color: radiance / level(radiance) }
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

    /// What the mean irradiance over the unit square is made of, in lux: what a point of the light gives, with nothing
    /// between, over its density.
    pub fn irradiance_from(&self, light: &LightPoint, point: Vec3, normal: Vec3) -> Vec3 {
        light.color * (self.weight(light, point, normal) * self.power * self.window(point))
    }

    fn window(&self, point: Vec3) -> f32 {
        if self.range.is_infinite() {
            return 1.0;
        }
        range_window(self.center.distance_squared(point), self.range)
    }

    /// Where light leaves it, times this strength per channel.
    pub(super) fn emission(&self, strength: Vec3) -> Emission {
        let of_triangle = |emitter: &Emitter| {
            let [a, b, c] = emitter.corners;
            let area = 0.5 * (b - a).cross(c - a).length();
            let radiance = level(emitter.radiance * strength);
            Emission {
                low: a.min(b).min(c),
                high: a.max(b).max(c),
                axes: if self.both_sides { Cone::ALL } else { Cone::one(emitter.normal) },
                cos_beyond: 0.0,
                intensity: radiance * area,
                most: PI * radiance,
                range: self.range,
            }
        };
        let all = self.triangles.iter().map(of_triangle).reduce(|all, next| all.and(&next));
        all.unwrap_or(Emission::NONE)
    }

    /// What of it a plane mirror shows; possibly nothing.
    pub(super) fn image(&self, mirror: &PlaneMirror) -> Self {
        let shown =
            self.triangles.iter().filter(|emitter| emitter.corners.iter().any(|&corner| mirror.height(corner) > 0.0));
        let image = |emitter: &Emitter| {
            // An image turns the winding around.
            let [a, b, c] = emitter.corners.map(|corner| mirror.image(corner));
            ([a, c, b], emitter.radiance)
        };
        Self { range: self.range, center: mirror.image(self.center), ..Self::new(shown.map(image), self.both_sides) }
    }

    /// Whether the light has no area or no radiance.
    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }
}

/// The mean of the channels.
fn level(radiance: Vec3) -> f32 {
    radiance.element_sum() / 3.0
}

impl From<&RectLight> for AreaLight {
    fn from(light: &RectLight) -> Self {
        let corner = |u: f32, v: f32| light.center + light.half_width * u + light.half_height * v;
        let [a, b, c, d] = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        let triangles = [[a, b, c], [a, c, d]].map(|corners| (corners, light.radiance));
        Self { range: light.range, ..Self::new(triangles.into_iter(), false) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

    /// A sphere of many triangles is a sphere: E = pi L (r / d)^2 for a surface that faces it; nearly so close to it.
    #[test]
    fn many_triangles() {
        let corner = |i: usize, j: usize| {
            let (sin, cos) = math::sin_cos(PI * i as f32 / 24.0);
            let (s, c) = math::sin_cos(2.0 * PI * j as f32 / 48.0);
            Vec3::new(sin * c, cos, sin * s) * 0.1
        };
        let sphere = (0..24 * 48).flat_map(|k| {
            let (i, j) = (k / 48, k % 48);
            let [a, b, c, d] = [corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)];
            [([a, b, c], Vec3::new(5.0, 2.0, 0.0)), ([a, c, d], Vec3::new(5.0, 2.0, 0.0))]
        });
        let light = AreaLight::new(sphere, false);
        for (distance, most) in [(1.0, 0.02), (0.3, 0.02), (0.2, 0.02), (0.15, 0.33), (0.12, 0.33)] {
            for direction in [Vec3::NEG_Z, Vec3::X, Vec3::Y, Vec3::new(0.48, -0.6, 0.64)] {
                let got = light.irradiance(distance * direction, -direction);
                let expected = Vec3::new(5.0, 2.0, 0.0) * PI * (0.1 / distance) * (0.1 / distance);
                let error = (got - expected).length() / expected.length();
                assert!(error < most, "{error} at {distance} m towards {direction}");
            }
        }
    }
}
