//! Puts baked light onto entities and takes it off again, exactly.
//!
//! What an entity was before is kept in a component on it: [`Lit`] on meshes, [`BakedLight`] on lights and
//! [`DimmedAmbient`] on cameras.

use bevy::light::{AmbientLight, DirectionalLight, GlobalAmbientLight, PointLight, RectLight, SpotLight};
use bevy::pbr::Lightmap;
use bevy::prelude::*;

use crate::lightmap_guard::HeldBack;
use crate::stand_in::{StandIn, given_mesh};

/// Which bake an entity has its light from.
#[derive(Reflect, Clone, Copy, Debug, PartialEq, Eq)]
pub enum BakeOrigin {
    /// The one that this app made.
    App,
    /// A saved one, by the `BakedSceneRoot` on this entity.
    Saved(Entity),
}

/// On a mesh with a baked lightmap: where that is from, and what the entity was before.
#[derive(Component, Reflect, Clone)]
#[reflect(Component)]
pub struct Lit {
    /// Which bake the lightmap is from.
    pub origin: BakeOrigin,
    /// The mesh before the bake.
    pub mesh: Handle<Mesh>,
    /// The mesh with the coordinates of the bake; the same one where it brought usable coordinates along.
    pub baked_mesh: Handle<Mesh>,
    /// The lightmap before the bake, from elsewhere.
    pub lightmap: Option<Lightmap>,
}

/// On a light that is in lightmaps: by which bake, and what the light was before.
#[derive(Component, Reflect, Clone, Copy, Debug)]
#[reflect(Component)]
pub struct BakedLight {
    /// Which bake the light is in.
    pub origin: BakeOrigin,
    /// Of the point, spot or directional light before the bake.
    pub affects_lightmapped_mesh_diffuse: bool,
    /// Of the light before the bake.
    pub visibility: Visibility,
}

/// On a camera whose ambient light leaves out meshes with lightmaps and did not before the bake.
#[derive(Component, Reflect, Clone, Copy, Debug)]
#[reflect(Component)]
pub struct DimmedAmbient;

/// The global ambient light leaves out meshes with lightmaps and did not before the bake.
#[derive(Resource, Reflect, Clone, Copy, Debug)]
#[reflect(Resource)]
pub struct DimmedGlobalAmbient;

/// Gives an entity a lightmap, and the mesh whose `UV_1` belongs to it.
pub(crate) fn attach_lightmap(
    world: &mut World,
    entity: Entity,
    origin: BakeOrigin,
    mesh: Handle<Mesh>,
    lightmap: Lightmap,
) {
    let Ok(mut entity) = world.get_entity_mut(entity) else { return };
    let Some(current) = entity.get().map(|mesh| given_mesh(mesh, entity.get()).clone()) else { return };
    let baked_mesh = mesh.clone();
    let lit = match entity.get::<Lit>() {
        Some(before) => Lit { origin, baked_mesh, ..before.clone() },
        None => Lit { origin, mesh: current.clone(), baked_mesh, lightmap: entity.get::<Lightmap>().cloned() },
    };
    if mesh != current {
        entity.insert(Mesh3d(mesh));
    }
    entity.remove::<HeldBack>().insert((lit, lightmap));
}

/// The mesh of an entity, that before all bakes if there was one.
pub(crate) fn mesh_before(world: &World, entity: Entity) -> Option<&Handle<Mesh>> {
    let shown = given_mesh(world.get(entity)?, world.get(entity));
    let lit = world.get::<Lit>(entity).filter(|lit| lit.baked_mesh == *shown);
    Some(lit.map_or(shown, |lit| &lit.mesh))
}

/// Keeps a light that is baked from lighting meshes with lightmaps a second time; its highlights stay.
///
/// A `RectLight` has no flag for that and is hidden.
pub(crate) fn silence_light(world: &mut World, entity: Entity, origin: BakeOrigin) {
    let Ok(mut entity) = world.get_entity_mut(entity) else { return };
    let visibility = entity.get::<Visibility>().copied().unwrap_or_default();
    let before = match entity.get::<BakedLight>() {
        Some(before) => BakedLight { origin, ..*before },
        None => BakedLight { origin, affects_lightmapped_mesh_diffuse: flag(&entity), visibility },
    };
    entity.insert(before);
    set_flag(&mut entity, false);
    if !entity.contains::<RectLight>() {
        return;
    }
    entity.insert(Visibility::Hidden);
    if entity.contains::<Children>() || entity.contains::<Mesh3d>() {
        let name = label(entity.world(), entity.id());
        warn!("the baked RectLight \"{name}\" is hidden with its mesh and children; make it an entity of its own");
    }
}

/// Keeps ambient light, which is not baked, off meshes with lightmaps.
pub(crate) fn dim_ambient_light(world: &mut World) {
    if let Some(mut ambient) = world.get_resource_mut::<GlobalAmbientLight>()
        && ambient.affects_lightmapped_meshes
    {
        ambient.affects_lightmapped_meshes = false;
        world.insert_resource(DimmedGlobalAmbient);
    }
    let mut cameras = world.query::<(Entity, &mut AmbientLight)>();
    let mut dimmed = Vec::new();
    for (entity, mut ambient) in cameras.iter_mut(world).filter(|(_, ambient)| ambient.affects_lightmapped_meshes) {
        ambient.affects_lightmapped_meshes = false;
        dimmed.push((entity, DimmedAmbient));
    }
    world.insert_batch(dimmed);
}

