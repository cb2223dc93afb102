//! Transparent things, pixel by pixel against the exact composite of the core.

use bevy::core_pipeline::oit::OrderIndependentTransparencySettings;
use bevy::core_pipeline::prepass::{DeferredPrepass, DepthPrepass};
use bevy::prelude::*;
use bevy::render::settings::{Backends, WgpuSettings};
use bevy_radiosity::transparency::{TransparencyPlugin, TransparentDepth, TransparentKey, TransparentOrder};
use radiosity::composite::{Samples, StraightRgba, back_to_front};
use radiosity_tests::panes::{
    self, BACKGROUND, GREEN, Pane, RED, differing, exact, move_to, spawn, swap_two_panes, triangles_of_panes,
    wrong_pixels, wrong_pixels_at_once,
};
use radiosity_tests::render::Studio;

fn studio() -> Option<Studio> {
    let mut studio = plain_studio()?;
    studio.app.add_plugins(TransparencyPlugin);
    Some(studio)
}

fn plain_studio() -> Option<Studio> {
    studio_with(Msaa::Off)
}

fn studio_with(msaa: Msaa) -> Option<Studio> {
    panes::studio(WgpuSettings { backends: Some(Backends::PRIMARY), ..default() }, msaa)
}

fn assert_exact(studio: &mut Studio) {
    let camera = studio.camera;
    assert_eq!(wrong_pixels(studio, camera, Samples::One), 0, "wrong pixels");
}

#[test]
fn moving_pane_changes_places() {
    let Some(mut studio) = studio() else { return };
    assert_eq!(swap_two_panes(&mut studio), [0, 0]);
}

/// What the plugin is for: should this fail, Bevy has learned it.
#[test]
fn plain_bevy_freezes_the_order() {
    let Some(mut studio) = plain_studio() else { return };
    let [before, after] = swap_two_panes(&mut studio);
    assert_eq!(before, 0);
    assert!(after > 500, "{after} wrong pixels after the swap");
}

/// The red pane behind the green one, and both have been drawn so.
fn red_behind_green() -> Option<(Studio, Entity, Entity)> {
    let mut studio = studio()?;
    let red = spawn(&mut studio, RED, Transform::from_xyz(0.1, 0.05, -0.5));
    let green = spawn(&mut studio, GREEN, Transform::from_xyz(-0.1, -0.05, 0.0));
    assert_exact(&mut studio);
    Some((studio, red, green))
}

const BEFORE_GREEN: Vec3 = Vec3::new(0.1, 0.05, 0.5);

#[test]
fn first_frame_after_a_move() {
    let Some((mut studio, red, _)) = red_behind_green() else { return };
    move_to(&mut studio, red, BEFORE_GREEN);
    let camera = studio.camera;
    assert_eq!(wrong_pixels_at_once(&mut studio, camera), 0, "wrong pixels");
}

#[test]
fn first_frame_of_what_moved_unseen() {
    let Some((mut studio, red, green)) = red_behind_green() else { return };
    let camera = studio.camera;
    set(&mut studio, red, Visibility::Hidden);
    drop(studio.picture(camera));
    move_to(&mut studio, red, BEFORE_GREEN);
    drop(studio.picture(camera));
    // It moves once more in the frame in which it is shown, and the other one, which was seen all the time, too.
    move_to(&mut studio, red, BEFORE_GREEN * 0.9);
    move_to(&mut studio, green, vec3(-0.1, -0.05, 0.1));
    set(&mut studio, red, Visibility::Inherited);
    assert_eq!(wrong_pixels_at_once(&mut studio, camera), 0, "wrong pixels");
}

#[test]
fn first_frame_of_a_camera_that_was_off() {
    let Some((mut studio, red, _)) = red_behind_green() else { return };
    let camera = studio.camera;
    let switch = |studio: &mut Studio, is_active| {
        studio.app.world_mut().get_mut::<Camera>(camera).unwrap().is_active = is_active;
    };
    switch(&mut studio, false);
    drop(studio.picture(camera));
    move_to(&mut studio, red, BEFORE_GREEN);
    drop(studio.picture(camera));
    switch(&mut studio, true);
    assert_eq!(wrong_pixels_at_once(&mut studio, camera), 0, "wrong pixels");
}

