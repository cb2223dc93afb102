//! A saved bake as an asset.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use bevy::asset::io::Reader;
use bevy::asset::{AssetLoader, LoadContext, ParseAssetPathError, ReadAssetBytesError, RenderAssetUsages};
use bevy::image::{ImageLoaderSettings, ImageSampler};
use bevy::prelude::*;
use radiosity::lightmap::LightmapUv;

use super::manifest::Manifest;
use super::uv::{self, BrokenUvFile};

/// A saved bake: `manifest.json` with the lightmaps beside it.
///
/// ```no_run
/// # use bevy::prelude::*;
/// # use bevy_radiosity::prelude::*;
/// fn spawn_level(mut commands: Commands, assets: Res<AssetServer>) {
///     commands.spawn((
///         WorldAssetRoot(assets.load("level/scene.glb#Scene0")),
///         BakedSceneRoot(assets.load("level/manifest.json")),
///     ));
/// }
/// ```
#[derive(Asset, Reflect, Clone, Debug, Default)]
pub struct BakedScene {
    /// Which lightmap belongs to which surface.
    #[reflect(ignore)]
    pub manifest: Manifest,
    /// The lightmaps, in the order of the manifest.
    #[dependency]
    pub images: Vec<Handle<Image>>,
    /// Lightmap coordinates of the meshes that brought none along, by the file names in the manifest.
    #[reflect(ignore)]
    pub uvs: BTreeMap<String, Arc<LightmapUv>>,
}

/// Loads [`BakedScene`]s. It has no file extension of its own: load with the type, from a path of any name.
#[derive(Default, TypePath)]
pub struct BakedSceneLoader;

impl AssetLoader for BakedSceneLoader {
    type Asset = BakedScene;
    type Settings = ();
    type Error = BakedSceneError;

    async fn load(
        &self,
        reader: &mut dyn Reader,
        _settings: &(),
        load_context: &mut LoadContext<'_>,
    ) -> Result<BakedScene, BakedSceneError> {
        let mut bytes = Vec::new();
        reader.read_to_end(&mut bytes).await?;
        let manifest: Manifest = serde_json::from_slice(&bytes)?;
        check(&manifest)?;
        let manifest_path = load_context.path().clone();
        let mut images = Vec::new();
        for image in &manifest.images {
            let path = manifest_path.resolve_embed_str(&image.file)?;
            images.push(load_context.load_builder().with_settings(as_lightmap).load(path));
        }
        let mut uvs = BTreeMap::new();
        for file in manifest.surfaces.iter().filter_map(|surface| surface.uv.as_ref()) {
            if !uvs.contains_key(file) {
                let bytes = load_context.read_asset_bytes(manifest_path.resolve_embed_str(file)?).await?;
                uvs.insert(file.clone(), Arc::new(uv::decode(&bytes)?));
            }
        }
        Ok(BakedScene { manifest, images, uvs })
    }
}

/// Why a saved bake could not be loaded. Its text says what to do.
#[derive(Debug)]
pub enum BakedSceneError {
    /// A file could not be read.
    Io(std::io::Error),
    /// A file beside the manifest could not be read.
    Beside(ReadAssetBytesError),
    /// A file name in the manifest is none.
    Path(ParseAssetPathError),
    /// The manifest is no manifest.
    Json(serde_json::Error),
    /// The manifest is of another version than 1.
    Version(u32),
    /// The manifest contradicts itself; the text says where.
    Invalid(String),
    /// A file of lightmap coordinates is broken.
    Uv(BrokenUvFile),
}

impl fmt::Display for BakedSceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => write!(f, "the manifest of the bake cannot be read: {error}"),
            Self::Beside(error) => write!(f, "a file beside the manifest of the bake cannot be read: {error}"),
            Self::Path(error) => write!(f, "the manifest of the bake has a broken file name: {error}"),
            Self::Json(error) => write!(f, "the manifest of the bake is broken, save the bake again: {error}"),
            Self::Version(version) => {
                write!(f, "the manifest of the bake has version {version} and this app reads version 1; bake again")
            }
            Self::Invalid(what) => write!(f, "the manifest of the bake is broken, save the bake again: {what}"),
            Self::Uv(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for BakedSceneError {}

impl From<std::io::Error> for BakedSceneError {
    fn from(error: std::io::Error) -> Self {
        Self::Io(error)
    }
}

impl From<ReadAssetBytesError> for BakedSceneError {
    fn from(error: ReadAssetBytesError) -> Self {
        Self::Beside(error)
    }
}

impl From<ParseAssetPathError> for BakedSceneError {
    fn from(error: ParseAssetPathError) -> Self {
        Self::Path(error)
    }
}

impl From<serde_json::Error> for BakedSceneError {
    fn from(error: serde_json::Error) -> Self {
        Self::Json(error)
    }
}

impl From<BrokenUvFile> for BakedSceneError {
    fn from(error: BrokenUvFile) -> Self {
        Self::Uv(error)
    }
}

/// After this no index and no rectangle of the manifest is out of range.
fn check(manifest: &Manifest) -> Result<(), BakedSceneError> {
    if manifest.version != 1 {
        return Err(BakedSceneError::Version(manifest.version));
    }
    for (index, surface) in manifest.surfaces.iter().enumerate() {
        let [min_u, min_v, max_u, max_v] = surface.uv_rect;
        let is_inside = 0.0 <= min_u && min_u < max_u && max_u <= 1.0 && 0.0 <= min_v && min_v < max_v && max_v <= 1.0;
        if surface.image >= manifest.images.len() || !is_inside {
            return Err(BakedSceneError::Invalid(format!("surface {index} lies outside of the images")));
        }
    }
    Ok(())
}

fn as_lightmap(settings: &mut ImageLoaderSettings) {
    settings.is_srgb = false;
    settings.sampler = ImageSampler::linear();
    // Nothing but the renderer reads the texels.
    settings.asset_usage = RenderAssetUsages::RENDER_WORLD;
}
