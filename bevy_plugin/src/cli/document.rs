//! A glTF file as JSON and one buffer, read from `.glb` or `.gltf` with all that it refers to.

use std::fs;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use percent_encoding::percent_decode_str;
use serde_json::{Value, json};

use super::accessor::{Elements, element_size};
use super::error::CliError;
use super::meshopt;

const MAGIC: &[u8] = b"glTF";
const JSON_CHUNK: u32 = 0x4E4F_534A;
const BINARY_CHUNK: u32 = 0x004E_4942;

/// A glTF file. Everything that it refers to lies in its one buffer.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Document {
    /// The glTF JSON. `buffers` has at most one entry, images have a `bufferView`.
    pub json: Value,
    /// What `buffers[0]` holds.
    pub buffer: Vec<u8>,
}

impl Document {
    /// Reads a `.glb` or `.gltf` file and the files that it refers to.
    pub fn read(path: &Path) -> Result<Self, CliError> {
        let shown = path.display();
        let bytes = fs::read(path)
            .map_err(|error| CliError::new(format!("cannot read {shown}: {error}; check the path of the scene")))?;
        let context = |error: CliError| match error {
            CliError::Failed(text) => CliError::Failed(format!("{shown}: {text}")),
            other => other,
        };
        Self::parse(&bytes, path.parent().unwrap_or(Path::new(""))).map_err(context)
    }

    /// Reads the bytes of a `.glb` or `.gltf` file whose other files lie in `folder`.
    pub fn parse(bytes: &[u8], folder: &Path) -> Result<Self, CliError> {
        let (json, binary) = if bytes.starts_with(MAGIC) { split_glb(bytes)? } else { (bytes, None) };
        let json: Value = serde_json::from_slice(json)
            .map_err(|error| CliError::new(format!("not a glTF file ({error}); export it as .glb or .gltf")))?;
        let version = json["asset"]["version"].as_str().unwrap_or("");
        if !version.starts_with("2.") {
            return Err(CliError::new("not a glTF 2.0 file; export it as .glb or .gltf of version 2.0"));
        }
        let mut document = Self { json, buffer: Vec::new() };
        meshopt::use_fallback(&mut document.json, binary.is_some())?;
        document.join_buffers(binary, folder)?;
        document.embed_images(folder)?;
        document.check_accessors()?;
        document.check_primitives()?;
        Ok(document)
    }

    /// The bytes of a `.glb` file.
    pub fn to_glb(&self) -> Vec<u8> {
        let mut json = self.json.to_string().into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let binary = self.buffer.len().next_multiple_of(4);
        let binary_chunk = if self.buffer.is_empty() { 0 } else { 8 + binary };
        let mut glb = Vec::with_capacity(20 + json.len() + binary_chunk);
        glb.extend(MAGIC);
        for word in [2, (20 + json.len() + binary_chunk) as u32, json.len() as u32, JSON_CHUNK] {
            glb.extend(word.to_le_bytes());
        }
        glb.extend(json);
        if binary_chunk > 0 {
            glb.extend((binary as u32).to_le_bytes());
            glb.extend(BINARY_CHUNK.to_le_bytes());
            glb.extend(&self.buffer);
            glb.resize(glb.len() + binary - self.buffer.len(), 0);
        }
        glb
    }

    /// A list of the document; empty where there is none.
    pub fn list(&self, key: &str) -> &[Value] {
        self.json[key].as_array().map_or(&[], Vec::as_slice)
    }

    /// A list of the document that can be changed; made where there is none.
    pub fn list_mut(&mut self, key: &str) -> &mut Vec<Value> {
        if !self.json[key].is_array() {
            self.json[key] = json!([]);
        }
        match &mut self.json[key] {
            Value::Array(list) => list,
            _ => unreachable!("it was just made a list"),
        }
    }

