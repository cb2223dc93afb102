//! Whether everything that is to be baked is there.

use bevy::asset::{LoadState, UntypedAssetId, VisitAssetDependencies};
use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy::world_serialization::{WorldInstance, WorldInstanceSpawner};

use super::{Baked, SkyLight};

/// Looks at everything below `Baked` entities, and at the sky.
#[derive(SystemParam)]
pub(crate) struct Loading<'w, 's> {
    baked: Query<'w, 's, Entity, With<Baked>>,
    children: Query<'w, 's, &'static Children>,
    scenes: Query<'w, 's, (&'static WorldAssetRoot, Option<&'static WorldInstance>)>,
    mesh_handles: Query<'w, 's, &'static Mesh3d>,
    material_handles: Query<'w, 's, &'static MeshMaterial3d<StandardMaterial>>,
    skies: Query<'w, 's, &'static SkyLight>,
    meshes: Res<'w, Assets<Mesh>>,
    materials: Res<'w, Assets<StandardMaterial>>,
    spawner: Option<Res<'w, WorldInstanceSpawner>>,
    server: Res<'w, AssetServer>,
}

/// Whether a scene, a mesh, a material, a texture or the sky of what is to be baked is still loading.
///
/// What failed to load does not come back and is not waited for.
pub(crate) fn still_loading(loading: Loading) -> bool {
    loading.sky_is_loading()
        || loading.baked.iter().any(|root| {
            loading.entity_is_loading(root)
                || loading.children.iter_descendants(root).any(|entity| loading.entity_is_loading(entity))
        })
}

impl Loading<'_, '_> {
    fn entity_is_loading(&self, entity: Entity) -> bool {
        self.scene_is_loading(entity) || self.mesh_is_loading(entity) || self.material_is_loading(entity)
    }

    fn sky_is_loading(&self) -> bool {
        let images = self.skies.iter().filter_map(|sky| sky.image.as_ref());
        !self.baked.is_empty() && images.into_iter().any(|image| self.asset_is_loading(image.id().untyped()))
    }

    fn scene_is_loading(&self, entity: Entity) -> bool {
        let (Ok((scene, instance)), Some(spawner)) = (self.scenes.get(entity), &self.spawner) else { return false };
        let is_spawned = instance.is_some_and(|instance| spawner.instance_is_ready(**instance));
        let has_failed = matches!(self.server.get_load_state(scene.0.id()), Some(LoadState::Failed(_)));
        !is_spawned && !has_failed
    }

    fn mesh_is_loading(&self, entity: Entity) -> bool {
        let Ok(mesh) = self.mesh_handles.get(entity) else { return false };
        !self.meshes.contains(&mesh.0) && self.asset_is_loading(mesh.0.id().untyped())
    }

    fn material_is_loading(&self, entity: Entity) -> bool {
        let Ok(material) = self.material_handles.get(entity) else { return false };
        let Some(asset) = self.materials.get(&material.0) else {
            return self.asset_is_loading(material.0.id().untyped());
        };
        let mut texture_is_loading = false;
        asset.visit_dependencies(&mut |texture| texture_is_loading |= self.asset_is_loading(texture));
        texture_is_loading
    }

    fn asset_is_loading(&self, asset: UntypedAssetId) -> bool {
        matches!(self.server.get_load_state(asset), Some(LoadState::NotLoaded | LoadState::Loading))
    }
}
