//! A light prepared for shadow rays: what it gives unoccluded, and where to look for what occludes it.

use glam::{Vec2, Vec3};

use super::{AreaLight, Cone, DirectionalLight, Emission, LightSource, PointLight, SpotLight};
use crate::geometry::{cone_direction, tangents};
use crate::math;

/// Rays to a ball or a disc of which one is chosen.
const CANDIDATES: usize = 8;

/// A light prepared for shadow rays.
#[derive(Clone, Debug)]
pub enum DirectLight {
    /// A point or a sphere.
    Point(PointLight),
    /// A point or a sphere inside a cone.
    Spot(SpotLight),
    /// From far away.
    Directional(DirectionalLight),
    /// Flat emitters.
    Area(AreaLight),
}

/// A ray that asks whether a point of a light is visible.
#[derive(Clone, Copy, Debug)]
pub struct ShadowRay {
    /// From the lit point towards the light.
    pub direction: Vec3,
    /// Length in multiples of `direction`: 1 ends at the light.
    pub end: f32,
    /// Which share of the irradiance comes along this ray, in any unit.
    pub weight: f32,
}

impl From<&LightSource> for DirectLight {
    fn from(source: &LightSource) -> Self {
        match source {
            LightSource::Point(light) => Self::Point(*light),
            LightSource::Spot(light) => Self::Spot(*light),
            LightSource::Directional(light) => Self::Directional(*light),
            LightSource::Rect(light) => Self::Area(light.into()),
        }
    }
}

impl DirectLight {
    /// Irradiance in lux at a point with this normal of length 1, with nothing between.
    pub fn irradiance(&self, point: Vec3, normal: Vec3) -> Vec3 {
        match self {
            Self::Point(light) => light.irradiance(point, normal),
            Self::Spot(light) => light.irradiance(point, normal),
            Self::Directional(light) => light.irradiance(normal),
            Self::Area(light) => light.irradiance(point, normal),
        }
    }

    /// Where light leaves it, times this strength per channel; nothing for light from far away, which is everywhere.
    pub fn emission(&self, strength: Vec3) -> Option<Emission> {
        match self {
            Self::Point(light) => Some(light.emission(strength, Cone::ALL)),
            Self::Spot(SpotLight { point, direction, outer_angle, .. }) => {
                Some(point.emission(strength, Cone { axis: *direction, cos: math::cos(*outer_angle) }))
            }
            Self::Directional(_) => None,
            Self::Area(light) => Some(light.emission(strength)),
        }
    }

    /// Whether the light has no extent, so that one ray tells all.
    pub fn is_sharp(&self) -> bool {
        match self {
            Self::Point(light) | Self::Spot(SpotLight { point: light, .. }) => light.radius == 0.0,
            Self::Directional(light) => light.angular_diameter == 0.0,
            Self::Area(_) => false,
        }
    }

    /// A shadow ray by three numbers in `[0, 1)`, and the irradiance in lux that it stands for alone: its mean over them is
    /// [`DirectLight::irradiance`].
    ///
    /// Balls and discs send one of a few rays, chosen by their weights, so that of one that is half below the horizon the
    /// half above stands for all.
    pub fn shadow_sample(&self, numbers: Vec3, point: Vec3, normal: Vec3) -> (ShadowRay, Vec3) {
        let square = numbers.truncate();
        if let Self::Area(light) = self {
            let target = light.point(square);
            let ray = ShadowRay { direction: target.position - point, end: 1.0, weight: 1.0 };
            return (ray, light.irradiance_from(&target, point, normal));
        }
        if self.is_sharp() {
            return (self.shadow_ray(square, point, normal), self.irradiance(point, normal));
        }
        let rays: [ShadowRay; CANDIDATES] = core::array::from_fn(|k| {
            let lattice = Vec2::new(k as f32, (3 * k) as f32) / CANDIDATES as f32;
            self.shadow_ray((square + lattice).fract(), point, normal)
        });
        let mut rest = numbers.z * rays.iter().map(|ray| ray.weight).sum::<f32>();
        let chosen = rays.iter().find(|ray| {
            rest -= ray.weight;
            rest < 0.0
        });
        chosen.map_or((rays[0], Vec3::ZERO), |ray| (*ray, self.irradiance(point, normal)))
    }

    /// The shadow ray from a lit point to the point of the light that belongs to a point of the unit square.
    pub fn shadow_ray(&self, square: Vec2, point: Vec3, normal: Vec3) -> ShadowRay {
        match self {
            Self::Point(light) | Self::Spot(SpotLight { point: light, .. }) => sphere_ray(light, square, point, normal),
            Self::Directional(light) => {
                let direction = cone_direction(square, -light.direction, math::cos(0.5 * light.angular_diameter));
                ShadowRay { direction, end: f32::INFINITY, weight: direction.dot(normal).max(0.0) }
            }
            Self::Area(light) => {
                let target = light.point(square);
                let weight = light.weight(&target, point, normal);
                ShadowRay { direction: target.position - point, end: 1.0, weight }
            }
        }
    }
}

/// To the disc that a luminous sphere shows.
fn sphere_ray(light: &PointLight, square: Vec2, point: Vec3, normal: Vec3) -> ShadowRay {
    let to_center = light.position - point;
    let axis = to_center.normalize_or(normal);
    let (tangent, bitangent) = tangents(axis);
    let foot = crate::geometry::disc(square) * light.radius;
    let direction = to_center + tangent * foot.x + bitangent * foot.y;
    ShadowRay { direction, end: 1.0, weight: direction.normalize_or_zero().dot(normal).max(0.0) }
}
