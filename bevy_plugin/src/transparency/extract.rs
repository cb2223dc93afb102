//! What the render world must know: the components of the few entities and cameras that have them.

use bevy::camera::primitives::Aabb;
use bevy::prelude::*;
use bevy::render::Extract;
use bevy::render::sync_world::{MainEntity, MainEntityHashMap};

use super::{TransparentDepth, TransparentOrder};

/// The orders of entities and the depths of cameras.
#[derive(Resource, Default)]
pub struct Orders {
    /// With half the size of the bounding box, zero where it is not known yet.
    pub entities: MainEntityHashMap<(TransparentOrder, Vec3)>,
    pub cameras: MainEntityHashMap<TransparentDepth>,
}

type Ordered<'a> = (Entity, &'a TransparentOrder, Option<&'a Aabb>);
type IsNew = Or<(Changed<TransparentOrder>, Changed<Aabb>)>;

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
        let half_size = aabb.map_or(Vec3::ZERO, |aabb| aabb.half_extents.into());
        orders.entities.insert(entity.into(), (order, half_size));
    }
}

pub fn extract_depths(mut orders: ResMut<Orders>, cameras: Extract<Query<(Entity, &TransparentDepth), With<Camera>>>) {
    orders.cameras.clear();
    orders.cameras.extend(cameras.iter().map(|(camera, &depth)| (camera.into(), depth)));
}
