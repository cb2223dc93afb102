//! Lamps that are seen in plane mirrors: they shine as their images behind the mirror do, through it.

use glam::Vec3;

use super::{DirectLight, DirectionalLight, PointLight, SpotLight};

/// A plane of which parts are a mirror, seen from the side to which its normal points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneMirror {
    /// Of length 1, on the side that reflects.
    pub normal: Vec3,
    /// The normal times any point of the plane, in meters.
    pub offset: f32,
    /// The lowest corner of the box around the mirror.
    pub low: Vec3,
    /// The highest corner of it.
    pub high: Vec3,
    /// Tells its triangles from those of other planes; the back of a mirror has the number of its front.
    pub number: u32,
}

impl PlaneMirror {
    /// The image of a point.
    pub fn image(&self, point: Vec3) -> Vec3 {
        point - self.normal * (2.0 * self.height(point))
    }

    /// A direction as the mirror shows it.
    pub fn image_of_direction(&self, direction: Vec3) -> Vec3 {
        direction - self.normal * (2.0 * direction.dot(self.normal))
    }

    /// How far in front of the plane a point is, in meters; negative behind it.
    pub fn height(&self, point: Vec3) -> f32 {
        point.dot(self.normal) - self.offset
    }

    /// The image of a lamp, unless the lamp is behind the mirror.
    pub fn image_of(&self, light: &DirectLight) -> Option<DirectLight> {
        match light {
            DirectLight::Point(light) => self.image_of_point(light).map(DirectLight::Point),
            DirectLight::Spot(light) => {
                let point = self.image_of_point(&light.point)?;
                Some(DirectLight::Spot(SpotLight {
                    point,
                    direction: self.image_of_direction(light.direction),
                    ..*light
                }))
            }
            DirectLight::Directional(light) => (light.direction.dot(self.normal) < 0.0).then(|| {
                DirectLight::Directional(DirectionalLight {
                    direction: self.image_of_direction(light.direction),
                    ..*light
                })
            }),
            DirectLight::Area(light) => {
                Some(light.image(self)).filter(|light| !light.is_empty()).map(DirectLight::Area)
            }
        }
    }

    fn image_of_point(&self, light: &PointLight) -> Option<PointLight> {
        let is_before = self.height(light.position) > -light.radius;
        is_before.then(|| PointLight { position: self.image(light.position), ..*light })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{LightSource, RectLight};

    /// The image of a lamp gives a place what the lamp gives the image of the place.
    #[test]
    fn images_of_lamps_shine_on_images_of_places() {
        let normal = Vec3::new(0.48, 0.6, 0.64);
        let mirror = PlaneMirror { normal, offset: -1.5, low: Vec3::ZERO, high: Vec3::ONE, number: 0 };
        let point = PointLight { position: Vec3::new(0.5, 2.0, 1.0), intensity: Vec3::ONE, range: 20.0, radius: 0.1 };
        let down = Vec3::new(-0.6, -0.8, 0.0);
        let lights = [
            LightSource::Point(point),
            LightSource::Spot(SpotLight { point, direction: down, inner_angle: 0.2, outer_angle: 1.2 }),
            LightSource::Directional(DirectionalLight {
                direction: down,
                illuminance: Vec3::ONE,
                angular_diameter: 0.0,
            }),
            LightSource::Rect(RectLight {
                center: Vec3::new(0.3, 2.0, -0.2),
                half_width: Vec3::X,
                half_height: Vec3::Z * 0.5,
                radiance: Vec3::ONE,
                range: 9.0,
            }),
        ];
        for light in lights {
            let light = DirectLight::from(&light);
            let image = mirror.image_of(&light).unwrap();
            for (place, facing) in [(Vec3::new(0.2, 0.1, 0.3), Vec3::Y), (Vec3::ZERO, Vec3::new(0.6, 0.8, 0.0))] {
                let expected = light.irradiance(place, facing);
                let got = image.irradiance(mirror.image(place), mirror.image_of_direction(facing));
                assert!(expected.x > 0.0 && got.abs_diff_eq(expected, 1e-5), "{got} {expected}");
            }
        }
    }

    #[test]
    fn lamps_behind_a_mirror_have_no_image() {
        let mirror = PlaneMirror { normal: Vec3::Y, offset: 3.0, low: Vec3::ZERO, high: Vec3::ONE, number: 0 };
        let point = PointLight { position: Vec3::Y, intensity: Vec3::ONE, range: 20.0, radius: 0.1 };
        assert!(mirror.image_of(&DirectLight::Point(point)).is_none());
        let sun = DirectionalLight { direction: Vec3::Y, illuminance: Vec3::ONE, angular_diameter: 0.0 };
        assert!(mirror.image_of(&DirectLight::Directional(sun)).is_none());
    }
}
