//! A stairwell: steps, landings, railings of thin bars, a skylight and lamps on the walls.

use bevy::math::{Affine3A, Quat, Vec3, vec2, vec3};

use crate::model::{Exhibit, Model, Paint, camera};
use crate::shape::Shape;
use crate::spline::lathe;

const WIDTH: f32 = 2.7;
const DEPTH: f32 = 5.4;
const HEIGHT: f32 = 6.4;
/// Of one step.
const RISE: f32 = 0.17;
const GOING: f32 = 0.28;
/// Steps of a flight.
const STEPS: usize = 10;
/// Where flights begin and end.
const LOW_Z: f32 = 4.1;
const HIGH_Z: f32 = LOW_Z - STEPS as f32 * GOING;
/// Width of a flight.
const FLIGHT: f32 = 1.2;
/// Height of the landing, and of the floor above it.
const LANDING: f32 = (STEPS + 1) as f32 * RISE;
const FLOOR: f32 = 2.0 * LANDING;

/// The stairwell.
pub fn exhibit() -> Exhibit {
    let mut model = Model::default();
    walls(&mut model);
    flights(&mut model);
    railings(&mut model);
    lamps(&mut model);
    model.seen_by("stairwell", camera(vec3(2.35, 1.6, 5.25), vec3(0.95, 2.1, 1.6), 66.0), 6.9, 32.0)
}

fn walls(model: &mut Model) {
    let plaster = model.paint("plaster", [0.74, 0.72, 0.68]);
    let dado = model.paint("dado", [0.16, 0.33, 0.34]);
    let white = model.paint("ceiling", [0.8, 0.8, 0.78]);
    let tiles = model.paint("floor tiles", [0.36, 0.33, 0.3]);
    let corners = [Vec3::ZERO, vec3(WIDTH, 0.0, 0.0), vec3(WIDTH, 0.0, DEPTH), vec3(0.0, 0.0, DEPTH)];
    let walls = [("back", 0), ("right", 1), ("front", 2), ("left", 3)];
    for (name, i) in walls {
        let (from, to) = (corners[i], corners[(i + 1) % 4]);
        let (along, length) = ((to - from).normalize(), from.distance(to));
        model.add(&format!("{name} dado"), dado, Shape::wall(from, along, length, 1.1, &[]));
        let upper = Shape::wall(from + vec3(0.0, 1.1, 0.0), along, length, HEIGHT - 1.1, &[]);
        model.add(&format!("{name} wall"), plaster, upper);
    }
    let rectangle = |y: f32| corners.map(|corner| corner.with_y(y));
    model.add("floor", tiles, Shape::quad(rectangle(0.0)).turned());
    ceiling(model, white);
}

/// With the skylight at the end of a shaft.
fn ceiling(model: &mut Model, white: Paint) {
    let hole = [vec2(0.75, 1.7), vec2(1.95, 3.7)];
    let lying =
        Affine3A::from_rotation_translation(Quat::from_rotation_x(std::f32::consts::FRAC_PI_2), vec3(0.0, HEIGHT, 0.0));
    model.add("ceiling", white, Shape::wall(Vec3::ZERO, Vec3::X, WIDTH, DEPTH, &[hole]).placed(lying));
    let [low, high] = hole;
    let at = |x: f32, z: f32, y: f32| vec3(x, y, z);
    let rim = |y: f32| [at(low.x, low.y, y), at(high.x, low.y, y), at(high.x, high.y, y), at(low.x, high.y, y)];
    model.add("skylight shaft", white, Shape::reveal(rim(HEIGHT), vec3(0.0, 0.45, 0.0)));
    let bars = [2.35, 3.0].map(|z| Shape::cuboid([low.x, HEIGHT + 0.3, z], [high.x, HEIGHT + 0.36, z + 0.04]));
    model.add("skylight bars", white, Shape::joined(bars));
    let sky = model.glow("sky", [4200.0, 5000.0, 6000.0]);
    model.add("sky", sky, Shape::quad(rim(HEIGHT + 0.45)));
}

fn flights(model: &mut Model) {
    let concrete = model.paint("concrete", [0.5, 0.48, 0.45]);
    let oak = model.paint("treads", [0.45, 0.29, 0.16]);
    let lower = Affine3A::IDENTITY;
    let turned = Quat::from_rotation_y(std::f32::consts::PI);
    let upper = Affine3A::from_rotation_translation(turned, vec3(WIDTH, LANDING, LOW_Z + HIGH_Z));
    model.add_all("flight", concrete, flight(), &[lower, upper]);
    let treads = (0..STEPS).map(|i| {
        let (y, z) = ((i + 1) as f32 * RISE, LOW_Z - i as f32 * GOING);
        Shape::cuboid([0.02, y, z - GOING], [FLIGHT - 0.02, y + 0.02, z + 0.02])
    });
    model.add_all("treads", oak, Shape::joined(treads), &[lower, upper]);
    model.add("landing", concrete, Shape::cuboid([0.0, LANDING - 0.2, 0.0], [WIDTH, LANDING, HIGH_Z]));
    model.add("upper floor", concrete, Shape::cuboid([0.0, FLOOR - 0.2, LOW_Z], [WIDTH, FLOOR, DEPTH]));
}

