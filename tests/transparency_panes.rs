//! Panes that no order can draw, cut: pixel by pixel against the exact composite of the core.

use std::f32::consts::{FRAC_PI_2, TAU};

use bevy::camera::ScalingMode;
use bevy::camera::visibility::RenderLayers;
use bevy::mesh::{MeshVertexAttribute, VertexAttributeValues};
use bevy::pbr::Lightmap;
use bevy::prelude::*;
use bevy::render::render_resource::VertexFormat;
use bevy::render::settings::{Backends, WgpuSettings};
use bevy_radiosity::prelude::*;
use bevy_radiosity::transparency::{SortedTriangles, TransparencyPlugin};
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

/// Under a parent that is not to scale, and for a camera without perspective.
#[test]
fn crossing_panes_of_a_scaled_parent() {
    let Some(mut studio) = studio() else { return };
    let lens = Projection::Orthographic(OrthographicProjection {
        scaling_mode: ScalingMode::FixedVertical { viewport_height: 1.6 },
        ..OrthographicProjection::default_3d()
    });
    let parallel = studio.add_camera(Transform::default(), (lens, Msaa::Off));
    let place = Transform::from_xyz(0.05, 0.0, 0.1).with_scale(vec3(1.4, 0.7, 0.9));
    let parent = studio.app.world_mut().spawn((place, Visibility::default())).id();
    let red = spawn(&mut studio, RED, Transform::from_rotation(Quat::from_rotation_y(0.6)));
    let green = spawn(&mut studio, GREEN, Transform::from_rotation(Quat::from_rotation_y(-0.5)));
    studio.app.world_mut().entity_mut(parent).add_children(&[red, green]);
    split(&mut studio, &[red, green]);
    for eye in EYES {
        let place = Transform::from_translation(eye).looking_at(Vec3::ZERO, Vec3::Y);
        for camera in [studio.camera, parallel] {
            studio.app.world_mut().entity_mut(camera).insert(place);
            let wrong = wrong_pixels(&mut studio, camera, Samples::One);
            assert!(wrong <= AT_EDGES, "{wrong} wrong pixels from {eye}");
        }
    }
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

/// A pane is drawn before another that it is behind, but keeps its place among other things where it covers nothing of it.
#[test]
fn panes_side_by_side() {
    let Some(mut studio) = studio() else { return };
    // The eye and the near one lie on different sides of the plane of the far one.
    let far =
        Transform::from_xyz(0.6, 0.0, -0.6).with_rotation(Quat::from_rotation_y(1.064)).with_scale(Vec3::splat(0.5));
    let near = Transform::from_xyz(-0.4, 0.0, 0.5).with_scale(Vec3::splat(0.5));
    spawn(&mut studio, Pane { size: 0.6, ..BLUE }, Transform::from_xyz(-0.5, 0.1, 0.0));
    // Whichever is cut first.
    for [first, second] in [[far, near], [near, far]] {
        let panes = [spawn(&mut studio, GREEN, first), spawn(&mut studio, RED, second)];
        assert_eq!(look_from(&mut studio, EYES[0]), 0, "whole");
        split(&mut studio, &panes);
        let wrong = look_from(&mut studio, EYES[0]);
        assert!(wrong <= AT_EDGES, "{wrong} wrong pixels");
        for pane in panes {
            studio.app.world_mut().despawn(pane);
        }
    }
}

/// From the frame on in which a pane is cut.
#[test]
fn pieces_are_seen_at_once() {
    let Some(mut studio) = studio() else { return };
    let red = spawn(&mut studio, RED, Transform::from_rotation(Quat::from_rotation_y(0.6)));
    let green = spawn(&mut studio, GREEN, Transform::from_rotation(Quat::from_rotation_y(-0.5)));
    let camera = studio.camera;
    drop(studio.picture(camera));
    split(&mut studio, &[red, green]);
    studio.app.update();
    assert!(pieces_of(&studio, red).len() > 1);
    for piece in pieces_of(&studio, red) {
        assert!(studio.app.world().get::<ViewVisibility>(piece).is_some_and(|seen| seen.get()));
    }
    studio.app.world_mut().entity_mut(red).insert(Visibility::Hidden);
    studio.app.update();
    for piece in pieces_of(&studio, red) {
        assert!(!studio.app.world().get::<ViewVisibility>(piece).is_some_and(|seen| seen.get()));
    }
}

fn pieces_of(studio: &Studio, pane: Entity) -> Vec<Entity> {
    let children = studio.app.world().get::<Children>(pane).map(|children| children.to_vec());
    children.into_iter().flatten().chain([pane]).collect()
}

/// Whatever an app does to a pane between two frames, it is drawn as a whole.
#[test]
fn panes_are_cut_again() {
    let Some(mut studio) = studio() else { return };
    let red = spawn(&mut studio, RED, Transform::from_rotation(Quat::from_rotation_y(0.6)));
    let green = spawn(&mut studio, GREEN, Transform::from_rotation(Quat::from_rotation_y(-0.5)));
    let given = studio.app.world().get::<Mesh3d>(red).unwrap().clone();
    split(&mut studio, &[red, green]);
    let hold = |studio: &mut Studio, what: &str| {
        let wrong = look_from(studio, EYES[1]);
        assert!(wrong <= AT_EDGES, "{wrong} wrong pixels {what}");
        assert!(studio.app.world().get::<Children>(red).is_some(), "{what} it is cut");
    };
    hold(&mut studio, "at first");
    studio.app.world_mut().entity_mut(red).remove::<SplitPane>().insert(SplitPane);
    hold(&mut studio, "taken away and given back");
    studio.app.world_mut().entity_mut(red).insert(given);
    hold(&mut studio, "with its own mesh given once more");
    studio.app.world_mut().entity_mut(red).despawn_related::<Children>();
    hold(&mut studio, "without its children");
    let pieces = studio.app.world().get::<Children>(red).unwrap().to_vec();
    studio.app.world_mut().despawn(pieces[0]);
    hold(&mut studio, "without one of its children");
    let pieces = studio.app.world().get::<Children>(red).unwrap().to_vec();
    studio.app.world_mut().entity_mut(pieces[0]).remove::<ChildOf>();
    hold(&mut studio, "when a child was taken away");
    let clone = studio.app.world_mut().entity_mut(red).clone_and_spawn();
    move_to(&mut studio, clone, vec3(0.0, 0.1, 0.3));
    hold(&mut studio, "beside its clone");
    studio.app.world_mut().despawn(clone);
    hold(&mut studio, "without its clone");
}

/// A pane that is cut is not sorted, before, with and after the other component.
#[test]
fn panes_with_sorted_triangles() {
    let Some(mut studio) = studio() else { return };
    let red = spawn(&mut studio, RED, Transform::from_rotation(Quat::from_rotation_y(0.6)));
    let green = spawn(&mut studio, GREEN, Transform::from_rotation(Quat::from_rotation_y(-0.5)));
    let given = studio.app.world().get::<Mesh3d>(red).unwrap().clone();
    studio.app.world_mut().entity_mut(red).insert(SortedTriangles { turn: 0.0 });
    look_from(&mut studio, EYES[0]);
    split(&mut studio, &[red, green]);
    for eye in EYES {
        let wrong = look_from(&mut studio, eye);
        assert!(wrong <= AT_EDGES, "{wrong} wrong pixels from {eye}");
    }
    studio.app.world_mut().entity_mut(red).remove::<SortedTriangles>();
    let wrong = look_from(&mut studio, EYES[1]);
    assert!(wrong <= AT_EDGES, "{wrong} wrong pixels without");
    studio.app.world_mut().entity_mut(red).remove::<SplitPane>();
    studio.app.update();
    assert_eq!(studio.app.world().get::<Mesh3d>(red), Some(&given));
}

/// What cannot be cut stays whole, and takes nothing from the others.
#[test]
fn unfit_panes() {
    let Some(mut studio) = studio() else { return };
    let red = spawn(&mut studio, RED, Transform::from_rotation(Quat::from_rotation_y(0.6)));
    let green = spawn(&mut studio, GREEN, Transform::from_rotation(Quat::from_rotation_y(-0.5)));
    let lost = spawn(&mut studio, RED, Transform::from_xyz(f32::NAN, 0.0, 0.0));
    let away = Transform::from_xyz(0.0, 0.0, 50.0);
    let [short, odd] = [(); 2].map(|()| spawn(&mut studio, RED, away));
    let mut meshes = studio.app.world_mut().resource_mut::<Assets<Mesh>>();
    let mut mesh = Mesh::from(Rectangle::new(1.0, 1.0));
    mesh.insert_attribute(Mesh::ATTRIBUTE_UV_0, vec![[0.0, 0.0]; 3]);
    let too_short = meshes.add(mesh);
    let mut mesh = Mesh::from(Rectangle::new(1.0, 1.0));
    let attribute = MeshVertexAttribute::new("Odd", 988_540_917, VertexFormat::Sint32x2);
    mesh.insert_attribute(attribute, VertexAttributeValues::Sint32x2(vec![[0, 0]; 4]));
    let uncuttable = meshes.add(mesh);
    studio.app.world_mut().entity_mut(short).insert(Mesh3d(too_short.clone()));
    studio.app.world_mut().entity_mut(odd).insert(Mesh3d(uncuttable.clone()));
    split(&mut studio, &[red, green, lost, short, odd]);
    let camera = studio.camera;
    drop(studio.picture(camera));
    let world = studio.app.world();
    for (pane, mesh) in [(short, too_short), (odd, uncuttable)] {
        assert_eq!(world.get::<Mesh3d>(pane), Some(&Mesh3d(mesh)));
    }
    assert!(world.get::<Children>(lost).is_none());
    assert!(world.get::<Children>(red).is_some() || world.get::<Children>(green).is_some());
    // Without any change nothing is cut again, the lost one notwithstanding.
    studio.app.world_mut().resource_mut::<Messages<AssetEvent<Mesh>>>().clear();
    studio.app.update();
    let messages = studio.app.world().resource::<Messages<AssetEvent<Mesh>>>();
    assert!(messages.is_empty(), "meshes were written again");
    for pane in [lost, short, odd] {
        studio.app.world_mut().despawn(pane);
    }
    let wrong = look_from(&mut studio, EYES[1]);
    assert!(wrong <= AT_EDGES, "{wrong} wrong pixels");
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
