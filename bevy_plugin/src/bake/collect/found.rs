//! The material of an entity, whichever type it has.

use bevy::asset::UntypedAssetId;
use bevy::ecs::world::EntityRef;
use bevy::gltf::{GltfMaterial, GltfMaterialName};
use bevy::prelude::*;

use crate::convert::MaterialInputs;
use crate::gltf::GltfMaterial3d;

/// A material and what it is called.
pub(super) struct Found {
    pub id: UntypedAssetId,
    pub name: Option<String>,
    pub inputs: MaterialInputs,
}

/// Where materials are looked for, what is drawn first.
pub(super) const LOOKUPS: &[fn(&World, EntityRef) -> Option<Found>] = &[
    #[cfg(feature = "render")]
    standard_material,
    gltf_material,
];

#[cfg(feature = "render")]
fn standard_material(world: &World, entity: EntityRef) -> Option<Found> {
    let handle = &entity.get::<MeshMaterial3d<StandardMaterial>>()?.0;
    let inputs = world.get_resource::<Assets<StandardMaterial>>()?.get(handle)?.into();
    Some(Found { id: handle.id().untyped(), name: name(entity), inputs })
}

fn gltf_material(world: &World, entity: EntityRef) -> Option<Found> {
    let handle = &entity.get::<GltfMaterial3d>()?.0;
    let inputs = world.get_resource::<Assets<GltfMaterial>>()?.get(handle)?.into();
    Some(Found { id: handle.id().untyped(), name: name(entity), inputs })
}

fn name(entity: EntityRef) -> Option<String> {
    entity.get::<GltfMaterialName>().map(|name| name.0.clone())
}