#[test]
fn first_frame_after_the_order_of_queuing() {
    let Some((mut studio, red, _)) = red_behind_green() else { return };
    let camera = studio.camera;
    set(&mut studio, camera, TransparentDepth::AsQueued);
    move_to(&mut studio, red, BEFORE_GREEN);
    let frozen = wrong_pixels(&mut studio, camera, Samples::One);
    assert!(frozen > 500, "as Bevy alone has it, {frozen} pixels are wrong");
    set(&mut studio, camera, TransparentDepth::Planar);
    assert_eq!(wrong_pixels_at_once(&mut studio, camera), 0, "wrong pixels");
}

/// Colors, sizes and depths without a pattern, from a low-discrepancy sequence.
fn pane(k: usize) -> (Pane, Vec3) {
    let [a, b, c] = [0.754_877_7, 0.569_840_3, 0.430_159_7].map(|step: f32| (0.5 + step * (k + 1) as f32).fract());
    let pane = Pane { rgb: [a, b, c], alpha: 0.3 + 0.5 * b, size: 0.4 + 0.5 * c };
    (pane, vec3(a - 0.5, b - 0.5, 0.8 * (c - 0.5)))
}

#[test]
fn ten_moving_panes() {
    let Some(mut studio) = studio() else { return };
    let panes: Vec<Entity> = (0..10)
        .map(|k| {
            let (pane, place) = pane(k);
            spawn(&mut studio, pane, Transform::from_translation(place))
        })
        .collect();
    for step in 0..6 {
        for (k, &entity) in panes.iter().enumerate() {
            move_to(&mut studio, entity, pane(k + 17 * step).1);
        }
        assert_exact(&mut studio);
    }
}

#[test]
fn late_and_despawned_panes() {
    let Some(mut studio) = studio() else { return };
    let mut panes: Vec<Entity> = (0..5)
        .map(|k| {
            let (pane, place) = pane(k);
            spawn(&mut studio, pane, Transform::from_translation(place))
        })
        .collect();
    assert_exact(&mut studio);
    let (late, place) = pane(5);
    panes.push(spawn(&mut studio, late, Transform::from_translation(place)));
    assert_exact(&mut studio);
    for gone in [0, 2] {
        let gone = panes.remove(gone);
        studio.app.world_mut().despawn(gone);
        assert_exact(&mut studio);
    }
    move_to(&mut studio, panes[0], vec3(0.0, 0.0, 0.6));
    assert_exact(&mut studio);
}

#[test]
fn multisampled() {
    let Some(mut studio) = studio_with(Msaa::Sample4) else { return };
    studio.app.add_plugins(TransparencyPlugin);
    let red = spawn(&mut studio, RED, Transform::from_xyz(0.1, 0.05, -0.5).with_rotation(Quat::from_rotation_z(0.3)));
    spawn(&mut studio, GREEN, Transform::from_xyz(-0.1, -0.05, 0.0).with_rotation(Quat::from_rotation_z(-0.2)));
    let camera = studio.camera;
    assert_eq!(wrong_pixels(&mut studio, camera, Samples::Four), 0);
    move_to(&mut studio, red, vec3(0.1, 0.05, 0.5));
    assert_eq!(wrong_pixels(&mut studio, camera, Samples::Four), 0);
}

/// What is behind for one camera is in front for the other.
#[test]
fn two_cameras() {
    let Some(mut studio) = studio() else { return };
    let behind = Transform::from_xyz(0.3, 0.2, -2.0).looking_at(Vec3::ZERO, Vec3::Y);
    let [first, second] = [studio.camera, studio.add_camera(behind, Msaa::Off)];
    let red = spawn(&mut studio, RED, Transform::from_xyz(0.1, 0.05, -0.5));
    spawn(&mut studio, GREEN, Transform::from_xyz(-0.1, -0.05, 0.0));
    for place in [vec3(0.1, 0.05, -0.5), vec3(0.1, 0.05, 0.5)] {
        move_to(&mut studio, red, place);
        for camera in [first, second] {
            assert_eq!(wrong_pixels(&mut studio, camera, Samples::One), 0, "camera {camera}");
        }
    }
}

