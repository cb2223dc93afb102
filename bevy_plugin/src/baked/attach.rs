//! A saved bake onto the entities of a scene; nothing is baked here.

use std::collections::HashMap;

use bevy::asset::LoadState;
use bevy::ecs::entity::EntityHashSet;
use bevy::pbr::Lightmap;
use bevy::prelude::*;

use super::BakedScene;
use super::manifest::{LightEntry, SurfaceEntry, SurfaceKey};
use crate::attach::{BakeOrigin, BakedLight, Lit, attach_lightmap, detach, dim_ambient_light, label, silence_light};
use crate::bake::BakeId;
use crate::gltf::{GltfLightSource, GltfSource};
use crate::lightmap_mesh::{fits, with_lightmap_uv};
use crate::stand_in::given_mesh;

/// Lights entities with a saved bake: those of a glTF scene that are below this entity, by their glTF indices, and
/// those with a `BakeId` wherever they are.
///
/// Entities may come and the bake may load in any order. Removing the component, or despawning its entity, takes the
/// light off again. To change the bake, insert the component anew. What this app bakes itself goes before.
#[derive(Component, Reflect, Clone, Debug, Default, PartialEq, Eq)]
#[reflect(Component, Default)]
pub struct BakedSceneRoot(pub Handle<BakedScene>);

/// An entity that a saved bake may light, or a saved bake itself.
type NewTarget =
    Or<(Changed<BakedSceneRoot>, Added<GltfSource>, Added<GltfLightSource>, Changed<BakeId>, Added<Mesh3d>)>;

/// Whether something came that a saved bake may light.
pub(super) fn something_is_new(
    new: Query<(), NewTarget>,
    mut scenes: MessageReader<AssetEvent<BakedScene>>,
    mut meshes: MessageReader<AssetEvent<Mesh>>,
) -> bool {
    let new_meshes = meshes.read().filter(|event| matches!(event, AssetEvent::Added { .. }));
    let is_loaded = scenes.read().count() + new_meshes.count() > 0;
    is_loaded || !new.is_empty()
}

pub(super) fn on_discard(discard: On<Discard, BakedSceneRoot>, mut commands: Commands) {
    let root = discard.entity;
    commands.queue(move |world: &mut World| detach(world, BakeOrigin::Saved(root)));
}

pub(super) fn attach_baked_scenes(world: &mut World, mut warned: Local<EntityHashSet>) {
    let mut roots = world.query::<(Entity, &BakedSceneRoot)>();
    let roots: Vec<_> = roots.iter(world).map(|(root, scene)| (root, scene.0.clone())).collect();
    for (root, handle) in roots {
        let Some(scene) = world.resource::<Assets<BakedScene>>().get(&handle).cloned() else { continue };
        if !images_are_loaded(world, &scene) {
            continue;
        }
        let missing = attach_scene(world, root, &scene);
        if missing > 0 && warned.insert(root) {
            warn!("{missing} surfaces of a saved bake are not in its scene; the scene changed, bake it again");
        }
    }
}

/// An image that failed keeps the bake away; its error is in the log.
fn images_are_loaded(world: &World, scene: &BakedScene) -> bool {
    let Some(server) = world.get_resource::<AssetServer>() else { return true };
    scene.images.iter().all(|image| matches!(server.get_load_state(image), None | Some(LoadState::Loaded)))
}

/// Where the keys of a manifest lead.
struct Targets {
    /// By node, mesh and primitive.
    surfaces: HashMap<[usize; 3], Vec<Entity>>,
    /// By node.
    lights: HashMap<usize, Vec<Entity>>,
    by_id: HashMap<String, Vec<Entity>>,
}

/// Returns how many surfaces of a glTF scene that is there were not found in it.
fn attach_scene(world: &mut World, root: Entity, scene: &BakedScene) -> usize {
    let targets = Targets::find(world, root);
    let origin = BakeOrigin::Saved(root);
    let mut meshes = HashMap::new();
    let mut missing = 0;
    for surface in &scene.manifest.surfaces {
        let entities = targets.of_surface(&surface.key);
        let is_gltf = matches!(surface.key, SurfaceKey::Gltf { .. });
        missing += usize::from(is_gltf && entities.is_empty() && !targets.surfaces.is_empty());
        for &entity in entities {
            attach_surface(world, entity, origin, scene, surface, &mut meshes);
        }
    }
    for light in &scene.manifest.lights {
        for &entity in targets.of_light(light) {
            if world.get::<BakedLight>(entity).is_none() {
                silence_light(world, entity, origin);
            }
        }
    }
    dim_ambient_light(world);
    missing
}

