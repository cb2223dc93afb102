//! Puts lightmap coordinates into the meshes of a glTF file and leaves the rest as it is.

use std::collections::{HashMap, HashSet};

use radiosity::lightmap::{LightmapUv, UvOrigin};
use serde_json::{Map, Value, json};

use super::accessor::Elements;
use super::document::Document;
use super::error::CliError;

const TRIANGLES: u64 = 4;

/// Gives a primitive its lightmap coordinates. Where they split vertices, all its attributes and morph targets follow.
/// Accessors that it no longer refers to are added to `replaced`.
pub(super) fn set_lightmap_uv(
    document: &mut Document,
    mesh: usize,
    primitive: usize,
    uv: &LightmapUv,
    replaced: &mut HashSet<usize>,
) -> Result<(), CliError> {
    let missing = || CliError::new(format!("mesh {mesh} has no primitive {primitive}"));
    let path = format!("/meshes/{mesh}/primitives/{primitive}");
    let mut json = document.json.pointer(&path).ok_or_else(missing)?.clone();
    replaced.extend(accessors_of(&json));
    match uv.origin {
        UvOrigin::Kept => keep_vertices(document, &mut json, uv)?,
        UvOrigin::Unwrapped => split_vertices(document, &mut json, uv)?,
    }
    *document.json.pointer_mut(&path).ok_or_else(missing)? = json;
    Ok(())
}

/// Every accessor that a primitive refers to.
fn accessors_of(primitive: &Value) -> Vec<usize> {
    let targets = primitive["targets"].as_array().into_iter().flatten();
    let attributes = targets.chain([&primitive["attributes"]]).filter_map(Value::as_object).flatten();
    let accessors = attributes.map(|(_, accessor)| accessor).chain([&primitive["indices"]]);
    accessors.filter_map(|accessor| Some(accessor.as_u64()? as usize)).collect()
}

/// For each vertex that Bevy's loader makes, the vertex of the file.
///
/// Without normals the loader gives each corner of each triangle a vertex of its own.
fn loaded_vertices(document: &Document, primitive: &Value) -> Result<Vec<u32>, CliError> {
    let attributes = &primitive["attributes"];
    let is_flat = attributes["NORMAL"].is_null() && primitive["mode"].as_u64().unwrap_or(TRIANGLES) == TRIANGLES;
    match primitive["indices"].as_u64() {
        Some(indices) if is_flat => Ok(Elements::read(document, indices as usize)?.unsigned()),
        _ => Ok((0..vertex_count(document, primitive)).collect()),
    }
}

fn vertex_count(document: &Document, primitive: &Value) -> u32 {
    let positions = primitive["attributes"]["POSITION"].as_u64().unwrap_or(u64::MAX) as usize;
    document.list("accessors").get(positions).and_then(|accessor| accessor["count"].as_u64()).unwrap_or(0) as u32
}

/// Sets the coordinates of the vertices that are there.
fn keep_vertices(document: &mut Document, primitive: &mut Value, uv: &LightmapUv) -> Result<(), CliError> {
    let loaded = loaded_vertices(document, primitive)?;
    let mut coordinates = vec![[0.0; 2]; vertex_count(document, primitive) as usize];
    for (&source, uv_1) in uv.sources.iter().zip(&uv.uv_1) {
        coordinates[loaded[source as usize] as usize] = uv_1.to_array();
    }
    set_coordinates(document, primitive, &coordinates);
    Ok(())
}

/// Gives the primitive a new list of vertices, each a copy of an old one.
fn split_vertices(document: &mut Document, primitive: &mut Value, uv: &LightmapUv) -> Result<(), CliError> {
    let loaded = loaded_vertices(document, primitive)?;
    let (mut sources, mut coordinates) = (Vec::new(), Vec::new());
    let mut known = HashMap::new();
    let renumbered = uv.sources.iter().zip(&uv.uv_1).map(|(&source, uv_1)| {
        let (source, uv_1) = (loaded[source as usize], uv_1.to_array());
        *known.entry((source, uv_1.map(f32::to_bits))).or_insert_with(|| {
            sources.push(source);
            coordinates.push(uv_1);
            sources.len() as u32 - 1
        })
    });
    let renumbered: Vec<u32> = renumbered.collect();
    let indices: Vec<u32> = uv.triangles.as_flattened().iter().map(|&vertex| renumbered[vertex as usize]).collect();
    if !sources.iter().copied().eq(0..vertex_count(document, primitive)) {
        pick_vertices(document, primitive, &sources)?;
    }
    primitive["mode"] = json!(TRIANGLES);
    primitive["indices"] = json!(Elements::indices(&indices).write(document, false));
    set_coordinates(document, primitive, &coordinates);
    Ok(())
}

/// Rewrites all attributes and morph targets for new vertices.
fn pick_vertices(document: &mut Document, primitive: &mut Value, sources: &[u32]) -> Result<(), CliError> {
    if let Some(extensions) = primitive["extensions"].as_object_mut() {
        // The compressed copy would have the old vertices.
        extensions.remove("KHR_draco_mesh_compression");
    }
    let mut written = HashMap::new();
    let mut rewrite = |attributes: &mut Map<String, Value>| {
        for accessor in attributes.values_mut() {
            let Some(index) = accessor.as_u64() else { continue };
            let new = match written.get(&index) {
                Some(&new) => new,
                None => Elements::read(document, index as usize)?.pick(sources).write(document, true),
            };
            written.insert(index, new);
            *accessor = json!(new);
        }
        Ok::<(), CliError>(())
    };
    if let Some(attributes) = primitive["attributes"].as_object_mut() {
        // They are about to be replaced.
        attributes.remove("TEXCOORD_1");
        rewrite(attributes)?;
    }
    for target in primitive["targets"].as_array_mut().into_iter().flatten() {
        target.as_object_mut().map_or(Ok(()), &mut rewrite)?;
    }
    Ok(())
}

