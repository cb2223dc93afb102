//! A game shows a glTF scene with a bake that was made before: by an app that saved it, or by the command line.

use std::path::Path;
use std::time::{Duration, Instant};

use bevy::mesh::VertexAttributeValues;
use bevy::pbr::Lightmap;
use bevy::prelude::*;
use bevy_radiosity::RadiosityPlugins;
use bevy_radiosity::gltf::GltfSource;
use bevy_radiosity::prelude::*;
use radiosity_tests::TestFolder;
use radiosity_tests::render::app_without_gpu;

/// A folder with `room.gltf`: floor and wall share a square without lightmap coordinates, under a lamp.
fn room(test: &str) -> TestFolder {
    let folder = TestFolder::new(test);
    let positions: [[f32; 3]; 4] = [[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]];
    let normals = [[0.0_f32, 1.0, 0.0]; 4];
    let floats = positions.into_iter().chain(normals).flatten().flat_map(f32::to_le_bytes);
    let indices = [0_u16, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes);
    folder.write("room.bin", &floats.chain(indices).collect::<Vec<u8>>());
    folder.write("room.gltf", ROOM.as_bytes());
    folder
}

const ROOM: &str = r#"{
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
    "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 100, "range": 50}]}},
    "nodes": [{"name": "floor", "mesh": 0},
              {"name": "wall", "mesh": 0, "translation": [0, 1, -1], "rotation": [0.70710678, 0, 0, 0.70710678]},
              {"name": "lamp", "translation": [0, 1, 1], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]}],
    "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": [0.5, 0.5, 0.5, 1]}}],
    "accessors": [
        {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, 0, -1], "max": [1, 0, 1]},
        {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
        {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 48},
                    {"buffer": 0, "byteOffset": 96, "byteLength": 12}],
    "buffers": [{"uri": "room.bin", "byteLength": 108}]}"#;

#[derive(Resource, Default)]
struct Heard {
    done: bool,
    saved: bool,
    failed: Vec<String>,
}

fn app(assets: &Path) -> App {
    let mut app = app_without_gpu(assets, RadiosityPlugins);
    app.init_resource::<Heard>()
        .insert_resource(BakeSettings { quality: Quality::Draft, resolution: Resolution::Texels(4096), ..default() })
        .add_observer(|_: On<BakeDone>, mut heard: ResMut<Heard>| heard.done = true)
        .add_observer(|_: On<BakeSaved>, mut heard: ResMut<Heard>| heard.saved = true)
        .add_observer(|failed: On<BakeFailed>, mut heard: ResMut<Heard>| heard.failed.push(failed.error.to_string()))
        .add_observer(|failed: On<SaveFailed>, mut heard: ResMut<Heard>| heard.failed.push(failed.error.to_string()));
    app
}

fn load<A: Asset>(app: &App, path: &'static str) -> Handle<A> {
    app.world().resource::<AssetServer>().load(path)
}

fn wait_until(app: &mut App, is_reached: impl Fn(&mut World) -> bool) {
    let start = Instant::now();
    while !is_reached(app.world_mut()) {
        assert!(start.elapsed() < Duration::from_secs(60), "nothing happens");
        assert!(app.world().resource::<Heard>().failed.is_empty(), "{:?}", app.world().resource::<Heard>().failed);
        app.update();
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// By node: the place in the lightmap, its size and the coordinates.
fn shown(world: &mut World) -> Vec<(usize, Rect, UVec2, Vec<[f32; 2]>)> {
    let mut lit = world.query::<(&GltfSource, &Mesh3d, &Lightmap)>();
    let (meshes, images) = (world.resource::<Assets<Mesh>>(), world.resource::<Assets<Image>>());
    let shown = lit.iter(world).map(|(source, mesh, map)| {
        let uv = meshes.get(&mesh.0).unwrap().attribute(Mesh::ATTRIBUTE_UV_1);
        let Some(VertexAttributeValues::Float32x2(uv)) = uv else { panic!("no UV_1") };
        (source.node, map.uv_rect, images.get(&map.image).unwrap().size(), uv.clone())
    });
    let mut shown: Vec<_> = shown.collect();
    shown.sort_by_key(|(node, ..)| *node);
    shown
}

fn lamp_lights_again(world: &mut World) -> bool {
    world.query::<&PointLight>().single(world).unwrap().affects_lightmapped_mesh_diffuse
}

#[test]
fn app_saves_and_game_shows() {
    let folder = room("by_app");
    let mut baker = app(folder.path());
    let scene = load(&baker, "room.gltf#Scene0");
    baker.world_mut().spawn((WorldAssetRoot(scene), BakeOnLoad));
    wait_until(&mut baker, |world| world.resource::<Heard>().done);
    let baked = shown(baker.world_mut());
    assert_eq!(baked.iter().map(|(node, ..)| *node).collect::<Vec<_>>(), [0, 1]);
    assert!(!lamp_lights_again(baker.world_mut()));
    baker.world_mut().trigger(SaveBake { folder: folder.path().to_owned() });
    wait_until(&mut baker, |world| world.resource::<Heard>().saved);

    let mut game = app(folder.path());
    let (scene, bake) = (load(&game, "room.gltf#Scene0"), load(&game, "manifest.json"));
    let root = game.world_mut().spawn((WorldAssetRoot(scene), BakedSceneRoot(bake))).id();
    wait_until(&mut game, |world| shown(world).len() == 2);
    assert_eq!(shown(game.world_mut()), baked);
    assert!(!lamp_lights_again(game.world_mut()));
    game.world_mut().entity_mut(root).remove::<BakedSceneRoot>();
    game.update();
    assert!(shown(game.world_mut()).is_empty() && lamp_lights_again(game.world_mut()));
}

#[test]
fn command_line_bakes_and_game_shows() {
    let folder = room("by_command_line");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let args = ["bake", &path("room.gltf"), "--out", &path("baked"), "--quality", "draft", "--resolution", "64"];
    let exit = bevy_radiosity::cli::run(args.map(Into::into));
    assert_eq!(format!("{exit:?}"), format!("{:?}", std::process::ExitCode::SUCCESS));

    let mut game = app(folder.path());
    let (scene, bake) = (load(&game, "baked/scene.glb#Scene0"), load(&game, "baked/manifest.json"));
    game.world_mut().spawn((WorldAssetRoot(scene), BakedSceneRoot(bake)));
    wait_until(&mut game, |world| shown(world).len() == 2);
    assert!(shown(game.world_mut()).iter().all(|(_, _, size, _)| *size == UVec2::splat(64)));
    assert!(!lamp_lights_again(game.world_mut()));
}
