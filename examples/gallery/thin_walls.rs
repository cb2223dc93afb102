//! A flat of seven rooms behind walls of one centimeter, with 24 lamps of many colors. One room has neither lamp nor
//! door: it is dark.

use bevy::math::{Affine3A, Vec2, Vec3, vec2, vec3};

use crate::model::{Exhibit, Model, Paint, camera};
use crate::shape::Shape;
use crate::spline::lathe;

const LENGTH: f32 = 10.0;
const WIDTH: f32 = 8.0;
const HEIGHT: f32 = 2.5;
const THICKNESS: f32 = 0.01;

/// The flat, seen from above: its ceiling is one-sided.
pub fn exhibit() -> Exhibit {
    let mut model = Model::default();
    shell(&mut model);
    partitions(&mut model);
    furniture(&mut model);
    lamps(&mut model);
    model.seen_by("thin_walls", camera(vec3(5.0, 11.2, 12.2), vec3(5.0, 0.25, 4.15), 37.0), 6.6, 24.0)
}

fn shell(model: &mut Model) {
    let plaster = model.paint("plaster", [0.75, 0.74, 0.71]);
    let boards = model.paint("boards", [0.5, 0.37, 0.24]);
    let white = model.paint("ceiling", [0.82, 0.82, 0.81]);
    let corners = [Vec3::ZERO, vec3(LENGTH, 0.0, 0.0), vec3(LENGTH, 0.0, WIDTH), vec3(0.0, 0.0, WIDTH)];
    for (i, name) in ["north wall", "east wall", "south wall", "west wall"].into_iter().enumerate() {
        let (from, to) = (corners[i], corners[(i + 1) % 4]);
        let wall = Shape::wall(from, (to - from).normalize(), from.distance(to), HEIGHT, &[]);
        model.add(name, plaster, wall);
    }
    model.add("floor", boards, Shape::quad(corners).turned());
    model.add("ceiling", white, Shape::quad(corners.map(|corner| corner.with_y(HEIGHT))));
}

/// Two sheets, their top, and the sides of the doors.
fn partition(from: Vec3, along: Vec3, length: f32, doors: &[f32]) -> Shape {
    let front = along.cross(Vec3::Y);
    let opening = |&door: &f32| [vec2(door, 0.0), vec2(door + 0.9, 2.05)];
    let openings: Vec<[Vec2; 2]> = doors.iter().map(opening).collect();
    let mirrored: Vec<[Vec2; 2]> =
        openings.iter().map(|[low, high]| [vec2(length - high.x, low.y), vec2(length - low.x, high.y)]).collect();
    let half = 0.5 * THICKNESS * front;
    let end = from + length * along;
    let top = [from + half, end + half, end - half, from - half].map(|corner| corner.with_y(HEIGHT));
    let sides = openings.iter().map(|[low, high]| {
        let at = |u: f32, v: f32| from + half + u * along + v * Vec3::Y;
        // Neither a threshold nor what lies under it.
        let corners = [at(high.x, low.y), at(high.x, high.y), at(low.x, high.y), at(low.x, low.y)];
        let jamb =
            |i: usize| Shape::quad([corners[i], corners[i + 1], corners[i + 1] - 2.0 * half, corners[i] - 2.0 * half]);
        Shape::joined((0..3).map(jamb))
    });
    let sheets = [
        Shape::wall(from + half, along, length, HEIGHT, &openings),
        Shape::wall(end - half, -along, length, HEIGHT, &mirrored),
        Shape::quad(top),
    ];
    Shape::joined(sheets.into_iter().chain(sides))
}

fn partitions(model: &mut Model) {
    let paints = [
        model.paint("rose", [0.72, 0.5, 0.46]),
        model.paint("sky blue", [0.46, 0.6, 0.7]),
        model.paint("cream", [0.76, 0.7, 0.56]),
        model.paint("mint", [0.52, 0.68, 0.56]),
    ];
    let walls = [
        ("corridor north", vec3(0.0, 0.0, 3.4), Vec3::X, LENGTH, &[1.2, 4.4, 7.8][..], 2),
        ("corridor south", vec3(0.0, 0.0, 4.6), Vec3::X, LENGTH, &[0.9, 6.8], 2),
        ("between bedrooms", vec3(3.2, 0.0, 0.0), Vec3::Z, 3.4, &[], 0),
        ("between bedroom and study", vec3(6.6, 0.0, 0.0), Vec3::Z, 3.4, &[], 1),
        ("bathroom wall", vec3(2.6, 0.0, 4.6), Vec3::Z, 3.4, &[], 3),
        ("dark room wall", vec3(5.2, 0.0, 4.6), Vec3::Z, 3.4, &[], 0),
    ];
    for (name, from, along, length, doors, paint) in walls {
        model.add(name, paints[paint], partition(from, along, length, doors));
    }
}

