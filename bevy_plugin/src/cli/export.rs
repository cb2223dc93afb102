//! Scenes of the core as glTF files.

use bevy::math::{Affine3A, Mat4, Quat, Vec3};
use radiosity::geometry::Mesh;
use radiosity::light::{Light, LightSource};
use radiosity::material::Material;
use radiosity::render::Camera;
use radiosity::scene::{Scene, cornell_box, cornell_camera};
use serde_json::{Value, json};

use super::accessor::Elements;
use super::document::Document;
use super::error::CliError;

/// A scene with its camera as a `.glb` file; `aspect` is the width of its picture over its height.
///
/// # Errors
///
/// The scene has something that glTF has not: a sky, textures in the core's form, rectangular lights, or lights with a
/// radius.
pub fn write_glb(scene: &Scene, camera: &Camera, aspect: f32) -> Result<Vec<u8>, CliError> {
    Ok(document("scene", scene, camera, aspect)?.to_glb())
}

/// The scene that is baked when none is given: the measured Cornell box with its camera.
pub(super) fn cornell_document() -> Result<Document, CliError> {
    let (transform, fov_y) = cornell_camera();
    document("Cornell box", &cornell_box(), &Camera::perspective(transform, fov_y), 1.0)
}

fn document(name: &str, scene: &Scene, camera: &Camera, aspect: f32) -> Result<Document, CliError> {
    check(scene)?;
    let mut document = Document { json: json!({ "asset": { "version": "2.0" }, "scene": 0 }), buffer: Vec::new() };
    document.json["materials"] = scene.materials.iter().map(material).collect();
    // A primitive has one material, and surfaces that share a mesh may have several.
    let mut shapes: Vec<(usize, usize)> = Vec::new();
    let mut nodes = Vec::new();
    for surface in &scene.surfaces {
        let shape = (surface.mesh, surface.material);
        let known = shapes.iter().position(|&other| other == shape);
        let index = known.unwrap_or(shapes.len());
        if known.is_none() {
            shapes.push(shape);
        }
        nodes.push(json!({ "name": surface.name, "mesh": index, "matrix": matrix(surface.transform) }));
    }
    let meshes: Vec<Value> =
        shapes.into_iter().map(|(shape, paint)| mesh(&mut document, &scene.meshes[shape], paint)).collect();
    document.json["meshes"] = json!(meshes);
    document.json["cameras"] = json!([{ "type": "perspective",
        "perspective": { "yfov": camera.fov_y, "aspectRatio": aspect, "znear": 0.01 } }]);
    nodes.push(json!({ "name": "camera", "camera": 0, "matrix": matrix(camera.transform) }));
    let mut extensions = vec!["KHR_materials_emissive_strength"];
    let lights: Vec<Value> = scene.lights.iter().map(light).collect();
    nodes.extend(scene.lights.iter().enumerate().map(|(index, light)| light_node(light, index)));
    if !lights.is_empty() {
        document.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": lights } });
        extensions.push("KHR_lights_punctual");
    }
    document.json["extensionsUsed"] = json!(extensions);
    document.json["scenes"] = json!([{ "name": name, "nodes": (0..nodes.len()).collect::<Vec<_>>() }]);
    document.json["nodes"] = json!(nodes);
    Ok(document)
}

/// That nothing would be lost.
fn check(scene: &Scene) -> Result<(), CliError> {
    let missing = |what: &str, remedy: &str| Err(CliError::new(format!("glTF has no {what}; {remedy}")));
    if scene.sky != Vec3::ZERO {
        return missing("sky", "use emissive surfaces");
    }
    if !scene.textures.is_empty() {
        return missing("textures in this form", "use colors");
    }
    for light in &scene.lights {
        let radius = match &light.source {
            LightSource::Point(point) => point.radius,
            LightSource::Spot(spot) => spot.point.radius,
            LightSource::Directional(_) => 0.0,
            LightSource::Rect(_) => return missing("rectangular lights", "use an emissive surface"),
        };
        if radius > 0.0 {
            return missing("radius of lights", "set it to 0 or use an emissive surface");
        }
    }
    Ok(())
}

fn matrix(transform: Affine3A) -> [f32; 16] {
    Mat4::from(transform).to_cols_array()
}

fn mesh(document: &mut Document, mesh: &Mesh, material: usize) -> Value {
    let arrays = |list: &[Vec3]| -> Vec<[f32; 3]> { list.iter().map(|vector| vector.to_array()).collect() };
    let mut attributes = json!({ "POSITION": Elements::vec3(&arrays(&mesh.positions)).write(document, true) });
    if !mesh.normals.is_empty() {
        attributes["NORMAL"] = json!(Elements::vec3(&arrays(&mesh.normals)).write(document, true));
    }
    for (name, list) in [("TEXCOORD_0", &mesh.uv_0), ("TEXCOORD_1", &mesh.uv_1)] {
        if !list.is_empty() {
            let list: Vec<[f32; 2]> = list.iter().map(|uv| uv.to_array()).collect();
            attributes[name] = json!(Elements::vec2(&list).write(document, true));
        }
    }
    let indices = Elements::indices(mesh.triangles.as_flattened()).write(document, false);
    json!({ "name": mesh.name, "primitives": [
        { "attributes": attributes, "indices": indices, "material": material }] })
}

fn material(material: &Material) -> Value {
    let strength = material.emissive.max_element().max(1.0);
    json!({
        "name": material.name,
        "doubleSided": material.double_sided,
        "pbrMetallicRoughness":
            { "baseColorFactor": material.base_color.to_array(), "metallicFactor": material.metallic },
        "emissiveFactor": (material.emissive / strength).to_array(),
        "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": strength } },
    })
}

/// Color times intensity is what it was; the color has 1 as its largest channel.
fn light(light: &Light) -> Value {
    let strength = light.source.strength();
    let intensity = strength.max_element();
    let color = if intensity > 0.0 { strength / intensity } else { Vec3::ONE };
    let mut json = json!({ "name": light.name, "color": color.to_array(), "intensity": intensity });
    let range = match &light.source {
        LightSource::Point(point) => {
            json["type"] = json!("point");
            point.range
        }
        LightSource::Spot(spot) => {
            json["type"] = json!("spot");
            json["spot"] = json!({ "innerConeAngle": spot.inner_angle, "outerConeAngle": spot.outer_angle });
            spot.point.range
        }
        LightSource::Directional(_) | LightSource::Rect(_) => {
            json["type"] = json!("directional");
            f32::INFINITY
        }
    };
    if range.is_finite() {
        json["range"] = json!(range);
    }
    json
}

/// Lights shine along their `-z`.
fn light_node(light: &Light, index: usize) -> Value {
    let turned = |direction: Vec3| Quat::from_rotation_arc(Vec3::NEG_Z, direction);
    let (place, turn) = match &light.source {
        LightSource::Point(point) => (point.position, Quat::IDENTITY),
        LightSource::Spot(spot) => (spot.point.position, turned(spot.direction)),
        LightSource::Directional(sun) => (Vec3::ZERO, turned(sun.direction)),
        LightSource::Rect(rectangle) => (rectangle.center, Quat::IDENTITY),
    };
    json!({ "name": light.name, "translation": place.to_array(), "rotation": turn.to_array(),
        "extensions": { "KHR_lights_punctual": { "light": index } } })
}