    /// Appends bytes to the buffer and returns the index of their view.
    pub fn push_view(&mut self, bytes: &[u8]) -> usize {
        self.buffer.resize(self.buffer.len().next_multiple_of(4), 0);
        let offset = self.buffer.len();
        self.buffer.extend(bytes);
        let length = self.buffer.len();
        self.json["buffers"] = json!([{ "byteLength": length }]);
        let views = self.list_mut("bufferViews");
        views.push(json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() }));
        views.len() - 1
    }

    /// The bytes of a view.
    pub fn view(&self, index: usize) -> Option<&[u8]> {
        let view = self.list("bufferViews").get(index)?;
        let offset = view["byteOffset"].as_u64().unwrap_or(0) as usize;
        self.buffer.get(offset..offset.checked_add(view["byteLength"].as_u64()? as usize)?)
    }

    /// Puts the data of all buffers into one and lets the views refer to it.
    fn join_buffers(&mut self, binary: Option<&[u8]>, folder: &Path) -> Result<(), CliError> {
        let mut offsets = Vec::new();
        for (index, buffer) in self.list("buffers").to_vec().iter().enumerate() {
            let length = buffer["byteLength"].as_u64().unwrap_or(0) as usize;
            let data = match (buffer["uri"].as_str(), binary) {
                (Some(uri), _) => resolve(uri, folder, "buffer")?,
                (None, Some(binary)) if index == 0 => binary.to_vec(),
                (None, _) => return Err(CliError::new(format!("truncated: it has no data for buffer {index}"))),
            };
            let Some(data) = data.get(..length) else {
                let text = format!("truncated: buffer {index} has {} bytes of {length}; export it again", data.len());
                return Err(CliError::new(text));
            };
            self.buffer.resize(self.buffer.len().next_multiple_of(4), 0);
            offsets.push((self.buffer.len(), length));
            self.buffer.extend(data);
        }
        if !offsets.is_empty() {
            self.json["buffers"] = json!([{ "byteLength": self.buffer.len() }]);
        }
        for (index, view) in self.list_mut("bufferViews").iter_mut().enumerate() {
            let damaged = || CliError::new(format!("damaged: buffer view {index} reaches beyond its buffer"));
            move_view(view, &offsets).ok_or_else(damaged)?;
        }
        Ok(())
    }

    /// Puts images that lie in files or URIs into the buffer.
    fn embed_images(&mut self, folder: &Path) -> Result<(), CliError> {
        for index in 0..self.list("images").len() {
            let Some(uri) = self.list("images")[index]["uri"].as_str().map(str::to_owned) else { continue };
            let data = resolve(&uri, folder, "texture")?;
            let view = self.push_view(&data);
            let image = &mut self.list_mut("images")[index];
            if image["name"].is_null() && !uri.starts_with("data:") {
                image["name"] = json!(decoded(&uri));
            }
            let Some(image) = image.as_object_mut() else { continue };
            image.remove("uri");
            image.insert("bufferView".into(), json!(view));
            let mime_type = mime_type(&data).or(image.get("mimeType").and_then(Value::as_str)).unwrap_or("image/png");
            image.insert("mimeType".into(), json!(mime_type));
        }
        Ok(())
    }

    /// Every accessor lies within its view.
    fn check_accessors(&self) -> Result<(), CliError> {
        for (index, accessor) in self.list("accessors").iter().enumerate() {
            let damaged =
                || CliError::new(format!("damaged: accessor {index} reaches beyond its data; export it again"));
            let Some(view_index) = accessor["bufferView"].as_u64() else { continue };
            let length = self.view(view_index as usize).ok_or_else(damaged)?.len() as u64;
            let stride = self.list("bufferViews")[view_index as usize]["byteStride"].as_u64();
            let size = element_size(accessor).ok_or_else(damaged)? as u64;
            let count = accessor["count"].as_u64().unwrap_or(0);
            let last = count.saturating_sub(1).saturating_mul(stride.unwrap_or(size));
            let end = last.saturating_add(accessor["byteOffset"].as_u64().unwrap_or(0)).saturating_add(size);
            if count > 0 && end > length {
                return Err(damaged());
            }
        }
        Ok(())
    }

    /// Every primitive has positions, as many of all else, and indices of these.
    fn check_primitives(&self) -> Result<(), CliError> {
        for (index, mesh) in self.list("meshes").iter().enumerate() {
            for primitive in mesh["primitives"].as_array().into_iter().flatten() {
                let name = mesh["name"].as_str().unwrap_or("without a name");
                let damaged = |what| CliError::new(format!("damaged: mesh {index} ({name}) {what}; export it again"));
                self.check_primitive(primitive).map_err(damaged)?;
            }
        }
        Ok(())
    }

    /// Says what is wrong with a primitive, as the end of a sentence about its mesh.
    fn check_primitive(&self, primitive: &Value) -> Result<(), String> {
        let accessor = |index: &Value| self.list("accessors").get(index.as_u64()? as usize);
        let count = |accessor: &Value| accessor["count"].as_u64().unwrap_or(0);
        let positions = accessor(&primitive["attributes"]["POSITION"]).ok_or("has no positions")?;
        let vertices = count(positions);
        let targets = primitive["targets"].as_array().into_iter().flatten();
        for (name, index) in targets.chain([&primitive["attributes"]]).filter_map(Value::as_object).flatten() {
            match accessor(index).map(count) {
                Some(values) if values == vertices => {}
                Some(values) => return Err(format!("has {vertices} positions and {values} values of {name}")),
                None => return Err(format!("has no data for {name}")),
            }
        }
        if primitive["indices"].is_null() {
            return Ok(());
        }
        let are_indices = |accessor: &&Value| {
            let component = accessor["componentType"].as_u64();
            matches!(component, Some(5121 | 5123 | 5125)) && accessor["type"] == json!("SCALAR")
        };
        let indices = accessor(&primitive["indices"]).filter(are_indices).ok_or("has wrong indices")?;
        if indices["bufferView"].is_null() && indices["sparse"].is_null() {
            // They are all 0, or compressed.
            return Ok(());
        }
        let elements = Elements::read(self, primitive["indices"].as_u64().unwrap_or(u64::MAX) as usize);
        match elements.map_err(|_| "has indices that cannot be read")?.unsigned().into_iter().max() {
            Some(last) if u64::from(last) >= vertices => {
                Err(format!("has {vertices} vertices, and a triangle names vertex {last}, counted from 0"))
            }
            _ => Ok(()),
        }
    }
}

