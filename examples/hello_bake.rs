//! A few cubes under a lamp, baked when the app starts.

use bevy::prelude::*;
use bevy_radiosity::prelude::*;

fn main() {
    App::new()
        .add_plugins((DefaultPlugins, RadiosityPlugins))
        .insert_resource(BakeSettings { quality: Quality::Draft, ..default() })
        .add_systems(Startup, (spawn_room, spawn_camera))
        .add_systems(Update, swing)
        .run();
}

/// Everything below `BakeOnLoad` is baked, the lamp too.
fn spawn_room(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    let wall = Mesh3d(meshes.add(Plane3d::default().mesh().size(4.0, 4.0)));
    let cube = Mesh3d(meshes.add(Cuboid::default()));
    let mut paint = |color: Srgba| MeshMaterial3d(materials.add(Color::from(color)));
    let white = paint(Srgba::gray(0.85));
    let upright = Quat::from_rotation_x(std::f32::consts::FRAC_PI_2);
    let to_the_right = Quat::from_rotation_z(-std::f32::consts::FRAC_PI_2);
    commands.spawn((
        BakeOnLoad,
        Transform::default(),
        Visibility::default(),
        children![
            (wall.clone(), white.clone()),
            (wall.clone(), white.clone(), Transform::from_xyz(0.0, 2.0, -2.0).with_rotation(upright)),
            (wall, paint(Srgba::rgb(0.8, 0.2, 0.1)), Transform::from_xyz(-2.0, 2.0, 0.0).with_rotation(to_the_right)),
            (cube.clone(), white, Transform::from_xyz(-1.0, 0.5, -1.0).with_rotation(Quat::from_rotation_y(0.3))),
            (cube.clone(), paint(Srgba::rgb(0.2, 0.5, 0.2)), Transform::from_xyz(1.0, 0.5, -0.9)),
            (cube, paint(Srgba::rgb(0.2, 0.3, 0.8)), Transform::from_xyz(-0.3, 0.25, 0.8).with_scale(Vec3::splat(0.5))),
            (PointLight { intensity: 300_000.0, radius: 0.15, ..default() }, Transform::from_xyz(0.6, 3.0, 0.8)),
        ],
    ));
}

fn spawn_camera(mut commands: Commands) {
    commands.spawn(Camera3d::default());
}

/// To and fro, so that the open sides of the room stay in front.
fn swing(mut cameras: Query<&mut Transform, With<Camera3d>>, time: Res<Time>) {
    let angle = 0.8 + 0.5 * (0.3 * time.elapsed_secs()).sin();
    let eye = Vec3::new(7.0 * angle.sin(), 3.0, 7.0 * angle.cos());
    for mut transform in &mut cameras {
        *transform = Transform::from_translation(eye).looking_at(1.5 * Vec3::Y, Vec3::Y);
    }
}
