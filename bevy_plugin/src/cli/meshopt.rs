//! Data that is compressed with meshopt, beside which a glTF file may keep it as it is.

use serde_json::{Value, json};

use super::error::CliError;

/// The extension, under the name of its draft and the one that it got.
const NAMES: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// Lets every view use the data that is not compressed.
///
/// `has_binary` says whether the file brings data for its first buffer itself.
///
/// # Errors
///
/// Where there is compressed data only, with the remedy.
pub(super) fn use_fallback(json: &mut Value, has_binary: bool) -> Result<(), CliError> {
    let list = |key: &str| json[key].as_array().cloned().unwrap_or_default();
    let buffers = list("buffers");
    let has_data = |view: &Value| {
        let index = view["buffer"].as_u64().unwrap_or(u64::MAX) as usize;
        let has_data = |buffer: &Value| buffer["uri"].is_string() || (index == 0 && has_binary && !is_fallback(buffer));
        buffers.get(index).is_some_and(has_data)
    };
    if list("bufferViews").iter().any(|view| is_compressed(view) && !has_data(view)) {
        return Err(CliError::new(
            "its meshes are compressed with meshopt; decompress it, as by gltfpack without -c and -cc, or export again",
        ));
    }
    list_mut(json, "bufferViews").for_each(remove_extension);
    for buffer in list_mut(json, "buffers").filter(|buffer| is_fallback(buffer) && buffer["uri"].is_null()) {
        // No view is left that needs what it stands for.
        *buffer = json!({ "byteLength": 0, "uri": "data:," });
    }
    for key in ["extensionsUsed", "extensionsRequired"] {
        if let Some(extensions) = json.get_mut(key).and_then(Value::as_array_mut) {
            extensions.retain(|extension| !NAMES.iter().any(|name| extension == name));
        }
    }
    Ok(())
}

/// The entries of a list, without making one where there is none.
fn list_mut<'a>(json: &'a mut Value, key: &str) -> impl Iterator<Item = &'a mut Value> {
    json.get_mut(key).and_then(Value::as_array_mut).into_iter().flatten()
}

fn is_compressed(view: &Value) -> bool {
    NAMES.iter().any(|name| view["extensions"].get(name).is_some())
}

/// Whether a buffer stands for data that is there compressed, and so may have none.
fn is_fallback(buffer: &Value) -> bool {
    NAMES.iter().any(|name| buffer["extensions"][name]["fallback"] == json!(true))
}

fn remove_extension(view: &mut Value) {
    let Some(extensions) = view.get_mut("extensions").and_then(Value::as_object_mut) else { return };
    extensions.retain(|name, _| !NAMES.contains(&name.as_str()));
    if extensions.is_empty() {
        view.as_object_mut().map(|view| view.remove("extensions"));
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::document::Document;
    use super::*;

    /// A file with one compressed view: its own data in a buffer with this URI, the compressed data in the next.
    fn compressed(name: &str, uri: Value) -> Result<Document, CliError> {
        let mut fallback = json!({ "byteLength": 3, "extensions": { name: { "fallback": true } } });
        if !uri.is_null() {
            fallback["uri"] = uri;
        }
        let json = json!({ "asset": { "version": "2.0" }, "extensionsUsed": [name, "KHR_other"],
            "buffers": [fallback, { "byteLength": 1, "uri": "data:;base64,CQ==" }],
            "bufferViews": [{ "buffer": 0, "byteLength": 3, "extensions": { name:
                { "buffer": 1, "byteLength": 1, "byteStride": 1, "count": 3, "mode": "ATTRIBUTES" } } }] });
        Document::parse(json.to_string().as_bytes(), Path::new(""))
    }

    #[test]
    fn data_beside_the_compressed_is_used() {
        for name in NAMES {
            let document = compressed(name, json!("data:;base64,AQID")).unwrap();
            assert_eq!(document.view(0), Some(&[1, 2, 3][..]));
            assert_eq!(document.json["extensionsUsed"], json!(["KHR_other"]));
            assert!(!document.json["bufferViews"].to_string().contains(name));
        }
    }

    /// Zeros for the missing data would be an empty scene.
    #[test]
    fn compressed_data_alone_is_refused() {
        for name in NAMES {
            let Err(CliError::Failed(text)) = compressed(name, Value::Null) else { panic!("it was accepted") };
            assert!(text.contains("gltfpack"), "{text}");
        }
    }
}