/// The JSON and the binary chunk of a `.glb` file.
fn split_glb(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), CliError> {
    let word = |offset: usize| bytes.get(offset..)?.first_chunk().map(|bytes| u32::from_le_bytes(*bytes) as usize);
    let truncated = || {
        let announced = word(8).unwrap_or(20);
        let text = format!("truncated: it has {} bytes of {announced}; export or copy it again", bytes.len());
        CliError::new(text)
    };
    if word(8).is_none_or(|announced| announced > bytes.len()) {
        return Err(truncated());
    }
    let chunk = |offset: usize, kind: u32| {
        let (length, found) = (word(offset)?, word(offset + 4)?);
        (found == kind as usize).then(|| bytes.get(offset + 8..(offset + 8).checked_add(length)?))?
    };
    let json = chunk(12, JSON_CHUNK).ok_or_else(truncated)?;
    Ok((json, chunk(20 + json.len(), BINARY_CHUNK)))
}

/// Lets a view refer to the joined buffer, given offset and length of each old buffer there.
fn move_view(view: &mut Value, buffers: &[(usize, usize)]) -> Option<()> {
    let (base, available) = *buffers.get(view["buffer"].as_u64()? as usize)?;
    let offset = view["byteOffset"].as_u64().unwrap_or(0);
    let end = offset.checked_add(view["byteLength"].as_u64()?)?;
    if end > available as u64 {
        return None;
    }
    view["buffer"] = json!(0);
    view["byteOffset"] = json!(base as u64 + offset);
    Some(())
}

/// The data of a `data:` URI or of a file.
fn resolve(uri: &str, folder: &Path, what: &str) -> Result<Vec<u8>, CliError> {
    if let Some(data) = uri.strip_prefix("data:") {
        let (header, payload) = data.split_once(',').unwrap_or(("", data));
        if !header.ends_with(";base64") {
            return Ok(percent_decode_str(payload).collect());
        }
        let damaged = |error| CliError::new(format!("damaged: a {what} in base64 cannot be read ({error})"));
        return STANDARD.decode(payload).map_err(damaged);
    }
    let file = decoded(uri);
    fs::read(folder.join(&file)).map_err(|error| {
        let text = format!("the {what} file {file} cannot be read ({error}); put it beside the scene or export a .glb");
        CliError::new(text)
    })
}

fn decoded(uri: &str) -> String {
    percent_decode_str(uri).decode_utf8_lossy().into_owned()
}

