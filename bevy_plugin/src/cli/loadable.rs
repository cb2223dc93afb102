//! A copy of a glTF file that Bevy's loader can read: what it stumbles over is replaced and named.

use std::collections::BTreeSet;

use serde_json::{Value, json};

use super::accessor::Elements;
use super::document::{Document, mime_type};
use super::error::CliError;

/// A white picture of one texel, which leaves a factor as it is.
const WHITE_PNG: &[u8] = &[
    0x89, b'P', b'N', b'G', 0x0D, 0x0A, 0x1A, 0x0A, 0, 0, 0, 13, b'I', b'H', b'D', b'R', 0, 0, 0, 1, 0, 0, 0, 1, 8, 0,
    0, 0, 0, 0x3A, 0x7E, 0x9B, 0x55, 0, 0, 0, 10, b'I', b'D', b'A', b'T', 0x78, 0xDA, 0x63, 0xF8, 0x0F, 0, 1, 1, 1, 0,
    0x1C, 0xB0, 0x8C, 0x99, 0, 0, 0, 0, b'I', b'E', b'N', b'D', 0xAE, 0x42, 0x60, 0x82,
];

/// Extensions without which the geometry cannot be read, and what to do about them.
const UNREADABLE: [(&str, &str); 1] =
    [("KHR_draco_mesh_compression", "its meshes are compressed with Draco; export without compression")];

/// Required extensions that change nothing about a bake beyond what the loader reads.
const HARMLESS: [&str; 6] = [
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "EXT_texture_webp",
    "EXT_texture_avif",
];

/// The copy, and what the user should know about it.
///
/// # Errors
///
/// The file requires an extension without which its geometry cannot be read.
pub(super) fn loadable(document: &Document) -> Result<(Document, Vec<String>), CliError> {
    let mut copy = document.clone();
    let mut warnings = check_extensions(document)?;
    for key in ["extensionsRequired", "animations"] {
        copy.json.as_object_mut().map(|json| json.remove(key));
    }
    let unreadable: Vec<(usize, String)> = (0..document.list("images").len())
        .filter_map(|index| Some((index, unreadable_format(document, index)?)))
        .collect();
    for (index, reason) in unreadable {
        warnings.push(replace_image(&mut copy, index, &reason));
    }
    give_sources(&mut copy, &mut warnings);
    dequantize(&mut copy)?;
    replace_modes(&mut copy, &mut warnings);
    warnings.extend(document.list("materials").iter().enumerate().filter_map(beyond_two_sets));
    Ok((copy, warnings))
}

/// Replaces an image of the copy by a white one and says so.
pub(super) fn replace_image(copy: &mut Document, index: usize, reason: &str) -> String {
    let name = copy.list("images")[index]["name"].as_str().map_or(format!("image {index}"), str::to_owned);
    let view = copy.push_view(WHITE_PNG);
    copy.list_mut("images")[index] = json!({ "bufferView": view, "mimeType": "image/png" });
    format!("texture \"{name}\" {reason}; convert it to PNG or JPEG. The factor of its materials alone is used")
}

/// The bytes and the true type of an image.
pub(super) fn image_data(document: &Document, index: usize) -> Option<(&[u8], &'static str)> {
    let view = document.list("images").get(index)?["bufferView"].as_u64()?;
    let data = document.view(view as usize)?;
    Some((data, mime_type(data)?))
}

fn check_extensions(document: &Document) -> Result<Vec<String>, CliError> {
    let required = || document.list("extensionsRequired").iter().filter_map(Value::as_str);
    let unreadable = UNREADABLE.iter().find(|(extension, _)| required().any(|required| required == *extension));
    if let Some((_, reason)) = unreadable {
        return Err(CliError::new(*reason));
    }
    let is_unknown = |extension: &&str| !HARMLESS.contains(extension) && !extension.starts_with("KHR_materials_");
    let unknown = required().filter(is_unknown);
    let warning = |extension| format!("the file requires the extension {extension}, which a bake does not know");
    let mut warnings: Vec<String> = unknown.map(warning).collect();
    let instanced = |node: &&Value| node["extensions"].get("EXT_mesh_gpu_instancing").is_some();
    let count = document.list("nodes").iter().filter(instanced).count();
    if count > 0 {
        warnings.push(format!(
            "{count} nodes are instanced with EXT_mesh_gpu_instancing, of which one instance is baked; export them as nodes"
        ));
    }
    Ok(warnings)
}

/// Why an image cannot be read, if its first bytes say so.
fn unreadable_format(document: &Document, index: usize) -> Option<String> {
    match image_data(document, index) {
        Some((_, "image/png" | "image/jpeg")) => None,
        Some((_, "image/ktx2")) => Some("is in KTX2 (Basis Universal)".into()),
        Some((_, "image/webp")) => Some("is in WebP".into()),
        _ => Some("has an unknown format".into()),
    }
}

