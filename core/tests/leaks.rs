//! Light where none belongs: a dark room beside a bright one, a closed house in the sun.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;
#[path = "common/sampling.rs"]
mod sampling;

use common::*;
use glam::Vec3;
use radiosity::bake::{Bake, Quality};
use radiosity::light::*;
use radiosity::scene::Scene;
use sampling::*;

/// What stands between the two rooms.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Wall {
    /// A double-sided quad without thickness; its lightmap faces the dark room.
    Sheet,
    /// Two one-sided quads at the same place.
    BackToBack,
    /// Two solid walls of these thicknesses with this gap between them, or overlap where it is negative.
    Solid { thickness: f32, gap: f32 },
}

/// Whether floor, ceiling and the long walls are quads that run through both rooms.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Shell {
    Through,
    OfEachRoom,
}

#[derive(Clone, Copy, Debug)]
enum Source {
    /// At this distance from the wall.
    Point(f32),
    Rect,
    Emissive,
}

const HEIGHT: f32 = 2.5;
const WIDTH: f32 = 4.0;
const LENGTH: f32 = 8.0;
/// So many texels before a wall are as dark as those behind it.
const CLEARED: f32 = 1.0;
/// Light in the dark room over the mean of the bright one.
const LARGEST_LEAK: f32 = 1e-3;

impl Wall {
    /// Where the bright room ends, and where the dark one starts, with the wall at `x`.
    fn span(self, x: f32) -> [f32; 2] {
        match self {
            Self::Sheet | Self::BackToBack => [x, x],
            Self::Solid { thickness, gap } => [x - thickness, x + gap + thickness],
        }
    }

    /// Adds the wall; it reaches so far into floor, ceiling and side walls.
    fn add(self, scene: &mut Scene, x: f32, sunk: f32) {
        let (low, high) = ([-sunk, -sunk], [HEIGHT + sunk, WIDTH + sunk]);
        let quad = |x: f32| [[x, low[0], low[1]], [x, low[0], high[1]], [x, high[0], high[1]], [x, high[0], low[1]]];
        let reversed = |mut corners: [[f32; 3]; 4]| {
            corners.reverse();
            corners
        };
        match self {
            Self::Sheet => {
                let material = scene.materials.len();
                scene.materials.push(radiosity::material::Material { double_sided: true, ..grey(0.7, 0.0) });
                add_quad(scene, "sheet", reversed(quad(x)), material);
            }
            Self::BackToBack => {
                add_quad(scene, "wall of the bright room", quad(x), 0);
                add_quad(scene, "wall of the dark room", reversed(quad(x)), 0);
            }
            Self::Solid { thickness, .. } => {
                let [start, end] = self.span(x);
                add_box(scene, "bright wall", [start, low[0], low[1]], [start + thickness, high[0], high[1]], 0, false);
                add_box(scene, "dark wall", [end - thickness, low[0], low[1]], [end, high[0], high[1]], 0, false);
            }
        }
    }
}

fn point(position: [f32; 3], candela: f32) -> LightSource {
    LightSource::Point(PointLight {
        position: Vec3::from_array(position),
        intensity: Vec3::splat(candela),
        range: f32::INFINITY,
        radius: 0.0,
    })
}

fn add_lamp(scene: &mut Scene, source: Source, end: f32) {
    let light = match source {
        Source::Point(distance) => point([end - distance, 0.5 * HEIGHT, 0.5 * WIDTH], 100.0),
        Source::Rect => LightSource::Rect(RectLight {
            center: Vec3::new(0.5 * end, HEIGHT - 0.05, 0.5 * WIDTH),
            half_width: Vec3::X * 0.5,
            half_height: Vec3::Z * 0.5,
            radiance: Vec3::splat(100.0),
            range: f32::INFINITY,
        }),
        Source::Emissive => {
            let material = scene.materials.len();
            scene.materials.push(grey(0.0, 100.0));
            let (y, [x, z]) = (HEIGHT - 0.05, [0.5 * end, 0.5 * WIDTH]);
            let quad = [[x, y, z], [x + 0.6, y, z], [x + 0.6, y, z + 0.6], [x, y, z + 0.6]];
            add_quad(scene, "lamp", quad, material);
            return;
        }
    };
    scene.lights.push(Light { name: "lamp".into(), source: light });
}

/// A bright room from x = 0 to the wall at `x`, and a dark one behind it.
fn two_rooms(wall: Wall, shell: Shell, source: Source, x: f32, sunk: f32) -> Scene {
    let mut scene = match shell {
        Shell::Through => room([0.0; 3], [LENGTH, HEIGHT, WIDTH], grey(0.7, 0.0)),
        Shell::OfEachRoom => {
            let [end, start] = wall.span(x);
            let mut scene = room([0.0; 3], [end, HEIGHT, WIDTH], grey(0.7, 0.0));
            add_box(&mut scene, "dark", [start, 0.0, 0.0], [LENGTH, HEIGHT, WIDTH], 0, true);
            scene
        }
    };
    if shell == Shell::Through {
        wall.add(&mut scene, x, sunk);
    }
    add_lamp(&mut scene, source, wall.span(x)[0]);
    scene
}

