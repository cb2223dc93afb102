//! Texels inside geometry, on top of each other, and smaller than they should be: counted, never black nor NaN.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;
#[expect(dead_code, reason = "each test uses a part of the helpers")]
#[path = "common/sampling.rs"]
mod sampling;

use common::*;
use glam::Vec3;
use radiosity::bake::{Bake, Quality};
use radiosity::geometry::Mesh;
use radiosity::light::*;
use radiosity::lightmap::{NONE, TexelState};
use radiosity::scene::{Scene, cornell_box};
use sampling::*;

/// A room with a lamp under its ceiling.
fn lit_room() -> Scene {
    let mut scene = room([-2.0, 0.0, -2.0], [2.0, 2.0, 2.0], grey(0.5, 0.0));
    scene.lights.push(Light {
        name: "lamp".into(),
        source: LightSource::Point(PointLight {
            position: Vec3::new(0.1, 1.8, 0.2),
            intensity: Vec3::splat(100.0),
            range: f32::INFINITY,
            radius: 0.0,
        }),
    });
    scene
}

/// The darkest light of a surface by both kernels, after all have been found finite and not negative.
fn darkest(scene: &Scene, bake: &Bake, counts: impl Fn(&str, Vec3) -> bool) -> f32 {
    assert!(
        bake.images.iter().flat_map(|image| &image.texels).all(|texel| texel.is_finite() && texel.min_element() >= 0.0)
    );
    let all = samples(scene, bake, 200).filter(|sample| counts(&scene.surfaces[sample.surface].name, sample.position));
    all.flat_map(|sample| KERNELS.map(|kernel| kernel.sample(bake, &sample).min_element()))
        .fold(f32::INFINITY, f32::min)
}

/// A cube inside a solid block: all of it is invalid, named in a warning, and not black.
#[test]
fn enclosed() {
    let mut scene = lit_room();
    add_box(&mut scene, "solid", [-0.5, 0.2, -0.5], [0.5, 0.8, 0.5], 0, false);
    add_box(&mut scene, "hidden", [-0.2, 0.4, -0.2], [0.2, 0.6, 0.2], 0, false);
    for density in [4.0, 16.0] {
        let bake = baked(&scene, &settings(density, Quality::Draft));
        let hidden = darkest(&scene, &bake, |name, _| name.starts_with("hidden"));
        println!(
            "enclosed at {density}/m: {hidden}, {} invalid, {:?}",
            bake.report.invalid_texels, bake.report.warnings
        );
        assert!(hidden > 0.0, "{hidden}");
        assert!(bake.report.invalid_texels >= 6, "{}", bake.report.invalid_texels);
        assert!(
            bake.report.warnings.iter().any(|warning| warning.contains("\"hidden 0\"")),
            "{:?}",
            bake.report.warnings
        );
    }
}

/// A box sunk into the floor: what shows of it and of the floor is as bright as that of a box that stands on it.
#[test]
fn partly_enclosed() {
    let light = |sunk: f32| {
        let mut scene = lit_room();
        add_box(&mut scene, "box", [-0.53, -sunk, -0.47], [0.51, 0.5, 0.55], 0, false);
        let bake = baked(&scene, &settings(8.0, Quality::Medium));
        let visible =
            |name: &str, at: Vec3| (name.starts_with("box") && at.y > 0.0) || at.y == 0.0 && !name.starts_with("box");
        (darkest(&scene, &bake, visible), bake.report.invalid_texels)
    };
    let (standing, sunk) = (light(0.0), light(0.31));
    println!("standing {standing:?} sunk {sunk:?}");
    assert!(sunk.1 > standing.1);
    assert!((sunk.0 / standing.0 - 1.0).abs() < 0.15, "{} {}", sunk.0, standing.0);
}

/// Decals in the plane of a floor, one way up or both: they agree with the floor beside them.
#[test]
fn coplanar() {
    let square = |half: f32, y: f32| [[-half, y, half], [half, y, half], [half, y, -half], [-half, y, -half]];
    for height in [0.0, 1e-6, -1e-6] {
        let mut scene = lit_room();
        add_quad(&mut scene, "decal", square(0.7, height), 0);
        add_quad(&mut scene, "decal again", square(0.4, height), 0);
        let bake = baked(&scene, &settings(8.0, Quality::High));
        let plain = baked(&lit_room(), &settings(8.0, Quality::High));
        assert_eq!(bake.report.invalid_texels, 0);
        let worst =
            samples(&scene, &bake, 50).filter(|sample| scene.surfaces[sample.surface].name.starts_with("decal"));
        let worst = worst.map(|sample| {
            let expected = lookup(&lit_room(), &plain, sample.position.with_y(0.0), Vec3::Y).x;
            (Kernel::Bilinear.sample(&bake, &sample).x / expected - 1.0).abs()
        });
        let worst = worst.fold(0.0, f32::max);
        println!("decals at {height}: {worst}");
        // At the border of a decal light stays the same over the last half texel: 4.6 % of it, so near the lamp.
        assert!(worst < 0.05, "{worst} at {height}");
    }
}

