//! Panes that no order can draw, cut: pixel by pixel against the exact composite of the core.

use std::f32::consts::{FRAC_PI_2, TAU};

use bevy::camera::visibility::RenderLayers;
use bevy::pbr::Lightmap;
use bevy::prelude::*;
use bevy::render::settings::{Backends, WgpuSettings};
use bevy_radiosity::prelude::*;
use bevy_radiosity::transparency::TransparencyPlugin;
use radiosity::composite::Samples;
use radiosity_tests::bake::bake;
use radiosity_tests::panes::{self, GREEN, Pane, RED, move_to, spawn, wrong_pixels};
use radiosity_tests::render::Studio;

const BLUE: Pane = Pane { rgb: [0.1, 0.2, 0.9], alpha: 0.7, size: 1.0 };

/// Behind the panes and beside them, so that all sides are seen.
const EYES: [Vec3; 4] =
    [Vec3::new(0.0, 0.0, 2.0), Vec3::new(1.3, 0.6, 1.4), Vec3::new(-1.8, 0.2, -0.7), Vec3::new(0.2, -1.5, -1.3)];

fn studio() -> Option<Studio> {
    let mut studio = panes::studio(WgpuSettings { backends: Some(Backends::PRIMARY), ..default() }, Msaa::Off)?;
    studio.app.add_plugins(TransparencyPlugin);
    Some(studio)
}

fn split(studio: &mut Studio, panes: &[Entity]) {
    for &pane in panes {
        studio.app.world_mut().entity_mut(pane).insert(SplitPane);
    }
}

fn look_from(studio: &mut Studio, eye: Vec3) -> usize {
    let camera = studio.camera;
    let place = Transform::from_translation(eye).looking_at(Vec3::ZERO, Vec3::Y);
    studio.app.world_mut().entity_mut(camera).insert(place);
    wrong_pixels(studio, camera, Samples::One)
}

/// At the edges of pieces the renderer and the core may part a pixel differently; a whole pane is thousands of them.
const AT_EDGES: usize = 4;

#[test]
fn crossing_panes() {
    let Some(mut studio) = studio() else { return };
    let red = spawn(&mut studio, RED, Transform::from_rotation(Quat::from_rotation_y(0.6)));
    let green = spawn(&mut studio, GREEN, Transform::from_rotation(Quat::from_rotation_y(-0.5)));
    let whole = look_from(&mut studio, EYES[0]);
    assert!(whole > 200, "whole, {whole} pixels are wrong");
    split(&mut studio, &[red, green]);
    for eye in EYES {
        let wrong = look_from(&mut studio, eye);
        assert!(wrong <= AT_EDGES, "{wrong} wrong pixels from {eye}");
    }
    // They move, and a third one comes between.
    move_to(&mut studio, red, vec3(0.1, 0.1, 0.2));
    let blue = spawn(&mut studio, BLUE, Transform::from_rotation(Quat::from_rotation_x(FRAC_PI_2 - 0.3)));
    split(&mut studio, &[blue]);
    for eye in EYES {
        let wrong = look_from(&mut studio, eye);
        assert!(wrong <= AT_EDGES, "{wrong} wrong pixels from {eye}, with three");
    }
    studio.app.world_mut().despawn(blue);
    let wrong = look_from(&mut studio, EYES[1]);
    assert!(wrong <= AT_EDGES, "{wrong} wrong pixels when one is gone");
}

/// Each over the next at one end and under the one before at the other.
#[test]
fn three_panes_in_a_cycle() {
    let Some(mut studio) = studio() else { return };
    let panes: Vec<Entity> = [RED, GREEN, BLUE]
        .into_iter()
        .enumerate()
        .map(|(k, pane)| {
            let turn = Quat::from_rotation_z(TAU * k as f32 / 3.0);
            let tilt = Quat::from_rotation_y(0.5);
            let place = Transform::from_translation(turn * vec3(0.0, -0.25, 0.0)).with_rotation(turn * tilt);
            spawn(&mut studio, Pane { size: 1.0, ..pane }, place.with_scale(vec3(1.0, 0.4, 1.0)))
        })
        .collect();
    let whole = look_from(&mut studio, EYES[0]);
    assert!(whole > 50, "whole, {whole} pixels are wrong");
    split(&mut studio, &panes);
    for eye in EYES {
        let wrong = look_from(&mut studio, eye);
        assert!(wrong <= AT_EDGES, "{wrong} wrong pixels from {eye}");
    }
}

/// One that is not cut stays between those that are, before and behind them.
#[test]
fn others_stay_between() {
    let Some(mut studio) = studio() else { return };
    let red = spawn(&mut studio, RED, Transform::from_rotation(Quat::from_rotation_y(0.3)));
    let green = spawn(&mut studio, GREEN, Transform::from_rotation(Quat::from_rotation_y(-0.3)));
    split(&mut studio, &[red, green]);
    let blue = spawn(&mut studio, BLUE, Transform::from_xyz(0.0, 0.0, 0.6));
    for z in [0.6, -0.6] {
        move_to(&mut studio, blue, vec3(0.0, 0.0, z));
        let wrong = look_from(&mut studio, EYES[0]);
        assert!(wrong <= AT_EDGES, "{wrong} wrong pixels with the third at {z}");
    }
}

