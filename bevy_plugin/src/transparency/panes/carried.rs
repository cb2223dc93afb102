//! What the pieces of a pane take over from it.

use std::any::TypeId;

use bevy::camera::visibility::RenderLayers;
use bevy::ecs::component::ComponentId;
use bevy::ecs::entity::EntityCloner;
use bevy::light::{NotShadowCaster, NotShadowReceiver};
use bevy::pbr::Lightmap;
use bevy::prelude::*;

use super::Pieces;
use crate::transparency::TransparentOrder;

/// The components that the pieces of a [`SplitPane`](super::SplitPane) take over from it, where it has them.
///
/// `MeshMaterial3d<StandardMaterial>`, `Lightmap`, `RenderLayers`, `NotShadowCaster`, `NotShadowReceiver` and
/// [`TransparentOrder`] are among them; add `MeshMaterial3d<M>` for materials of your own.
#[derive(Resource, Clone, Debug)]
pub struct PieceComponents(Vec<TypeId>);

impl PieceComponents {
    /// One more.
    pub fn add<C: Component + Clone>(&mut self) -> &mut Self {
        self.0.push(TypeId::of::<C>());
        self
    }
}

impl Default for PieceComponents {
    fn default() -> Self {
        let mut components = Self(Vec::new());
        components.add::<MeshMaterial3d<StandardMaterial>>().add::<Lightmap>().add::<RenderLayers>();
        components.add::<NotShadowCaster>().add::<NotShadowReceiver>().add::<TransparentOrder>();
        components
    }
}

/// Those of its components that an entity has.
pub fn carried(world: &World, entity: Entity) -> Vec<ComponentId> {
    let (PieceComponents(types), Ok(entity)) = (world.resource(), world.get_entity(entity)) else { return Vec::new() };
    let ids = types.iter().filter_map(|&id| world.components().get_valid_id(id));
    ids.filter(|&id| entity.contains_id(id)).collect()
}

/// Gives a piece what its pane has, and takes from it what that has not.
pub fn carry(world: &mut World, pane: Entity, piece: Entity, components: &[ComponentId]) {
    let surplus: Vec<ComponentId> =
        carried(world, piece).into_iter().filter(|component| !components.contains(component)).collect();
    world.entity_mut(piece).remove_by_ids(&surplus);
    EntityCloner::build_opt_in(world)
        .without_required_components(|cloner| {
            cloner.allow_by_ids(components.iter().copied());
        })
        .clone_entity(pane, piece);
}

/// Does so for those panes whose components have changed since the system ran last.
pub fn carry_changes<'a>(world: &mut World, panes: impl Iterator<Item = (Entity, &'a [ComponentId])>) {
    let (last_run, this_run) = (world.last_change_tick(), world.read_change_tick());
    for (pane, components) in panes {
        let Ok(entity) = world.get_entity(pane) else { continue };
        let ticks = components.iter().filter_map(|&id| entity.get_change_ticks_by_id(id));
        let has_changed = ticks.into_iter().any(|ticks| ticks.is_changed(last_run, this_run));
        let Some(Pieces(pieces)) = entity.get::<Pieces>().filter(|_| has_changed) else { continue };
        for piece in pieces.clone() {
            carry(world, pane, piece, components);
        }
    }
}
