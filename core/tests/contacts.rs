//! Light at contacts, edges and terminators against closed forms.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;
#[expect(dead_code, reason = "each test uses a part of the helpers")]
#[path = "common/sampling.rs"]
mod sampling;

use common::*;
use core::f32::consts::PI;
use glam::Vec3;
use radiosity::bake::{Bake, Quality};
use radiosity::form_factor::point_to_triangle;
use radiosity::geometry::Mesh;
use radiosity::light::*;
use radiosity::scene::Scene;
use sampling::*;

/// A box between two corners.
type Block = [[f32; 3]; 2];

/// A black floor with black boxes on it under a sky of radiance 1.
fn blocks_on_a_floor(blocks: &[Block]) -> Scene {
    let mut scene = Scene { materials: vec![grey(0.0, 0.0)], sky: Vec3::ONE, ..Default::default() };
    add_quad(&mut scene, "floor", [[-2.0, 0.0, 2.0], [2.0, 0.0, 2.0], [2.0, 0.0, -2.0], [-2.0, 0.0, -2.0]], 0);
    for [low, high] in blocks {
        add_box(&mut scene, "box", *low, *high, 0, false);
    }
    scene
}

/// Irradiance / pi at a point of the floor: the share of the sky that the boxes leave. Exact where no box hides another.
fn sky_seen(blocks: &[Block], point: Vec3) -> f32 {
    let mut hidden = 0.0;
    for [low, high] in blocks {
        let mut alone = Scene::default();
        add_box(&mut alone, "box", *low, *high, 0, false);
        for mesh in &alone.meshes {
            for triangle in &mesh.triangles {
                let corners = triangle.map(|vertex| mesh.positions[vertex as usize].max(Vec3::new(-9.0, 0.0, -9.0)));
                let [a, b, c] = corners;
                if (point - a).dot((b - a).cross(c - a)) > 0.0 {
                    hidden += point_to_triangle(point, Vec3::Y, &corners);
                }
            }
        }
    }
    1.0 - hidden
}

/// What is wrong at points of the floor that lie so many texels from the nearest box: root mean square, mean, largest.
fn errors(scene: &Scene, bake: &Bake, blocks: &[Block], texels: core::ops::Range<f32>) -> [f32; 3] {
    let density = bake.report.texels_per_meter;
    let (mut sum, mut squares, mut largest, mut count) = (0.0, 0.0, 0.0_f32, 0.0);
    for sample in samples(scene, bake, 16_384) {
        let at = sample.position;
        let distance = |[low, high]: &Block| {
            let nearest = at.clamp(Vec3::from_array(*low), Vec3::from_array(*high));
            nearest.with_y(0.0).distance(at) * density
        };
        let nearest = blocks.iter().map(distance).fold(f32::INFINITY, f32::min);
        if scene.surfaces[sample.surface].name != "floor" || nearest <= 1e-3 || !texels.contains(&nearest) {
            continue;
        }
        let error = Kernel::Bilinear.sample(bake, &sample).x - sky_seen(blocks, at);
        (sum, squares, count) = (sum + error, squares + error * error, count + 1.0);
        largest = largest.max(error.abs());
    }
    [(squares / count).sqrt(), sum / count, largest]
}

/// Distances from a foot in texels.
const RANGES: [core::ops::Range<f32>; 4] = [0.0..0.5, 0.5..1.0, 1.0..2.0, 4.0..5.0];

/// Root mean square errors at these distances stay below these, the sky being 1.
fn check(blocks: &[Block], density: f32, most: [f32; 4]) {
    let scene = blocks_on_a_floor(blocks);
    let bake = baked(&scene, &settings(density, Quality::High));
    for (range, most) in RANGES.into_iter().zip(most) {
        let [rms, mean, largest] = errors(&scene, &bake, blocks, range.clone());
        println!("{:?}, {range:?} texels away: rms {rms:.4} mean {mean:+.4} largest {largest:.4}", blocks[0]);
        assert!(rms < most, "{rms} at {range:?} texels from {:?}", blocks[0]);
    }
}

