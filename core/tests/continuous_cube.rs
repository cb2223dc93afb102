//! The unit cube whose radiosity varies within its faces: the truth for a bake, from which six patches are 6 % away.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;

use common::*;
use glam::Vec3;
use radiosity::bake::{Bake, Quality};
use radiosity::lightmap::TexelState;
use radiosity::scene::Scene;

const REFLECTANCE: f32 = 0.5;

/// Name, position, normal and radiosity, for exitance 1 on the floor and reflectance 0.5 everywhere. By Galerkin and by
/// collocation on up to 80 x 80 cells a face, with exact form factors; both agree to 2e-5 of each value.
const POINTS: [(&str, [f32; 3], [f32; 3], f32); 9] = [
    ("floor, middle", [0.5, 0.0, 0.5], [0.0, 1.0, 0.0], 1.091_805_1),
    ("floor, halfway", [0.25, 0.0, 0.25], [0.0, 1.0, 0.0], 1.098_229_9),
    ("floor, near a wall", [0.05, 0.0, 0.5], [0.0, 1.0, 0.0], 1.112_644),
    ("ceiling, middle", [0.5, 1.0, 0.5], [0.0, -1.0, 0.0], 0.197_604_48),
    ("ceiling, halfway", [0.25, 1.0, 0.25], [0.0, -1.0, 0.0], 0.177_532_1),
    ("ceiling, near a wall", [0.05, 1.0, 0.5], [0.0, -1.0, 0.0], 0.164_907_1),
    ("wall, near the floor", [0.0, 0.05, 0.5], [1.0, 0.0, 0.0], 0.311_179_3),
    ("wall, halfway", [0.0, 0.25, 0.25], [1.0, 0.0, 0.0], 0.230_713_5),
    ("wall, near the ceiling", [0.0, 0.95, 0.5], [1.0, 0.0, 0.0], 0.118_107_6),
];

/// Mean radiosities of the ceiling and of a wall, from the same computations, extrapolated; they agree to 3e-6.
const CEILING: f32 = 0.171_216_08;
const WALL: f32 = 0.181_105_26;

/// Surface 0 is the floor, 1 the ceiling, the others are walls.
fn cube() -> Scene {
    let mut scene = room([0.0; 3], [1.0; 3], grey(REFLECTANCE, 0.0));
    scene.materials.push(grey(REFLECTANCE, 1.0));
    scene.surfaces[0].material = 1;
    scene
}

/// `b = e + rho E`, where a texel holds `E / pi` for exitance `pi`.
fn radiosity(texel: Vec3, surface: usize) -> f32 {
    texel.x * REFLECTANCE + if surface == 0 { 1.0 } else { 0.0 }
}

/// The mean of the texels of a surface.
fn mean(bake: &Bake, surface: usize) -> f32 {
    let placement = bake.placements[surface].unwrap();
    let image = &bake.images[placement.image];
    let size = glam::Vec2::new(image.width as f32, image.height as f32);
    let [low, high] = [placement.min * size, placement.max * size].map(|corner| corner.round().as_usizevec2());
    let pixels = (low.y..high.y).flat_map(|y| (low.x..high.x).map(move |x| y * image.width as usize + x));
    let valid = pixels.filter(|&pixel| image.states[pixel] == TexelState::Valid);
    let values: Vec<f32> = valid.map(|pixel| radiosity(image.texels[pixel], surface)).collect();
    values.iter().sum::<f32>() / values.len() as f32
}

/// Where the symmetry of the cube carries a point and its normal.
fn mirrored(point: Vec3, normal: Vec3) -> impl Iterator<Item = [Vec3; 2]> {
    let middle = Vec3::new(0.5, 0.0, 0.5);
    (0..8).map(move |k| {
        let mirror = |v: Vec3| {
            let sign = |bit: i32| if k & bit == 0 { 1.0 } else { -1.0 };
            let [x, z] = [v.x * sign(1), v.z * sign(2)];
            if k & 4 == 0 { Vec3::new(x, v.y, z) } else { Vec3::new(z, v.y, x) }
        };
        [mirror(point - middle) + middle, mirror(normal)]
    })
}

/// Means of faces within 0.1 %; single points, two texels and more from the edges, within 0.2 % in the root mean square,
/// and each within 0.3 % when its mirror images are averaged: the rest is the noise of the rays.
#[test]
fn a_bake_reaches_the_continuous_solution() {
    let scene = cube();
    let bake = baked(&scene, &settings(48.0, Quality::High));
    for (surface, expected) in [(1, CEILING), (2, WALL), (3, WALL), (4, WALL), (5, WALL)] {
        let error = mean(&bake, surface) / expected - 1.0;
        assert!(error.abs() < 1e-3, "surface {surface}: {error}");
    }
    let total: f32 = (0..6).map(|surface| mean(&bake, surface)).sum();
    assert!((total - 2.0).abs() < 1e-3, "the sum of the means is e / (1 - rho): {total}");

    let mut squares = 0.0;
    for (name, point, normal, expected) in POINTS {
        let surface = if point[1] == 0.0 { 0 } else { 1 };
        let at = |[point, normal]: [Vec3; 2]| radiosity(lookup(&scene, &bake, point, normal), surface);
        let errors: Vec<f32> = mirrored(Vec3::from_array(point), Vec3::from_array(normal))
            .map(|place| at(place) / expected - 1.0)
            .collect();
        let error = errors.iter().sum::<f32>() / 8.0;
        println!("{name}: {:.3} %", 100.0 * error);
        assert!(error.abs() < 3e-3, "{name}: {error}");
        squares += errors.iter().map(|error| error * error).sum::<f32>() / 8.0;
    }
    let rms = (squares / POINTS.len() as f32).sqrt();
    println!("{:.3} % rms", 100.0 * rms);
    assert!(rms < 2e-3, "{rms}");
}
