//! A colonnade under the sun: columns with smooth normals, steps, a wall, a luminous sky.

use bevy::math::{Affine3A, Quat, Vec3, vec2, vec3};

use crate::model::{Exhibit, Model, camera};
use crate::shape::Shape;
use crate::spline::lathe;

/// Top of the steps.
const BASE: f32 = 0.45;
const COLUMNS: usize = 7;

/// The colonnade.
pub fn exhibit() -> Exhibit {
    let mut model = Model::default();
    ground(&mut model);
    columns(&mut model);
    wall(&mut model);
    sky(&mut model);
    model.seen_by("colonnade", camera(vec3(9.2, 1.75, 4.6), vec3(-0.8, 2.25, -1.2), 46.0), 12.0, 16.0)
}

fn ground(model: &mut Model) {
    let paving = model.paint("paving", [0.46, 0.41, 0.34]);
    let marble = model.paint("marble", [0.72, 0.68, 0.61]);
    let tiles = model.paint("tiles", [0.42, 0.2, 0.14]);
    let rectangle = |x: [f32; 2], z: [f32; 2], y: f32| {
        Shape::quad([vec3(x[0], y, z[1]), vec3(x[1], y, z[1]), vec3(x[1], y, z[0]), vec3(x[0], y, z[0])])
    };
    model.add("plaza", paving, rectangle([-11.0, 11.0], [-6.0, 9.0], 0.0));
    for (number, out) in [0.9, 0.6, 0.3].into_iter().enumerate() {
        let (low, high) = (0.15 * number as f32, 0.15 * (number + 1) as f32);
        let step = Shape::cuboid([-9.0 - out, low, -4.0], [9.0 + out, high, 0.5 + out]);
        model.add(&format!("step {}", number + 1), marble, step);
    }
    // A runner of tiles, a finger's breadth above the marble.
    model.add("tiles", tiles, Shape::cuboid([-8.6, BASE, -3.3], [8.6, BASE + 0.015, -1.1]));
}

fn columns(model: &mut Model) {
    let marble = model.paint("column marble", [0.74, 0.7, 0.62]);
    let profiles: [&[[f32; 2]]; 7] = [
        // The torus of the base.
        &[[0.34, 0.12], [0.43, 0.12], [0.43, 0.26], [0.34, 0.26]],
        &[[0.34, 0.26], [0.3, 0.27], [0.29, 0.3], [0.285, 0.36]],
        // The shaft, with its entasis.
        &[[0.285, 0.36], [0.295, 1.6], [0.27, 2.6], [0.235, 3.34]],
        &[[0.235, 3.34], [0.265, 3.35], [0.265, 3.41], [0.235, 3.42]],
        &[[0.235, 3.42], [0.235, 3.46]],
        // The echinus of the capital.
        &[[0.235, 3.46], [0.26, 3.55], [0.34, 3.57], [0.36, 3.64]],
        &[[0.36, 3.64], [0.0, 3.64]],
    ];
    let round = lathe(Vec3::ZERO, &profiles, [6, 7]);
    let plinth = Shape::cuboid([-0.44, 0.0, -0.44], [0.44, 0.12, 0.44]);
    let abacus = Shape::cuboid([-0.4, 3.64, -0.4], [0.4, 3.78, 0.4]);
    let places: Vec<Affine3A> =
        (0..COLUMNS).map(|i| Affine3A::from_translation(vec3(2.75 * (i as f32 - 3.0), BASE, 0.0))).collect();
    model.add_all("column", marble, Shape::joined([round, plinth, abacus]), &places);
    let beam = model.paint("beam", [0.68, 0.63, 0.55]);
    let top = BASE + 3.78;
    model.add("architrave", beam, Shape::cuboid([-9.2, top, -0.36], [9.2, top + 0.42, 0.36]));
    model.add("frieze", beam, Shape::cuboid([-9.2, top + 0.42, -0.32], [9.2, top + 0.8, 0.32]));
    model.add("cornice", beam, Shape::cuboid([-9.45, top + 0.8, -4.0], [9.45, top + 0.98, 0.6]));
    let dentils = (0..74).map(|i| {
        let x = -9.1 + 0.25 * i as f32;
        Shape::cuboid([x, top + 0.68, 0.32], [x + 0.13, top + 0.8, 0.44])
    });
    model.add("dentils", beam, Shape::joined(dentils));
}

