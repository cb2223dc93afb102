//! A finished bake onto the entities of the app, and off again.

use bevy::asset::RenderAssetUsages;
use bevy::image::ImageSampler;
use bevy::pbr::Lightmap;
use bevy::prelude::*;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};
use radiosity::bake::Bake;
use radiosity::lightmap::{LightmapImage, Placement};

use super::{BakeSettings, Collected, collect};
use crate::attach::{
    BakeOrigin, attach_lightmap, detach, dim_ambient_light, label, mesh_before, silence_light, swap_with_before,
};
use crate::baked::ktx2::shared_exponent;
use crate::lightmap_mesh::with_lightmap_uv;

/// The bake that shows: there from `BakeDone` to `RemoveBake`.
#[derive(Resource, Reflect, Clone, Default)]
#[reflect(Resource, Default)]
pub struct AppliedBake {
    /// The result of the core: texels, states, charts and patches of each image, coordinates, and the report.
    #[reflect(ignore)]
    pub bake: Bake,
    /// The lightmaps as the renderer sees them, in the order of the bake.
    pub images: Vec<Handle<Image>>,
    /// The entity of each surface of the bake.
    pub surfaces: Vec<Entity>,
    /// The mesh of the bake that each surface shows.
    pub surface_meshes: Vec<usize>,
    /// The lights that are in the lightmaps.
    pub lights: Vec<Entity>,
}

/// What [`collect`] finds, as if no bake showed: meshes with their own coordinates, and lights that a bake has hidden.
pub fn collect_unlit(world: &mut World) -> Collected {
    swap_with_before(world);
    let collected = collect(world);
    swap_with_before(world);
    collected
}

/// Shows a bake of collected entities instead of the one before.
///
/// For apps that call [`collect_unlit`] and `radiosity::bake::bake` themselves; `StartBake` ends here too. An entity that
/// is gone or shows another mesh by now gets no lightmap.
pub fn apply_bake(world: &mut World, collected: &Collected, bake: Bake, settings: &BakeSettings) {
    remove_bake(world);
    let images = add_images(world, &bake);
    let meshes = add_meshes(world, collected, &bake);
    let surface_meshes: Vec<_> = collected.scene.surfaces.iter().map(|surface| surface.mesh).collect();
    for ((&entity, &mesh), placement) in collected.surfaces.iter().zip(&surface_meshes).zip(&bake.placements) {
        let Some(Placement { image, min, max }) = *placement else { continue };
        match mesh_before(world, entity) {
            Some(before) if *before == collected.mesh_handles[mesh] => {}
            Some(_) => {
                let name = label(world, entity);
                warn!("the mesh of \"{name}\" is another one than before the bake; bake again to light it");
                continue;
            }
            None => continue,
        }
        let uv_rect = Rect { min: min.to_array().into(), max: max.to_array().into() };
        let lightmap = Lightmap { image: images[image].clone(), uv_rect, bicubic_sampling: settings.bicubic_sampling };
        attach_lightmap(world, entity, BakeOrigin::App, meshes[mesh].clone(), lightmap);
    }
    for &light in &collected.lights {
        silence_light(world, light, BakeOrigin::App);
    }
    dim_ambient_light(world);
    let (surfaces, lights) = (collected.surfaces.clone(), collected.lights.clone());
    world.insert_resource(AppliedBake { bake, images, surfaces, surface_meshes, lights });
}

/// Takes the bake of this app off: meshes, lights and ambient light are as they were before.
pub fn remove_bake(world: &mut World) {
    if world.remove_resource::<AppliedBake>().is_some() {
        detach(world, BakeOrigin::App);
    }
}

fn add_images(world: &mut World, bake: &Bake) -> Vec<Handle<Image>> {
    let mut images = world.resource_mut::<Assets<Image>>();
    bake.images.iter().map(|lightmap| images.add(image(lightmap))).collect()
}

/// Four bytes a texel with a shared exponent, which every GPU can filter.
fn image(lightmap: &LightmapImage) -> Image {
    let size = Extent3d { width: lightmap.width, height: lightmap.height, depth_or_array_layers: 1 };
    let texels = lightmap.texels.iter().flat_map(|texel| shared_exponent(texel.to_array()).to_le_bytes()).collect();
    let format = TextureFormat::Rgb9e5Ufloat;
    let usages = RenderAssetUsages::RENDER_WORLD;
    let mut image = Image::new(size, TextureDimension::D2, texels, format, usages);
    image.sampler = ImageSampler::linear();
    image
}

/// For each mesh of the bake the one to show: the app's own where its coordinates are what the bake uses.
fn add_meshes(world: &mut World, collected: &Collected, bake: &Bake) -> Vec<Handle<Mesh>> {
    let mut meshes = world.resource_mut::<Assets<Mesh>>();
    let with_uv = |(handle, uv): (&Handle<Mesh>, &Option<_>)| {
        let lightmap_mesh = with_lightmap_uv(meshes.get(handle)?, uv.as_ref()?)?;
        Some(meshes.add(lightmap_mesh))
    };
    let new_meshes: Vec<_> = collected.mesh_handles.iter().zip(&bake.uvs).map(with_uv).collect();
    let own = collected.mesh_handles.iter().cloned();
    new_meshes.into_iter().zip(own).map(|(new, own)| new.unwrap_or(own)).collect()
}
