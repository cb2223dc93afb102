//! A camera flies along a closed curve through baked bays, at constant speed; lamps hang at equal distances on another.

#[path = "../spline_vase/model.rs"]
mod model;
#[path = "../spline_vase/screenshot.rs"]
mod screenshot;
#[path = "../viewer/windowless.rs"]
mod windowless;

use std::f32::consts::FRAC_PI_2;

use bevy::camera::{Exposure, Hdr};
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::prelude::*;
use bevy_radiosity::prelude::*;

use crate::model::{HALF, Paints, spawn_bay, spawn_plinth, spawn_vault, spawn_wall, vase};

const HELP: &str = "\
spline_rail [--screenshot FILE.png]

  Escape: end
  --screenshot: without a window, bakes, writes a picture, and ends";

/// Bays in a row, towards +Z.
const BAYS: usize = 3;
/// Meters per second.
const SPEED: f32 = 0.8;

fn main() -> AppExit {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let mut app = App::new();
    match &words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => {
            println!("{HELP}");
            app.add_plugins(DefaultPlugins).add_systems(Update, end);
        }
        ["--screenshot", path] => {
            app.add_plugins(windowless::without_window(DefaultPlugins.build()));
            // In the picture it has flown for some meters, whatever the time.
            app.add_plugins(screenshot::plugin(path.into())).add_systems(PostStartup, stand_still);
        }
        _ => {
            eprintln!("{HELP}");
            return AppExit::from_code(2);
        }
    }
    let resolution = Resolution::TexelsPerMeter(24.0);
    app.add_plugins(RadiosityPlugins)
        .insert_resource(BakeSettings { quality: Quality::Draft, resolution, uv: UvMode::Keep, ..default() })
        .insert_resource(GlobalAmbientLight::NONE)
        .insert_resource(ClearColor(Color::BLACK))
        .add_systems(Startup, spawn)
        .add_observer(fail)
        .run()
}

fn spawn(mut commands: Commands, mut materials: ResMut<Assets<StandardMaterial>>) {
    let paints = Paints::new(&mut materials);
    let root = commands.spawn((BakeOnLoad, Transform::default(), Visibility::default())).id();
    for number in 0..BAYS {
        let z = 2.0 * HALF * number as f32;
        let bay = commands.spawn((Transform::from_xyz(0.0, 0.0, z), Visibility::default(), ChildOf(root))).id();
        spawn_bay_between(&mut commands, bay, &paints, number);
        // Beside the way, now left, now right.
        let place = Vec3::new(if number % 2 == 0 { 0.7 } else { -0.7 }, 0.0, 0.0);
        spawn_plinth(&mut commands, bay, &paints, place);
        commands.spawn((
            Name::new("vase"),
            SplineSurface::revolution(vase()),
            MeshMaterial3d(paints.clay.clone()),
            Transform::from_translation(place + 0.6 * Vec3::Y),
            ChildOf(bay),
        ));
    }
    spawn_lamps(&mut commands, root, &paints);
    spawn_camera(&mut commands);
}

/// The first bay has a back wall, the last one a front wall, each both sides.
fn spawn_bay_between(commands: &mut Commands, bay: Entity, paints: &Paints, number: usize) {
    if number == 0 {
        spawn_bay(commands, bay, paints);
    } else {
        let floor = [[-HALF, HALF], [HALF, HALF], [-HALF, -HALF], [HALF, -HALF]];
        let floor = ControlNet::bezier(2, floor.map(|[x, z]| Vec3::new(x, 0.0, z)).to_vec());
        let stone = MeshMaterial3d(paints.stone.clone());
        commands.spawn((Name::new("floor"), SplineSurface::from(floor), stone, ChildOf(bay)));
        spawn_vault(commands, bay, paints);
        spawn_wall(commands, bay, paints, FRAC_PI_2);
    }
    spawn_wall(commands, bay, paints, -FRAC_PI_2);
    if number == BAYS - 1 {
        spawn_wall(commands, bay, paints, 2.0 * FRAC_PI_2);
    }
}

/// A rail on a wavy curve below the crown, and lamps below it.
fn spawn_lamps(commands: &mut Commands, root: Entity, paints: &Paints) {
    let length = 2.0 * HALF * (BAYS - 1) as f32;
    let wave = |k: usize| {
        let share = k as f32 / 8.0;
        Vec3::new(0.5 * (9.0 * share).sin(), 2.75 + 0.08 * (7.0 * share).cos(), -0.8 + (length + 1.6) * share)
    };
    let curve = SplineCurve::open(3, (0..=8).map(wave).collect());
    let rail = SplineSweep::Tube { radius: 0.012 };
    commands.spawn((Name::new("rail"), curve.clone(), rail, MeshMaterial3d(paints.clay.clone()), ChildOf(root)));
    let light = PointLight { color: Color::linear_rgb(1.0, 0.82, 0.6), intensity: 900.0, radius: 0.02, ..default() };
    let lamps = LightsAlong { count: 9, light: LightAlong::Point(light) };
    commands.spawn((Name::new("lamp"), curve, lamps, Transform::from_xyz(0.0, -0.08, 0.0), ChildOf(root)));
}

fn spawn_camera(commands: &mut Commands) {
    let far = 2.0 * HALF * (BAYS - 1) as f32;
    let points = [
        [-0.5, 1.3, -0.6],
        [-0.75, 1.1, 0.4 * far],
        [0.6, 1.6, 0.6 * far],
        [-0.4, 1.4, far + 0.4],
        [0.6, 1.3, far + 0.6],
        [0.75, 1.9, 0.55 * far],
        [-0.6, 1.5, 0.3 * far],
        [0.3, 1.2, -0.7],
    ];
    let way = commands.spawn((Name::new("way"), SplineCurve::closed(3, points.map(Vec3::from).to_vec()))).id();
    commands.spawn((
        Camera3d::default(),
        TravelAlong::new(way, SPEED),
        Projection::from(PerspectiveProjection { fov: 1.1, near: 0.01, ..default() }),
        Exposure { ev100: 6.3 },
        Hdr,
        Tonemapping::KhronosPbrNeutral,
        Msaa::Off,
    ));
}

fn stand_still(mut travel: Single<&mut TravelAlong>) {
    (travel.speed, travel.distance) = (0.0, 7.4);
}

fn end(keys: Res<ButtonInput<KeyCode>>, mut exit: MessageWriter<AppExit>) {
    if keys.just_pressed(KeyCode::Escape) {
        exit.write(AppExit::Success);
    }
}

fn fail(failed: On<BakeFailed>, mut exit: MessageWriter<AppExit>) {
    error!("{}", failed.error);
    exit.write(AppExit::error());
}
