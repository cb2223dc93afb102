//! Cornell boxes joined by doors: a cube of them, each with two blocks.

use std::f32::consts::{FRAC_PI_2, PI};

use glam::{Affine3A, Quat, Vec3};
use radiosity::geometry::Mesh;
use radiosity::light::{Light, LightSource, PointLight};
use radiosity::material::Material;
use radiosity::scene::{Receiver, Scene, Surface};

/// Side of a room in meters.
const SIDE: f32 = 2.0;
/// From the middle of a door to its side, and its height.
const DOOR: [f32; 2] = [0.4, 1.6];

const FLOOR: usize = 0;
const CEILING: usize = 1;
const WALL: usize = 2;
const WALL_WITH_DOOR: usize = 3;
const BLOCK: usize = 4;

/// `count` rooms in each direction, the sides of their blocks cut into `cuts` x `cuts` squares, and so many lamps.
pub fn rooms(count: usize, cuts: usize, lamps: usize) -> Scene {
    let mut scene = Scene { materials: ["white", "red", "green"].map(paint).into(), ..Default::default() };
    scene.meshes = vec![
        mesh("floor", &[[[-1., 0., 1.], [1., 0., 1.], [1., 0., -1.], [-1., 0., -1.]]]),
        mesh("ceiling", &[[[-1., 2., -1.], [1., 2., -1.], [1., 2., 1.], [-1., 2., 1.]]]),
        mesh("wall", &[upright([-1.0, 1.0], [0.0, SIDE])]),
        mesh(
            "wall with door",
            &[
                upright([-1.0, -DOOR[0]], [0.0, SIDE]),
                upright([-DOOR[0], DOOR[0]], [DOOR[1], SIDE]),
                upright([DOOR[0], 1.0], [0.0, SIDE]),
            ],
        ),
        mesh("block", &block(cuts)),
    ];
    for room in 0..count.pow(3) {
        let place = [room % count, room / count % count, room / count / count];
        add_room(&mut scene, place, count);
    }
    scene.lights = (0..lamps).map(|index| lamp(index, count, lamps)).collect();
    scene
}

fn paint(name: &str) -> Material {
    let [r, g, b] = match name {
        "red" => [0.6, 0.06, 0.05],
        "green" => [0.1, 0.4, 0.1],
        _ => [0.73; 3],
    };
    Material { name: name.into(), base_color: Vec3::new(r, g, b).extend(1.0), ..Default::default() }
}

fn add_room(scene: &mut Scene, place: [usize; 3], count: usize) {
    let room = Affine3A::from_translation(SIDE * Vec3::from(place.map(|index| index as f32)));
    let turned = |quarters: usize| room * Affine3A::from_rotation_y(quarters as f32 * FRAC_PI_2);
    add(scene, FLOOR, 0, room);
    add(scene, CEILING, 0, room);
    // The walls lie towards -z, -x, +z and +x.
    for (quarters, (axis, end, material)) in
        [(2, 0, 0), (0, 0, 1), (2, count - 1, 0), (0, count - 1, 2)].into_iter().enumerate()
    {
        let wall = if place[axis] == end { WALL } else { WALL_WITH_DOOR };
        add(scene, wall, material, turned(quarters));
    }
    for (height, angle, x, z) in [(0.6, 0.3, 0.35, 0.3), (1.2, -0.3, -0.35, -0.3)] {
        let (scale, turn) = (Vec3::new(0.6, height, 0.6), Quat::from_rotation_y(angle));
        add(scene, BLOCK, 0, room * Affine3A::from_scale_rotation_translation(scale, turn, Vec3::new(x, 0.0, z)));
    }
}

fn add(scene: &mut Scene, mesh: usize, material: usize, transform: Affine3A) {
    scene.surfaces.push(Surface {
        name: scene.meshes[mesh].name.clone(),
        mesh,
        material,
        transform,
        receiver: Receiver::Lightmap { density: 1.0 },
        casts: true,
    });
}

/// A lamp below the ceiling of one room after the other; more than one in a room stand on a circle.
fn lamp(index: usize, count: usize, lamps: usize) -> Light {
    let (rooms, room) = (count.pow(3), index % count.pow(3));
    let [x, y, z] = [room % count, room / count % count, room / count / count].map(|index| SIDE * index as f32);
    let (round, rounds) = (index / rooms, lamps.div_ceil(rooms));
    let angle = 2.0 * PI * round as f32 / rounds as f32;
    let radius = if rounds > 1 { 0.7 } else { 0.0 };
    let position = Vec3::new(x + radius * angle.cos(), y + 1.8, z + radius * angle.sin());
    let intensity = Vec3::splat(50.0 / rounds as f32);
    let source = LightSource::Point(PointLight { position, intensity, range: f32::INFINITY, radius: 0.05 });
    Light { name: format!("lamp {index}"), source }
}

/// A rectangle at the far side of a room.
fn upright([left, right]: [f32; 2], [low, high]: [f32; 2]) -> [[f32; 3]; 4] {
    [[left, low, -1.0], [right, low, -1.0], [right, high, -1.0], [left, high, -1.0]]
}

/// The top and the four sides of a cube that stands on the floor.
fn block(cuts: usize) -> Vec<[[f32; 3]; 4]> {
    let side = |index: usize| index as f32 / cuts as f32 - 0.5;
    let square = |turn: Quat, i: usize, j: usize| {
        let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        corners.map(|(i, j)| (turn * Vec3::new(side(i), side(j), 0.5) + 0.5 * Vec3::Y).to_array())
    };
    let sides = (0..4).map(|quarters| Quat::from_rotation_y(quarters as f32 * FRAC_PI_2));
    let faces = sides.chain([Quat::from_rotation_x(-FRAC_PI_2)]);
    faces.flat_map(|turn| (0..cuts * cuts).map(move |k| square(turn, k % cuts, k / cuts))).collect()
}

fn mesh(name: &str, squares: &[[[f32; 3]; 4]]) -> Mesh {
    let positions = squares.as_flattened().iter().map(|&corner| Vec3::from(corner)).collect();
    let triangles = (0..squares.len() as u32).map(|k| 4 * k).flat_map(|i| [[i, i + 1, i + 2], [i, i + 2, i + 3]]);
    Mesh { name: name.into(), positions, triangles: triangles.collect(), ..Default::default() }
}
