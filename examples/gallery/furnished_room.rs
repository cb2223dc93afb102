//! A living room of spline and box furniture: sun and sky through a window, three lamps.

use std::f32::consts::{FRAC_PI_2, PI};

use bevy::math::{Affine3A, Quat, Vec2, Vec3, vec2, vec3};
use radiosity::geometry::hash;

use crate::model::{Exhibit, Model, camera};
use crate::shape::Shape;
use crate::spline::{cushion, lathe, patch, sheet, strip};

const LENGTH: f32 = 5.6;
const WIDTH: f32 = 4.4;
const HEIGHT: f32 = 2.7;
/// Where the window begins and ends, along the wall from its left end seen from inside, and upwards.
const WINDOW: [Vec2; 2] = [vec2(1.2, 0.85), vec2(3.2, 2.35)];

/// The room.
pub fn exhibit() -> Exhibit {
    let mut model = Model::default();
    walls(&mut model);
    window(&mut model);
    sofa(&mut model);
    coffee_table(&mut model);
    dining_table(&mut model);
    shelf(&mut model);
    lamps(&mut model);
    plant(&mut model);
    model.seen_by("furnished_room", camera(vec3(5.35, 1.6, 4.2), vec3(1.75, 0.95, 1.0), 50.0), 7.4, 24.0)
}

fn walls(model: &mut Model) {
    let plaster = model.paint("plaster", [0.76, 0.73, 0.67]);
    let sage = model.paint("sage", [0.36, 0.42, 0.34]);
    let white = model.paint("white", [0.82, 0.82, 0.8]);
    let oak = model.paint("oak floor", [0.46, 0.31, 0.18]);
    model.add("window wall", plaster, Shape::wall(vec3(0.0, 0.0, WIDTH), Vec3::NEG_Z, WIDTH, HEIGHT, &[WINDOW]));
    model.add("back wall", sage, Shape::wall(Vec3::ZERO, Vec3::X, LENGTH, HEIGHT, &[]));
    model.add("right wall", plaster, Shape::wall(vec3(LENGTH, 0.0, 0.0), Vec3::Z, WIDTH, HEIGHT, &[]));
    model.add("front wall", plaster, Shape::wall(vec3(LENGTH, 0.0, WIDTH), Vec3::NEG_X, LENGTH, HEIGHT, &[]));
    let rectangle = |y: f32| [vec3(0.0, y, WIDTH), vec3(LENGTH, y, WIDTH), vec3(LENGTH, y, 0.0), vec3(0.0, y, 0.0)];
    model.add("floor", oak, Shape::quad(rectangle(0.0)));
    model.add("ceiling", white, Shape::quad(rectangle(HEIGHT)).turned());
    let skirting = [
        Shape::cuboid([0.0, 0.0, 0.0], [LENGTH, 0.08, 0.015]),
        Shape::cuboid([0.0, 0.0, 0.015], [0.015, 0.08, WIDTH]),
        Shape::cuboid([LENGTH - 0.015, 0.0, 0.015], [LENGTH, 0.08, WIDTH]),
    ];
    model.add("skirting", white, Shape::joined(skirting));
}

/// Its niche, its frame, curtains, what is bright outside, and the sun.
fn window(model: &mut Model) {
    let white = model.paint("window frame", [0.8, 0.8, 0.78]);
    let at = |along: f32, y: f32, x: f32| vec3(x, y, WIDTH - along);
    let [low, high] = WINDOW;
    let corners = [(low.x, low.y), (high.x, low.y), (high.x, high.y), (low.x, high.y)].map(|(u, v)| at(u, v, 0.0));
    model.add("window niche", white, Shape::reveal(corners, vec3(-0.22, 0.0, 0.0)));
    let bar = |u: [f32; 2], v: [f32; 2]| {
        let (a, b) = (at(u[1], v[0], -0.16), at(u[0], v[1], -0.1));
        Shape::cuboid(a, b)
    };
    let (left, right, below, above, thick) = (low.x, high.x, low.y, high.y, 0.05);
    let middle = low.midpoint(high);
    let bars = [
        bar([left, right], [below, below + thick]),
        bar([left, right], [above - thick, above]),
        bar([left, left + thick], [below + thick, above - thick]),
        bar([right - thick, right], [below + thick, above - thick]),
        bar([middle.x - 0.03, middle.x + 0.03], [below + thick, above - thick]),
        bar([left + thick, middle.x - 0.03], [1.86, 1.9]),
        bar([middle.x + 0.03, right - thick], [1.86, 1.9]),
    ];
    model.add("window frame", white, Shape::joined(bars));
    model.add("window sill", white, Shape::cuboid(at(right + 0.06, below - 0.03, 0.0), at(left - 0.06, below, 0.14)));
    let linen = model.paint("linen", [0.7, 0.62, 0.5]);
    let steel = model.paint("steel", [0.35, 0.35, 0.36]);
    model.add("left curtain", linen, curtain(left - 0.45, left + 0.12));
    model.add("right curtain", linen, curtain(right - 0.12, right + 0.45));
    let rod = Shape::cylinder(Vec3::ZERO, 0.012, 3.1, 8)
        .placed(Affine3A::from_rotation_translation(Quat::from_rotation_x(FRAC_PI_2), at(3.75, 2.5, 0.09)));
    model.add("curtain rod", steel, rod);
    let sky = model.glow("sky", [2600.0, 3200.0, 4000.0]);
    model.add("sky", sky, Shape::wall(vec3(-3.2, -0.6, 7.5), Vec3::NEG_Z, 10.5, 3.7, &[]));
    model.sun(vec3(1.0, -0.78, -0.3), [14_000.0, 12_600.0, 10_500.0]);
}