fn set_coordinates(document: &mut Document, primitive: &mut Value, coordinates: &[[f32; 2]]) {
    let accessor = Elements::vec2(coordinates).write(document, true);
    let attributes = &mut primitive["attributes"];
    attributes["TEXCOORD_1"] = json!(accessor);
    if attributes["TEXCOORD_0"].is_null() {
        // glTF allows a second set only beside a first, and Bevy's shader does not compile without one. Where a texture
        // is looked up by it, a bake and Bevy so far took the factor alone; one texel all over is nearer to that than
        // a picture spread over the charts of the lightmap would be.
        let zeros = Elements::vec2(&vec![[0.0; 2]; coordinates.len()]).write(document, true);
        attributes["TEXCOORD_0"] = json!(zeros);
    }
}

#[cfg(test)]
mod tests {
    use bevy::math::{Vec2, vec2};

    use super::*;

    /// A quad of two triangles with a normal, or without.
    fn quad(normals: bool) -> Document {
        let mut document = Document { json: json!({ "asset": { "version": "2.0" } }), buffer: Vec::new() };
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let positions = Elements::vec3(&corners).write(&mut document, true);
        let mut attributes = json!({ "POSITION": positions });
        if normals {
            attributes["NORMAL"] = json!(Elements::vec3(&[[0.0, 0.0, 1.0]; 4]).write(&mut document, true));
        }
        let target = Elements::vec3(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]]);
        let target = target.write(&mut document, true);
        let indices = Elements::indices(&[0, 1, 2, 0, 2, 3]).write(&mut document, false);
        document.json["meshes"] = json!([{ "primitives": [
            { "attributes": attributes, "indices": indices, "targets": [{ "POSITION": target }] }] }]);
        document
    }

    fn read(document: &Document, pointer: &str) -> Elements {
        let accessor = document.json.pointer(&format!("/meshes/0/primitives/0{pointer}")).unwrap();
        Elements::read(document, accessor.as_u64().unwrap() as usize).unwrap()
    }

    /// Each corner of the triangles has the position, normal and morph target that it had, and the new coordinates.
    #[test]
    fn splitting_keeps_every_corner() {
        for normals in [true, false] {
            let before = quad(normals);
            let mut after = before.clone();
            // Six vertices for four; as the loader numbers them without normals, or with.
            let sources = if normals { vec![0, 1, 2, 0, 2, 3] } else { (0..6).collect() };
            let uv_1: Vec<Vec2> = (0..6).map(|i| vec2(i as f32 / 5.0, 0.5)).collect();
            let triangles = vec![[0, 1, 2], [3, 4, 5]];
            let uv = LightmapUv { origin: UvOrigin::Unwrapped, sources, uv_1: uv_1.clone(), triangles };
            set_lightmap_uv(&mut after, 0, 0, &uv, &mut HashSet::new()).unwrap();
            let (old, new) = (read(&before, "/indices").unsigned(), read(&after, "/indices").unsigned());
            for pointer in ["/attributes/POSITION", "/targets/0/POSITION"] {
                assert_eq!(read(&after, pointer).pick(&new), read(&before, pointer).pick(&old));
            }
            let arrays: Vec<[f32; 2]> = uv_1.iter().map(|uv| uv.to_array()).collect();
            assert_eq!(read(&after, "/attributes/TEXCOORD_1").pick(&new).count(), 6);
            assert_eq!(read(&after, "/attributes/TEXCOORD_1").pick(&new), {
                let mut expected = after.clone();
                let accessor = Elements::vec2(&arrays).write(&mut expected, true);
                Elements::read(&expected, accessor).unwrap()
            });
        }
    }

    /// Coordinates that split nothing leave positions, indices and all other accessors alone.
    #[test]
    fn kept_coordinates_touch_nothing_else() {
        let before = quad(true);
        let mut after = before.clone();
        let uv_1 = vec![vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 1.0), vec2(0.0, 1.0)];
        let uv = LightmapUv { origin: UvOrigin::Kept, sources: (0..4).collect(), uv_1, triangles: vec![] };
        set_lightmap_uv(&mut after, 0, 0, &uv, &mut HashSet::new()).unwrap();
        let primitive = |document: &Document| document.json["meshes"][0]["primitives"][0].clone();
        let (old, mut new) = (primitive(&before), primitive(&after));
        for key in ["TEXCOORD_0", "TEXCOORD_1"] {
            new["attributes"].as_object_mut().unwrap().remove(key);
        }
        assert_eq!(old, new);
        assert!(after.buffer.starts_with(&before.buffer));
        // The first set that glTF wants beside the second is none of its own.
        assert_eq!(read(&after, "/attributes/TEXCOORD_0").bounds(), (vec![0.0; 2], vec![0.0; 2]));
    }
}