/// The MIME type of an image, told by its first bytes.
pub(super) fn mime_type(image: &[u8]) -> Option<&'static str> {
    match image {
        [0x89, b'P', b'N', b'G', ..] => Some("image/png"),
        [0xFF, 0xD8, 0xFF, ..] => Some("image/jpeg"),
        [0xAB, b'K', b'T', b'X', ..] => Some("image/ktx2"),
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => Some("image/webp"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document() -> Document {
        let json = json!({ "asset": { "version": "2.0" }, "buffers": [{ "byteLength": 6 }],
            "bufferViews": [{ "buffer": 0, "byteLength": 6 }] });
        Document { json, buffer: vec![1, 2, 3, 4, 5, 6] }
    }

    #[test]
    fn glb_reads_back() {
        let again = Document::parse(&document().to_glb(), Path::new("")).unwrap();
        assert_eq!(again.view(0), Some(&[1, 2, 3, 4, 5, 6][..]));
    }

    /// Whatever is cut off, the message says so and nothing panics.
    #[test]
    fn every_truncation_is_named() {
        let glb = document().to_glb();
        for length in 4..glb.len() {
            let Err(CliError::Failed(text)) = Document::parse(&glb[..length], Path::new("")) else {
                panic!("{length}")
            };
            assert!(text.contains("truncated"), "{length}: {text}");
        }
    }

    #[test]
    fn buffers_and_images_of_uris_are_embedded() {
        let text = json!({ "asset": { "version": "2.0" },
            "buffers": [{ "byteLength": 3, "uri": "data:application/octet-stream;base64,AQID" },
                        { "byteLength": 2, "uri": "data:application/octet-stream;base64,BAUG" }],
            "bufferViews": [{ "buffer": 1, "byteOffset": 1, "byteLength": 1 }],
            "images": [{ "uri": "data:image/png;base64,iVBORw==" }] });
        let document = Document::parse(text.to_string().as_bytes(), Path::new("")).unwrap();
        assert_eq!(document.view(0), Some(&[5][..]));
        assert_eq!(document.list("buffers").len(), 1);
        let image = &document.list("images")[0];
        assert_eq!(image["mimeType"], "image/png");
        assert_eq!(document.view(image["bufferView"].as_u64().unwrap() as usize), Some(&b"\x89PNG"[..]));
    }

    #[test]
    fn a_missing_file_is_named() {
        let text = json!({ "asset": { "version": "2.0" }, "images": [{ "uri": "no%20such.png" }] });
        let Err(CliError::Failed(text)) = Document::parse(text.to_string().as_bytes(), Path::new("/nowhere")) else {
            panic!("a missing file was found")
        };
        assert!(text.contains("texture file no such.png"), "{text}");
    }

    #[test]
    fn a_mesh_without_positions_is_damage() {
        let mut document = document();
        document.json["meshes"] = json!([{ "name": "Wall", "primitives": [{ "attributes": {} }] }]);
        let Err(CliError::Failed(text)) = Document::parse(&document.to_glb(), Path::new("")) else {
            panic!("a mesh without positions was accepted")
        };
        assert!(text.contains("(Wall)"), "{text}");
    }

    /// Indices and attributes that fit no vertex are told before a loader trusts them.
    #[test]
    fn a_mesh_that_contradicts_itself_is_damage() {
        let mesh = |indices: [u16; 3], normals: usize| {
            let mut document = Document { json: json!({ "asset": { "version": "2.0" } }), buffer: Vec::new() };
            let positions = Elements::vec3(&[[0.0; 3]; 3]).write(&mut document, true);
            let normals = Elements::vec3(&vec![[0.0; 3]; normals]).write(&mut document, true);
            let indices = Elements::indices(&indices.map(u32::from)).write(&mut document, false);
            document.json["meshes"] = json!([{ "name": "Wall", "primitives": [
                { "attributes": { "POSITION": positions, "NORMAL": normals }, "indices": indices }] }]);
            Document::parse(&document.to_glb(), Path::new(""))
        };
        assert!(mesh([0, 1, 2], 3).is_ok());
        for (document, reason) in
            [(mesh([0, 1, 3], 3), "vertex 3"), (mesh([0, 1, 2], 2), "3 positions and 2 values of NORMAL")]
        {
            let Err(CliError::Failed(text)) = document else { panic!("{reason}") };
            assert!(text.contains("mesh 0 (Wall)") && text.contains(reason), "{text}");
        }
    }

    #[test]
    fn an_accessor_beyond_its_view_is_damage() {
        let mut document = document();
        document.json["accessors"] = json!([{ "bufferView": 0, "componentType": 5123, "type": "VEC2", "count": 2 }]);
        assert!(Document::parse(&document.to_glb(), Path::new("")).is_err());
    }
}