/// The brightest point of the dark side over the mean of the bright side, and where it is.
fn leak(
    scene: &Scene,
    bake: &Bake,
    kernel: Kernel,
    counts: impl Fn(&str) -> bool,
    dark: impl Fn(Vec3, f32) -> bool,
    bright: impl Fn(Vec3) -> bool,
) -> (f32, Vec3, String) {
    let (mut worst, mut sum, mut count) = ((0.0, Vec3::ZERO, String::new()), 0.0, 0.0);
    for sample in samples(scene, bake, 400) {
        let name = &scene.surfaces[sample.surface].name;
        let light = kernel.sample(bake, &sample).max_element();
        assert!(light.is_finite() && light >= 0.0);
        // Charts end on borders of texels, so that texels are up to 4 % larger than asked for.
        let margin = 1.05 * (kernel.reach() - CLEARED) / bake.report.texels_per_meter;
        if counts(name) && dark(sample.position, margin) {
            if light > worst.0 {
                worst = (light, sample.position, scene.surfaces[sample.surface].name.clone());
            }
        } else if bright(sample.position) {
            (sum, count) = (sum + light, count + 1.0);
        }
    }
    let mean: f32 = sum / f32::max(count, 1.0);
    assert!(mean > 0.0, "the bright side is black");
    (worst.0 / mean, worst.1, worst.2)
}

/// The larger leak of both kernels.
///
/// Where quads run through both rooms, all points count for the bilinear kernel, up to the very foot of the wall. The
/// bicubic one reaches a texel farther, and mixes in what lies beyond walls that are thinner: there points count from so
/// far on. Beside walls of 3.5 texels, all count.
fn leak_of_rooms(wall: Wall, shell: Shell, source: Source, x: f32, sunk: f32, density: f32) -> f32 {
    let scene = two_rooms(wall, shell, source, x, sunk);
    let bake = baked(&scene, &settings(density, Quality::Draft));
    let [end, start] = wall.span(x);
    let counts = |name: &str| !name.contains("bright") && (shell == Shell::Through || name.starts_with("dark"));
    let leak = |kernel: Kernel| {
        let dark = |at: Vec3, margin: f32| {
            let is_wide = (start - end) * density >= 2.0 * kernel.reach() - 0.5;
            let margin = if shell == Shell::Through && at.x != start && !is_wide { margin } else { 0.0 };
            at.x >= start + margin && at.y >= 0.0 && at.y <= HEIGHT && at.z >= 0.0 && at.z <= WIDTH
        };
        let (leak, place, surface) = leak(&scene, &bake, kernel, counts, dark, |at| at.x < end - 0.5);
        println!(
            "{wall:?} {shell:?} {source:?} x {x} sunk {sunk} {density}/m {kernel:?}: {leak:.6} at {place} of {surface}"
        );
        leak
    };
    KERNELS.map(leak).into_iter().fold(0.0, f32::max)
}

const WALLS: [Wall; 6] = [
    Wall::Sheet,
    Wall::BackToBack,
    Wall::Solid { thickness: 0.1, gap: 0.0 },
    Wall::Solid { thickness: 0.1, gap: -0.03 },
    Wall::Solid { thickness: 0.1, gap: 0.01 },
    Wall::Solid { thickness: 0.01, gap: 0.01 },
];

fn worst_of(shell: Shell, density: f32, walls: &[Wall], sources: &[Source], places: &[f32]) -> f32 {
    let mut worst = 0.0_f32;
    for (&wall, &source) in walls.iter().flat_map(|wall| sources.iter().map(move |source| (wall, source))) {
        for (k, &x) in places.iter().enumerate() {
            let sunk = if k % 2 == 0 { 0.2 } else { 0.0 };
            worst = worst.max(leak_of_rooms(wall, shell, source, x, sunk, density));
        }
    }
    worst
}

/// Walls on borders of texels, through their middles, and elsewhere in them.
const PLACES: [f32; 4] = [4.0, 4.5, 4.2, 3.85];

#[test]
fn rooms_with_quads_of_their_own() {
    for density in [1.0, 4.0] {
        let sources = [Source::Point(0.01), Source::Point(0.05)];
        let worst = worst_of(Shell::OfEachRoom, density, &WALLS[1..], &sources, &PLACES[1..3]);
        assert!(worst < LARGEST_LEAK, "{worst} at {density}/m");
    }
}

#[test]
fn quads_through_both_rooms_coarse() {
    let sources = [Source::Point(0.01), Source::Point(2.0), Source::Emissive];
    let worst = worst_of(Shell::Through, 1.0, &WALLS, &sources, &PLACES);
    assert!(worst < LARGEST_LEAK, "{worst}");
}