impl Targets {
    fn find(world: &mut World, root: Entity) -> Self {
        let mut targets = Self { surfaces: HashMap::new(), lights: HashMap::new(), by_id: HashMap::new() };
        let mut below = vec![root];
        while let Some(entity) = below.pop() {
            if let Some(&GltfSource { node, mesh, primitive }) = world.get(entity) {
                targets.surfaces.entry([node, mesh, primitive]).or_default().push(entity);
            }
            if let Some(&GltfLightSource { node }) = world.get(entity) {
                targets.lights.entry(node).or_default().push(entity);
            }
            below.extend(world.get::<Children>(entity).into_iter().flatten());
        }
        for (entity, id) in world.query::<(Entity, &BakeId)>().iter(world) {
            targets.by_id.entry(id.0.clone()).or_default().push(entity);
        }
        targets
    }

    fn of_surface(&self, key: &SurfaceKey) -> &[Entity] {
        let entities = match key {
            SurfaceKey::Gltf { node, mesh, primitive, .. } => self.surfaces.get(&[*node, *mesh, *primitive]),
            SurfaceKey::Entity { bake_id } => self.by_id.get(bake_id),
        };
        entities.map_or(&[], Vec::as_slice)
    }

    fn of_light(&self, light: &LightEntry) -> &[Entity] {
        let entities = match light {
            LightEntry::Gltf { node } => self.lights.get(node),
            LightEntry::Entity { bake_id } => self.by_id.get(bake_id),
        };
        entities.map_or(&[], Vec::as_slice)
    }
}

/// Meshes with split vertices, by the mesh before and the file of coordinates: shared ones stay shared.
type SplitMeshes = HashMap<(AssetId<Mesh>, String), Handle<Mesh>>;

fn attach_surface(
    world: &mut World,
    entity: Entity,
    origin: BakeOrigin,
    scene: &BakedScene,
    surface: &SurfaceEntry,
    split_meshes: &mut SplitMeshes,
) {
    let mesh = world.get(entity).map(|mesh| given_mesh(mesh, world.get(entity)).clone());
    let Some(mut mesh) = mesh else { return };
    if world.get::<Lit>(entity).is_some() {
        return;
    }
    if let Some(file) = &surface.uv {
        if !world.resource::<Assets<Mesh>>().contains(&mesh) {
            // Its event comes when it is loaded.
            return;
        }
        match split_mesh(world, &mesh, scene, file, split_meshes) {
            Some(split) => mesh = split,
            None => {
                let name = label(world, entity);
                warn!("the mesh of \"{name}\" is another one than at the bake; it stays without, bake again");
                return;
            }
        }
    }
    let [min_u, min_v, max_u, max_v] = surface.uv_rect;
    let image = scene.images[surface.image].clone();
    let lightmap = Lightmap { image, uv_rect: Rect::new(min_u, min_v, max_u, max_v), bicubic_sampling: false };
    attach_lightmap(world, entity, origin, mesh, lightmap);
}

/// None where the coordinates are not for this mesh.
fn split_mesh(
    world: &mut World,
    mesh: &Handle<Mesh>,
    scene: &BakedScene,
    file: &str,
    split_meshes: &mut SplitMeshes,
) -> Option<Handle<Mesh>> {
    let key = (mesh.id(), file.to_owned());
    if let Some(split) = split_meshes.get(&key) {
        return Some(split.clone());
    }
    let uv = scene.uvs.get(file)?;
    let mut meshes = world.resource_mut::<Assets<Mesh>>();
    let before = meshes.get(mesh).filter(|mesh| fits(mesh, uv))?;
    let split = match with_lightmap_uv(before, uv) {
        Some(split) => meshes.add(split),
        None => mesh.clone(),
    };
    split_meshes.insert(key, split.clone());
    Some(split)
}
