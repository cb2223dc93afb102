//! A bay of a groin vault, and what stands in it: exact surfaces, each a chart of its own.

use std::f32::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

use bevy::prelude::*;
use bevy_radiosity::prelude::*;

/// Half of the side of a bay, in meters.
pub const HALF: f32 = 1.5;
/// Where the vault begins.
pub const SPRINGING: f32 = 1.7;

/// The materials.
pub struct Paints {
    /// Vault and floor.
    pub stone: Handle<StandardMaterial>,
    /// Walls.
    pub plaster: Handle<StandardMaterial>,
    /// What is colored.
    pub clay: Handle<StandardMaterial>,
}

impl Paints {
    /// Matt ones.
    pub fn new(materials: &mut Assets<StandardMaterial>) -> Self {
        let mut paint = |[red, green, blue]: [f32; 3]| {
            materials.add(StandardMaterial {
                base_color: Color::linear_rgb(red, green, blue),
                perceptual_roughness: 1.0,
                reflectance: 0.0,
                ..default()
            })
        };
        Self { stone: paint([0.72, 0.68, 0.6]), plaster: paint([0.74, 0.52, 0.4]), clay: paint([0.15, 0.35, 0.65]) }
    }
}

/// The control points of a vase: radius and height, up on the outside and down on the inside.
pub fn vase() -> SplineCurve {
    let profile = [
        [0.0, 0.0],
        [0.09, 0.0],
        [0.12, 0.01],
        [0.13, 0.06],
        [0.3, 0.2],
        [0.3, 0.42],
        [0.1, 0.55],
        [0.09, 0.66],
        [0.17, 0.72],
        [0.16, 0.73],
        [0.07, 0.66],
        [0.08, 0.54],
        [0.27, 0.4],
        [0.27, 0.22],
        [0.1, 0.04],
        [0.0, 0.04],
    ];
    SplineCurve::open(3, profile.map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec())
}

/// A round plinth, 0.6 m high.
pub fn spawn_plinth(commands: &mut Commands, root: Entity, paints: &Paints, foot: Vec3) {
    let profile = [[0.34, 0.0], [0.34, 0.08], [0.24, 0.12], [0.24, 0.5], [0.3, 0.54], [0.3, 0.6], [0.0, 0.6]];
    let profile = SplineCurve::open(1, profile.map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec());
    commands.spawn((
        Name::new("plinth"),
        SplineSurface::revolution(profile),
        Baked { density: 2.0 },
        MeshMaterial3d(paints.stone.clone()),
        Transform::from_translation(foot),
        ChildOf(root),
    ));
}

/// Floor, two walls and the vault of a bay around the origin of `root`.
pub fn spawn_bay(commands: &mut Commands, root: Entity, paints: &Paints) {
    let floor = [[-HALF, HALF], [HALF, HALF], [-HALF, -HALF], [HALF, -HALF]];
    let floor = ControlNet::bezier(2, floor.map(|[x, z]| Vec3::new(x, 0.0, z)).to_vec());
    let stone = MeshMaterial3d(paints.stone.clone());
    commands.spawn((Name::new("floor"), SplineSurface::from(floor), stone, ChildOf(root)));
    spawn_vault(commands, root, paints);
    spawn_wall(commands, root, paints, 0.0);
    spawn_wall(commands, root, paints, FRAC_PI_2);
}

/// Eight webs; a web is the part of a cylinder between an arch and a groin, along straight lines.
///
/// Both are a quarter turn: the groin, an ellipse, is the arch with its depth set to its width. The webs of an arch meet
/// smoothly at its crown.
pub fn spawn_vault(commands: &mut Commands, root: Entity, paints: &Paints) {
    for side in 0..4 {
        for (half, sign) in [("left", -1.0), ("right", 1.0)] {
            let (arch, groin) = (quarter(sign, |_| HALF), quarter(sign, |across| across));
            // So that the front shows down.
            let (first, last) = if sign > 0.0 { (groin, arch) } else { (arch, groin) };
            commands.spawn((
                Name::new(format!("web {side} {half}")),
                SplineSurface::Ruled { first, last },
                MeshMaterial3d(paints.stone.clone()),
                Transform::from_rotation(Quat::from_rotation_y(FRAC_PI_2 * side as f32)),
                ChildOf(root),
            ));
        }
    }
}

/// A quarter turn from the springing to the crown; `x` of a point follows from how far it is from the middle.
fn quarter(sign: f32, x: impl Fn(f32) -> f32) -> SplineCurve {
    let points = [[HALF, 0.0], [HALF, HALF], [0.0, HALF]];
    let points = points.map(|[across, up]| Vec3::new(x(across), SPRINGING + up, sign * across));
    SplineCurve::bezier(points.to_vec()).with_weights(vec![1.0, FRAC_1_SQRT_2, 1.0])
}

/// A wall up to the arch, turned about the vertical from the back.
pub fn spawn_wall(commands: &mut Commands, root: Entity, paints: &Paints, turn: f32) {
    let rectangle = [[-HALF, 0.0], [HALF, 0.0], [-HALF, SPRINGING], [HALF, SPRINGING]];
    let rectangle = ControlNet::bezier(2, rectangle.map(|[x, y]| Vec3::new(x, y, -HALF)).to_vec());
    let [left, right] = [-1.0, 1.0].map(lunette);
    for (name, surface) in [("wall", rectangle.into()), ("left lunette", left), ("right lunette", right)] {
        commands.spawn((
            Name::new(format!("{name} at {turn:.1}")),
            surface,
            MeshMaterial3d(paints.plaster.clone()),
            Transform::from_rotation(Quat::from_rotation_y(turn)),
            ChildOf(root),
        ));
    }
}

/// A quarter of a disc below the arch of the back wall; the upright in the middle is two of its four edges, so that none
/// is collapsed.
fn lunette(sign: f32) -> SplineSurface {
    let at = |x: f32, up: f32| Vec3::new(sign * x, SPRINGING + up, -HALF);
    let line = |from: [f32; 2], to: [f32; 2]| SplineCurve::bezier([from, to].map(|[x, up]| at(x, up)).to_vec());
    let arc = [[HALF, 0.0], [HALF, HALF], [0.0, HALF]].map(|[x, up]| at(x, up)).to_vec();
    let arc = SplineCurve::bezier(arc).with_weights(vec![1.0, FRAC_1_SQRT_2, 1.0]);
    let (foot, middle, crown, springing) = ([0.0; 2], [0.0, 0.5 * HALF], [0.0, HALF], [HALF, 0.0]);
    let upright = line(foot, middle);
    let edges = match sign > 0.0 {
        true => vec![line(foot, springing), arc, line(middle, crown), upright],
        false => vec![line(springing, foot), upright, line(crown, middle), arc],
    };
    SplineSurface::Coons { edges }
}
