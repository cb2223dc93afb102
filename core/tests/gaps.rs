//! Light in a gap narrower than the patches that line it, against the integral equation of a slot.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;

use common::*;
use glam::Vec3;
use radiosity::bake::{BakeSettings, Keep, Quality};
use radiosity::progress::Progress;
use radiosity::scene::Scene;
use radiosity::transport::Relighter;

const REFLECTANCE: f32 = 0.8;
/// Between the walls.
const WIDTH: f32 = 0.05;
const DEPTH: f32 = 0.5;
/// Half of it; far more than the width, as if the slot had no ends.
const LENGTH: f32 = 32.0;

/// Two walls that face each other, black outside, under a sky of 1; a black floor closes the slot below.
fn slot() -> Scene {
    let mut scene =
        Scene { materials: vec![grey(REFLECTANCE, 0.0), grey(0.0, 0.0)], sky: Vec3::ONE, ..Default::default() };
    let [low, high, half] = [-DEPTH, 0.0, 0.5 * WIDTH];
    add_quad(
        &mut scene,
        "left",
        [[-half, low, LENGTH], [-half, low, -LENGTH], [-half, high, -LENGTH], [-half, high, LENGTH]],
        0,
    );
    add_quad(
        &mut scene,
        "right",
        [[half, low, -LENGTH], [half, low, LENGTH], [half, high, LENGTH], [half, high, -LENGTH]],
        0,
    );
    add_quad(
        &mut scene,
        "floor",
        [[-half, low, LENGTH], [half, low, LENGTH], [half, low, -LENGTH], [-half, low, -LENGTH]],
        1,
    );
    for (name, end) in [("back", -LENGTH), ("front", LENGTH)] {
        let corners = [[-half, low, end], [half, low, end], [half, high, end], [-half, high, end]];
        add_quad(&mut scene, name, corners, 1);
    }
    scene
}

/// Irradiance / pi at some depths of a long slot: `H(z) = S(z) + rho integral K(z, z') H(z') dz'`, with the share of the
/// sky `S = (1 - z / sqrt(z^2 + w^2)) / 2` and `K = w^2 / 2 / (w^2 + (z - z')^2)^(3/2)` between parallel strips (Howell,
/// "A Catalog of Radiation Heat Transfer Configuration Factors", factors B-4 and C-1 without ends); the floor is black.
fn irradiance() -> impl Fn(f32) -> f32 {
    const STRIPS: usize = 1000;
    let (width, step) = (f64::from(WIDTH), f64::from(DEPTH) / STRIPS as f64);
    let depth = |strip: usize| (strip as f64 + 0.5) * step;
    // The share of an interval, exact: K is the derivative of t / sqrt(t^2 + w^2) / 2.
    let share = |from: f64, to: f64| 0.5 * (to / to.hypot(width) - from / from.hypot(width));
    let sky: Vec<f64> = (0..STRIPS).map(|strip| 0.5 * (1.0 - depth(strip) / depth(strip).hypot(width))).collect();
    let kernel: Vec<f64> =
        (0..STRIPS).map(|apart| share((apart as f64 - 0.5) * step, (apart as f64 + 0.5) * step)).collect();
    let mut light = sky.clone();
    for _ in 0..60 {
        let of = |strip: usize| {
            let seen: f64 = (0..STRIPS).map(|other| kernel[strip.abs_diff(other)] * light[other]).sum();
            sky[strip] + f64::from(REFLECTANCE) * seen
        };
        light = (0..STRIPS).map(of).collect();
    }
    move |z| light[((f64::from(z) / step) as usize).min(STRIPS - 1)] as f32
}

/// A slot whose patches are three times as wide as it is: its light is that of the equation all the way down, to a part of
/// what enters, whether it is baked, or kept and lit again.
#[test]
fn light_in_a_slot() {
    let (scene, exact) = (slot(), irradiance());
    for keep in [Keep::Lightmaps, Keep::Transport] {
        let settings = BakeSettings { keep, ..settings(32.0, Quality::Draft) };
        let mut bake = baked(&scene, &settings);
        if let Some(transport) = &bake.transport {
            let relit = Relighter::new(transport, 0).relight(&transport.lighting, &Progress::default()).unwrap();
            for (image, texels) in bake.images.iter_mut().zip(relit.images) {
                image.texels = texels;
            }
        }
        for row in 1..14 {
            // The middles of texels.
            let z = (row as f32 + 0.5) / 32.0;
            let light = |k: i32| {
                let at = Vec3::new(-0.5 * WIDTH, -z, k as f32 / 32.0 - 0.5);
                lookup(&scene, &bake, at, Vec3::X).x
            };
            let (found, exact) = ((0..32).map(light).sum::<f32>() / 32.0, exact(z));
            println!("{keep:?} at {z:.3}: {found:.5}, exact {exact:.5}");
            assert!((found - exact).abs() < 0.08 * exact + 0.002, "{found} instead of {exact} at {z}");
        }
    }
}