/// Wherever a box stands in the grid of texels, the floor at its foot is neither too dark nor too bright.
#[test]
fn foot_of_a_box() {
    for (phase, sunk) in [(0.0, 0.0), (0.02, 0.0), (0.04, 0.05), (0.0625, 0.0), (0.08, 0.01), (0.11, 0.0)] {
        let block = [[-0.4 + phase, -sunk, -0.4 + phase], [0.5 + phase, 0.5, 0.5 + 0.5 * phase]];
        check(&[block], 8.0, [0.055, 0.015, 0.009, 0.007]);
    }
}

/// Legs of 2 cm under texels of 5 cm, over the middles of texels and, where no texel can hold their shadow, between.
#[test]
fn thin_legs() {
    let between = [0.19, 0.065, 0.032, 0.004];
    let over_the_middle = [0.19, 0.025, 0.018, 0.004];
    for (phase, most) in [(0.0, between), (0.012, over_the_middle), (0.024, over_the_middle), (0.031, between)] {
        let leg = |x: f32, z: f32| [[x + phase, 0.0, z + phase], [x + phase + 0.02, 0.5, z + phase + 0.02]];
        check(&[leg(-0.5, -0.5), leg(0.5, -0.5), leg(-0.5, 0.5), leg(0.5, 0.5)], 20.0, most);
    }
}

/// A sphere of radius 1 with smooth normals, in flat triangles.
fn sphere(segments: usize, rings: usize) -> Mesh {
    let mut mesh = Mesh { name: "sphere".into(), ..Default::default() };
    for ring in 0..=rings {
        for segment in 0..=segments {
            let (polar, around) = (PI * ring as f32 / rings as f32, 2.0 * PI * segment as f32 / segments as f32);
            let normal = Vec3::new(polar.sin() * around.cos(), polar.cos(), polar.sin() * around.sin());
            mesh.positions.push(normal);
            mesh.normals.push(normal);
        }
    }
    let at = |ring: usize, segment: usize| (ring * (segments + 1) + segment) as u32;
    for (ring, segment) in (0..rings).flat_map(|ring| (0..segments).map(move |segment| (ring, segment))) {
        let [a, b, c, d] = [at(ring, segment), at(ring, segment + 1), at(ring + 1, segment + 1), at(ring + 1, segment)];
        if ring > 0 {
            mesh.triangles.push([a, b, c]);
        }
        if ring + 1 < rings {
            mesh.triangles.push([a, c, d]);
        }
    }
    mesh
}

/// Coarse spheres with smooth normals are lit like smooth spheres, without facets at the terminator.
#[test]
fn terminator() {
    let sun = LightSource::Directional(DirectionalLight {
        direction: Vec3::new(-0.8, -0.36, -0.48),
        illuminance: Vec3::splat(PI),
        angular_diameter: 0.0,
    });
    let point = LightSource::Point(PointLight {
        position: Vec3::new(2.4, 1.08, 1.44),
        intensity: Vec3::splat(4.0 * PI),
        range: f32::INFINITY,
        radius: 0.0,
    });
    for (segments, rings) in [(16, 8), (32, 16)] {
        for source in [sun, point] {
            let mut scene = Scene { materials: vec![grey(0.0, 0.0)], ..Default::default() };
            add_mesh(&mut scene, sphere(segments, rings), 0);
            scene.lights.push(Light { name: "light".into(), source });
            let bake = baked(&scene, &settings(32.0, Quality::Medium));
            let (mut largest, mut squares, mut count) = (0.0_f32, 0.0, 0.0);
            for sample in samples(&scene, &bake, 64) {
                let normal = sample.position.normalize();
                let expected = match source {
                    LightSource::Point(light) => {
                        let way = light.position - normal;
                        4.0 * way.normalize().dot(normal).max(0.0) / way.length_squared()
                    }
                    _ => normal.dot(Vec3::new(0.8, 0.36, 0.48)).max(0.0),
                };
                let error = Kernel::Bilinear.sample(&bake, &sample).x - expected;
                largest = largest.max(error.abs());
                (squares, count) = (squares + error * error, count + 1.0);
            }
            let rms: f32 = f32::sqrt(squares / count);
            println!("{segments} x {rings}: rms {rms:.4} largest {largest:.4}");
            // The light at full sun is 1.
            assert!(rms < 0.08 / segments as f32 && largest < 0.6 / segments as f32, "{rms} {largest}");
        }
    }
}