/// From one place along the window wall to another, in waves.
fn curtain(from: f32, to: f32) -> Shape {
    const FOLDS: usize = 6;
    let (cuts, step) = ([8, 6], (to - from) / FOLDS as f32);
    let fold = |number: usize| {
        let row = move |y: f32, wave: f32| {
            [0.0, wave, -wave, 0.0]
                .into_iter()
                .enumerate()
                .map(move |(i, out)| vec3(0.1 + out, y, WIDTH - from - step * (number as f32 + i as f32 / 3.0)))
        };
        [(0.03, 0.17), (1.3, 0.13), (2.47, 0.1)].into_iter().flat_map(|(y, wave)| row(y, wave)).collect()
    };
    let folds: Vec<Vec<Vec3>> = (0..FOLDS).map(fold).collect();
    sheet(strip(&folds, 4, cuts), [cuts[0] * FOLDS, cuts[1]], 0.006)
}

fn sofa(model: &mut Model) {
    let cloth = model.paint("blue cloth", [0.14, 0.23, 0.33]);
    let accent = model.paint("mustard cloth", [0.62, 0.4, 0.1]);
    let walnut = model.paint("walnut", [0.28, 0.16, 0.09]);
    let body = [
        Shape::cuboid([1.7, 0.14, 0.06], [3.9, 0.36, 0.96]),
        Shape::cuboid([1.92, 0.36, 0.06], [3.68, 0.82, 0.28]),
        Shape::cuboid([1.7, 0.36, 0.06], [1.92, 0.6, 0.96]),
        Shape::cuboid([3.68, 0.36, 0.06], [3.9, 0.6, 0.96]),
    ];
    model.add("sofa", cloth, Shape::joined(body));
    let seat = cushion(vec2(0.86, 0.7), 0.13, 14);
    let seats = [2.36, 3.24].map(|x| Affine3A::from_translation(vec3(x, 0.435, 0.61)));
    model.add_all("seat cushion", cloth, seat, &seats);
    let lean = Quat::from_rotation_x(1.25);
    let pillow = cushion(vec2(0.44, 0.42), 0.14, 12);
    let pillows = [2.2, 3.42].map(|x| Affine3A::from_rotation_translation(lean, vec3(x, 0.72, 0.38)));
    model.add_all("pillow", accent, pillow, &pillows);
    let leg = Shape::cone(Vec3::ZERO, [0.018, 0.028], 0.14, 12);
    let legs = [(1.78, 0.14), (3.82, 0.14), (1.78, 0.88), (3.82, 0.88)];
    model.add_all("sofa leg", walnut, leg, &legs.map(|(x, z)| Affine3A::from_translation(vec3(x, 0.0, z))));
    let wool = model.paint("wool", [0.56, 0.48, 0.4]);
    model.add("rug", wool, Shape::cuboid([1.6, 0.0, 1.0], [4.1, 0.012, 2.45]));
    let frame = model.paint("black frame", [0.04, 0.04, 0.04]);
    let bar = |low: [f32; 3], high: [f32; 3]| Shape::cuboid(low, high);
    let bars = [
        bar([2.2, 1.3, 0.0], [3.4, 1.33, 0.03]),
        bar([2.2, 2.07, 0.0], [3.4, 2.1, 0.03]),
        bar([2.2, 1.33, 0.0], [2.23, 2.07, 0.03]),
        bar([3.37, 1.33, 0.0], [3.4, 2.07, 0.03]),
    ];
    model.add("picture frame", frame, Shape::joined(bars));
    for (name, color, x) in
        [("left", [0.75, 0.3, 0.16], 2.23), ("middle", [0.85, 0.7, 0.42], 2.61), ("right", [0.12, 0.3, 0.36], 2.99)]
    {
        let paint = model.paint(&format!("{name} of the picture"), color);
        let canvas = Shape::wall(vec3(x, 1.33, 0.012), Vec3::X, 0.38, 0.74, &[]);
        model.add(&format!("picture {name}"), paint, canvas);
    }
}