/// Lets every texture have an image that the loader finds, and every image its true type.
fn give_sources(copy: &mut Document, warnings: &mut Vec<String>) {
    for index in 0..copy.list("images").len() {
        if let Some((_, mime_type)) = image_data(copy, index) {
            copy.list_mut("images")[index]["mimeType"] = json!(mime_type);
        }
    }
    let images = copy.list("images").len();
    let is_usable = |texture: &Value| texture["source"].as_u64().is_some_and(|source| (source as usize) < images);
    let lost: Vec<usize> =
        copy.list("textures").iter().enumerate().filter(|(_, texture)| !is_usable(texture)).map(|(i, _)| i).collect();
    for &index in &lost {
        let extensions = copy.list("textures")[index]["extensions"].as_object().cloned().unwrap_or_default();
        // Images of extensions were replaced above, and named.
        let replaced = extensions.values().find_map(|extension| extension["source"].as_u64());
        let source = replaced.filter(|&source| (source as usize) < images).unwrap_or_else(|| {
            warnings.push(format!("texture {index} has no image. The factor of its materials alone is used"));
            let view = copy.push_view(WHITE_PNG);
            copy.list_mut("images").push(json!({ "bufferView": view, "mimeType": "image/png" }));
            copy.list("images").len() as u64 - 1
        });
        copy.list_mut("textures")[index]["source"] = json!(source);
    }
}

/// Says when a material looks a texture up by a third set of coordinates, which Bevy does not have.
fn beyond_two_sets((index, material): (usize, &Value)) -> Option<String> {
    let base = &material["pbrMetallicRoughness"];
    let textures = [&base["baseColorTexture"], &base["metallicRoughnessTexture"], &material["emissiveTexture"]];
    let sets = textures.into_iter().filter_map(|texture| texture["texCoord"].as_u64());
    let name = material["name"].as_str().map_or(format!("material {index}"), str::to_owned);
    sets.max().filter(|&set| set > 1).map(|set| {
        format!("\"{name}\" looks a texture up by TEXCOORD_{set}, for which TEXCOORD_0 is taken as in Bevy; use the first two sets")
    })
}

/// Makes floats of those attributes that the loader takes as floats only.
fn dequantize(copy: &mut Document) -> Result<(), CliError> {
    let quantized: BTreeSet<usize> = copy
        .list("meshes")
        .iter()
        .flat_map(|mesh| mesh["primitives"].as_array().into_iter().flatten())
        .flat_map(|primitive| {
            let targets = primitive["targets"].as_array().into_iter().flatten();
            targets.chain([&primitive["attributes"]]).filter_map(Value::as_object).flatten()
        })
        .filter(|(name, _)| matches!(name.as_str(), "POSITION" | "NORMAL" | "TANGENT" | "TEXCOORD_0" | "TEXCOORD_1"))
        .filter_map(|(_, accessor)| Some(accessor.as_u64()? as usize))
        .filter(|&accessor| {
            copy.list("accessors").get(accessor).is_some_and(|accessor| accessor["componentType"] != json!(5126))
        })
        .collect();
    for accessor in quantized {
        let new = Elements::read(copy, accessor)?.to_floats().write(copy, true);
        let accessors = copy.list_mut("accessors");
        accessors[accessor] = accessors[new].clone();
    }
    Ok(())
}

/// Makes points of triangle fans and line loops, which the loader refuses together with the whole file.
fn replace_modes(copy: &mut Document, warnings: &mut Vec<String>) {
    for (index, mesh) in copy.list_mut("meshes").iter_mut().enumerate() {
        let name = mesh["name"].as_str().map_or(format!("mesh {index}"), str::to_owned);
        for primitive in mesh["primitives"].as_array_mut().into_iter().flatten() {
            let mode = primitive["mode"].as_u64();
            if mode == Some(6) {
                warnings.push(format!("\"{name}\" is a triangle fan and left out; export it as triangles"));
            }
            if matches!(mode, Some(2 | 6)) {
                primitive["mode"] = json!(0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_image(data: &[u8]) -> Document {
        let mut document = Document { json: json!({ "asset": { "version": "2.0" } }), buffer: Vec::new() };
        let view = document.push_view(data);
        document.json["images"] = json!([{ "name": "Bricks", "bufferView": view, "mimeType": "image/webp" }]);
        document
    }

    /// The white texel is a picture that a reader accepts, and it is white.
    #[test]
    fn the_replacement_is_white() {
        let mut reader = png::Decoder::new(std::io::Cursor::new(WHITE_PNG)).read_info().unwrap();
        let mut texel = [0];
        reader.next_frame(&mut texel).unwrap();
        assert_eq!(texel, [255]);
    }

    #[test]
    fn webp_is_replaced_and_named() {
        let mut document = with_image(b"RIFF....WEBPVP8 ");
        document.json["textures"] = json!([{ "extensions": { "EXT_texture_webp": { "source": 0 } } }]);
        document.json["extensionsRequired"] = json!(["EXT_texture_webp"]);
        let (copy, warnings) = loadable(&document).unwrap();
        assert_eq!(image_data(&copy, 0), Some((WHITE_PNG, "image/png")));
        assert_eq!(copy.list("textures")[0]["source"], 0);
        assert!(warnings.len() == 1 && warnings[0].contains("\"Bricks\" is in WebP"), "{warnings:?}");
    }

    #[test]
    fn a_wrong_type_is_corrected() {
        let (copy, warnings) = loadable(&with_image(WHITE_PNG)).unwrap();
        assert_eq!(copy.list("images")[0]["mimeType"], "image/png");
        assert!(warnings.is_empty());
    }

    #[test]
    fn draco_is_refused_with_the_remedy() {
        let mut document = with_image(WHITE_PNG);
        document.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
        let Err(CliError::Failed(text)) = loadable(&document) else { panic!("Draco was accepted") };
        assert!(text.contains("Draco; export without"), "{text}");
    }
}
