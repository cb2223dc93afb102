//! The measured Cornell box against irradiance that two independent path tracers agree on.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;

use common::*;
use core::f32::consts::PI;
use glam::Vec3;
use radiosity::bake::Quality;
use radiosity::scene::cornell_box;

type Published = (&'static str, [f32; 3], [f32; 3], [f32; 3]);

/// Name, position in millimeters, normal, and irradiance at 620, 548 and 452 nm for a lamp of radiance 1, known to
/// 0.1 %.
const POINTS: [Published; 11] = [
    ("floor a", [450.0, 0.0, 120.0], [0.0, 1.0, 0.0], [0.0438596, 0.0381398, 0.0372322]),
    ("floor b", [278.0, 0.0, 200.0], [0.0, 1.0, 0.0], [0.0609747, 0.0569603, 0.0567498]),
    ("floor c", [100.0, 0.0, 450.0], [0.0, 1.0, 0.0], [0.0478897, 0.0536277, 0.0463999]),
    ("floor e", [520.0, 0.0, 300.0], [0.0, 1.0, 0.0], [0.0103918, 0.0039191, 0.0037636]),
    ("ceiling", [100.0, 548.8, 100.0], [0.0, -1.0, 0.0], [0.0145253, 0.0171609, 0.0122014]),
    ("back a", [278.0, 274.0, 559.2], [0.0, 0.0, -1.0], [0.0616614, 0.0625555, 0.0577274]),
    ("back b", [100.0, 450.0, 559.2], [0.0, 0.0, -1.0], [0.0421307, 0.0461859, 0.0395015]),
    ("green a", [0.0, 274.0, 279.6], [1.0, 0.0, 0.0], [0.0664019, 0.0650433, 0.0625243]),
    ("green b", [0.0, 60.0, 150.0], [1.0, 0.0, 0.0], [0.0248051, 0.0281687, 0.0242207]),
    ("short top", [185.5, 165.0, 169.0], [0.0, 1.0, 0.0], [0.0827849, 0.0846623, 0.0798021]),
    ("red", [552.8, 182.933, 372.8], [-0.999_915_6, 0.011_660_82, -0.005_721_98], [0.027821, 0.021328, 0.0207936]),
];

#[test]
fn published_points_within_one_percent() {
    let scene = cornell_box();
    let lamp = scene.materials.iter().find(|material| material.is_emissive()).unwrap().emissive;
    let bake = baked(&scene, &settings(200.0, Quality::High));
    let mut worst = 0.0_f32;
    for (name, position, normal, expected) in POINTS {
        let got = lookup(&scene, &bake, Vec3::from_array(position) * 1e-3, Vec3::from_array(normal)) * PI / lamp;
        let error = (got / Vec3::from_array(expected) - 1.0).abs().max_element();
        println!("{name}: {:.2} %", 100.0 * error);
        worst = worst.max(error);
    }
    assert!(worst < 0.01, "{worst}");
}
