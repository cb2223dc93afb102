//! The scene that is baked when none is given, as a glTF file.

use radiosity::geometry::Mesh;
use radiosity::material::Material;
use radiosity::scene::{cornell_box, cornell_camera};
use serde_json::{Value, json};

use super::accessor::Elements;
use super::document::Document;

/// The measured Cornell box with its camera.
pub(super) fn cornell_document() -> Document {
    let scene = cornell_box();
    let mut document = Document { json: json!({ "asset": { "version": "2.0" }, "scene": 0 }), buffer: Vec::new() };
    document.json["extensionsUsed"] = json!(["KHR_materials_emissive_strength"]);
    document.json["materials"] = scene.materials.iter().map(material).collect();
    let meshes: Vec<Value> = scene
        .surfaces
        .iter()
        .map(|surface| mesh(&mut document, &scene.meshes[surface.mesh], surface.material))
        .collect();
    document.json["meshes"] = json!(meshes);
    let (transform, fov_y) = cornell_camera();
    document.json["cameras"] =
        json!([{ "type": "perspective", "perspective": { "yfov": fov_y, "aspectRatio": 1.0, "znear": 0.01 } }]);
    let mut nodes: Vec<Value> = scene
        .surfaces
        .iter()
        .enumerate()
        .map(|(index, surface)| json!({ "name": surface.name, "mesh": index, "matrix": matrix(surface.transform) }))
        .collect();
    nodes.push(json!({ "name": "camera", "camera": 0, "matrix": matrix(transform) }));
    document.json["scenes"] = json!([{ "name": "Cornell box", "nodes": (0..nodes.len()).collect::<Vec<_>>() }]);
    document.json["nodes"] = json!(nodes);
    document
}

fn matrix(transform: impl Into<bevy::math::Mat4>) -> [f32; 16] {
    transform.into().to_cols_array()
}

fn mesh(document: &mut Document, mesh: &Mesh, material: usize) -> Value {
    let positions: Vec<[f32; 3]> = mesh.positions.iter().map(|position| position.to_array()).collect();
    let positions = Elements::vec3(&positions).write(document, true);
    let indices = Elements::indices(mesh.triangles.as_flattened()).write(document, false);
    json!({ "name": mesh.name, "primitives": [
        { "attributes": { "POSITION": positions }, "indices": indices, "material": material }] })
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