#[test]
fn deferred_camera() {
    let Some(mut studio) = studio() else { return };
    let camera = studio.camera;
    studio.app.world_mut().entity_mut(camera).insert((DepthPrepass, DeferredPrepass));
    assert_eq!(swap_two_panes(&mut studio), [0, 0]);
}

/// Order independent transparency stays as it is: exact for panes that cross, which no order of draws is.
#[test]
fn beside_order_independent_transparency() {
    let Some(mut studio) = studio() else { return };
    let camera = studio.camera;
    studio.app.world_mut().entity_mut(camera).insert(OrderIndependentTransparencySettings::default());
    spawn(&mut studio, RED, Transform::from_rotation(Quat::from_rotation_y(0.6)));
    spawn(&mut studio, GREEN, Transform::from_rotation(Quat::from_rotation_y(-0.5)));
    // Colors of its layers have nine bits, and alpha has eight.
    let seen = studio.picture(camera);
    let triangles = triangles_of_panes(&mut studio);
    assert_eq!(differing(&seen, &exact(&studio, camera, Samples::One, &triangles), 0.01), 0);
}

/// The middle of the picture is the composite of these panes, the first at the back.
fn assert_drawn(studio: &mut Studio, panes: &[Pane]) {
    let background = StraightRgba { rgb: BACKGROUND, alpha: 1.0 };
    let layers = panes.iter().map(|pane| StraightRgba { rgb: pane.rgb, alpha: pane.alpha });
    let expected = back_to_front(std::iter::once(background).chain(layers).map(StraightRgba::premultiplied));
    let expected = Vec4::from_array(expected.to_array()).truncate();
    let seen = studio.center();
    assert!(seen.abs_diff_eq(expected, 0.004), "{seen} is seen, and should be {expected}");
}

fn set<C: Component>(studio: &mut Studio, entity: Entity, component: C) {
    studio.app.world_mut().entity_mut(entity).insert(component);
}

#[test]
fn layers_priorities_and_biases() {
    let Some(mut studio) = studio() else { return };
    let red = spawn(&mut studio, RED, Transform::from_xyz(0.0, 0.0, -0.5));
    let green = spawn(&mut studio, GREEN, Transform::default());
    assert_drawn(&mut studio, &[RED, GREEN]);
    set(&mut studio, red, TransparentOrder { layer: 1, ..default() });
    assert_drawn(&mut studio, &[GREEN, RED]);
    set(&mut studio, green, TransparentOrder { layer: 1, priority: 1, ..default() });
    assert_drawn(&mut studio, &[RED, GREEN]);
    set(&mut studio, red, TransparentOrder { layer: 1, priority: 2, ..default() });
    assert_drawn(&mut studio, &[GREEN, RED]);
    set(&mut studio, green, TransparentOrder { layer: 2, priority: -7, ..default() });
    assert_drawn(&mut studio, &[RED, GREEN]);
    studio.app.world_mut().entity_mut(green).remove::<TransparentOrder>();
    set(&mut studio, red, TransparentOrder { bias: 0.4, ..default() });
    assert_drawn(&mut studio, &[RED, GREEN]);
    set(&mut studio, red, TransparentOrder { bias: 0.6, ..default() });
    assert_drawn(&mut studio, &[GREEN, RED]);
    studio.app.world_mut().entity_mut(red).remove::<TransparentOrder>();
    assert_drawn(&mut studio, &[RED, GREEN]);
}

