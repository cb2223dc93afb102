//! Loads a scene through Bevy without window and renderer.

use std::path::Path;
use std::thread::sleep;
use std::time::Duration;

use bevy::asset::io::memory::{Dir, MemoryAssetReader};
use bevy::asset::io::{AssetSourceBuilder, AssetSourceId};
use bevy::asset::{AssetPlugin, LoadState, RenderAssetUsages};
use bevy::gltf::{Gltf, GltfPlugin};
use bevy::image::{
    CompressedImageFormatSupport, CompressedImageFormats, ImageLoader, ImagePlugin, ImageSampler, ImageType,
};
use bevy::mesh::MeshPlugin;
use bevy::prelude::*;
use bevy::world_serialization::WorldSerializationPlugin;
use radiosity::render::Camera as RenderCamera;

use super::document::Document;
use super::error::CliError;
use super::loadable::{image_data, loadable, replace_image};
use crate::bake::{Baked, Collected, collect};
use crate::gltf::{GltfLightSource, GltfSource, GltfSourcePlugin};

/// The name under which the file lies in memory.
const FILE: &str = "scene.glb";

/// A scene that is ready to bake.
pub(super) struct Loaded {
    /// Surfaces and lights, and warnings about them.
    pub collected: Collected,
    /// For each surface where in the file it comes from.
    pub sources: Vec<GltfSource>,
    /// For each light its node in the file.
    pub light_nodes: Vec<usize>,
    /// The first perspective camera of the file, and its width over its height.
    pub camera: Option<(RenderCamera, f32)>,
}

/// Loads and collects the default scene of a document.
pub(super) fn load(document: &Document) -> Result<Loaded, CliError> {
    let (mut copy, mut warnings) = loadable(document)?;
    let mut app = load_app(&copy).or_else(|error| {
        // One picture that cannot be decoded makes the loader refuse the whole file.
        let replaced = replace_undecodable(&mut copy);
        if replaced.is_empty() {
            return Err(error);
        }
        warnings.extend(replaced);
        load_app(&copy)
    })?;
    let collected = collect(app.world_mut());
    let world = app.world();
    let source = |&entity: &Entity| world.get::<GltfSource>(entity).copied().unwrap_or_default();
    let sources = collected.surfaces.iter().map(source).collect();
    let light_node = |&entity: &Entity| world.get::<GltfLightSource>(entity).map(|light| light.node);
    let light_nodes = collected.lights.iter().filter_map(light_node).collect();
    warnings.extend(collected.warnings.iter().cloned());
    let camera = camera(app.world_mut());
    if camera.is_none() && app.world_mut().query::<&Camera>().iter(app.world()).next().is_some() {
        warnings.push("no camera of the scene is a perspective one, so the preview is an overview; add one".into());
    }
    let collected = Collected { warnings, ..collected };
    Ok(Loaded { collected, sources, light_nodes, camera })
}

/// An app in which the scene of the document stands.
fn load_app(document: &Document) -> Result<App, CliError> {
    let mut app = headless_app(document.to_glb());
    let gltf: Handle<Gltf> = app.world().resource::<AssetServer>().load(format!("memory://{FILE}"));
    loop {
        app.update();
        let server = app.world().resource::<AssetServer>();
        match (server.load_state(&gltf), server.is_loaded_with_dependencies(&gltf)) {
            (LoadState::Failed(error), _) => {
                return Err(CliError::new(format!(
                    "the scene cannot be loaded ({}); see what a glTF validator says about it, or export it again",
                    first_line(&error)
                )));
            }
            (_, true) => break,
            _ => sleep(Duration::from_millis(1)),
        }
    }
    let world = app.world_mut();
    let scene = world
        .resource::<Assets<Gltf>>()
        .get(&gltf)
        .and_then(|gltf| gltf.default_scene.clone().or_else(|| gltf.scenes.first().cloned()));
    let scene = scene.ok_or_else(|| CliError::new("the file has no scene; export one with meshes"))?;
    let registry = world.resource::<AppTypeRegistry>().clone();
    world.resource_scope(|world, scenes: Mut<Assets<WorldAsset>>| {
        let spawned = scenes.get(&scene).map(|scene| scene.write_to_world_with(world, &mut default(), &registry));
        match spawned {
            Some(Ok(_)) => Ok(()),
            Some(Err(error)) => Err(CliError::new(format!("the scene cannot be spawned: {}", first_line(&error)))),
            None => Err(CliError::new("the file has no scene; export one with meshes")),
        }
    })?;
    let roots: Vec<Entity> =
        world.query_filtered::<Entity, (With<Transform>, Without<ChildOf>)>().iter(world).collect();
    for root in roots {
        world.entity_mut(root).insert(Baked::default());
    }
    // Transforms are propagated by one more turn.
    app.update();
    Ok(app)
}

