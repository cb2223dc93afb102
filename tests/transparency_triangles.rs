//! The triangles within a transparent mesh, pixel by pixel against the exact composite of the core.

use bevy::asset::RenderAssetUsages;
use bevy::camera::visibility::RenderLayers;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use bevy::render::settings::{Backends, WgpuSettings};
use bevy_radiosity::transparency::{SortedTriangles, TransparencyPlugin};
use radiosity::composite::{Samples, StraightRgba};
use radiosity_tests::panes::{self, CLOSE, ColoredTriangle, differing, exact};
use radiosity_tests::render::Studio;

/// Squares of different colors in one mesh.
const SQUARES: usize = 100;

fn studio() -> Option<Studio> {
    let mut studio = panes::studio(WgpuSettings { backends: Some(Backends::PRIMARY), ..default() }, Msaa::Off)?;
    studio.app.add_plugins(TransparencyPlugin);
    Some(studio)
}

/// Facing +Z, in no order of depth: at most 16 lie behind a pixel.
fn square(k: usize) -> ([Vec3; 4], StraightRgba) {
    let steps = [0.819_172_5, 0.671_043_6, 0.549_700_5, 0.450_3];
    let [x, y, z, alpha] = steps.map(|step: f32| (0.5 + step * (k + 1) as f32).fract());
    let center = Vec3::new(x, y, z) - 0.5;
    let corner = |x, y| center + 0.12 * Vec3::new(x, y, 0.0);
    let color = StraightRgba { rgb: [x, y, z], alpha: 0.3 + 0.5 * alpha };
    ([corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)], color)
}

fn triangles(place: &Transform, count: usize) -> Vec<ColoredTriangle> {
    let squares = (0..count).map(square);
    let triangles = squares.flat_map(|(corners, color)| {
        [[0, 1, 2], [0, 2, 3]].map(|of: [usize; 3]| (of.map(|corner| place.transform_point(corners[corner])), color))
    });
    triangles.collect()
}

fn mesh(count: usize) -> Mesh {
    let squares: Vec<_> = (0..count).map(square).collect();
    let positions: Vec<Vec3> = squares.iter().flat_map(|(corners, _)| *corners).collect();
    let rgba = |color: StraightRgba| [color.rgb[0], color.rgb[1], color.rgb[2], color.alpha];
    let colors: Vec<[f32; 4]> = squares.iter().flat_map(|(_, color)| [rgba(*color); 4]).collect();
    let indices = (0..count as u32).flat_map(|k| [0, 1, 2, 0, 2, 3].map(|corner| 4 * k + corner)).collect();
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, vec![[0.0, 0.0, 1.0]; positions.len()])
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_attribute(Mesh::ATTRIBUTE_COLOR, colors)
        .with_inserted_indices(Indices::U32(indices))
}

fn spawn(studio: &mut Studio, mesh: Mesh, place: Transform) -> (Entity, Handle<Mesh>) {
    let world = studio.app.world_mut();
    let mesh = world.resource_mut::<Assets<Mesh>>().add(mesh);
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial {
        alpha_mode: AlphaMode::Blend,
        unlit: true,
        cull_mode: None,
        ..default()
    });
    (world.spawn((Mesh3d(mesh.clone()), MeshMaterial3d(material), place)).id(), mesh)
}

fn wrong(studio: &mut Studio, camera: Entity, place: &Transform, count: usize) -> usize {
    let seen = studio.picture(camera);
    differing(&seen, &exact(studio, camera, Samples::One, &triangles(place, count)), CLOSE)
}

/// From the front, from the back, and turned.
#[test]
fn large_mesh_from_all_sides() {
    let Some(mut studio) = studio() else { return };
    let place = Transform::default();
    let (entity, shared) = spawn(&mut studio, mesh(SQUARES), place);
    let front = studio.camera;
    let unsorted = wrong(&mut studio, front, &place, SQUARES);
    assert!(unsorted > 500, "without order {unsorted} pixels are wrong");
    studio.app.world_mut().entity_mut(entity).insert(SortedTriangles::default());
    assert_eq!(wrong(&mut studio, front, &place, SQUARES), 0, "from the front");
    let behind = Transform::from_xyz(0.0, 0.0, -2.0).looking_at(Vec3::ZERO, Vec3::Y);
    studio.app.world_mut().entity_mut(front).insert(behind);
    assert_eq!(wrong(&mut studio, front, &place, SQUARES), 0, "from behind");
    let turned = Transform::from_xyz(0.1, 0.0, 0.2).with_rotation(Quat::from_rotation_y(std::f32::consts::PI));
    studio.app.world_mut().entity_mut(entity).insert(turned);
    assert_eq!(wrong(&mut studio, front, &turned, SQUARES), 0, "turned round");
    let own = studio.app.world().get::<Mesh3d>(entity).unwrap().0.clone();
    assert_ne!(own, shared, "it has a copy of its own");
    studio.app.world_mut().entity_mut(entity).remove::<SortedTriangles>();
    studio.app.update();
    assert_eq!(studio.app.world().get::<Mesh3d>(entity).unwrap().0, shared, "and gets its mesh back");
}

