//! Where a transparent thing is, as the renderer will draw it in this frame.

use bevy::camera::primitives::Aabb;
use bevy::core_pipeline::core_3d::TransparentSortingInfo3d;
use bevy::ecs::system::SystemParam;
use bevy::math::{Affine3, Affine3A, Affine3Ext, Vec3A};
use bevy::pbr::{MeshInputUniform, MeshUniform, RenderMeshInstances};
use bevy::prelude::*;
use bevy::render::batching::gpu_preprocessing::BatchedInstanceBuffers;
use bevy::render::mesh::RenderMesh;
use bevy::render::render_asset::RenderAssets;
use bevy::render::sync_world::MainEntity;
use radiosity::composite::{Bounds, BoxPoint, DrawKey, ViewDepth};

use super::extract::Orders;
use super::panes::ExtractedPanes;
use super::{TransparentKey, TransparentOrder};

type InstanceBuffers = BatchedInstanceBuffers<MeshUniform, MeshInputUniform>;

/// The transforms of all meshes, which the renderer has in one of two forms, and what else decides on their order.
#[derive(SystemParam)]
pub struct Places<'w> {
    instances: Option<Res<'w, RenderMeshInstances>>,
    buffers: Option<Res<'w, InstanceBuffers>>,
    meshes: Res<'w, RenderAssets<RenderMesh>>,
    pub orders: Res<'w, Orders>,
    pub panes: Res<'w, ExtractedPanes>,
}

impl Places<'_> {
    /// The key of an item. Only those with an order of their own are looked up; what the others need stands in the item.
    #[inline]
    pub fn key(&self, entity: MainEntity, item: TransparentSortingInfo3d, depth: &ViewDepth) -> DrawKey {
        let TransparentSortingInfo3d::Sorted { mesh_center, depth_bias } = item else {
            return DrawKey::new(i16::MIN, i16::MIN, f32::NEG_INFINITY);
        };
        let Some(&(order, aabb)) = self.orders.entities.get(&entity) else {
            return DrawKey::new(0, 0, depth.of_point(mesh_center) + depth_bias);
        };
        let TransparentOrder { layer, priority, bias, key } = order;
        let place = match self.mesh(entity) {
            None => depth.of_point(mesh_center),
            Some((world, center)) => {
                let unknown = Aabb { center: center.into(), half_extents: Vec3A::ZERO };
                of_mesh(depth, &world, &aabb.unwrap_or(unknown), key)
            }
        };
        DrawKey::new(layer, priority, place + depth_bias + bias)
    }

    /// The center of the bounding box of a mesh in the world.
    pub fn center(&self, entity: MainEntity) -> Option<Vec3> {
        self.mesh(entity).map(|(world, center)| world.transform_point3(center))
    }

    /// The transform of a mesh and the center of its bounding box.
    fn mesh(&self, entity: MainEntity) -> Option<(Affine3A, Vec3)> {
        let (world_from_local, mesh) = match **self.instances.as_ref()? {
            RenderMeshInstances::CpuBuilding(ref instances) => {
                let instance = instances.get(&entity)?;
                (instance.transforms.world_from_local, instance.mesh_asset_id())
            }
            RenderMeshInstances::GpuBuilding(ref instances) => {
                let instance = instances.get(&entity)?;
                let index = instance.gpu_specific.current_uniform_index();
                let uniform = self.buffers.as_ref()?.current_input_buffer.get_unchecked(index);
                (Affine3::from_transpose(uniform.world_from_local), instance.mesh_asset_id())
            }
        };
        Some((world_from_local.into(), self.meshes.get(mesh)?.aabb_center))
    }
}

fn of_mesh(depth: &ViewDepth, world: &Affine3A, aabb: &Aabb, key: TransparentKey) -> f32 {
    let point = match key {
        TransparentKey::Origin => return depth.of_point(world.translation.into()),
        TransparentKey::Center => BoxPoint::Center,
        TransparentKey::Nearest => BoxPoint::Nearest,
        TransparentKey::Farthest => BoxPoint::Farthest,
    };
    let half_axes =
        [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| world.transform_vector3(axis * Vec3::from(aabb.half_extents)));
    depth.of_bounds(&Bounds { center: world.transform_point3(aabb.center.into()), half_axes }, point)
}