/// What furniture is painted with.
struct Paints {
    wood: Paint,
    cloth: Paint,
    linen: Paint,
    red: Paint,
    white: Paint,
}

fn furniture(model: &mut Model) {
    let paints = Paints {
        wood: model.paint("wood", [0.42, 0.27, 0.15]),
        cloth: model.paint("cloth", [0.3, 0.36, 0.5]),
        linen: model.paint("bed linen", [0.72, 0.69, 0.63]),
        red: model.paint("red cloth", [0.55, 0.14, 0.1]),
        white: model.paint("enamel", [0.8, 0.8, 0.8]),
    };
    bedrooms(model, &paints);
    living_room(model, &paints);
    stools(model, &paints);
    bathroom(model, &paints);
    storage(model, &paints);
}

fn bedrooms(model: &mut Model, &Paints { wood, linen, .. }: &Paints) {
    let bed = |x: f32, z: f32| {
        Shape::joined([
            Shape::cuboid([x, 0.12, z], [x + 1.5, 0.3, z + 2.05]),
            Shape::cuboid([x, 0.3, z], [x + 1.5, 0.75, z + 0.06]),
        ])
    };
    model.add("beds", wood, Shape::joined([bed(0.8, 0.1), bed(4.2, 0.1)]));
    let mattress = |x: f32, z: f32| Shape::cuboid([x + 0.04, 0.3, z + 0.1], [x + 1.46, 0.5, z + 2.0]);
    model.add("mattresses", linen, Shape::joined([mattress(0.8, 0.1), mattress(4.2, 0.1)]));
    let feet = [(0.85, 0.15), (2.2, 0.15), (0.85, 2.0), (2.2, 2.0), (4.25, 0.15), (5.6, 0.15), (4.25, 2.0), (5.6, 2.0)];
    let feet = feet.map(|(x, z)| Shape::cuboid([x, 0.0, z], [x + 0.05, 0.12, z + 0.05]));
    model.add("bed feet", wood, Shape::joined(feet));
    model.add(
        "wardrobes",
        wood,
        Shape::joined([
            Shape::cuboid([2.6, 0.0, 0.4], [3.18, 2.1, 1.9]),
            Shape::cuboid([6.0, 0.0, 0.6], [6.58, 2.1, 2.2]),
        ]),
    );
}

fn living_room(model: &mut Model, &Paints { wood, cloth, red, .. }: &Paints) {
    let table = |low: [f32; 2], high: [f32; 2], y: f32| {
        let legs =
            [(low[0], low[1]), (high[0] - 0.05, low[1]), (low[0], high[1] - 0.05), (high[0] - 0.05, high[1] - 0.05)];
        let legs = legs.map(|(x, z)| Shape::cuboid([x, 0.0, z], [x + 0.05, y - 0.03, z + 0.05]));
        let top = Shape::cuboid([low[0], y - 0.03, low[1]], [high[0], y, high[1]]);
        Shape::joined(legs.into_iter().chain([top]))
    };
    model.add("desk", wood, table([8.0, 0.15], [9.7, 0.85], 0.74));
    model.add("dining table", wood, table([7.9, 5.6], [9.3, 6.5], 0.74));
    model.add("low table", wood, table([5.9, 6.5], [6.7, 7.1], 0.4));
    let sofa = [
        Shape::cuboid([5.4, 0.05, 7.2], [7.4, 0.42, 7.98]),
        Shape::cuboid([5.4, 0.42, 7.75], [7.4, 0.8, 7.98]),
        Shape::cuboid([5.22, 0.05, 7.2], [5.4, 0.6, 7.98]),
        Shape::cuboid([7.4, 0.05, 7.2], [7.58, 0.6, 7.98]),
    ];
    model.add("sofa", cloth, Shape::joined(sofa));
    model.add("rug", red, Shape::cuboid([5.6, 0.0, 5.6], [7.2, 0.01, 7.1]));
}

fn stools(model: &mut Model, &Paints { red, .. }: &Paints) {
    let stools = [(8.1, 5.2), (9.0, 5.2), (8.1, 6.8), (9.0, 6.8), (8.7, 1.2)];
    let stool: [&[[f32; 2]]; 4] = [
        &[[0.0, 0.0], [0.13, 0.0]],
        &[[0.13, 0.0], [0.02, 0.05], [0.02, 0.36], [0.18, 0.42]],
        &[[0.18, 0.42], [0.18, 0.46], [0.16, 0.46]],
        &[[0.16, 0.46], [0.0, 0.46]],
    ];
    let stools = stools.map(|(x, z)| Affine3A::from_translation(vec3(x, 0.0, z)));
    model.add_all("stool", red, lathe(Vec3::ZERO, &stool, [5, 6]), &stools);
}

