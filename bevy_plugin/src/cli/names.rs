//! Unique names for the nodes with a mesh, by which a bake finds its surfaces again.

use std::collections::HashSet;

use serde_json::{Value, json};

use super::document::Document;

/// Names may have this many bytes; Blender cuts longer ones off.
const MAX_BYTES: usize = 60;

/// Gives every node with a mesh a name that no other such node has: its own, cut to 60 bytes, else `nodeN`; duplicates
/// get `-N`.
///
/// The first node with a name keeps it, whatever stands before it and is called anew. Nodes without a mesh keep theirs.
pub(super) fn make_unique(document: &mut Document) {
    let nodes = document.list_mut("nodes");
    let mut taken = HashSet::new();
    let keeps = |node: &Value| {
        let fits = |name: &&str| !name.is_empty() && name.len() <= MAX_BYTES;
        let name = node["name"].as_str().filter(|_| has_mesh(node)).filter(fits);
        name.is_some_and(|name| taken.insert(name.to_owned()))
    };
    let kept: Vec<bool> = nodes.iter().map(keeps).collect();
    let names_without_mesh = nodes.iter().filter(|node| !has_mesh(node)).filter_map(|node| node["name"].as_str());
    taken.extend(names_without_mesh.map(str::to_owned));
    for (index, node) in nodes.iter_mut().enumerate() {
        if kept[index] || !has_mesh(node) {
            continue;
        }
        let wanted = match node["name"].as_str() {
            Some(name) if !name.is_empty() => cut(name, MAX_BYTES).to_owned(),
            _ => format!("node{index}"),
        };
        let name = unused(&wanted, &taken);
        node["name"] = json!(name);
        taken.insert(name);
    }
}

fn has_mesh(node: &Value) -> bool {
    node.get("mesh").is_some()
}

/// The name, or with the smallest number behind it that makes it unused.
fn unused(wanted: &str, taken: &HashSet<String>) -> String {
    if !taken.contains(wanted) {
        return wanted.to_owned();
    }
    let numbered = (1_usize..).map(|number| {
        let suffix = format!("-{number}");
        format!("{}{suffix}", cut(wanted, MAX_BYTES - suffix.len()))
    });
    numbered.into_iter().find(|name| !taken.contains(name)).unwrap_or_default()
}

/// The first bytes of a text, without half a character.
fn cut(text: &str, bytes: usize) -> &str {
    &text[..text.floor_char_boundary(bytes)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_short() {
        let long = "ä".repeat(40);
        let nodes = json!([{ "mesh": 0, "name": "Wall" }, { "mesh": 0, "name": "Wall" }, { "mesh": 0 }, { "name": "Lamp" },
            { "mesh": 0, "name": "Lamp" }, { "mesh": 0, "name": long }, { "mesh": 0, "name": long },
            { "mesh": 0, "name": "Wall-1" }]);
        let mut document = Document { json: json!({ "nodes": nodes }), buffer: Vec::new() };
        make_unique(&mut document);
        let names: Vec<&str> = document.list("nodes").iter().map(|node| node["name"].as_str().unwrap()).collect();
        // What has a name of its own keeps it, though an earlier duplicate would get it.
        assert_eq!(names[..5], ["Wall", "Wall-2", "node2", "Lamp", "Lamp"]);
        assert_eq!((names[5], names[7]), ("ä".repeat(30).as_str(), "Wall-1"));
        let with_mesh = [&names[..3], &names[4..]].concat();
        assert_eq!(with_mesh.iter().collect::<HashSet<_>>().len(), with_mesh.len());
        assert!(names.iter().all(|name| name.len() <= MAX_BYTES));
    }
}
