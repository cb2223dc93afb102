//! What a bake changes in an app, and that all of it is undone, replaced, saved and attached again.

use std::fs;
use std::path::Path;

use bevy::light::{AmbientLight, GlobalAmbientLight, RectLight};
use bevy::mesh::VertexAttributeValues;
use bevy::pbr::Lightmap;
use bevy::prelude::*;
use bevy_radiosity::RadiosityPlugins;
use bevy_radiosity::attach::{BakeOrigin, BakedLight, Lit};
use bevy_radiosity::bake::{Collected, apply_bake, collect_unlit, remove_bake};
use bevy_radiosity::baked::{SaveError, save_bake};
use bevy_radiosity::gltf::{GltfLightSource, GltfSource};
use bevy_radiosity::prelude::*;
use radiosity::bake::Bake;
use radiosity::lightmap::{LightmapImage, LightmapUv, Placement, TexelState, UvOrigin};
use radiosity_tests::TestFolder;
use radiosity_tests::render::app_without_gpu;

fn app(assets: &Path) -> App {
    app_without_gpu(assets, RadiosityPlugins)
}

/// Two cubes that share a mesh, a wall with lightmap coordinates and a lightmap from elsewhere, and a light of every
/// kind, some of which are set as a bake sets them.
fn spawn_room(app: &mut App) {
    let world = app.world_mut();
    let cube = world.resource_mut::<Assets<Mesh>>().add(Cuboid::default());
    let wall: Mesh = Rectangle::default().into();
    let uv = wall.attribute(Mesh::ATTRIBUTE_UV_0).unwrap().clone();
    let wall = world.resource_mut::<Assets<Mesh>>().add(wall.with_inserted_attribute(Mesh::ATTRIBUTE_UV_1, uv));
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial::default());
    let material = MeshMaterial3d(material);
    let image = world.resource_mut::<Assets<Image>>().add(Image::default());
    let own_lightmap = Lightmap { image, uv_rect: Rect::new(0.0, 0.5, 0.5, 1.0), bicubic_sampling: true };
    let baked_before = SpotLight { affects_lightmapped_mesh_diffuse: false, ..default() };
    let id = |id: &str| (Name::new(id.to_owned()), BakeId(id.to_owned()));
    world.spawn((
        Baked::default(),
        Transform::default(),
        Visibility::default(),
        children![
            (id("left"), Mesh3d(cube.clone()), material.clone(), Transform::from_xyz(-2.0, 0.0, 0.0)),
            (id("right"), Mesh3d(cube), material.clone(), Transform::from_xyz(2.0, 0.0, 0.0)),
            (id("wall"), Mesh3d(wall), material, own_lightmap),
            (id("lamp"), PointLight::default()),
            (id("torch"), baked_before),
            (id("sun"), DirectionalLight::default()),
            (id("panel"), RectLight::default(), Visibility::Visible),
        ],
    ));
    world.spawn((Camera3d::default(), AmbientLight::default()));
    app.update();
}

/// A lightmap: image, rectangle and filter.
type Shown = (AssetId<Image>, Rect, bool);

/// Everything that a bake may change, in the order of the entities.
#[derive(Debug, PartialEq)]
struct State {
    meshes: Vec<(Entity, AssetId<Mesh>, Option<Shown>)>,
    lights: Vec<(Entity, Option<bool>, Visibility)>,
    ambient: Vec<bool>,
}

fn state(app: &mut App) -> State {
    let world = app.world_mut();
    let lightmap = |map: &Lightmap| (map.image.id(), map.uv_rect, map.bicubic_sampling);
    let mut meshes = world.query::<(Entity, &Mesh3d, Option<&Lightmap>)>();
    let meshes = meshes.iter(world).map(|(entity, mesh, map)| (entity, mesh.0.id(), map.map(lightmap)));
    let mut meshes: Vec<_> = meshes.collect();
    meshes.sort_by_key(|mesh| mesh.0);
    let mut lights =
        world.query::<(Entity, Option<&PointLight>, Option<&SpotLight>, Option<&DirectionalLight>, &Visibility)>();
    let flags = lights.iter(world).map(|(entity, point, spot, sun, &visibility)| {
        let point = point.map(|light| light.affects_lightmapped_mesh_diffuse);
        let spot = spot.map(|light| light.affects_lightmapped_mesh_diffuse);
        let sun = sun.map(|light| light.affects_lightmapped_mesh_diffuse);
        (entity, point.or(spot).or(sun), visibility)
    });
    let mut lights: Vec<_> = flags.collect();
    lights.sort_by_key(|light| light.0);
    let mut cameras = world.query::<&AmbientLight>();
    let mut ambient: Vec<_> = cameras.iter(world).map(|light| light.affects_lightmapped_meshes).collect();
    ambient.push(world.resource::<GlobalAmbientLight>().affects_lightmapped_meshes);
    State { meshes, lights, ambient }
}