/// A long pane that slants through the scene: its nearest point is before the other pane, its farthest behind.
#[test]
fn keys_of_boxes() {
    let Some(mut studio) = studio() else { return };
    let long = Pane { size: 3.0, ..RED };
    let slant = Transform::from_xyz(0.0, 0.0, -0.3).with_rotation(Quat::from_rotation_y(0.9));
    let red = spawn(&mut studio, long, slant);
    spawn(&mut studio, GREEN, Transform::default());
    assert_drawn(&mut studio, &[RED, GREEN]);
    set(&mut studio, red, TransparentOrder { key: TransparentKey::Nearest, ..default() });
    assert_drawn(&mut studio, &[GREEN, RED]);
    move_to(&mut studio, red, vec3(0.0, 0.0, 0.3));
    set(&mut studio, red, TransparentOrder { key: TransparentKey::Center, ..default() });
    assert_drawn(&mut studio, &[GREEN, RED]);
    set(&mut studio, red, TransparentOrder { key: TransparentKey::Farthest, ..default() });
    assert_drawn(&mut studio, &[RED, GREEN]);
}

/// A mesh whose origin lies behind the other pane, and its center before it.
#[test]
fn key_of_the_origin() {
    let Some(mut studio) = studio() else { return };
    let red = spawn(&mut studio, RED, Transform::from_xyz(0.0, 0.0, -0.5));
    let handle = studio.app.world().get::<Mesh3d>(red).unwrap().0.clone();
    let mut meshes = studio.app.world_mut().resource_mut::<Assets<Mesh>>();
    let moved = meshes.get(&handle).unwrap().clone().translated_by(Vec3::Z);
    meshes.insert(&handle, moved).unwrap();
    spawn(&mut studio, GREEN, Transform::default());
    assert_drawn(&mut studio, &[GREEN, RED]);
    set(&mut studio, red, TransparentOrder { key: TransparentKey::Origin, ..default() });
    assert_drawn(&mut studio, &[RED, GREEN]);
}

/// One pane is farther from the camera, the other from its plane.
#[test]
fn depths_of_cameras() {
    let Some(mut studio) = studio() else { return };
    let camera = studio.camera;
    spawn(&mut studio, RED, Transform::from_xyz(0.0, 0.0, -1.0));
    let wide = Pane { size: 4.0, ..GREEN };
    spawn(&mut studio, wide, Transform::from_xyz(1.6, 0.0, -0.8));
    assert_drawn(&mut studio, &[RED, GREEN]);
    set(&mut studio, camera, TransparentDepth::Radial);
    assert_drawn(&mut studio, &[GREEN, RED]);
    set(&mut studio, camera, TransparentDepth::Along(Dir3::X));
    assert_drawn(&mut studio, &[RED, GREEN]);
    set(&mut studio, camera, TransparentDepth::Along(Dir3::NEG_X));
    assert_drawn(&mut studio, &[GREEN, RED]);
    set(&mut studio, camera, TransparentDepth::Planar);
    assert_drawn(&mut studio, &[RED, GREEN]);
}

/// Panes in one plane, seen by a camera that trembles: rounding makes now one the nearer, now another.
#[test]
fn equal_depths_do_not_flicker() {
    let Some(mut studio) = studio() else { return };
    let camera = studio.camera;
    let turn = Quat::from_euler(EulerRot::XYZ, 0.3, 0.5, 0.0);
    for k in 0..8 {
        let (pane, place) = pane(k);
        let place = turn * vec3(place.x, place.y, 0.0) * 0.3;
        spawn(&mut studio, Pane { size: 1.2, ..pane }, Transform::from_translation(place).with_rotation(turn));
    }
    let mut seen = Vec::new();
    for tremble in 0..8 {
        let away = turn * vec3(0.0, 0.0, 2.0) + turn * Vec3::X * (1e-4 * tremble as f32);
        set(&mut studio, camera, Transform::from_translation(away).with_rotation(turn));
        seen.push(studio.center());
    }
    assert!(seen.iter().all(|pixel| pixel.abs_diff_eq(seen[0], 1e-3)), "{seen:?}");
}
