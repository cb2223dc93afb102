//! Makes `Lightmap` components safe to add, change and remove at any time, which Bevy 0.19.1 alone does not.
//!
//! | what happens | Bevy alone | with [`LightmapGuardPlugin`] |
//! |---|---|---|
//! | a lightmap comes or goes after its mesh was drawn | the renderer stops with a validation error | it shows |
//! | `Lightmap::image` becomes another handle | the old one stays (bevyengine/bevy#20299) | one frame without, then the new one |
//! | the mesh has no `UV_1` | the mesh is not drawn | the lightmap is taken off, with a warning |
//! | the mesh is skinned or morphed | the renderer stops | the lightmap is taken off, with a warning |
//! | the camera renders deferred | baked and ambient light count twice (bevyengine/bevy#20140) | so too, with one warning |

use bevy::asset::AssetEventSystems;
use bevy::core_pipeline::prepass::DeferredPrepass;
use bevy::ecs::entity::{EntityHashMap, EntityHashSet};
use bevy::mesh::MeshVertexAttribute;
use bevy::pbr::Lightmap;
use bevy::prelude::*;

/// Makes `Lightmap` components safe to add, change and remove at any time.
#[derive(Default)]
pub struct LightmapGuardPlugin;

/// What the plugin does to lightmaps, in this order.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LightmapSystems {
    /// In `First`: lightmaps whose image was replaced in the last frame come back.
    Return,
    /// In `PostUpdate`, before asset events: lightmaps that their meshes cannot carry are taken off.
    Check,
    /// In `PostUpdate`, before asset events: the renderer learns of all changes.
    Announce,
}

impl Plugin for LightmapGuardPlugin {
    fn build(&self, app: &mut App) {
        app.configure_sets(First, LightmapSystems::Return)
            .configure_sets(
                PostUpdate,
                (LightmapSystems::Check, LightmapSystems::Announce).chain().before(AssetEventSystems),
            )
            .add_systems(First, return_held_back.in_set(LightmapSystems::Return))
            .add_systems(
                PostUpdate,
                (
                    (take_off_unfit, warn_of_deferred_cameras).in_set(LightmapSystems::Check),
                    (hold_back_new_images, mark_meshes_changed).chain().in_set(LightmapSystems::Announce),
                ),
            );
    }
}

/// A lightmap that stays away for one frame, so that the renderer forgets the image that it showed before.
#[derive(Component, Reflect)]
#[reflect(Component)]
pub(crate) struct HeldBack(Lightmap);

fn return_held_back(mut commands: Commands, held_back: Query<(Entity, &HeldBack)>) {
    for (entity, HeldBack(lightmap)) in &held_back {
        commands.entity(entity).insert_if_new(lightmap.clone()).remove::<HeldBack>();
    }
}

/// A lightmap or a mesh is new to the other.
type NewPair = (With<Lightmap>, Or<(Changed<Lightmap>, Changed<Mesh3d>)>);

/// Meshes that are still loading are looked at when they are there.
fn take_off_unfit(
    mut commands: Commands,
    new_pairs: Query<Entity, NewPair>,
    lit: Query<(&Mesh3d, Option<&Name>), With<Lightmap>>,
    meshes: Res<Assets<Mesh>>,
    mut unchecked: Local<EntityHashSet>,
) {
    unchecked.extend(&new_pairs);
    unchecked.retain(|&entity| {
        let Ok((mesh_handle, name)) = lit.get(entity) else { return false };
        let Some(mesh) = meshes.get(&mesh_handle.0) else { return true };
        if let Err(reason) = can_carry_lightmap(mesh) {
            let name = name.map_or_else(|| entity.to_string(), Name::to_string);
            warn!("\"{name}\" cannot have a lightmap and loses it: {reason}");
            commands.entity(entity).remove::<Lightmap>();
        }
        false
    });
}

/// Whether Bevy can draw a mesh with a lightmap; else why not and what to do.
///
/// A mesh whose data lives on the GPU only cannot be looked into and passes.
fn can_carry_lightmap(mesh: &Mesh) -> Result<(), &'static str> {
    let has = |attribute: MeshVertexAttribute, unknown| mesh.try_contains_attribute(attribute).unwrap_or(unknown);
    if has(Mesh::ATTRIBUTE_JOINT_INDEX, false) && has(Mesh::ATTRIBUTE_JOINT_WEIGHT, false) {
        return Err("its mesh is skinned; light it in real time");
    }
    if mesh.try_has_morph_targets().unwrap_or(false) {
        return Err("its mesh has morph targets; light it in real time");
    }
    if !has(Mesh::ATTRIBUTE_UV_1, true) {
        return Err("its mesh has no UV_1; bake again, or bring back the mesh that was baked");
    }
    Ok(())
}

fn warn_of_deferred_cameras(
    deferred_cameras: Query<(), With<DeferredPrepass>>,
    lightmaps: Query<(), With<Lightmap>>,
    mut warned: Local<bool>,
) {
    if *warned || deferred_cameras.is_empty() || lightmaps.is_empty() {
        return;
    }
    *warned = true;
    warn!(
        "a camera renders deferred: Bevy 0.19 then adds baked lights and ambient light a second time to meshes with \
         lightmaps; render forward, or remove the baked lights"
    );
}

/// The renderer reads the image of a lightmap only when the lightmap is new to it.
fn hold_back_new_images(
    mut commands: Commands,
    changed: Query<(Entity, &Lightmap), Changed<Lightmap>>,
    lightmaps: Query<(), With<Lightmap>>,
    mut removed: RemovedComponents<Lightmap>,
    mut shown: Local<EntityHashMap<AssetId<Image>>>,
) {
    for (entity, lightmap) in &changed {
        let image = lightmap.image.id();
        if shown.insert(entity, image).is_some_and(|before| before != image) {
            shown.remove(&entity);
            commands.entity(entity).remove::<Lightmap>().insert(HeldBack(lightmap.clone()));
        }
    }
    for entity in removed.read().filter(|&entity| !lightmaps.contains(entity)) {
        shown.remove(&entity);
    }
}

/// The renderer chooses a new pipeline only for entities whose mesh or material component changed.
fn mark_meshes_changed(
    changed: Query<Entity, Changed<Lightmap>>,
    mut removed: RemovedComponents<Lightmap>,
    mut meshes: Query<&mut Mesh3d>,
) {
    for entity in changed.iter().chain(removed.read()) {
        if let Ok(mut mesh) = meshes.get_mut(entity) {
            mesh.set_changed();
        }
    }
}