fn bathroom(model: &mut Model, &Paints { white, .. }: &Paints) {
    let basin: [&[[f32; 2]]; 4] = [
        &[[0.0, 0.0], [0.1, 0.0]],
        &[[0.1, 0.0], [0.06, 0.3], [0.1, 0.7], [0.26, 0.74], [0.27, 0.85]],
        &[[0.27, 0.85], [0.268, 0.856], [0.25, 0.85]],
        &[[0.25, 0.85], [0.22, 0.78], [0.1, 0.77], [0.0, 0.77]],
    ];
    model.add("basin", white, lathe(vec3(2.2, 0.0, 5.4), &basin, [7, 8]));
    let tub = [
        Shape::cuboid([0.02, 0.0, 7.2], [1.8, 0.1, 7.98]),
        Shape::cuboid([0.02, 0.1, 7.2], [1.8, 0.58, 7.26]),
        Shape::cuboid([0.02, 0.1, 7.92], [1.8, 0.58, 7.98]),
        Shape::cuboid([0.02, 0.1, 7.26], [0.08, 0.58, 7.92]),
        Shape::cuboid([1.74, 0.1, 7.26], [1.8, 0.58, 7.92]),
    ];
    model.add("bath tub", white, Shape::joined(tub));
}

fn storage(model: &mut Model, &Paints { wood, .. }: &Paints) {
    model.add(
        "boxes",
        wood,
        Shape::joined([
            Shape::cuboid([3.0, 0.0, 5.2], [3.7, 0.5, 5.8]),
            Shape::cuboid([4.0, 0.0, 6.6], [4.6, 0.8, 7.2]),
        ]),
    );
    let shelves = (0..5).map(|i| Shape::cuboid([6.62, 0.3 + 0.42 * i as f32, 0.1], [6.9, 0.33 + 0.42 * i as f32, 2.6]));
    let ends = [0.07, 2.6].map(|z| Shape::cuboid([6.62, 0.0, z], [6.9, 2.1, z + 0.03]));
    model.add("shelves", wood, Shape::joined(shelves.chain(ends)));
}

/// Luminous panels in the ceiling and globes, with a few point lights between.
fn lamps(model: &mut Model) {
    let panels = [
        ("warm", [4200.0, 3000.0, 1700.0], &[(1.6, 1.7), (4.0, 1.2), (5.6, 2.6)][..]),
        ("neutral", [3200.0, 3000.0, 2700.0], &[(0.8, 4.0), (3.6, 4.0), (6.4, 4.0), (9.2, 4.0)]),
        ("cool", [3000.0, 3700.0, 4600.0], &[(8.3, 1.2), (7.6, 2.5), (9.4, 2.6)]),
        ("green", [900.0, 3600.0, 1700.0], &[(0.8, 5.6), (1.8, 6.4)]),
        ("amber", [5200.0, 2500.0, 500.0], &[(6.1, 5.3), (7.6, 7.0)]),
        ("violet", [2600.0, 900.0, 4400.0], &[(8.7, 7.4)]),
    ];
    for (name, radiance, places) in panels {
        let paint = model.glow(&format!("{name} panel"), radiance);
        for (number, &(x, z)) in places.iter().enumerate() {
            let y = HEIGHT - 0.02;
            let corners = [
                vec3(x - 0.2, y, z + 0.2),
                vec3(x + 0.2, y, z + 0.2),
                vec3(x + 0.2, y, z - 0.2),
                vec3(x - 0.2, y, z - 0.2),
            ];
            model.add(&format!("{name} panel {}", number + 1), paint, Shape::quad(corners).turned());
        }
    }
    let globes = [
        ("rose", [9000.0, 2200.0, 2600.0], vec3(0.4, 0.9, 0.5)),
        ("blue", [1500.0, 3200.0, 9000.0], vec3(9.6, 0.95, 0.4)),
    ];
    for (name, radiance, place) in globes {
        let paint = model.glow(&format!("{name} globe"), radiance);
        model.add(&format!("{name} globe"), paint, Shape::ball(place, 0.07, 2));
    }
    for (number, (place, color)) in [
        (vec3(2.9, 1.2, 2.6), [30.0, 22.0, 13.0]),
        (vec3(3.5, 0.9, 0.4), [26.0, 20.0, 12.0]),
        (vec3(2.2, 1.5, 5.2), [10.0, 34.0, 22.0]),
        (vec3(8.6, 1.5, 6.05), [40.0, 28.0, 14.0]),
        (vec3(5.5, 1.5, 7.0), [45.0, 18.0, 4.0]),
        (vec3(9.6, 1.2, 7.6), [20.0, 6.0, 34.0]),
        (vec3(7.0, 1.9, 3.0), [14.0, 18.0, 24.0]),
    ]
    .into_iter()
    .enumerate()
    {
        model.point_light(&format!("lamp {}", number + 1), place, color);
    }
}
