//! Light sources and the irradiance that they give at a point, before anything stands in between.

mod area;
mod direct;
mod falloff;
mod lamps;
mod mirror;
mod sky;
mod tree;

pub use area::*;
pub use direct::*;
pub use falloff::*;
pub use lamps::*;
pub use mirror::*;
pub use sky::*;
pub use tree::*;

use alloc::string::String;

use glam::Vec3;

/// A light source with a name for messages.
#[derive(Clone, Debug)]
pub struct Light {
    /// For messages.
    pub name: String,
    /// What shines.
    pub source: LightSource,
}

/// What shines. Directions have length 1; quantities are per linear RGB channel.
#[derive(Clone, Copy, Debug)]
pub enum LightSource {
    /// The same intensity in all directions.
    Point(PointLight),
    /// A point light inside a cone.
    Spot(SpotLight),
    /// From far away.
    Directional(DirectionalLight),
    /// A rectangle that emits from one side.
    Rect(RectLight),
}

/// The same intensity in all directions, from a point or a sphere.
#[derive(Clone, Copy, Debug)]
pub struct PointLight {
    /// Center, in meters.
    pub position: Vec3,
    /// Luminous intensity in candela.
    pub intensity: Vec3,
    /// The light fades to zero here, by the window `(1 - (d / range)^4)^2`; infinite: no window.
    pub range: f32,
    /// Of the luminous sphere, in meters; 0: a point.
    pub radius: f32,
}

/// A point light inside a cone around `direction`.
///
/// The cone multiplies by `saturate((cos angle - cos outer) / max(cos inner - cos outer, 1e-4))^2`.
#[derive(Clone, Copy, Debug)]
pub struct SpotLight {
    /// The light without its cone.
    pub point: PointLight,
    /// Away from the light, length 1.
    pub direction: Vec3,
    /// Half angle in radians up to which the light is whole.
    pub inner_angle: f32,
    /// Half angle in radians beyond which nothing is lit.
    pub outer_angle: f32,
}

/// From far away, like the sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLight {
    /// Away from the light, length 1.
    pub direction: Vec3,
    /// Irradiance on a surface that faces the light, in lux.
    pub illuminance: Vec3,
    /// Angular diameter in radians; 0: sharp shadows.
    pub angular_diameter: f32,
}

/// A rectangle that emits from one side as a diffuse surface does.
#[derive(Clone, Copy, Debug)]
pub struct RectLight {
    /// Center, in meters.
    pub center: Vec3,
    /// From the center to the middle of one side.
    pub half_width: Vec3,
    /// From the center to the middle of the next side; light leaves along `half_width x half_height`.
    pub half_height: Vec3,
    /// Emitted radiance in cd/m2.
    pub radiance: Vec3,
    /// The light fades to zero here, by the window of [`PointLight::range`].
    pub range: f32,
}

impl LightSource {
    /// Intensity in cd of points and spots, illuminance in lx of directional lights, radiance in cd/m2 of rectangles.
    pub fn strength(&self) -> Vec3 {
        match self {
            Self::Point(light) => light.intensity,
            Self::Spot(light) => light.point.intensity,
            Self::Directional(light) => light.illuminance,
            Self::Rect(light) => light.radiance,
        }
    }

    /// The same light with this strength.
    pub fn with_strength(self, strength: Vec3) -> Self {
        match self {
            Self::Point(light) => Self::Point(PointLight { intensity: strength, ..light }),
            Self::Spot(light) => {
                Self::Spot(SpotLight { point: PointLight { intensity: strength, ..light.point }, ..light })
            }
            Self::Directional(light) => Self::Directional(DirectionalLight { illuminance: strength, ..light }),
            Self::Rect(light) => Self::Rect(RectLight { radiance: strength, ..light }),
        }
    }
}
