//! Which emissive surfaces are lights with shadow rays of their own, and which are patches that shine.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3;

use crate::geometry::normal_and_area;
use crate::light::{AreaLight, DirectLight};
use crate::scene::World;

/// Emissive surfaces with at most so many triangles become lights.
const MOST_TRIANGLES: usize = 64;
/// Emissive surfaces with more than this share of all area are seen well enough by the rays that gather.
const LARGEST_SHARE: f32 = 0.05;

/// The lights of a scene, and for each surface whether its emission is among them.
///
/// Small, uniform emitters would be noise in gathered light: as lights they are a closed form times a visible share.
pub(super) fn lights(world: &World) -> (Vec<DirectLight>, Vec<bool>) {
    let mut lights: Vec<DirectLight> = world.scene.lights.iter().map(|light| (&light.source).into()).collect();
    let mut is_light = vec![false; world.scene.surfaces.len()];
    let triangles = triangles_of_surfaces(world);
    let area = |triangle: u32| normal_and_area(&world.corners[triangle as usize]).map_or(0.0, |(_, area)| area);
    let areas: Vec<f32> =
        triangles.iter().map(|of_surface| of_surface.iter().map(|&triangle| area(triangle)).sum()).collect();
    let whole: f32 = areas.iter().sum();
    for (index, surface) in world.scene.surfaces.iter().enumerate() {
        let material = &world.scene.materials[surface.material];
        let count = triangles[index].len();
        let shines = surface.casts && material.is_emissive() && material.emissive_texture.is_none();
        if !shines || count == 0 || count > MOST_TRIANGLES || areas[index] > LARGEST_SHARE * whole {
            continue;
        }
        let corners = triangles[index].iter().map(|&triangle| world.corners[triangle as usize]);
        let light = AreaLight::new(corners, material.emissive.max(Vec3::ZERO), material.double_sided);
        is_light[index] = true;
        lights.push(DirectLight::Area(light));
    }
    (lights, is_light)
}

fn triangles_of_surfaces(world: &World) -> Vec<Vec<u32>> {
    let mut triangles = vec![Vec::new(); world.scene.surfaces.len()];
    for (triangle, source) in world.sources.iter().enumerate() {
        triangles[source.surface as usize].push(triangle as u32);
    }
    triangles
}
