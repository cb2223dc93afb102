//! Takes data out of a glTF file that nothing refers to any more.

use std::collections::HashSet;

use serde_json::{Value, json};

use super::document::Document;

/// Bytes of four floats; vertices and indices have no larger elements.
const LARGEST_ELEMENT: usize = 16;

/// Empties those of the replaced accessors that nothing refers to, and takes their data out of the buffer.
///
/// The accessors and views themselves stay, with one element, so that no index changes its meaning and readers that want
/// data behind every accessor find some.
pub(super) fn prune(document: &mut Document, replaced: &HashSet<usize>) {
    let live = live_accessors(document);
    let unused: HashSet<usize> = replaced.difference(&live).copied().collect();
    let live_views = live_views(document, &unused);
    let mut dead_views = HashSet::new();
    for &index in &unused {
        let accessor = &mut document.list_mut("accessors")[index];
        let views = views_of(accessor);
        if accessor["bufferView"].is_null() || views.iter().any(|view| live_views.contains(view)) {
            continue;
        }
        dead_views.extend(views);
        let (component, kind, view) = (&accessor["componentType"], &accessor["type"], &accessor["bufferView"]);
        *accessor = json!({ "componentType": component, "type": kind, "bufferView": view, "count": 1 });
    }
    let old = std::mem::take(&mut document.buffer);
    let mut buffer = Vec::with_capacity(old.len());
    for (index, view) in document.list_mut("bufferViews").iter_mut().enumerate() {
        if dead_views.contains(&index) {
            *view = json!({ "buffer": 0, "byteLength": LARGEST_ELEMENT });
            continue;
        }
        let number = |value: &Value| value.as_u64().unwrap_or(0) as usize;
        let (start, length) = (number(&view["byteOffset"]), number(&view["byteLength"]));
        buffer.resize(usize::next_multiple_of(buffer.len(), 4), 0);
        view["byteOffset"] = json!(buffer.len());
        buffer.extend(old.get(start..start + length).unwrap_or(&[]));
    }
    buffer.resize(buffer.len().max(LARGEST_ELEMENT), 0);
    document.json["buffers"] = json!([{ "byteLength": buffer.len() }]);
    document.buffer = buffer;
}

/// Every accessor that something refers to, or may, in an extension.
fn live_accessors(document: &Document) -> HashSet<usize> {
    let objects = |value: &Value| value.as_object().into_iter().flatten().map(|(_, v)| v.clone()).collect::<Vec<_>>();
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let mut live: Vec<Value> = Vec::new();
    for primitive in document.list("meshes").iter().flat_map(|mesh| list(&mesh["primitives"])) {
        live.extend(objects(&primitive["attributes"]));
        live.extend(list(&primitive["targets"]).iter().flat_map(objects));
        live.push(primitive["indices"].clone());
    }
    for sampler in document.list("animations").iter().flat_map(|animation| list(&animation["samplers"])) {
        live.extend([sampler["input"].clone(), sampler["output"].clone()]);
    }
    live.extend(document.list("skins").iter().map(|skin| skin["inverseBindMatrices"].clone()));
    let mut indices = live.iter().filter_map(|value| Some(value.as_u64()? as usize)).collect();
    numbers_of_extensions(&document.json, false, &mut indices);
    indices
}

/// Every view that an image or a used accessor refers to, or an extension may.
fn live_views(document: &Document, unused: &HashSet<usize>) -> HashSet<usize> {
    let used = document.list("accessors").iter().enumerate().filter(|(index, _)| !unused.contains(index));
    let mut live = used.map(|(_, accessor)| accessor).chain(document.list("images")).flat_map(views_of).collect();
    numbers_of_extensions(&document.json, false, &mut live);
    live
}

/// The views that an accessor or an image refers to.
fn views_of(user: &Value) -> Vec<usize> {
    let sparse = &user["sparse"];
    let places = [&user["bufferView"], &sparse["indices"]["bufferView"], &sparse["values"]["bufferView"]];
    places.into_iter().filter_map(|view| Some(view.as_u64()? as usize)).collect()
}

/// All whole numbers inside of extensions: what they mean is not known, so each may be an index.
fn numbers_of_extensions(value: &Value, inside: bool, numbers: &mut HashSet<usize>) {
    match value {
        Value::Number(number) if inside => numbers.extend(number.as_u64().map(|number| number as usize)),
        Value::Array(list) => list.iter().for_each(|value| numbers_of_extensions(value, inside, numbers)),
        Value::Object(object) => {
            for (key, value) in object {
                numbers_of_extensions(value, inside || key == "extensions", numbers);
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::super::accessor::Elements;
    use super::*;

    /// Only what was replaced and is used nowhere goes; all other elements stay as they were.
    #[test]
    fn what_is_used_stays() {
        let mut document = Document { json: json!({ "asset": { "version": "2.0" } }), buffer: Vec::new() };
        let accessors: Vec<usize> =
            (0..4).map(|i| Elements::vec3(&[[i as f32; 3]; 5]).write(&mut document, true)).collect();
        document.json["meshes"] = json!([{ "primitives": [{ "attributes": { "POSITION": accessors[1] } }] }]);
        document.json["extensions"] = json!({ "EXT_unknown": { "something": accessors[2] } });
        let before = document.clone();
        prune(&mut document, &HashSet::from([0, 1, 2]));
        assert_eq!(document.buffer.len(), 3 * 60);
        for &kept in &accessors[1..] {
            let read = |document| Elements::read(document, kept).unwrap();
            assert_eq!(read(&document), read(&before));
        }
        assert_eq!(Elements::read(&document, 0).unwrap().count(), 1);
    }
}
