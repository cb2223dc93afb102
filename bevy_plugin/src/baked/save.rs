//! The bake of this app into files.

use std::collections::{BTreeSet, HashMap};
use std::path::{Path, PathBuf};
use std::{fmt, fs, io};

use bevy::prelude::*;

use super::manifest::{FILE_NAME, LightEntry, Manifest, SurfaceKey, hash};
use super::{ktx2, uv};
use crate::attach::{Lit, label};
use crate::bake::{AppliedBake, BakeId};
use crate::gltf::{GltfLightSource, GltfSource};

/// Saves the bake of this app, so that `BakedSceneRoot` attaches it without baking.
///
/// Every baked entity needs a `BakeId` of its own, or is in a glTF scene that is spawned once.
#[derive(Event, Reflect, Clone, Debug)]
pub struct SaveBake {
    /// Gets `manifest.json` and the lightmaps; made if it is not there.
    pub folder: PathBuf,
}

/// The bake is saved.
#[derive(Event, Reflect, Clone, Debug)]
pub struct BakeSaved {
    /// Has `manifest.json` and the lightmaps.
    pub folder: PathBuf,
}

/// The bake was not saved.
#[derive(Event, Reflect, Debug)]
#[reflect(from_reflect = false)]
pub struct SaveFailed {
    /// Why, and what to do about it.
    #[reflect(ignore)]
    pub error: SaveError,
}

/// Why a bake was not saved. Its text says what to do.
#[derive(Debug)]
pub enum SaveError {
    /// There is no bake.
    NothingToSave,
    /// An entity could not be found again.
    NoBakeId {
        /// Its name or number.
        entity: String,
    },
    /// Two entities could not be told apart.
    SameKey {
        /// The name or number of one of them.
        entity: String,
        /// The name or number of the other one.
        other: String,
    },
    /// A file could not be written.
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
}

impl fmt::Display for SaveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NothingToSave => write!(f, "there is no bake to save; trigger `StartBake` and wait for `BakeDone`"),
            Self::NoBakeId { entity } => write!(
                f,
                "\"{entity}\" could not be found again when the bake is loaded; give it a `BakeId` of its own and save again"
            ),
            Self::SameKey { entity, other } => write!(
                f,
                "\"{entity}\" and \"{other}\" could not be told apart when the bake is loaded; give each a `BakeId` of its own"
            ),
            Self::Io { path, error } => write!(f, "{} cannot be written: {error}", path.display()),
        }
    }
}

impl std::error::Error for SaveError {}

pub(super) fn on_save(save: On<SaveBake>, mut commands: Commands) {
    let folder = save.folder.clone();
    commands.queue(move |world: &mut World| match save_bake(world, &folder) {
        Ok(()) => world.trigger(BakeSaved { folder }),
        Err(error) => world.trigger(SaveFailed { error }),
    });
}

/// What [`SaveBake`] does, at once.
///
/// # Errors
///
/// See [`SaveError`]. The manifest is written last, so that a bake that was saved before stays whole until then.
pub fn save_bake(world: &World, folder: &Path) -> Result<(), SaveError> {
    let applied = world.get_resource::<AppliedBake>().ok_or(SaveError::NothingToSave)?;
    let mut manifest = describe(world, applied)?;
    let io_error = |path: &Path| {
        let path = path.to_owned();
        move |error| SaveError::Io { path, error }
    };
    fs::create_dir_all(folder).map_err(io_error(folder))?;
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        write_whole(&path, bytes).map_err(io_error(&path))
    };
    let mut images = Vec::new();
    for (image, entry) in applied.bake.images.iter().zip(&manifest.images) {
        let bytes = ktx2::encode(image);
        write(&entry.file, &bytes)?;
        images.push(bytes);
    }
    // The scene itself is not at hand; other lightmaps make another hash.
    manifest.hash = hash(images.iter().flatten());
    let files: BTreeSet<_> = manifest.surfaces.iter().filter_map(|surface| surface.uv.as_deref()).collect();
    for (mesh, uv) in applied.bake.uvs.iter().enumerate() {
        let file = uv_file(mesh);
        if let (Some(uv), true) = (uv, files.contains(&*file)) {
            write(&file, &uv::encode(uv))?;
        }
    }
    let json = serde_json::to_vec_pretty(&manifest).map_err(io::Error::from);
    write(FILE_NAME, &json.map_err(io_error(folder))?)
}

/// Never leaves half a file.
fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let unfinished = path.with_added_extension("part");
    fs::write(&unfinished, bytes)?;
    fs::rename(&unfinished, path)
}

fn uv_file(mesh: usize) -> String {
    format!("uv-{mesh}.bin")
}

fn describe(world: &World, applied: &AppliedBake) -> Result<Manifest, SaveError> {
    let mut owners = HashMap::new();
    let mut keys = Vec::new();
    for (&entity, placement) in applied.surfaces.iter().zip(&applied.bake.placements) {
        // An entity that is gone by now needs no light.
        if placement.is_none() || world.get::<Lit>(entity).is_none() {
            keys.push(None);
            continue;
        }
        let key = surface_key(world, entity)?;
        if let Some(other) = owners.insert(key.clone(), entity) {
            return Err(SaveError::SameKey { entity: label(world, entity), other: label(world, other) });
        }
        keys.push(Some(key));
    }
    let mut manifest = Manifest::new(String::new(), &applied.bake, |surface| keys[surface].clone());
    let kept = (0..keys.len()).filter(|&surface| keys[surface].is_some());
    for (surface, entry) in kept.zip(&mut manifest.surfaces) {
        let lit = world.get::<Lit>(applied.surfaces[surface]);
        let is_new_mesh = lit.is_some_and(|lit| lit.mesh != lit.baked_mesh);
        entry.uv = is_new_mesh.then(|| uv_file(applied.surface_meshes[surface]));
    }
    let lights = applied.lights.iter().filter(|&&light| world.get_entity(light).is_ok());
    manifest.lights = lights.map(|&light| light_key(world, light)).collect::<Result<_, _>>()?;
    Ok(manifest)
}

fn surface_key(world: &World, entity: Entity) -> Result<SurfaceKey, SaveError> {
    if let Some(id) = world.get::<BakeId>(entity) {
        return Ok(SurfaceKey::Entity { bake_id: id.0.clone() });
    }
    let Some(&GltfSource { node, mesh, primitive }) = world.get(entity) else {
        return Err(SaveError::NoBakeId { entity: label(world, entity) });
    };
    let parent = world.get::<ChildOf>(entity).map(ChildOf::parent);
    let node_name = parent.and_then(|parent| world.get::<Name>(parent)).map_or_else(String::new, Name::to_string);
    Ok(SurfaceKey::Gltf { node, node_name, mesh, primitive })
}

fn light_key(world: &World, entity: Entity) -> Result<LightEntry, SaveError> {
    if let Some(id) = world.get::<BakeId>(entity) {
        return Ok(LightEntry::Entity { bake_id: id.0.clone() });
    }
    match world.get::<GltfLightSource>(entity) {
        Some(&GltfLightSource { node }) => Ok(LightEntry::Gltf { node }),
        None => Err(SaveError::NoBakeId { entity: label(world, entity) }),
    }
}