#[test]
fn quads_through_both_rooms_fine() {
    let sources = [Source::Point(0.05), Source::Rect];
    for (density, walls, places) in [(4.0, &WALLS[..], &PLACES[..]), (20.0, &WALLS[2..3], &PLACES[1..2])] {
        let worst = worst_of(Shell::Through, density, walls, &sources, places);
        assert!(worst < LARGEST_LEAK, "{worst} at {density}/m");
    }
}

/// Walls of 1.5 texels: light comes to their very foot.
#[test]
fn quads_that_run_under_thick_walls() {
    let walls = [Wall::Solid { thickness: 0.1, gap: -0.01 }];
    for place in PLACES {
        let worst = worst_of(Shell::Through, 8.0, &walls, &[Source::Point(0.05)], &[place]);
        assert!(worst < LARGEST_LEAK, "{worst}");
    }
}

/// A house without doors on a lawn in the sun, whose floor is the lawn.
#[test]
fn closed_house_in_the_sun() {
    let mut worst = 0.0_f32;
    for density in [1.0, 4.0] {
        for both in [false, true] {
            let mut scene = Scene { materials: vec![grey(0.7, 0.0)], sky: Vec3::splat(2000.0), ..Default::default() };
            scene.materials[0].double_sided = both;
            let lawn = [[-8.0, 0.0, 8.0], [8.0, 0.0, 8.0], [8.0, 0.0, -8.0], [-8.0, 0.0, -8.0]];
            add_quad(&mut scene, "lawn", lawn, 0);
            let (low, high) = ([-3.3, -0.1, -3.6], [3.1, 2.5, 3.7]);
            add_box(&mut scene, "inside", low, high, 0, true);
            if !both {
                add_box(&mut scene, "outside", low, high, 0, false);
            }
            let sun = DirectionalLight {
                direction: Vec3::new(0.48, -0.6, 0.64),
                illuminance: Vec3::splat(100_000.0),
                angular_diameter: 0.0093,
            };
            scene.lights.push(Light { name: "sun".into(), source: LightSource::Directional(sun) });
            let bake = baked(&scene, &settings(density, Quality::Draft));
            for kernel in KERNELS {
                let dark = |at: Vec3, margin: f32| {
                    let (low, high) = (Vec3::from_array(low), Vec3::from_array(high));
                    let margin = if at.y == 0.0 { Vec3::new(margin, 0.0, margin) } else { Vec3::ZERO };
                    at.y >= 0.0 && at.cmpge(low + margin).all() && at.cmple(high - margin).all()
                };
                let is_lawn = |at: Vec3| at.y == 0.0 && at.x.abs() > 5.0;
                let (leak, place, name) =
                    leak(&scene, &bake, kernel, |name| !name.starts_with("outside"), dark, is_lawn);
                println!("house {density}/m double-sided {both} {kernel:?}: {leak:.6} at {place} of {name}");
                worst = worst.max(leak);
            }
        }
    }
    assert!(worst < LARGEST_LEAK, "{worst}");
}

/// Four rooms over one floor and under one ceiling, parted by two walls of 1 cm, of which one is dark: no light comes
/// around the crossing, where the texel across from a dark one is bright and both between are in other rooms.
#[test]
fn crossing_of_thin_walls() {
    let (half, density) = (0.005, 8.0);
    for [x, z] in [[4.0, 2.0], [4.06, 2.03], [3.93, 2.11], [4.02, 1.98]] {
        let mut scene = room([0.0; 3], [LENGTH, HEIGHT, WIDTH], grey(0.7, 0.0));
        add_box(&mut scene, "wall along z", [x - half, -0.1, -0.1], [x + half, HEIGHT + 0.1, WIDTH + 0.1], 0, false);
        add_box(&mut scene, "wall along x", [-0.1, -0.1, z - half], [LENGTH + 0.1, HEIGHT + 0.1, z + half], 0, false);
        for [lamp_x, lamp_z, candela] in [[2.0, 1.0, 100.0], [6.0, 1.0, 40.0], [2.0, 3.0, 30.0]] {
            let source = point([lamp_x, 1.5, lamp_z], candela);
            scene.lights.push(Light { name: "lamp".into(), source });
        }
        let bake = baked(&scene, &settings(density, Quality::Draft));
        for kernel in KERNELS {
            let dark = |at: Vec3, margin: f32| {
                let is_level = at.y == 0.0 || at.y == HEIGHT;
                is_level && at.x > x + half + margin && at.z > z + half + margin
            };
            let (leak, place, name) =
                leak(&scene, &bake, kernel, |_| true, dark, |at| at.x < x - 0.5 && at.z < z - 0.5);
            println!("crossing at {x}, {z} {kernel:?}: {leak:.6} at {place} of {name}");
            assert!(leak < LARGEST_LEAK, "{leak}");
        }
    }
}