/// Up towards `-z`, at the left wall: risers, goings, and a slanted soffit.
fn flight() -> Shape {
    // In a picture where -z runs to the right; it is turned into place afterwards.
    let thick = 0.2;
    let corner = |i: usize, up: usize| vec3(i as f32 * GOING, (i + up) as f32 * RISE, 0.0);
    let soffit = |i: usize| vec3(i as f32 * GOING, (i as f32 * RISE - thick).max(0.0), 0.0);
    let end = STEPS;
    let faces: Vec<Vec<Vec3>> =
        (0..end).map(|i| vec![soffit(i), soffit(i + 1), corner(i + 1, 0), corner(i, 1)]).collect();
    let mut outline: Vec<Vec3> = (0..=end).map(soffit).collect();
    outline.extend((0..end).rev().flat_map(|i| [corner(i + 1, 0), corner(i, 1)]));
    let place = Affine3A::from_rotation_translation(
        Quat::from_rotation_y(std::f32::consts::FRAC_PI_2),
        vec3(FLIGHT, 0.0, LOW_Z),
    );
    Shape::prism(&faces, &outline, vec3(0.0, 0.0, -FLIGHT)).placed(place)
}

fn railings(model: &mut Model) {
    let steel = model.paint("painted steel", [0.06, 0.06, 0.07]);
    let oak = model.paint("handrail", [0.5, 0.3, 0.15]);
    let bar = |x: f32, y: f32, z: f32| Shape::cylinder(vec3(x, y, z), 0.009, 0.9, 8);
    let lower = (0..STEPS).flat_map(|i| {
        let (y, z) = ((i + 1) as f32 * RISE + 0.02, LOW_Z - (i as f32 + 0.5) * GOING);
        [-0.07, 0.07].map(|off| bar(FLIGHT - 0.06, y, z + off))
    });
    let upper = (0..STEPS).flat_map(|i| {
        let (y, z) = (LANDING + (i + 1) as f32 * RISE + 0.02, HIGH_Z + (i as f32 + 0.5) * GOING);
        [-0.07, 0.07].map(|off| bar(WIDTH - FLIGHT + 0.06, y, z + off))
    });
    let edge = (0..12).map(|i| bar(0.06 + 0.12 * i as f32, FLOOR, LOW_Z + 0.06));
    model.add("bars", steel, Shape::joined(lower.chain(upper).chain(edge)));
    let rail = |from: Vec3, to: Vec3| {
        let turn = Quat::from_rotation_arc(Vec3::Y, (to - from).normalize());
        Shape::cylinder(Vec3::ZERO, 0.024, from.distance(to), 12)
            .placed(Affine3A::from_rotation_translation(turn, from))
    };
    let along = |x: f32, y: f32, z: [f32; 2]| {
        let height = y + RISE + 0.92;
        rail(vec3(x, height, z[0]), vec3(x, height + (STEPS - 1) as f32 * RISE, z[1]))
    };
    let half = 0.5 * GOING;
    let rails = [
        along(FLIGHT - 0.06, 0.0, [LOW_Z - half, HIGH_Z + half]),
        along(WIDTH - FLIGHT + 0.06, LANDING, [HIGH_Z + half, LOW_Z - half]),
        rail(vec3(0.0, FLOOR + 0.9, LOW_Z + 0.06), vec3(WIDTH - FLIGHT, FLOOR + 0.9, LOW_Z + 0.06)),
    ];
    model.add("handrails", oak, Shape::joined(rails));
}

fn lamps(model: &mut Model) {
    let brass = model.paint("brass", [0.52, 0.38, 0.18]);
    let globe = model.glow("warm glass", [7000.0, 5000.0, 2800.0]);
    // Plates that stand on the wall, and a globe before each.
    let plate: [&[[f32; 2]]; 3] =
        [&[[0.1, 0.0], [0.1, 0.02]], &[[0.1, 0.02], [0.03, 0.02]], &[[0.03, 0.02], [0.03, 0.06], [0.0, 0.06]]];
    let plate = lathe(Vec3::ZERO, &plate, [5, 3]);
    let wall = |x: f32, y: f32, z: f32, side: f32| {
        Affine3A::from_rotation_translation(Quat::from_rotation_arc(Vec3::Y, side * Vec3::X), vec3(x, y, z))
    };
    let places = [
        wall(WIDTH, 1.95, 3.0, -1.0),
        wall(0.0, LANDING + 1.95, 0.7, 1.0),
        wall(WIDTH, FLOOR + 1.95, 4.7, -1.0),
        wall(0.0, 1.95, 4.75, 1.0),
    ];
    model.add_all("lamp plate", brass, plate, &places);
    model.add_all("lamp globe", globe, Shape::ball([0.0, 0.125, 0.0], 0.07, 2), &places);
}