/// Sorted in the background.
#[test]
fn many_triangles() {
    let Some(mut studio) = studio() else { return };
    let place = Transform::from_xyz(0.0, 0.0, 0.1);
    let (entity, _) = spawn(&mut studio, crowd(), place);
    studio.app.world_mut().entity_mut(entity).insert(SortedTriangles::default());
    let camera = studio.camera;
    // Until the task is done.
    (0..20).for_each(|_| drop(studio.picture(camera)));
    assert_eq!(wrong(&mut studio, camera, &place, SQUARES), 0);
}

/// The squares, and more triangles than are sorted at once, far from what the camera sees.
fn crowd() -> Mesh {
    let mut mesh = mesh(SQUARES);
    let mut away = Sphere::new(1.0).mesh().uv(128, 64).translated_by(Vec3::new(0.0, 0.0, 50.0));
    let colors = vec![[1.0_f32; 4]; away.count_vertices()];
    away.insert_attribute(Mesh::ATTRIBUTE_COLOR, colors);
    away.remove_attribute(Mesh::ATTRIBUTE_UV_0);
    mesh.merge(&away).expect("both have the same attributes");
    mesh
}

/// A mesh that the app changes, one without indices, and one that it takes away.
#[test]
fn meshes_that_change() {
    let Some(mut studio) = studio() else { return };
    let place = Transform::default();
    let (entity, handle) = spawn(&mut studio, mesh(SQUARES / 2), place);
    studio.app.world_mut().entity_mut(entity).insert(SortedTriangles { turn: 0.0 });
    let camera = studio.camera;
    assert_eq!(wrong(&mut studio, camera, &place, SQUARES / 2), 0);
    let flat = mesh(SQUARES).with_duplicated_vertices();
    studio.app.world_mut().resource_mut::<Assets<Mesh>>().insert(&handle, flat).unwrap();
    assert_eq!(wrong(&mut studio, camera, &place, SQUARES), 0, "the asset changed, and has no indices");
    let other = studio.app.world_mut().resource_mut::<Assets<Mesh>>().add(mesh(20));
    studio.app.world_mut().entity_mut(entity).insert(Mesh3d(other));
    assert_eq!(wrong(&mut studio, camera, &place, 20), 0, "another mesh");
    studio.app.world_mut().despawn(entity);
    let seen = studio.picture(camera);
    assert!(seen.iter().all(|pixel| pixel.abs_diff_eq(Vec3::from(panes::BACKGROUND), CLOSE)));
}

/// A nearer camera that does not see the mesh does not count.
#[test]
fn cameras_on_other_layers() {
    let Some(mut studio) = studio() else { return };
    let place = Transform::default();
    let (entity, _) = spawn(&mut studio, mesh(SQUARES), place);
    studio.app.world_mut().entity_mut(entity).insert(SortedTriangles::default());
    let nearer = Transform::from_xyz(0.0, 0.0, -1.5).looking_at(Vec3::ZERO, Vec3::Y);
    let nearer = studio.add_camera(nearer, (Msaa::Off, RenderLayers::layer(7)));
    let camera = studio.camera;
    assert_eq!(wrong(&mut studio, camera, &place, SQUARES), 0, "it sees others");
    studio.app.world_mut().entity_mut(nearer).remove::<RenderLayers>();
    assert_eq!(wrong(&mut studio, nearer, &place, SQUARES), 0, "it sees the mesh");
}

/// What cannot be sorted is drawn as it is.
#[test]
fn unfit_meshes_are_drawn() {
    let Some(mut studio) = studio() else { return };
    let lines = Mesh::new(PrimitiveTopology::LineList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, vec![[0.0; 3], [1.0; 3]]);
    let mut hidden = mesh(10);
    hidden.asset_usage = RenderAssetUsages::RENDER_WORLD;
    let place = Transform::default();
    for mesh in [lines, Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default()), hidden] {
        let (entity, handle) = spawn(&mut studio, mesh, place);
        let camera = studio.camera;
        drop(studio.picture(camera));
        studio.app.world_mut().entity_mut(entity).insert(SortedTriangles::default());
        drop(studio.picture(camera));
        assert_eq!(studio.app.world().get::<Mesh3d>(entity).unwrap().0, handle);
    }
}