/// A bake by hand: one image in which each surface has a column, and all triangles split from each other.
fn bake_by_hand(collected: &Collected, radiance: f32) -> Bake {
    let scene = &collected.scene;
    let uvs = scene.meshes.iter().map(|mesh| {
        let sources: Vec<u32> = mesh.triangles.iter().flatten().copied().collect();
        let has_uv = !mesh.uv_1.is_empty();
        let count = if has_uv { mesh.positions.len() as u32 } else { sources.len() as u32 };
        let made = (0..count).map(|vertex| Vec2::new(vertex as f32 / count as f32, 0.5)).collect();
        Some(LightmapUv {
            origin: if has_uv { UvOrigin::Kept } else { UvOrigin::Unwrapped },
            uv_1: if has_uv { mesh.uv_1.clone() } else { made },
            triangles: if has_uv {
                mesh.triangles.clone()
            } else {
                (0..count / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect()
            },
            sources: if has_uv { (0..count).collect() } else { sources },
        })
    });
    let columns = scene.surfaces.len() as f32;
    let placement = |column: usize| {
        let (min, max) = (column as f32 / columns, (column + 1) as f32 / columns);
        Some(Placement { image: 0, min: Vec2::new(min, 0.0), max: Vec2::new(max, 1.0) })
    };
    let image = LightmapImage {
        width: 8,
        height: 4,
        texels: vec![Vec3::splat(radiance); 32],
        states: vec![TexelState::Valid; 32],
        charts: vec![0; 32],
        patches: vec![0; 32],
        errors: vec![0.0; 32],
    };
    Bake {
        images: vec![image],
        uvs: uvs.collect(),
        placements: (0..scene.surfaces.len()).map(placement).collect(),
        ..Default::default()
    }
}

fn bake_room(app: &mut App, radiance: f32) {
    let world = app.world_mut();
    let collected = collect_unlit(world);
    assert_eq!((collected.surfaces.len(), collected.lights.len()), (3, 4));
    let bake = bake_by_hand(&collected, radiance);
    apply_bake(world, &collected, bake, &BakeSettings::default());
    // Images that are replaced take one frame longer.
    app.update();
    app.update();
}

fn named(app: &mut App, name: &str) -> Entity {
    let mut names = app.world_mut().query::<(Entity, &Name)>();
    names.iter(app.world()).find(|(_, other)| other.as_str() == name).map(|(entity, _)| entity).unwrap()
}

#[test]
fn bake_lights_meshes_and_silences_lights() {
    let folder = TestFolder::new("silences");
    let mut app = app(folder.path());
    spawn_room(&mut app);
    bake_room(&mut app, 1.0);
    let state = state(&mut app);
    assert!(state.meshes.iter().all(|(_, _, map)| map.is_some()));
    assert!(state.ambient.iter().all(|affects| !affects));
    assert!(state.lights.iter().all(|(_, affects, _)| *affects != Some(true)));
    let panel = named(&mut app, "panel");
    assert_eq!(app.world().get::<Visibility>(panel), Some(&Visibility::Hidden));
    // 12 triangles with 3 vertices each, whose other attributes are those of the cube.
    let (left, right, wall) = (named(&mut app, "left"), named(&mut app, "right"), named(&mut app, "wall"));
    let world = app.world();
    let handle = |entity| world.get::<Mesh3d>(entity).unwrap().0.clone();
    assert_eq!(handle(left), handle(right), "a shared mesh stays shared");
    assert_eq!(handle(wall), world.get::<Lit>(wall).unwrap().mesh, "usable coordinates stay as they are");
    let cube = world.resource::<Assets<Mesh>>().get(&handle(left)).unwrap();
    let before = Mesh::from(Cuboid::default());
    let corners = |mesh: &Mesh| {
        let Some(VertexAttributeValues::Float32x3(all)) = mesh.attribute(Mesh::ATTRIBUTE_NORMAL) else { panic!() };
        mesh.indices().unwrap().iter().map(|index| all[index]).collect::<Vec<_>>()
    };
    assert_eq!(cube.attribute(Mesh::ATTRIBUTE_UV_1).unwrap().len(), 36);
    assert_eq!(corners(cube), corners(&before));
}

#[test]
fn removing_a_bake_restores_everything() {
    let folder = TestFolder::new("restores");
    let mut app = app(folder.path());
    spawn_room(&mut app);
    let before = state(&mut app);
    bake_room(&mut app, 1.0);
    assert_ne!(state(&mut app), before);
    remove_bake(app.world_mut());
    app.update();
    app.update();
    assert_eq!(state(&mut app), before);
    let left_over = app.world_mut().query_filtered::<(), Or<(With<Lit>, With<BakedLight>)>>().iter(app.world()).count();
    assert_eq!(left_over, 0);
}

#[test]
fn second_bake_replaces_the_first() {
    let folder = TestFolder::new("replaces");
    let mut app = app(folder.path());
    spawn_room(&mut app);
    let before = state(&mut app);
    bake_room(&mut app, 1.0);
    let first = state(&mut app);
    let (images, meshes) =
        (app.world().resource::<Assets<Image>>().len(), app.world().resource::<Assets<Mesh>>().len());
    bake_room(&mut app, 2.0);
    app.update();
    let second = state(&mut app);
    assert_eq!((first.lights, first.ambient), (second.lights, second.ambient));
    for ((_, _, old), (_, _, new)) in first.meshes.iter().zip(&second.meshes) {
        assert_ne!(old.unwrap().0, new.unwrap().0);
        assert_eq!(old.unwrap().1, new.unwrap().1);
    }
    assert_eq!(app.world().resource::<Assets<Image>>().len(), images, "images of the first bake are dropped");
    assert_eq!(app.world().resource::<Assets<Mesh>>().len(), meshes, "meshes of the first bake are dropped");
    remove_bake(app.world_mut());
    app.update();
    app.update();
    assert_eq!(state(&mut app), before);
}

/// Loads what `folder` holds and waits until it is attached.
fn attach(app: &mut App) -> Entity {
    let scene = app.world().resource::<AssetServer>().load("manifest.json");
    let root = app.world_mut().spawn(BakedSceneRoot(scene)).id();
    for _ in 0..2000 {
        app.update();
        let is_lit = app.world_mut().query::<&Lit>().iter(app.world()).next().is_some();
        if is_lit {
            // Images that are replaced take one frame longer.
            app.update();
            app.update();
            return root;
        }
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    panic!("nothing was attached in two seconds");
}

/// What is seen of lightmaps: rectangles and coordinates by name.
fn shown(app: &mut App) -> Vec<(String, Rect, Vec<[f32; 2]>)> {
    let mut lit = app.world_mut().query::<(&Name, &Mesh3d, &Lightmap)>();
    let world = app.world();
    let meshes = world.resource::<Assets<Mesh>>();
    let coordinates = |mesh: &Mesh3d| match meshes.get(&mesh.0).unwrap().attribute(Mesh::ATTRIBUTE_UV_1) {
        Some(VertexAttributeValues::Float32x2(uv)) => uv.clone(),
        _ => panic!("no UV_1"),
    };
    let shown = lit.iter(world).map(|(name, mesh, map)| (name.to_string(), map.uv_rect, coordinates(mesh)));
    let mut shown: Vec<_> = shown.collect();
    shown.sort_by(|a, b| a.0.cmp(&b.0));
    shown
}

#[test]
fn saved_bake_comes_back_by_bake_id() {
    let folder = TestFolder::new("comes_back");
    let mut first = app(folder.path());
    spawn_room(&mut first);
    bake_room(&mut first, 3.0);
    save_bake(first.world(), folder.path()).unwrap();

    let mut second = app(folder.path());
    spawn_room(&mut second);
    let before = state(&mut second);
    let root = attach(&mut second);
    assert_eq!(shown(&mut second), shown(&mut first));
    let attached = state(&mut second);
    assert!(attached.lights.iter().all(|(_, affects, _)| *affects != Some(true)));
    let wall = named(&mut second, "wall");
    let world = second.world();
    let image = world.resource::<Assets<Image>>().get(&world.get::<Lightmap>(wall).unwrap().image).unwrap();
    let three = bevy_radiosity::baked::ktx2::shared_exponent([3.0; 3]).to_le_bytes();
    assert_eq!((image.width(), image.height()), (8, 4));
    assert_eq!(image.data.as_deref(), Some(&*three.repeat(32)));

    // A bake of the app itself goes before, also when more is spawned.
    bake_room(&mut second, 5.0);
    let extra = second.world_mut().spawn(Mesh3d::default()).id();
    second.update();
    let origins =
        |app: &mut App| app.world_mut().query::<&Lit>().iter(app.world()).map(|lit| lit.origin).collect::<Vec<_>>();
    assert_eq!(origins(&mut second), [BakeOrigin::App; 3]);
    assert_ne!(state(&mut second).meshes, attached.meshes);
    second.world_mut().trigger(RemoveBake);
    let more = second.world_mut().spawn(Mesh3d::default()).id();
    second.update();
    second.update();
    assert_eq!(origins(&mut second), [BakeOrigin::Saved(root); 3]);

    for entity in [extra, more, root] {
        second.world_mut().despawn(entity);
    }
    second.update();
    second.update();
    assert_eq!(state(&mut second), before);
}

#[test]
fn entity_without_bake_id_is_named() {
    let folder = TestFolder::new("without_id");
    let mut app = app(folder.path());
    spawn_room(&mut app);
    bake_room(&mut app, 1.0);
    let left = named(&mut app, "left");
    app.world_mut().entity_mut(left).remove::<BakeId>();
    let error = save_bake(app.world(), folder.path()).unwrap_err();
    assert!(matches!(&error, SaveError::NoBakeId { entity } if entity == "left"), "{error}");
    assert!(error.to_string().contains("\"left\"") && error.to_string().contains("BakeId"));

    app.world_mut().entity_mut(left).insert(BakeId("right".into()));
    let error = save_bake(app.world(), folder.path()).unwrap_err();
    assert!(matches!(error, SaveError::SameKey { .. }), "{error}");
    remove_bake(app.world_mut());
    assert!(matches!(save_bake(app.world(), folder.path()), Err(SaveError::NothingToSave)));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "nothing is written");
}

/// By glTF indices below the root, and nowhere else.
#[test]
fn saved_bake_lights_its_gltf_scene() {
    let folder = TestFolder::new("gltf");
    let mut app = app(folder.path());
    spawn_room(&mut app);
    let source = |node| GltfSource { node, mesh: 0, primitive: 0 };
    for (name, node) in [("left", 1), ("right", 2), ("wall", 3)] {
        let entity = named(&mut app, name);
        app.world_mut().entity_mut(entity).remove::<BakeId>().insert(source(node));
    }
    for (name, node) in [("lamp", 4), ("torch", 5), ("sun", 6)] {
        let entity = named(&mut app, name);
        app.world_mut().entity_mut(entity).remove::<BakeId>().insert(GltfLightSource { node });
    }
    bake_room(&mut app, 1.0);
    save_bake(app.world(), folder.path()).unwrap();
    remove_bake(app.world_mut());

    let scene = app.world().resource::<AssetServer>().load("manifest.json");
    let left = named(&mut app, "left");
    let root = app.world().get::<ChildOf>(left).unwrap().parent();
    let elsewhere = app.world().get::<Mesh3d>(left).unwrap().clone();
    let elsewhere = app.world_mut().spawn((elsewhere, source(1))).id();
    app.world_mut().entity_mut(root).insert(BakedSceneRoot(scene));
    for _ in 0..2000 {
        app.update();
        std::thread::sleep(std::time::Duration::from_millis(1));
        if app.world().get::<Lit>(left).is_some() {
            break;
        }
    }
    app.update();
    app.update();
    let sun = named(&mut app, "sun");
    assert_eq!(shown(&mut app).len(), 3);
    assert!(!app.world().get::<DirectionalLight>(sun).unwrap().affects_lightmapped_mesh_diffuse);
    assert!(app.world().get::<Lit>(elsewhere).is_none());

    // What is spawned later is lit too.
    let late = app.world().get::<Lit>(left).unwrap().mesh.clone();
    let late = app.world_mut().spawn((Mesh3d(late), source(2), ChildOf(root))).id();
    app.update();
    assert!(app.world().get::<Lightmap>(late).is_some());
}