/// Charts smaller than a texel, slivers, and triangles without area.
#[test]
fn tiny_charts() {
    let mut scene = lit_room();
    for (k, size) in [0.2_f32, 0.05, 0.01, 0.001].into_iter().enumerate() {
        let x = -1.5 + k as f32;
        let quad = [[x, 0.5, size], [x + size, 0.5, size], [x + size, 0.5, 0.0], [x, 0.5, 0.0]];
        add_quad(&mut scene, &format!("tiny {size}"), quad, 0);
        let quad = [[x, 0.7, 0.5], [x + 1.0, 0.7, 0.5], [x + 1.0, 0.7, 0.5 - 0.1 * size], [x, 0.7, 0.5 - 0.1 * size]];
        add_quad(&mut scene, &format!("sliver {size}"), quad, 0);
    }
    let flat = Mesh {
        name: "tiny with degenerate triangles".into(),
        positions: [[0.0, 0.3, 1.0], [0.2, 0.3, 1.0], [0.2, 0.3, 0.8], [0.1, 0.3, 1.0]].map(Vec3::from_array).to_vec(),
        triangles: vec![[0, 1, 2], [0, 1, 3], [2, 2, 1]],
        ..Default::default()
    };
    add_mesh(&mut scene, flat, 0);
    for density in [1.0, 4.0, 16.0] {
        let bake = baked(&scene, &settings(density, Quality::Draft));
        let is_small = |name: &str, _| name.starts_with("tiny") || name.starts_with("sliver");
        let darkest = darkest(&scene, &bake, is_small);
        println!("tiny at {density}/m: {darkest}");
        assert!(darkest > 1.0, "{darkest} at {density}/m");
    }
}

/// Both kernels take from texels of the own chart and from its gutter only; where no seam is mended over the gutter, what
/// they find lies within what the chart holds.
#[test]
fn kernels_stay_in_their_charts() {
    let mut furnished = lit_room();
    add_box(&mut furnished, "block", [-0.53, -0.02, -0.47], [0.51, 0.5, 0.55], 0, false);
    add_box(&mut furnished, "stick", [1.03, -0.02, -0.47], [1.05, 0.5, -0.45], 0, false);
    for (scene, density) in [(&cornell_box(), 30.0), (&furnished, 8.0), (&furnished, 2.0)] {
        let bake = baked(scene, &settings(density, Quality::Draft));
        let (mut worst, mut foreign) = (0.0_f32, 0);
        for sample in samples(scene, &bake, 300) {
            let image = &bake.images[sample.image];
            let own = image.charts[sample.at.y as usize * image.width as usize + sample.at.x as usize];
            if own == NONE {
                continue;
            }
            for kernel in KERNELS {
                let taps = kernel.taps(image, sample.at);
                let is_foreign = |&&(texel, weight): &&(usize, f32)| {
                    let state = image.states[texel];
                    weight > 1e-6
                        && (state == TexelState::Empty || (image.charts[texel] != own && state != TexelState::Gutter))
                };
                foreign += taps.iter().filter(is_foreign).count();
                let (low, high) = range(&bake, sample.image, own);
                let light = kernel.sample(&bake, &sample).x;
                worst = worst.max((low - light).max(light - high) / high.max(1e-6));
            }
        }
        println!("{density}/m: {foreign} taps of other charts, {worst} beyond the chart");
        let has_seams = scene.surfaces.len() < furnished.surfaces.len();
        assert!(foreign == 0 && (has_seams || worst < 1e-4), "{foreign} {worst}");
    }
}

/// The darkest and the brightest texel of a chart.
fn range(bake: &Bake, image: usize, chart: u32) -> (f32, f32) {
    let image = &bake.images[image];
    let own = image.texels.iter().zip(&image.charts).filter(|(_, other)| **other == chart);
    own.fold((f32::INFINITY, 0.0), |(low, high), (texel, _)| (f32::min(low, texel.x), f32::max(high, texel.x)))
}
