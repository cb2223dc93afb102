//! The Cornell box as it was measured, the oldest scene with a photograph to compare with.
//!
//! Positions and reflectances are those of the "Cornell Box Data" that Cornell University publishes. The
//! spectra are read at 620, 548 and 452 nm, which stand for red, green and blue. The front is open.

use alloc::vec;
use alloc::vec::Vec;

use glam::{Affine3A, Vec3, Vec3A};

use super::{Receiver, Scene, Surface};
use crate::geometry::Mesh;
use crate::material::Material;
use crate::spectrum::{Bands, CORNELL_GREEN, CORNELL_RED, CORNELL_WHITE, cornell_band};

/// Radiance of the lamp in cd/m2, the same in all three bands: the picture is balanced for its light, as the photograph
/// of the box was. The lamp gives about 500 lm, as a 40 W bulb does, and the middle of the floor gets about 700 lx, as
/// a well-lit desk does.
const LAMP_RADIANCE: f32 = 11_500.0;

/// What the lamp reflects, at all wavelengths.
const LAMP: Bands<76> = Bands([0.78; 76]);

/// Vertical field of view of the camera in radians: a film of 25 mm behind a lens of 35 mm, `2 atan(12.5 / 35)`.
const FOV_Y: f32 = 0.68604788;

/// Height of the ceiling in millimeters.
const CEILING: f32 = 548.8;

/// The box of 0.55 m with its two blocks, lit by a lamp of 130 mm x 105 mm in the ceiling.
///
/// Seen from the camera `x` points to the left, `y` up and `z` away; the origin lies on the floor, in front, at the
/// green wall.
///
/// Each wall and each block is a surface of its own. All fronts look into the room.
pub fn cornell_box() -> Scene {
    let emissive = Vec3::splat(LAMP_RADIANCE);
    let mut scene = Scene {
        materials: vec![
            paint("white", CORNELL_WHITE),
            paint("red", CORNELL_RED),
            paint("green", CORNELL_GREEN),
            Material { emissive, ..paint("lamp", LAMP) },
        ],
        ..Default::default()
    };
    for (mesh, material) in [
        (fan("floor", [[552.8, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 559.2], [549.6, 0.0, 559.2]]), 0),
        (ceiling(), 0),
        (fan("back", [[549.6, 0.0, 559.2], [0.0, 0.0, 559.2], [0.0, CEILING, 559.2], [556.0, CEILING, 559.2]]), 0),
        (fan("green", [[0.0, 0.0, 559.2], [0.0, 0.0, 0.0], [0.0, CEILING, 0.0], [0.0, CEILING, 559.2]]), 2),
        // This wall is not plane; its diagonal runs from its first vertex.
        (fan("red", [[552.8, 0.0, 0.0], [549.6, 0.0, 559.2], [556.0, CEILING, 559.2], [556.0, CEILING, 0.0]]), 1),
        (fan("light", lamp_outline()), 3),
        (block("short_block", 165.0, [[130.0, 65.0], [82.0, 225.0], [240.0, 272.0], [290.0, 114.0]]), 0),
        (block("tall_block", 330.0, [[423.0, 247.0], [265.0, 296.0], [314.0, 456.0], [472.0, 406.0]]), 0),
    ] {
        add(&mut scene, mesh, material);
    }
    scene
}

/// From the camera of the photograph to the world, and its vertical field of view in radians.
///
/// The camera looks along its `-z`, with `y` up; the picture is square.
pub fn cornell_camera() -> (Affine3A, f32) {
    let position = Vec3A::new(0.278, 0.273, -0.8);
    (Affine3A::from_cols(Vec3A::NEG_X, Vec3A::Y, Vec3A::NEG_Z, position), FOV_Y)
}

fn paint(name: &str, reflectance: Bands<76>) -> Material {
    let [red, green, blue] = [620.0, 548.0, 452.0].map(|wavelength| reflectance.0[cornell_band(wavelength)]);
    Material { name: name.into(), base_color: Vec3::new(red, green, blue).extend(1.0), ..Default::default() }
}

fn add(scene: &mut Scene, mesh: Mesh, material: usize) {
    scene.surfaces.push(Surface {
        name: mesh.name.clone(),
        mesh: scene.meshes.len(),
        material,
        transform: Affine3A::IDENTITY,
        receiver: Receiver::Lightmap { density: 1.0 },
        casts: true,
    });
    scene.meshes.push(mesh);
}

/// A quadrilateral cut from its first vertex; millimeters.
fn fan(name: &str, corners: [[f32; 3]; 4]) -> Mesh {
    mesh(name, &corners, vec![[0, 1, 2], [0, 2, 3]])
}

/// Four trapezoids around the lamp.
fn ceiling() -> Mesh {
    let outline = [[556.0, CEILING, 0.0], [556.0, CEILING, 559.2], [0.0, CEILING, 559.2], [0.0, CEILING, 0.0]];
    let ring = [outline, lamp_outline()].concat();
    let triangles = (0..4).flat_map(|i| {
        let j = (i + 1) % 4;
        [[i, j, j + 4], [i, j + 4, i + 4]]
    });
    mesh("ceiling", &ring, triangles.collect())
}

