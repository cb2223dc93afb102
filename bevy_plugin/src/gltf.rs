//! What Bevy's glTF loader leaves out and a bake needs: indices, materials without a renderer, and lights as glTF means
//! them.

use bevy::asset::LoadContext;
use bevy::ecs::entity::EntityHashMap;
use bevy::gltf::GltfMaterial;
use bevy::gltf::extensions::{ErasedGltfExtensionHandler, GltfExtensionHandler, GltfExtensionHandlers};
use bevy::light::{DirectionalLight, PointLight, SpotLight};
use bevy::prelude::*;

/// Marks the entities of glTF scenes with their indices and materials and mends their lights. Add it before a glTF
/// file is loaded.
#[derive(Clone, Copy, Debug, Default)]
pub struct GltfSourcePlugin;

impl Plugin for GltfSourcePlugin {
    fn build(&self, app: &mut App) {
        let handlers = app.world_mut().get_resource_or_init::<GltfExtensionHandlers>();
        // Nothing loads while plugins are built, so the lock is free.
        if let Some(mut handlers) = handlers.0.try_write() {
            handlers.push(Box::new(SourceHandler::default()));
        }
    }
}

/// Where a mesh entity comes from: indices in its glTF file.
#[derive(Component, Reflect, Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[reflect(Component, Default)]
pub struct GltfSource {
    /// Index of the node.
    pub node: usize,
    /// Index of the mesh.
    pub mesh: usize,
    /// Index of the primitive within the mesh.
    pub primitive: usize,
}

/// Where a light entity comes from: the index of its node in its glTF file.
#[derive(Component, Reflect, Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[reflect(Component, Default)]
pub struct GltfLightSource {
    /// Index of the node.
    pub node: usize,
}

/// The material of a mesh entity as the glTF file has it, which is there without a renderer too.
#[derive(Component, Reflect, Clone, Debug)]
#[reflect(Component)]
pub struct GltfMaterial3d(pub Handle<GltfMaterial>);

/// Sees every entity that the loader spawns.
#[derive(Clone, Default)]
struct SourceHandler {
    /// Mesh entities with mesh and primitive, by the entity of their node: the loader tells the node afterwards.
    primitives: EntityHashMap<Vec<(Entity, usize, usize)>>,
}

impl GltfExtensionHandler for SourceHandler {
    fn dyn_clone(&self) -> Box<dyn ErasedGltfExtensionHandler> {
        Box::new(self.clone())
    }

    fn on_spawn_mesh_and_material(
        &mut self,
        load_context: &mut LoadContext<'_>,
        primitive: &::gltf::Primitive,
        mesh: &::gltf::Mesh,
        _material: &::gltf::Material,
        entity: &mut EntityWorldMut,
        material_label: &str,
    ) {
        entity.insert(GltfMaterial3d(load_context.get_label_handle(material_label.to_owned())));
        if let Some(node) = entity.get::<ChildOf>().map(ChildOf::parent) {
            self.primitives.entry(node).or_default().push((entity.id(), mesh.index(), primitive.index()));
        }
    }

    fn on_gltf_node(&mut self, _: &mut LoadContext<'_>, gltf_node: &::gltf::Node, entity: &mut EntityWorldMut) {
        let node = gltf_node.index();
        let primitives = self.primitives.remove(&entity.id()).unwrap_or_default();
        entity.world_scope(|world| {
            for (entity, mesh, primitive) in primitives {
                world.entity_mut(entity).insert(GltfSource { node, mesh, primitive });
            }
        });
    }

    fn on_spawn_light_directional(
        &mut self,
        _: &mut LoadContext<'_>,
        node: &::gltf::Node,
        entity: &mut EntityWorldMut,
    ) {
        entity.insert(GltfLightSource { node: node.index() });
        if let Some(mut light) = entity.get_mut::<DirectionalLight>() {
            light.color = linear(light.color);
        }
    }

    fn on_spawn_light_point(&mut self, _: &mut LoadContext<'_>, node: &::gltf::Node, entity: &mut EntityWorldMut) {
        entity.insert(GltfLightSource { node: node.index() });
        if let Some(mut light) = entity.get_mut::<PointLight>() {
            light.color = linear(light.color);
        }
    }

    fn on_spawn_light_spot(&mut self, _: &mut LoadContext<'_>, node: &::gltf::Node, entity: &mut EntityWorldMut) {
        entity.insert(GltfLightSource { node: node.index() });
        if let Some(mut light) = entity.get_mut::<SpotLight>() {
            light.color = linear(light.color);
            // The loader stores the range here; glTF has no radius.
            light.radius = 0.0;
        }
    }
}

/// glTF gives light colors linearly; the loader takes the same numbers for sRGB.
fn linear(color: Color) -> Color {
    let Srgba { red, green, blue, .. } = color.to_srgba();
    Color::linear_rgb(red, green, blue)
}