fn coffee_table(model: &mut Model) {
    let walnut = model.paint("walnut table", [0.3, 0.17, 0.09]);
    let center = vec3(2.85, 0.0, 1.65);
    let top = lathe(
        center,
        &[
            &[[0.0, 0.38], [0.46, 0.38]],
            &[[0.46, 0.38], [0.49, 0.38], [0.49, 0.41], [0.46, 0.41]],
            &[[0.46, 0.41], [0.0, 0.41]],
        ],
        [10, 4],
    );
    model.add("coffee table", walnut, top);
    let legs = [0.3, 2.4, 4.5].map(|angle: f32| {
        let lean = Quat::from_rotation_y(angle) * Quat::from_rotation_z(0.16);
        Affine3A::from_rotation_translation(lean, center + Quat::from_rotation_y(angle) * vec3(0.38, 0.014, 0.0))
    });
    model.add_all("coffee table leg", walnut, Shape::cone(Vec3::ZERO, [0.011, 0.018], 0.372, 12), &legs);
    let glaze = model.paint("celadon", [0.3, 0.52, 0.46]);
    let vase: [&[[f32; 2]]; 5] = [
        &[[0.0, 0.0], [0.05, 0.0]],
        &[[0.05, 0.0], [0.13, 0.05], [0.13, 0.15], [0.035, 0.19], [0.03, 0.23], [0.055, 0.26]],
        &[[0.055, 0.26], [0.052, 0.264], [0.047, 0.26]],
        &[[0.047, 0.26], [0.022, 0.23], [0.027, 0.19], [0.12, 0.15], [0.12, 0.05], [0.04, 0.012]],
        &[[0.04, 0.012], [0.0, 0.012]],
    ];
    model.add("vase", glaze, lathe(center + vec3(-0.14, 0.41, -0.1), &vase, [8, 16]));
    let paper = model.paint("magazine", [0.66, 0.2, 0.16]);
    let turn = Affine3A::from_rotation_translation(Quat::from_rotation_y(0.5), center + vec3(0.17, 0.41, 0.1));
    model.add("magazine", paper, Shape::cuboid([-0.11, 0.0, -0.15], [0.11, 0.012, 0.15]).placed(turn));
}

fn dining_table(model: &mut Model) {
    let beech = model.paint("beech", [0.6, 0.43, 0.26]);
    let center = vec3(1.45, 0.0, 3.35);
    model.add("dining table", beech, Shape::cuboid(center + vec3(-0.75, 0.72, -0.42), center + vec3(0.75, 0.75, 0.42)));
    let corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
    let legs = corners.map(|(x, z)| Affine3A::from_translation(center + vec3(0.68 * x, 0.0, 0.36 * z)));
    model.add_all("table leg", beech, Shape::cone(Vec3::ZERO, [0.018, 0.028], 0.72, 12), &legs);
    let places = [(-0.35, -0.5, PI), (0.35, -0.52, PI - 0.15), (-0.35, 0.5, 0.0), (0.35, 0.52, 0.2)];
    let places = places
        .map(|(x, z, turn)| Affine3A::from_rotation_translation(Quat::from_rotation_y(turn), center + vec3(x, 0.0, z)));
    let green = model.paint("chair", [0.2, 0.3, 0.24]);
    model.add_all("chair", green, chair(), &places);
    let porcelain = model.paint("porcelain", [0.8, 0.78, 0.74]);
    let bowl: [&[[f32; 2]]; 4] = [
        &[[0.0, 0.0], [0.05, 0.0]],
        &[[0.05, 0.0], [0.13, 0.01], [0.15, 0.06], [0.16, 0.08]],
        &[[0.16, 0.08], [0.158, 0.083], [0.153, 0.08]],
        &[[0.153, 0.08], [0.143, 0.06], [0.12, 0.016], [0.0, 0.012]],
    ];
    model.add("fruit bowl", porcelain, lathe(center + vec3(0.1, 0.75, 0.0), &bowl, [8, 10]));
    let orange = model.paint("oranges", [0.8, 0.32, 0.05]);
    let fruits = [(0.045, 0.0), (-0.03, 0.04), (-0.03, -0.045)];
    let places = fruits.map(|(x, z)| Affine3A::from_translation(center + vec3(0.1 + x, 0.808, z)));
    model.add_all("orange", orange, Shape::ball(Vec3::ZERO, 0.038, 6), &places);
}

