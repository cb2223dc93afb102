//! The camera, which turns around a point.

use bevy::camera::{Exposure, Hdr};
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::input::mouse::{AccumulatedMouseMotion, AccumulatedMouseScroll, MouseScrollUnit};
use bevy::prelude::*;
use bevy_radiosity::bake::AppliedBake;
use bevy_radiosity::prelude::*;
use radiosity::render::{automatic_ev100, overview};

/// A camera that finds the scene, exposes it, and follows mouse and keys.
pub fn plugin(app: &mut App) {
    app.add_systems(Startup, spawn)
        .add_systems(Update, (turn, move_along, end))
        // Scenes are spawned before it.
        .add_systems(PostUpdate, switch_off_others)
        .add_observer(see_all)
        .add_observer(expose);
}

/// Where the camera stands.
#[derive(Component, Clone, Copy)]
pub struct Orbit {
    /// The point that stays in the middle of the picture.
    focus: Vec3,
    /// From the eye to the focus, in meters.
    distance: f32,
}

fn spawn(mut commands: Commands) {
    let lens = PerspectiveProjection { near: 0.01, ..default() };
    commands.spawn((
        Camera3d::default(),
        Projection::from(lens),
        Hdr,
        Tonemapping::KhronosPbrNeutral,
        Orbit { focus: Vec3::ZERO, distance: 1.0 },
    ));
}

/// The file may bring cameras along, which are looked through once, and then not used.
fn switch_off_others(mut others: Query<&mut Camera, (Added<Camera>, Without<Orbit>)>) {
    for mut camera in &mut others {
        camera.is_active = false;
    }
}

/// The cameras of the scene.
type Others = (With<Camera>, Without<Orbit>);

/// Takes the place of the first camera of the scene, or one from which all of it is to be seen.
fn see_all(
    started: On<BakeStarted>,
    ours: Single<(&mut Orbit, &mut Transform, &mut Projection)>,
    others: Query<(&GlobalTransform, &Projection), Others>,
) {
    let (mut orbit, mut transform, mut lens) = ours.into_inner();
    let all = overview(&started.collected.scene);
    let (pose, fov) = match others.iter().next() {
        Some((pose, Projection::Perspective(lens))) => (pose.compute_transform(), lens.fov),
        Some((pose, _)) => (pose.compute_transform(), all.fov_y),
        None => (Transform::from_matrix(all.transform.into()), all.fov_y),
    };
    *transform = pose.with_scale(Vec3::ONE);
    orbit.distance = distance(&started, pose);
    orbit.focus = transform.translation + transform.forward() * orbit.distance;
    if let Projection::Perspective(lens) = &mut *lens {
        lens.fov = fov;
    }
}

/// To the middle of the scene, as far as it lies ahead.
fn distance(started: &BakeStarted, eye: Transform) -> f32 {
    let (low, high) = radiosity::scene::World::new(&started.collected.scene).bounds();
    let ahead = (low.midpoint(high) - eye.translation).dot(*eye.forward());
    ahead.max(0.1 * (high - low).length())
}

/// As the core exposes its pictures.
fn expose(_: On<BakeDone>, applied: Res<AppliedBake>, camera: Single<Entity, With<Orbit>>, mut commands: Commands) {
    let ev100 = automatic_ev100(&applied.bake.images);
    info!("exposed with EV100 {ev100:.1}");
    commands.entity(*camera).insert(Exposure { ev100 });
}

fn turn(
    camera: Single<(&mut Orbit, &mut Transform)>,
    buttons: Res<ButtonInput<MouseButton>>,
    motion: Res<AccumulatedMouseMotion>,
    scroll: Res<AccumulatedMouseScroll>,
) {
    let (mut orbit, mut transform) = camera.into_inner();
    let lines = match scroll.unit {
        MouseScrollUnit::Line => scroll.delta.y,
        MouseScrollUnit::Pixel => scroll.delta.y / 50.0,
    };
    orbit.distance *= 0.9_f32.powf(lines);
    let (mut yaw, mut pitch, _) = transform.rotation.to_euler(EulerRot::YXZ);
    if buttons.pressed(MouseButton::Left) {
        yaw -= 0.005 * motion.delta.x;
        pitch = (pitch - 0.005 * motion.delta.y).clamp(-1.55, 1.55);
    }
    if buttons.pressed(MouseButton::Right) {
        let across = transform.right() * -motion.delta.x + transform.up() * motion.delta.y;
        let step = 0.001 * orbit.distance * across;
        orbit.focus += step;
    }
    transform.rotation = Quat::from_euler(EulerRot::YXZ, yaw, pitch, 0.0);
    transform.translation = orbit.focus - transform.forward() * orbit.distance;
}

fn move_along(camera: Single<(&mut Orbit, &Transform)>, keys: Res<ButtonInput<KeyCode>>, time: Res<Time>) {
    let (mut orbit, transform) = camera.into_inner();
    let directions = [
        (KeyCode::KeyW, transform.forward()),
        (KeyCode::KeyS, transform.back()),
        (KeyCode::KeyA, transform.left()),
        (KeyCode::KeyD, transform.right()),
        (KeyCode::KeyQ, Dir3::NEG_Y),
        (KeyCode::KeyE, Dir3::Y),
    ];
    let pressed = directions.into_iter().filter(|(key, _)| keys.pressed(*key));
    let direction: Vec3 = pressed.map(|(_, direction)| *direction).sum();
    let step = orbit.distance * time.delta_secs() * direction;
    orbit.focus += step;
}

fn end(keys: Res<ButtonInput<KeyCode>>, mut exit: MessageWriter<AppExit>) {
    if keys.just_pressed(KeyCode::Escape) {
        exit.write(AppExit::Success);
    }
}