/// What an error says before its backtrace.
fn first_line(error: &impl ToString) -> String {
    error.to_string().lines().next().unwrap_or_default().to_owned()
}

fn headless_app(glb: Vec<u8>) -> App {
    let folder = Dir::default();
    folder.insert_asset(Path::new(FILE), glb);
    let reader =
        move || -> Box<dyn bevy::asset::io::ErasedAssetReader> { Box::new(MemoryAssetReader { root: folder.clone() }) };
    let mut app = App::new();
    app.register_asset_source(AssetSourceId::from("memory"), AssetSourceBuilder::new(reader))
        .add_plugins((MinimalPlugins, TransformPlugin, AssetPlugin::default(), ImagePlugin::default(), MeshPlugin))
        .add_plugins((WorldSerializationPlugin, GltfPlugin::default(), GltfSourcePlugin))
        .insert_resource(CompressedImageFormatSupport(CompressedImageFormats::NONE))
        .register_asset_loader(ImageLoader::new(CompressedImageFormats::NONE));
    app.finish();
    app.cleanup();
    app
}

/// Replaces every picture that cannot be decoded and says which.
fn replace_undecodable(document: &mut Document) -> Vec<String> {
    let undecodable = |&index: &usize| match image_data(document, index) {
        Some((data, mime_type)) => Image::from_buffer(
            data,
            ImageType::MimeType(mime_type),
            CompressedImageFormats::NONE,
            true,
            ImageSampler::Default,
            RenderAssetUsages::MAIN_WORLD,
        )
        .is_err(),
        None => true,
    };
    let indices: Vec<usize> = (0..document.list("images").len()).filter(undecodable).collect();
    indices.into_iter().map(|index| replace_image(document, index, "cannot be decoded")).collect()
}

fn camera(world: &mut World) -> Option<(RenderCamera, f32)> {
    let mut cameras = world.query::<(&Camera, &Projection, &GlobalTransform)>();
    let perspective = cameras.iter(world).filter_map(|(camera, projection, transform)| match projection {
        Projection::Perspective(perspective) => Some((camera.is_active, perspective, transform.affine())),
        _ => None,
    });
    let (_, perspective, transform) = perspective.max_by_key(|(is_active, ..)| *is_active)?;
    Some((RenderCamera::perspective(transform, perspective.fov), perspective.aspect_ratio))
}

#[cfg(test)]
mod tests {
    use radiosity::light::LightSource;
    use serde_json::json;

    use super::*;