fn lamp_outline() -> [[f32; 3]; 4] {
    [[343.0, CEILING, 227.0], [343.0, CEILING, 332.0], [213.0, CEILING, 332.0], [213.0, CEILING, 227.0]]
}

/// The top and the four sides of a block that stands on the floor; corners in `x` and `z`.
fn block(name: &str, height: f32, corners: [[f32; 2]; 4]) -> Mesh {
    let at = |i: usize, y| [corners[i % 4][0], y, corners[i % 4][1]];
    let top = [at(0, height), at(1, height), at(2, height), at(3, height)];
    let sides = (0..4).map(|i| [at(i, 0.0), at(i + 1, 0.0), at(i + 1, height), at(i, height)]);
    let faces: Vec<_> = core::iter::once(top).chain(sides).collect();
    let triangles = (0..5).map(|face| 4 * face).flat_map(|i| [[i, i + 1, i + 2], [i, i + 2, i + 3]]);
    mesh(name, faces.as_flattened(), triangles.collect())
}

fn mesh(name: &str, millimeters: &[[f32; 3]], triangles: Vec<[u32; 3]>) -> Mesh {
    let positions = millimeters.iter().map(|&corner| Vec3::from(corner) / 1000.0).collect();
    Mesh { name: name.into(), positions, triangles, ..Default::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners(mesh: &Mesh) -> impl Iterator<Item = [Vec3; 3]> {
        mesh.triangles.iter().map(|triangle| triangle.map(|i| mesh.positions[i as usize]))
    }

    /// Twice the area, along the normal.
    fn cross([a, b, c]: [Vec3; 3]) -> Vec3 {
        (b - a).cross(c - a)
    }

    fn area(scene: &Scene, name: &str) -> f32 {
        let mesh = scene.meshes.iter().find(|mesh| mesh.name == name).unwrap();
        corners(mesh).map(|triangle| cross(triangle).length() / 2.0).sum()
    }

    /// The published outlines give these areas in square meters.
    #[test]
    fn areas_are_those_of_the_published_outlines() {
        let scene = cornell_box();
        for (name, expected) in [
            ("light", 0.130 * 0.105),
            ("floor", 0.5592 * (0.5528 + 0.5496) / 2.0),
            ("ceiling", 0.5560 * 0.5592 - 0.130 * 0.105),
            ("green", 0.5488 * 0.5592),
            ("back", 0.5488 * (0.5496 + 0.5560) / 2.0),
        ] {
            let area = area(&scene, name);
            assert!((area - expected).abs() < 1e-6, "{name}: {area} instead of {expected}");
        }
    }

    /// Walls look at the middle of the room, blocks away from their own middle.
    #[test]
    fn fronts_look_into_the_room() {
        for mesh in cornell_box().meshes {
            let middle = mesh.positions.iter().sum::<Vec3>() / mesh.positions.len() as f32;
            let is_block = mesh.name.ends_with("block");
            for triangle in corners(&mesh) {
                let outwards = if is_block { triangle[0] - middle } else { Vec3::splat(0.275) - triangle[0] };
                assert!(cross(triangle).dot(outwards) > 0.0, "{} {triangle:?}", mesh.name);
            }
        }
    }

    /// Every edge is met by one other edge that runs against it, but for the open front and the feet of the blocks.
    #[test]
    fn surfaces_join_without_gaps() {
        let scene = cornell_box();
        let edges: Vec<[Vec3; 2]> = scene
            .meshes
            .iter()
            .flat_map(corners)
            .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]])
            .filter(|edge| !edge.iter().all(|end| end.z == 0.0))
            .filter(|&[a, b]| !is_foot(a, b))
            .collect();
        for &[a, b] in &edges {
            let partners = edges.iter().filter(|&&edge| edge == [b, a]).count();
            assert_eq!(partners, 1, "from {a} to {b}");
        }
    }

    /// On the floor, and not on its outline.
    fn is_foot(a: Vec3, b: Vec3) -> bool {
        let inside = |p: Vec3| p.y == 0.0 && p.x > 0.0 && p.x < 0.5 && p.z > 0.0 && p.z < 0.5;
        inside(a) && inside(b)
    }

    /// Published: 39.3077 degrees; the middle of the picture looks along `+z`, and red is on the left.
    #[test]
    fn the_camera_looks_into_the_open_front() {
        let (camera, fov_y) = cornell_camera();
        assert!((fov_y.to_degrees() - 39.3077).abs() < 1e-4);
        assert_eq!(camera.transform_vector3(Vec3::NEG_Z), Vec3::Z);
        assert_eq!(camera.transform_vector3(Vec3::NEG_X), Vec3::X);
        assert!((camera.matrix3.determinant() - 1.0).abs() < 1e-6);
    }
}
