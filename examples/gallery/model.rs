//! A scene in the making.

use bevy::math::{Affine3A, Vec3, Vec4};
use radiosity::geometry::Mesh;
use radiosity::light::{DirectionalLight, Light, LightSource, PointLight};
use radiosity::material::Material;
use radiosity::render::Camera;
use radiosity::scene::{Receiver, Scene, Surface};

use crate::shape::Shape;

/// One of the scenes of the gallery.
pub struct Exhibit {
    /// The name of its files.
    pub name: &'static str,
    /// What is baked.
    pub scene: Scene,
    /// From where it is seen.
    pub camera: Camera,
    /// Width of the picture over its height.
    pub aspect: f32,
    /// The exposure of the picture.
    pub ev100: f32,
    /// Density of the lightmaps, in texels per meter.
    pub density: f32,
}

/// A material of a model.
#[derive(Clone, Copy, Debug)]
pub struct Paint(usize);

/// A scene in the making.
#[derive(Default)]
pub struct Model {
    /// What there is already.
    pub scene: Scene,
}

impl Model {
    /// A matt color; reflectance per linear RGB channel.
    pub fn paint(&mut self, name: &str, reflectance: [f32; 3]) -> Paint {
        self.material(Material {
            name: name.into(),
            base_color: Vec3::from(reflectance).extend(1.0),
            ..Default::default()
        })
    }

    /// Something that shines and reflects nothing; radiance in cd/m2.
    pub fn glow(&mut self, name: &str, radiance: [f32; 3]) -> Paint {
        let base_color = Vec4::new(0.0, 0.0, 0.0, 1.0);
        self.material(Material { name: name.into(), base_color, emissive: radiance.into(), ..Default::default() })
    }

    fn material(&mut self, material: Material) -> Paint {
        self.scene.materials.push(material);
        Paint(self.scene.materials.len() - 1)
    }

    /// Adds a shape as a surface of its own.
    pub fn add(&mut self, name: &str, paint: Paint, shape: Shape) {
        self.add_all(name, paint, shape, &[Affine3A::IDENTITY]);
    }

    /// Adds a shape at several places.
    pub fn add_all(&mut self, name: &str, Paint(material): Paint, shape: Shape, places: &[Affine3A]) {
        let Shape { positions, normals, triangles } = shape;
        let mesh = self.scene.meshes.len();
        self.scene.meshes.push(Mesh { name: name.into(), positions, normals, triangles, ..Default::default() });
        for (number, &transform) in places.iter().enumerate() {
            self.scene.surfaces.push(Surface {
                name: if places.len() == 1 { name.into() } else { format!("{name} {}", number + 1) },
                mesh,
                material,
                transform,
                receiver: Receiver::Lightmap { density: 1.0 },
                casts: true,
            });
        }
    }

    /// Adds a point light; intensity in cd.
    pub fn point_light(&mut self, name: &str, position: impl Into<Vec3>, intensity: [f32; 3]) {
        let (position, intensity) = (position.into(), intensity.into());
        let source = LightSource::Point(PointLight { position, intensity, range: 1000.0, radius: 0.0 });
        self.scene.lights.push(Light { name: name.into(), source });
    }

    /// Adds a sun whose light goes along `direction`; illuminance in lx.
    pub fn sun(&mut self, direction: Vec3, illuminance: [f32; 3]) {
        let (direction, illuminance) = (direction.normalize(), illuminance.into());
        let angular_diameter = 0.53_f32.to_radians();
        let source = LightSource::Directional(DirectionalLight { direction, illuminance, angular_diameter });
        self.scene.lights.push(Light { name: "sun".into(), source });
    }

    /// The finished scene in a wide picture.
    pub fn seen_by(self, name: &'static str, camera: Camera, ev100: f32, density: f32) -> Exhibit {
        Exhibit { name, scene: self.scene, camera, aspect: 16.0 / 9.0, ev100, density }
    }
}

/// Looks from `eye` at `target`; the picture is `fov_y` degrees high.
pub fn camera(eye: Vec3, target: Vec3, fov_y: f32) -> Camera {
    Camera::looking_at(eye, target, fov_y.to_radians())
}
