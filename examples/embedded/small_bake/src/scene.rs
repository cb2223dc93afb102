//! The quads of the Cornell box as a scene with coordinates of its own, so that nothing has to be unwrapped.

use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use glam::{Affine3A, Vec2, Vec3};
use program::r#box::{self, Fineness};
use radiosity::geometry::Mesh;
use radiosity::material::Material;
use radiosity::scene::{Receiver, Scene, Surface};

const UNCUT: Fineness = Fineness { wall: [1; 2], ceiling: [1; 2], lamp: [1; 2], sides: [[1; 2]; 2], top: [1; 2] };

/// In meters: no quad is farther across than 1 minus twice this, or leans out by more.
const MARGIN: f32 = 0.2;

/// Each quad is a surface with a material and a lightmap of its own.
pub fn scene() -> Scene {
    let mut scene = Scene::default();
    for (index, quad) in r#box::surfaces(&UNCUT).iter().enumerate() {
        scene.meshes.push(mesh(quad));
        scene.materials.push(Material {
            base_color: quad.reflectance.extend(1.0),
            emissive: quad.exitance,
            ..Material::default()
        });
        scene.surfaces.push(Surface {
            name: String::new(),
            mesh: index,
            material: index,
            transform: Affine3A::IDENTITY,
            receiver: Receiver::Lightmap { density: 1.0 },
            casts: true,
        });
    }
    scene
}

/// Two triangles; lightmap coordinates are meters along the first side and across it, none of them below 0 or above 1.
fn mesh(quad: &r#box::Surface) -> Mesh {
    let [origin, along, ..] = quad.corners;
    let u = (along - origin).normalize_or_zero();
    let v = normal(&quad.corners).cross(u);
    let place = |corner: &Vec3| Vec2::new((corner - origin).dot(u), (corner - origin).dot(v)) + MARGIN;
    let uv_1: Vec<Vec2> = quad.corners.iter().map(place).collect();
    Mesh { positions: quad.corners.to_vec(), uv_1, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Mesh::default() }
}

fn normal([a, b, c, d]: &[Vec3; 4]) -> Vec3 {
    (c - a).cross(d - b).normalize_or_zero()
}