/// The name of an entity, else its number.
pub(crate) fn label(world: &World, entity: Entity) -> String {
    world.get::<Name>(entity).map_or_else(|| entity.to_string(), Name::to_string)
}

/// Takes off everything that a bake put on; all is as before.
pub(crate) fn detach(world: &mut World, origin: BakeOrigin) {
    let mut meshes = world.query::<(Entity, &Lit)>();
    let lit: Vec<_> = meshes.iter(world).map(|(entity, lit)| (entity, lit.clone())).collect();
    let (ours, others): (Vec<_>, Vec<_>) = lit.into_iter().partition(|(_, lit)| lit.origin == origin);
    for (entity, before) in ours {
        restore_mesh(world, entity, before);
    }
    let mut lights = world.query::<(Entity, &BakedLight)>();
    let lights: Vec<_> = lights.iter(world).map(|(entity, light)| (entity, *light)).collect();
    for (entity, before) in lights.into_iter().filter(|(_, light)| light.origin == origin) {
        restore_light(world, entity, before);
    }
    if others.is_empty() {
        restore_ambient_light(world);
    }
}

fn restore_mesh(world: &mut World, entity: Entity, before: Lit) {
    let mut entity = world.entity_mut(entity);
    entity.remove::<(Lit, HeldBack)>();
    match before.lightmap {
        Some(lightmap) => entity.insert(lightmap),
        None => entity.remove::<Lightmap>(),
    };
    let shown = entity.get().map(|mesh| given_mesh(mesh, entity.get()));
    if shown == Some(&before.baked_mesh) && before.baked_mesh != before.mesh {
        entity.insert(Mesh3d(before.mesh));
    }
}

fn restore_light(world: &mut World, entity: Entity, before: BakedLight) {
    let mut entity = world.entity_mut(entity);
    entity.remove::<BakedLight>();
    set_flag(&mut entity, before.affects_lightmapped_mesh_diffuse);
    if entity.contains::<RectLight>() {
        entity.insert(before.visibility);
    }
}

fn restore_ambient_light(world: &mut World) {
    if world.remove_resource::<DimmedGlobalAmbient>().is_some()
        && let Some(mut ambient) = world.get_resource_mut::<GlobalAmbientLight>()
    {
        ambient.affects_lightmapped_meshes = true;
    }
    let mut cameras = world.query_filtered::<(Entity, &mut AmbientLight), With<DimmedAmbient>>();
    let mut restored = Vec::new();
    for (entity, mut ambient) in cameras.iter_mut(world) {
        ambient.affects_lightmapped_meshes = true;
        restored.push(entity);
    }
    for entity in restored {
        world.entity_mut(entity).remove::<DimmedAmbient>();
    }
}

/// Shows the world as it was before all bakes, or, called again, as it is after them. Nothing counts as changed.
pub(crate) fn swap_with_before(world: &mut World) {
    for (mut drawn, stand_in, lit) in world.query::<(&mut Mesh3d, Option<&mut StandIn>, &Lit)>().iter_mut(world) {
        let drawn = &mut drawn.bypass_change_detection().0;
        let mesh = match stand_in.map(Mut::into_inner) {
            Some(stand_in) if stand_in.drawn == *drawn => &mut stand_in.given,
            _ => drawn,
        };
        if *mesh == lit.baked_mesh {
            *mesh = lit.mesh.clone();
        } else if *mesh == lit.mesh {
            *mesh = lit.baked_mesh.clone();
        }
    }
    let mut rect_lights = world.query_filtered::<(&mut Visibility, &mut BakedLight), With<RectLight>>();
    for (mut visibility, mut light) in rect_lights.iter_mut(world) {
        let visibility = visibility.bypass_change_detection();
        core::mem::swap(visibility, &mut light.bypass_change_detection().visibility);
    }
}

/// `affects_lightmapped_mesh_diffuse` of whichever light this is; a `RectLight` has none.
fn flag(light: &EntityWorldMut) -> bool {
    let point = light.get::<PointLight>().map(|light| light.affects_lightmapped_mesh_diffuse);
    let spot = light.get::<SpotLight>().map(|light| light.affects_lightmapped_mesh_diffuse);
    let directional = light.get::<DirectionalLight>().map(|light| light.affects_lightmapped_mesh_diffuse);
    point.or(spot).or(directional).unwrap_or(true)
}

fn set_flag(light: &mut EntityWorldMut, affects: bool) {
    if let Some(mut point) = light.get_mut::<PointLight>() {
        point.affects_lightmapped_mesh_diffuse = affects;
    }
    if let Some(mut spot) = light.get_mut::<SpotLight>() {
        spot.affects_lightmapped_mesh_diffuse = affects;
    }
    if let Some(mut directional) = light.get_mut::<DirectionalLight>() {
        directional.affects_lightmapped_mesh_diffuse = affects;
    }
}