/// The back wall with niches, benches and urns.
fn wall(model: &mut Model) {
    let ochre = model.paint("ochre plaster", [0.66, 0.42, 0.22]);
    let niche_paint = model.paint("niche", [0.5, 0.16, 0.1]);
    let stone = model.paint("bench", [0.62, 0.58, 0.52]);
    let height = 0.8 + 3.78;
    let center = |i: usize| 2.75 * (i as f32 - 2.5);
    let openings: Vec<_> =
        (0..6).map(|i| [vec2(9.2 + center(i) - 0.55, 0.75), vec2(9.2 + center(i) + 0.55, 2.75)]).collect();
    let origin = vec3(-9.2, BASE, -3.6);
    model.add("back wall", ochre, Shape::wall(origin, Vec3::X, 18.4, height, &openings));
    let niche = openings.iter().map(|[low, high]| {
        let at = |u: f32, v: f32| origin + vec3(u, v, 0.0);
        let corners = [at(low.x, low.y), at(high.x, low.y), at(high.x, high.y), at(low.x, high.y)];
        let depth = vec3(0.0, 0.0, -0.38);
        Shape::joined([Shape::reveal(corners, depth), Shape::quad(corners.map(|corner| corner + depth))])
    });
    model.add("niches", niche_paint, Shape::joined(niche));
    let end = |x: f32, along: Vec3, z: f32| Shape::wall(vec3(x, BASE, z), along, 0.4, height, &[]);
    model.add("wall ends", ochre, Shape::joined([end(9.2, Vec3::NEG_Z, -3.6), end(-9.2, Vec3::Z, -4.0)]));
    let bench = Shape::joined([
        Shape::cuboid([-0.8, 0.36, -0.2], [0.8, 0.44, 0.2]),
        Shape::cuboid([-0.65, 0.0, -0.16], [-0.5, 0.36, 0.16]),
        Shape::cuboid([0.5, 0.0, -0.16], [0.65, 0.36, 0.16]),
    ]);
    let benches = [1, 3].map(|i| Affine3A::from_translation(vec3(center(i), BASE, -3.3)));
    model.add_all("bench", stone, bench, &benches);
    let clay = model.paint("terracotta", [0.55, 0.28, 0.17]);
    let urn: [&[[f32; 2]]; 6] = [
        &[[0.0, 0.0], [0.16, 0.0]],
        &[[0.16, 0.0], [0.16, 0.06], [0.06, 0.08], [0.1, 0.14]],
        &[[0.1, 0.14], [0.34, 0.3], [0.34, 0.6], [0.15, 0.7]],
        &[[0.15, 0.7], [0.11, 0.74], [0.13, 0.8], [0.22, 0.82]],
        &[[0.22, 0.82], [0.22, 0.84], [0.18, 0.84]],
        &[[0.18, 0.84], [0.1, 0.76], [0.05, 0.7], [0.0, 0.7]],
    ];
    let places = [0, 2, 4, 5].map(|i| {
        let turn = Quat::from_rotation_y(0.3 * i as f32);
        Affine3A::from_rotation_translation(turn, vec3(center(i), BASE + 0.75, -3.78))
    });
    let places = places.map(|mut place| {
        place.matrix3 *= 0.72;
        place
    });
    model.add_all("urn", clay, lathe(Vec3::ZERO, &urn, [8, 10]), &places);
}

/// A luminous panel above and one at the end, out of the way of the sun.
fn sky(model: &mut Model) {
    let blue = model.glow("sky", [3000.0, 4000.0, 5600.0]);
    let haze = model.glow("haze", [4200.0, 4800.0, 5600.0]);
    let above = [vec3(-11.0, 14.0, 6.0), vec3(9.0, 14.0, 6.0), vec3(9.0, 14.0, -6.0), vec3(-11.0, 14.0, -6.0)];
    model.add("sky", blue, Shape::quad(above).turned());
    let end = Shape::wall(vec3(-11.0, 0.0, 9.0), Vec3::NEG_Z, 22.0, 14.0, &[]);
    model.add("haze", haze, end);
    model.sun(vec3(-0.27, -0.6, -0.72), [38_000.0, 34_000.0, 28_000.0]);
}
