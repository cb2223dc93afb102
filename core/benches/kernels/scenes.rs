//! What the kernels work on: the Cornell box, and a hall of balls with 100 000 triangles.

use core::f32::consts::{PI, TAU};

use glam::{Affine3A, Vec3};
use radiosity::geometry::{Mesh, Ray, Sobol, cosine_direction, hash};
use radiosity::light::{Light, LightSource, PointLight};
use radiosity::material::Material;
use radiosity::scene::{Receiver, Scene, Surface};

/// Quads around a ball and from pole to pole.
const AROUND: u32 = 64;
const DOWN: u32 = 32;
/// Balls along each side of the floor of the hall.
const BALLS: u32 = 5;

/// Some 100 000 triangles: 25 balls in a box of 6 x 3 x 6 m with a lamp.
pub fn hall() -> Scene {
    let mut scene = Scene { meshes: vec![ball(), room()], materials: vec![white()], ..Default::default() };
    let placed = |name: &str, mesh, place: Vec3| Surface {
        name: name.into(),
        mesh,
        material: 0,
        transform: Affine3A::from_translation(place),
        receiver: Receiver::Lightmap { density: 1.0 },
        casts: true,
    };
    scene.surfaces.push(placed("room", 1, Vec3::ZERO));
    for k in 0..BALLS * BALLS {
        let [x, z] = [k % BALLS, k / BALLS].map(|cell| cell as f32 + 1.0);
        scene.surfaces.push(placed("ball", 0, Vec3::new(x, 0.5, z)));
    }
    let lamp =
        PointLight { position: Vec3::new(3.3, 2.5, 2.9), intensity: Vec3::splat(100.0), range: 100.0, radius: 0.1 };
    scene.lights.push(Light { name: "lamp".into(), source: LightSource::Point(lamp) });
    scene
}

/// One smooth ball: many charts that belong together.
pub fn one_ball() -> Scene {
    let mut scene = hall();
    scene.surfaces.truncate(2);
    scene
}

fn white() -> Material {
    Material { base_color: Vec3::splat(0.7).extend(1.0), ..Default::default() }
}

fn ball() -> Mesh {
    let point = |column: u32, row: u32| {
        let (angle, height) = (TAU * column as f32 / AROUND as f32, PI * row as f32 / DOWN as f32);
        Vec3::new(height.sin() * angle.cos(), height.cos(), -height.sin() * angle.sin())
    };
    let normals: Vec<Vec3> = (0..=DOWN).flat_map(|row| (0..AROUND).map(move |column| point(column, row))).collect();
    let vertex = |column: u32, row: u32| row * AROUND + column % AROUND;
    let quads = (0..DOWN).flat_map(|row| (0..AROUND).map(move |column| (column, row)));
    let halves = quads.flat_map(|(column, row)| {
        let [a, b] = [vertex(column, row), vertex(column, row + 1)];
        let [c, d] = [vertex(column + 1, row + 1), vertex(column + 1, row)];
        [(row + 1 < DOWN).then_some([a, b, c]), (row > 0).then_some([a, c, d])]
    });
    let triangles = halves.flatten().collect();
    let positions = normals.iter().map(|normal| *normal * 0.4).collect();
    Mesh { name: "ball".into(), positions, normals, triangles, ..Default::default() }
}

/// A box seen from inside, from the origin to (6, 3, 6).
fn room() -> Mesh {
    let corner = |k: u32| Vec3::new((k & 1) as f32 * 6.0, (k >> 1 & 1) as f32 * 3.0, (k >> 2) as f32 * 6.0);
    let faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles = (0..6_u32).flat_map(|face| [[0, 1, 2], [0, 2, 3]].map(|half: [u32; 3]| half.map(|k| 4 * face + k)));
    let positions = faces.iter().flatten().map(|&k| corner(k)).collect();
    Mesh { name: "room".into(), positions, triangles: triangles.collect(), ..Default::default() }
}

/// Rays as a tile of texels sends them: from points side by side on a floor in nearly the same directions, in turn.
pub fn coherent(low: Vec3, high: Vec3, count: u32) -> Vec<Ray> {
    let size = high - low;
    let ray = |k: u32| {
        let (tile, texel, turn) = (k / 1024, k % 64, k / 64 % 16);
        let corner = Sobol::new(7).square(tile);
        let place = corner * 0.9 + glam::Vec2::new((texel % 8) as f32, (texel / 8) as f32) * 1e-3;
        let origin = low + size * Vec3::new(place.x, 1e-3, place.y);
        Ray { origin, direction: cosine_direction(Sobol::new(tile).square(turn), Vec3::Y), end: f32::INFINITY }
    };
    (0..count).map(ray).collect()
}

/// Rays from anywhere to anywhere.
pub fn incoherent(low: Vec3, high: Vec3, count: u32) -> Vec<Ray> {
    let ray = |k: u32| {
        let sequence = Sobol::new(hash(11, k));
        let numbers: [f32; 3] = core::array::from_fn(|dimension| sequence.dimension(0, dimension));
        let direction = cosine_direction(sequence.square(1), if k.is_multiple_of(2) { Vec3::Y } else { Vec3::NEG_Y });
        Ray { origin: low + (high - low) * Vec3::from_array(numbers), direction, end: f32::INFINITY }
    };
    (0..count).map(ray).collect()
}
