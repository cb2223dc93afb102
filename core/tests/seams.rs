//! Seams: texels of different charts and objects agree where they show the same place, and nothing else changes.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;

use common::*;
use glam::{Vec2, Vec3};
use radiosity::bake::{Bake, BakeSettings, Keep, Quality};
use radiosity::geometry::Mesh;
use radiosity::light::{Light, LightSource, PointLight};
use radiosity::scene::{Receiver, Scene};

fn add_lamp(scene: &mut Scene, position: [f32; 3]) {
    let point = PointLight {
        position: Vec3::from_array(position),
        intensity: Vec3::splat(50.0),
        range: f32::INFINITY,
        radius: 0.1,
    };
    scene.lights.push(Light { name: "lamp".into(), source: LightSource::Point(point) });
}

/// A room with a lamp and a pillar, without its floor.
fn hall() -> Scene {
    let mut scene = room([0.0; 3], [3.0, 2.5, 3.0], grey(0.6, 0.0));
    scene.surfaces.remove(0);
    scene
}

fn tiles(density: impl Fn(usize) -> f32) -> Scene {
    let mut scene = hall();
    for tile in 0..9 {
        let [x, z] = [(tile % 3) as f32, (tile / 3) as f32];
        let corners = [[x, 0.0, z], [x, 0.0, z + 1.0], [x + 1.0, 0.0, z + 1.0], [x + 1.0, 0.0, z]];
        let index = add_quad(&mut scene, "tile", corners, 0);
        scene.surfaces[index].receiver = Receiver::Lightmap { density: density(tile) };
    }
    add_lamp(&mut scene, [0.8, 1.9, 1.3]);
    scene
}

#[test]
fn tiles_of_different_density() {
    let scene = tiles(|tile| 1.0 + 0.37 * (tile % 4) as f32);
    let bake = baked(&scene, &settings(16.0, Quality::Draft));
    println!("{:?}", bake.report.seams);
    panic!();
}
