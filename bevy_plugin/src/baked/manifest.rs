//! Which lightmap belongs to which surface: `manifest.json` of a saved bake.

use radiosity::bake::Bake;
use radiosity::lightmap::Placement;
use serde::{Deserialize, Serialize};

/// Name of the manifest in the folder of a bake.
pub const FILE_NAME: &str = "manifest.json";

/// The lightmaps of a saved bake and the surfaces that they belong to.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of the format; 1.
    pub version: u32,
    /// Hash of the scene and of all settings that have a say in the texels, in hexadecimal.
    pub hash: String,
    /// The lightmaps.
    pub images: Vec<ImageEntry>,
    /// Every surface that has a lightmap.
    pub surfaces: Vec<SurfaceEntry>,
    /// Every light that is in the lightmaps, so that it need not light those surfaces again.
    #[serde(default)]
    pub lights: Vec<LightEntry>,
}

/// One lightmap.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ImageEntry {
    /// KTX2 file beside the manifest.
    pub file: String,
    /// The same texels in 32-bit floats, beside the manifest; not every bake has them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exr: Option<String>,
    /// Texels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

/// A surface and its place in a lightmap.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfaceEntry {
    /// Which surface.
    #[serde(flatten)]
    pub key: SurfaceKey,
    /// Index into the images.
    pub image: usize,
    /// Smallest `u` and `v`, then greatest `u` and `v`, in `0..1`, `v` down.
    pub uv_rect: [f32; 4],
    /// File beside the manifest with the lightmap coordinates of the mesh; without one the mesh brings them along.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uv: Option<String>,
}

/// How a surface is found again.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(untagged)]
pub enum SurfaceKey {
    /// By its indices in the `scene.glb` beside the manifest.
    Gltf {
        /// Index of the node.
        node: usize,
        /// Name of the node, which no other node with a mesh has.
        node_name: String,
        /// Index of the mesh.
        mesh: usize,
        /// Index of the primitive within the mesh.
        primitive: usize,
    },
    /// By the `BakeId` of its entity.
    Entity {
        /// The text of the `BakeId`.
        bake_id: String,
    },
}

/// How a light is found again.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(untagged)]
pub enum LightEntry {
    /// By its node in the `scene.glb` beside the manifest.
    Gltf {
        /// Index of the node.
        node: usize,
    },
    /// By the `BakeId` of its entity.
    Entity {
        /// The text of the `BakeId`.
        bake_id: String,
    },
}

impl Manifest {
    /// Describes a bake. `surface_key` names a surface by its index in the scene, where it can be found again.
    pub fn new(hash: String, bake: &Bake, surface_key: impl Fn(usize) -> Option<SurfaceKey>) -> Self {
        let images = bake.images.iter().enumerate().map(|(index, image)| ImageEntry {
            file: image_file(index),
            exr: None,
            width: image.width,
            height: image.height,
        });
        let surfaces = bake.placements.iter().enumerate().filter_map(|(index, placement)| {
            let Placement { image, min, max } = (*placement)?;
            Some(SurfaceEntry { key: surface_key(index)?, image, uv_rect: [min.x, min.y, max.x, max.y], uv: None })
        });
        Self { version: 1, hash, images: images.collect(), surfaces: surfaces.collect(), lights: Vec::new() }
    }
}

/// The file of a lightmap.
pub(crate) fn image_file(index: usize) -> String {
    format!("lightmap-{index}.ktx2")
}

/// FNV-1a in hexadecimal, which stays the same forever.
pub fn hash<'a>(bytes: impl IntoIterator<Item = &'a u8>) -> String {
    let mix = |hash: u64, &byte: &u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3);
    format!("{:016x}", bytes.into_iter().fold(0xCBF2_9CE4_8422_2325, mix))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The names that other tools read.
    #[test]
    fn has_the_documented_shape() {
        let text = r#"{"version":1,"hash":"0a","images":[{"file":"a.ktx2","exr":"a.exr","width":4,"height":8}],
            "surfaces":[{"node":1,"node_name":"Wall","mesh":2,"primitive":3,"image":0,"uv_rect":[0,0.25,0.5,1]},
                        {"bake_id":"floor","image":0,"uv_rect":[0,0,1,1]}]}"#;
        let manifest: Manifest = serde_json::from_str(text).unwrap();
        let wall = SurfaceKey::Gltf { node: 1, node_name: "Wall".into(), mesh: 2, primitive: 3 };
        assert_eq!(
            manifest.surfaces[0],
            SurfaceEntry { key: wall, image: 0, uv_rect: [0.0, 0.25, 0.5, 1.0], uv: None }
        );
        assert_eq!(manifest.surfaces[1].key, SurfaceKey::Entity { bake_id: "floor".into() });
        let again: Manifest = serde_json::from_str(&serde_json::to_string(&manifest).unwrap()).unwrap();
        assert_eq!(again, manifest);
    }
}