/// A chair whose back is at `+z`.
fn chair() -> Shape {
    let legs = [(-0.19, -0.19), (0.19, -0.19), (-0.19, 0.19), (0.19, 0.19)];
    let legs = legs.map(|(x, z)| Shape::cone(vec3(x, 0.0, z), [0.012, 0.016], 0.44, 10));
    let posts = [-0.19, 0.19].map(|x| Shape::cylinder(vec3(x, 0.47, 0.19), 0.012, 0.38, 10));
    let rest: Vec<Vec3> = [0.66, 0.74, 0.84]
        .into_iter()
        .flat_map(|y| [(-0.21, 0.17), (-0.1, 0.23), (0.1, 0.23), (0.21, 0.17)].map(|(x, z)| vec3(x, y, z)))
        .collect();
    let rest = sheet(patch(&rest, 4, [12, 4]), [12, 4], 0.015);
    let seat = Shape::cuboid([-0.22, 0.44, -0.22], [0.22, 0.47, 0.22]);
    Shape::joined(legs.into_iter().chain(posts).chain([seat, rest]))
}

fn shelf(model: &mut Model) {
    let white = model.paint("shelf", [0.74, 0.71, 0.65]);
    let (left, right, depth) = (4.35, 5.45, 0.3);
    let uprights = [left, 0.5 * (left + right) - 0.01, right - 0.02];
    let uprights = uprights.map(|x| Shape::cuboid([x, 0.0, 0.0], [x + 0.02, 2.0, depth]));
    let heights = [0.08, 0.46, 0.84, 1.22, 1.6, 1.98];
    let boards = heights.map(|y| {
        [left + 0.02, 0.5 * (left + right) + 0.01]
            .map(|x| Shape::cuboid([x, y, 0.0], [x + 0.5 * (right - left) - 0.03, y + 0.02, depth]))
    });
    model.add("shelf", white, Shape::joined(uprights.into_iter().chain(boards.into_iter().flatten())));
    let colors = [[0.5, 0.12, 0.1], [0.12, 0.22, 0.4], [0.65, 0.55, 0.35], [0.16, 0.32, 0.2], [0.24, 0.2, 0.2]];
    let paints = [0, 1, 2, 3, 4].map(|i| model.paint(&format!("book {}", i + 1), colors[i]));
    let mut books: [Vec<Shape>; 5] = Default::default();
    for (row, y) in heights[..5].iter().enumerate() {
        for (half, start) in [left + 0.025, 0.5 * (left + right) + 0.015].into_iter().enumerate() {
            let mut x = start;
            // Not every compartment is full.
            let end = start + 0.5 * (right - left) - 0.06 - [0.0, 0.17, 0.3][(2 * row + half) % 3];
            for number in 0.. {
                let random =
                    |purpose: u32| (hash(hash(row as u32, half as u32), 7 * number + purpose) % 1000) as f32 / 1000.0;
                let (thickness, height, deep) =
                    (0.02 + 0.025 * random(0), 0.2 + 0.12 * random(1), 0.15 + 0.09 * random(2));
                if x + thickness > end {
                    break;
                }
                let book =
                    Shape::cuboid([x, y + 0.02, depth - 0.03 - deep], [x + thickness, y + 0.02 + height, depth - 0.03]);
                books[(random(3) * 5.0) as usize].push(book);
                x += thickness + 0.001;
            }
        }
    }
    for (number, (paint, books)) in paints.into_iter().zip(books).enumerate() {
        model.add(&format!("books {}", number + 1), paint, Shape::joined(books));
    }
}

