//! How far the bake is: a bar at the lower edge of the window, and the title of the window.

use bevy::prelude::*;
use bevy::window::PrimaryWindow;
use bevy_radiosity::prelude::*;

use crate::camera::Orbit;

/// Before the camera, in meters; all else is behind it.
const DEPTH: f32 = 0.011;

/// From the start of the bake to its end.
pub fn plugin(app: &mut App) {
    app.add_observer(spawn).add_observer(grow).add_observer(finish);
}

#[derive(Component)]
struct Bar;

fn spawn(
    _: On<BakeStarted>,
    camera: Single<Entity, With<Orbit>>,
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    let color = Color::srgb(0.3, 0.8, 0.3);
    let material = MeshMaterial3d(materials.add(StandardMaterial { unlit: true, ..color.into() }));
    let bar = (Bar, Mesh3d(meshes.add(Rectangle::new(1.0, 1.0))), material, Transform::from_scale(Vec3::ZERO));
    commands.entity(*camera).with_child(bar);
}

fn grow(
    progress: On<BakeProgress>,
    mut bar: Single<&mut Transform, With<Bar>>,
    lens: Single<&Projection, With<Orbit>>,
    mut window: Single<&mut Window, With<PrimaryWindow>>,
) {
    let Projection::Perspective(lens) = *lens else { return };
    let height = 2.0 * DEPTH * (0.5 * lens.fov).tan();
    let width = height * lens.aspect_ratio;
    bar.scale = Vec3::new(width * progress.done, 0.02 * height, 1.0);
    bar.translation = Vec3::new(-0.5 * (1.0 - progress.done) * width, -0.49 * height, -DEPTH);
    let BakeProgress { stage, done, remaining_seconds, .. } = *progress;
    window.title = format!("viewer: {stage}, {:.0} %, {remaining_seconds:.0} s to go", 100.0 * done);
}

fn finish(
    done: On<BakeDone>,
    bar: Single<Entity, With<Bar>>,
    mut window: Single<&mut Window, With<PrimaryWindow>>,
    mut commands: Commands,
) {
    let report = &done.report;
    window.title = format!("viewer: {} texels in {} lightmaps", report.texels, report.images);
    commands.entity(*bar).despawn();
}