/// Pieces look like their panes, and panes get their meshes back.
#[test]
fn pieces_follow_their_panes() {
    let Some(mut studio) = studio() else { return };
    let red = spawn(&mut studio, RED, Transform::from_rotation(Quat::from_rotation_y(0.6)));
    let green = spawn(&mut studio, GREEN, Transform::from_rotation(Quat::from_rotation_y(-0.5)));
    let mesh = studio.app.world().get::<Mesh3d>(red).unwrap().clone();
    split(&mut studio, &[red, green]);
    let camera = studio.camera;
    drop(studio.picture(camera));
    let pieces: Vec<Entity> = studio.app.world().get::<Children>(red).expect("it is cut").to_vec();
    assert!(pieces.len() > 1);

    let material = studio.app.world().get::<MeshMaterial3d<StandardMaterial>>(green).unwrap().clone();
    let order = TransparentOrder { layer: 3, ..default() };
    studio.app.world_mut().entity_mut(red).insert((material.clone(), order, RenderLayers::from_layers(&[0, 2])));
    drop(studio.picture(camera));
    let pieces: Vec<Entity> = studio.app.world().get::<Children>(red).expect("it is cut").to_vec();
    for &piece in &pieces {
        let piece = studio.app.world().entity(piece);
        assert_eq!(piece.get::<MeshMaterial3d<StandardMaterial>>(), Some(&material));
        assert_eq!(piece.get::<TransparentOrder>(), Some(&order));
        assert!(piece.contains::<RenderLayers>());
    }
    studio.app.world_mut().entity_mut(red).remove::<RenderLayers>();
    drop(studio.picture(camera));
    let pieces: Vec<Entity> = studio.app.world().get::<Children>(red).expect("it is cut").to_vec();
    assert!(pieces.iter().all(|&piece| !studio.app.world().entity(piece).contains::<RenderLayers>()));

    studio.app.world_mut().entity_mut(red).remove::<SplitPane>();
    studio.app.update();
    assert_eq!(studio.app.world().get::<Mesh3d>(red), Some(&mesh));
    assert!(studio.app.world().get::<Children>(red).is_none());
}

/// A bake sees whole panes; their pieces show its light.
#[test]
fn baked_panes_are_cut() {
    let Some(mut studio) = panes::studio(WgpuSettings { backends: Some(Backends::PRIMARY), ..default() }, Msaa::Off)
    else {
        return;
    };
    studio.app.add_plugins(RadiosityPlugins);
    let light = PointLight { intensity: 20_000.0, ..default() };
    studio.app.world_mut().spawn((Baked::default(), light, Transform::from_xyz(0.0, 0.5, 1.5)));
    let panes = [0.6, -0.5].map(|angle| {
        let mesh = Mesh::from(Rectangle::new(1.0, 1.0));
        let world = studio.app.world_mut();
        let mesh = world.resource_mut::<Assets<Mesh>>().add(mesh);
        let glass = StandardMaterial { alpha_mode: AlphaMode::Blend, ..Color::srgba(0.8, 0.5, 0.3, 0.5).into() };
        let glass = world.resource_mut::<Assets<StandardMaterial>>().add(glass);
        let place = Transform::from_rotation(Quat::from_rotation_y(angle));
        world.spawn((Baked::default(), SplitPane, Mesh3d(mesh), MeshMaterial3d(glass), place)).id()
    });
    let camera = studio.camera;
    drop(studio.picture(camera));
    bake(&mut studio.app);
    let lit = studio.picture(camera);
    assert!(lit.iter().any(|pixel| pixel.distance(Vec3::from(panes::BACKGROUND)) > 0.05), "the light shows");
    let world = studio.app.world();
    let lightmaps = panes.map(|pane| world.get::<Lightmap>(pane).expect("each pane has one").clone());
    for (pane, lightmap) in panes.into_iter().zip(lightmaps) {
        for &piece in world.get::<Children>(pane).expect("it is cut") {
            let of_piece = world.get::<Lightmap>(piece).expect("each piece has one");
            assert_eq!((&of_piece.image, of_piece.uv_rect), (&lightmap.image, lightmap.uv_rect));
            let mesh = world.resource::<Assets<Mesh>>().get(&world.get::<Mesh3d>(piece).unwrap().0).unwrap();
            assert!(mesh.contains_attribute(Mesh::ATTRIBUTE_UV_1));
        }
    }
}

/// More panes than there is room for are drawn whole, and nothing is lost.
#[test]
fn too_many_panes() {
    let Some(mut studio) = studio() else { return };
    let panes: Vec<Entity> = (0..40)
        .map(|k| {
            let turn = Quat::from_euler(EulerRot::XYZ, 0.3 * k as f32, 0.7 * k as f32, 0.1);
            spawn(&mut studio, Pane { alpha: 0.4, ..RED }, Transform::from_rotation(turn))
        })
        .collect();
    split(&mut studio, &panes);
    let camera = studio.camera;
    drop(studio.picture(camera));
    assert!(panes.iter().all(|&pane| studio.app.world().get::<Children>(pane).is_none()));
    // Few enough again.
    for &pane in &panes[2..] {
        studio.app.world_mut().despawn(pane);
    }
    let wrong = wrong_pixels(&mut studio, camera, Samples::One);
    assert!(wrong <= AT_EDGES, "{wrong} wrong pixels");
}