fn lamps(model: &mut Model) {
    let brass = model.paint("brass", [0.5, 0.36, 0.16]);
    let paper = model.paint("lamp shade", [0.78, 0.7, 0.56]);
    let bulb = model.glow("warm bulb", [16_000.0, 11_500.0, 6_500.0]);
    let foot = vec3(4.12, 0.0, 0.55);
    let stand: [&[[f32; 2]]; 4] = [
        &[[0.0, 0.0], [0.14, 0.0]],
        &[[0.14, 0.0], [0.14, 0.02], [0.03, 0.02], [0.012, 0.05]],
        &[[0.012, 0.05], [0.012, 1.42]],
        &[[0.012, 1.42], [0.0, 1.42]],
    ];
    model.add("floor lamp", brass, lathe(foot, &stand, [5, 6]));
    let shade: [&[[f32; 2]]; 4] = [
        &[[0.24, 1.36], [0.22, 1.5], [0.15, 1.6], [0.14, 1.7]],
        &[[0.14, 1.7], [0.135, 1.7]],
        &[[0.135, 1.7], [0.145, 1.6], [0.215, 1.5], [0.235, 1.36]],
        &[[0.235, 1.36], [0.24, 1.36]],
    ];
    model.add("floor lamp shade", paper, lathe(foot, &shade, [8, 8]));
    model.add("floor lamp bulb", bulb, Shape::ball(foot + vec3(0.0, 1.48, 0.0), 0.045, 1));
    let hook = vec3(1.45, 0.0, 3.35);
    model.add("cord", brass, Shape::cylinder(hook + vec3(0.0, 1.78, 0.0), 0.004, HEIGHT - 1.78, 6));
    let copper = model.paint("copper", [0.6, 0.3, 0.18]);
    let bell: [&[[f32; 2]]; 5] = [
        &[[0.21, 1.5], [0.2, 1.66], [0.09, 1.68], [0.04, 1.78]],
        &[[0.04, 1.78], [0.0, 1.78]],
        &[[0.0, 1.772], [0.035, 1.772]],
        &[[0.035, 1.772], [0.085, 1.672], [0.194, 1.655], [0.205, 1.5]],
        &[[0.205, 1.5], [0.21, 1.5]],
    ];
    model.add("pendant lamp", copper, lathe(hook, &bell, [8, 8]));
    model.add("pendant bulb", bulb, Shape::ball(hook + vec3(0.0, 1.6, 0.0), 0.04, 1));
    model.point_light("reading light", [5.25, 1.9, 0.9], [40.0, 30.0, 18.0]);
}

fn plant(model: &mut Model) {
    let clay = model.paint("clay", [0.5, 0.25, 0.15]);
    let leaf_green = model.paint("leaf", [0.12, 0.3, 0.08]);
    let foot = vec3(0.55, 0.0, 0.5);
    let pot: [&[[f32; 2]]; 5] = [
        &[[0.0, 0.0], [0.12, 0.0]],
        &[[0.12, 0.0], [0.17, 0.1], [0.15, 0.24], [0.18, 0.3]],
        &[[0.18, 0.3], [0.178, 0.305], [0.165, 0.3]],
        &[[0.165, 0.3], [0.15, 0.27]],
        &[[0.15, 0.27], [0.0, 0.27]],
    ];
    model.add("pot", clay, lathe(foot, &pot, [8, 6]));
    let blade: Vec<Vec3> = [(0.0, 0.012, 0.0), (0.12, 0.16, 0.3), (0.34, 0.12, 0.46), (0.52, 0.004, 0.3)]
        .into_iter()
        .flat_map(|(x, half, y)| [-1.0, 0.0, 1.0].map(|side: f32| vec3(x, y + 0.05 * side.abs(), side * half)))
        .collect();
    let leaf = sheet(patch(&blade, 3, [6, 12]), [6, 12], 0.004);
    let leaves: Vec<Affine3A> = (0..11)
        .map(|i| {
            let (turn, tall) = (2.4 * i as f32, 0.55 + 0.06 * i as f32);
            let lean = Quat::from_rotation_y(turn) * Quat::from_rotation_z(0.12 * (i % 4) as f32);
            let place = foot + vec3(0.0, 0.26, 0.0) + Quat::from_rotation_y(turn) * vec3(0.03, 0.0, 0.0);
            Affine3A::from_scale_rotation_translation(Vec3::splat(tall), lean, place)
        })
        .collect();
    model.add_all("leaf", leaf_green, leaf, &leaves);
}