    /// glTF: colors are linear, intensity is in candela or lux, lights shine along -Z and have no size.
    #[test]
    fn lights_are_those_of_gltf() {
        let light = |index: usize| json!({ "extensions": { "KHR_lights_punctual": { "light": index } } });
        let color = [0.25, 0.5, 1.0];
        let lights = json!([{ "type": "point", "color": color, "intensity": 2.0 },
            { "type": "spot", "color": color, "intensity": 2.0, "range": 5.0, "spot": { "outerConeAngle": 0.5 } },
            { "type": "directional", "color": color, "intensity": 2.0 }]);
        let json = json!({ "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0, 1, 2] }],
            "nodes": [light(0), light(1), light(2)], "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": { "KHR_lights_punctual": { "lights": lights } } });
        let loaded = load(&Document { json, buffer: Vec::new() }).unwrap();
        assert_eq!(loaded.light_nodes, [0, 1, 2]);
        let expected = 2.0 * Vec3::from(color);
        for light in &loaded.collected.scene.lights {
            match light.source {
                LightSource::Point(point) => assert!(point.intensity.abs_diff_eq(expected, 1e-5), "{point:?}"),
                LightSource::Spot(spot) => {
                    assert!(spot.point.intensity.abs_diff_eq(expected, 1e-5), "{spot:?}");
                    assert_eq!((spot.point.range, spot.point.radius, spot.direction), (5.0, 0.0, Vec3::NEG_Z));
                }
                LightSource::Directional(sun) => {
                    assert!(sun.illuminance.abs_diff_eq(expected, 1e-5), "{sun:?}");
                    assert_eq!(sun.direction, Vec3::NEG_Z);
                }
                LightSource::Rect(_) => panic!("glTF has no rectangles"),
            }
        }
        assert_eq!(loaded.collected.scene.lights.len(), 3);
    }

    /// An orthographic camera gives no preview of its own, which is said; a perspective one does.
    #[test]
    fn cameras_without_perspective_are_told() {
        let cameras = json!([{ "type": "orthographic",
            "orthographic": { "xmag": 1.0, "ymag": 1.0, "znear": 0.1, "zfar": 10.0 } },
            { "type": "perspective", "perspective": { "yfov": 1.0, "znear": 0.1 } }]);
        for (nodes, overviews) in [(json!([{ "camera": 0 }]), 1), (json!([{ "camera": 0 }, { "camera": 1 }]), 0)] {
            let indices: Vec<usize> = (0..nodes.as_array().map_or(0, Vec::len)).collect();
            let json = json!({ "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": indices }],
                "nodes": nodes, "cameras": cameras });
            let loaded = load(&Document { json, buffer: Vec::new() }).unwrap();
            let told = loaded.collected.warnings.iter().filter(|warning| warning.contains("overview")).count();
            assert_eq!((told, loaded.camera.is_none()), (overviews, overviews == 1));
        }
    }

    #[test]
    fn errors_are_told_without_their_backtrace() {
        assert_eq!(first_line(&"it is broken\n   0: core::panic"), "it is broken");
    }

    /// Integers for positions, which the loader does not take, are the same places as floats.
    #[test]
    fn quantized_meshes_are_loaded() {
        let mut document = Document { json: json!({ "asset": { "version": "2.0" }, "scene": 0 }), buffer: Vec::new() };
        let shorts = [0_u16, 0, 0, 0, 65535, 0, 0, 0, 0, 65535, 0, 0];
        let bytes: Vec<u8> = shorts.iter().flat_map(|short| short.to_le_bytes()).collect();
        let view = document.push_view(&bytes);
        document.json["bufferViews"][view]["byteStride"] = json!(8);
        document.json["accessors"] = json!([{ "bufferView": view, "componentType": 5123, "normalized": true,
            "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [65535, 65535, 0] }]);
        document.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
        document.json["meshes"] = json!([{ "primitives": [{ "attributes": { "POSITION": 0 } }] }]);
        document.json["nodes"] = json!([{ "name": "Corner", "mesh": 0, "scale": [2, 2, 2] }]);
        document.json["scenes"] = json!([{ "nodes": [0] }]);
        let loaded = load(&document).unwrap();
        let scene = &loaded.collected.scene;
        assert_eq!(scene.meshes[0].positions, [Vec3::ZERO, Vec3::X, Vec3::Y]);
        assert_eq!((scene.surfaces[0].name.as_str(), scene.surfaces[0].transform.matrix3.x_axis.x), ("Corner", 2.0));
        assert_eq!(loaded.sources, [GltfSource { node: 0, mesh: 0, primitive: 0 }]);
    }
}
