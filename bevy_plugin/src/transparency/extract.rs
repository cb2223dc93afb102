//! What the render world must know: what has moved, and the components of the few entities and cameras that have them.

use bevy::camera::primitives::Aabb;
use bevy::core_pipeline::core_3d::Transparent3d;
use bevy::pbr::Transmissive3d;
use bevy::prelude::*;
use bevy::render::Extract;
use bevy::render::render_phase::ViewSortedRenderPhases;
use bevy::render::sync_world::{MainEntity, MainEntityHashMap};

use super::phase::DepthSorted;
use super::{TransparentDepth, TransparentOrder};

/// The meshes that have moved since the last frame, transparent or not, with the centers of their bounding boxes in the
/// world, where they have one. Empty while nothing is transparent.
#[derive(Resource, Default)]
pub struct Moved(pub Vec<(MainEntity, Option<Vec3>)>);

/// The orders of entities and the depths of cameras.
#[derive(Resource, Default)]
pub struct Orders {
    /// With the bounding box, where it is known.
    pub entities: MainEntityHashMap<(TransparentOrder, Option<Aabb>)>,
    pub cameras: MainEntityHashMap<TransparentDepth>,
}

type Place<'a> = (Entity, &'a GlobalTransform, Option<&'a Aabb>);
type HasMoved = (With<Mesh3d>, Or<(Changed<GlobalTransform>, Changed<Aabb>)>);
type Ordered<'a> = (Entity, &'a TransparentOrder, Option<&'a Aabb>);
type IsNew = Or<(Changed<TransparentOrder>, Changed<Aabb>)>;

/// What comes into view in this frame is queued with its place of this frame: it is enough to follow what was in view in
/// the last one.
pub fn extract_moved(
    mut moved: ResMut<Moved>,
    transparent: Option<Res<ViewSortedRenderPhases<Transparent3d>>>,
    transmissive: Option<Res<ViewSortedRenderPhases<Transmissive3d>>>,
    meshes: Extract<Query<Place, HasMoved>>,
) {
    moved.0.clear();
    if has_items(transparent.as_deref()) || has_items(transmissive.as_deref()) {
        moved.0.extend(meshes.iter().map(|(entity, transform, aabb)| {
            (entity.into(), aabb.map(|aabb| transform.transform_point(aabb.center.into())))
        }));
    }
}

fn has_items<I: DepthSorted>(phases: Option<&ViewSortedRenderPhases<I>>) -> bool {
    phases.is_some_and(|phases| phases.values().any(|phase| !phase.items.is_empty()))
}

pub fn extract_orders(
    mut orders: ResMut<Orders>,
    changed: Extract<Query<Ordered, IsNew>>,
    all: Extract<Query<(), With<TransparentOrder>>>,
    mut removed: Extract<RemovedComponents<TransparentOrder>>,
) {
    for entity in removed.read().filter(|&entity| !all.contains(entity)) {
        orders.entities.remove(&MainEntity::from(entity));
    }
    for (entity, &order, aabb) in &changed {
        orders.entities.insert(entity.into(), (order, aabb.copied()));
    }
}

pub fn extract_depths(mut orders: ResMut<Orders>, cameras: Extract<Query<(Entity, &TransparentDepth), With<Camera>>>) {
    orders.cameras.clear();
    orders.cameras.extend(cameras.iter().map(|(camera, &depth)| (camera.into(), depth)));
}
