//! What a scene and its settings must be before a bake begins.

use alloc::format;
use alloc::string::String;

use glam::Vec3;

use super::{BakeError, BakeSettings};
use crate::geometry::Mesh;
use crate::light::{Light, LightSource, SpotLight};
use crate::lightmap::Resolution;
use crate::scene::{Receiver, Scene};

/// Refuses what cannot be baked, with the name of the culprit.
pub(super) fn check(scene: &Scene, settings: &BakeSettings) -> Result<(), BakeError> {
    check_settings(settings)?;
    scene.meshes.iter().try_for_each(check_mesh)?;
    for surface in &scene.surfaces {
        let (name, materials, meshes) = (&surface.name, scene.materials.len(), scene.meshes.len());
        if surface.mesh >= meshes || surface.material >= materials {
            return invalid(format!("surface \"{name}\" names a mesh or a material that the scene does not have"));
        }
        if !surface.transform.is_finite() {
            return invalid(format!("the transform of surface \"{name}\" is not finite; mend it or leave it out"));
        }
        if matches!(surface.receiver, Receiver::Lightmap { density } if !(density > 0.0 && density.is_finite())) {
            return invalid(format!("the density factor of surface \"{name}\" is not positive; 1 is usual"));
        }
    }
    let receives = |receiver: &Receiver| *receiver != Receiver::Nothing;
    let triangles = |mesh: usize| scene.meshes[mesh].triangles.len();
    if !scene.surfaces.iter().any(|surface| receives(&surface.receiver) && triangles(surface.mesh) > 0) {
        return Err(BakeError::NothingToBake);
    }
    scene.lights.iter().try_for_each(check_light)?;
    if !(scene.sky.is_finite() && scene.sky.min_element() >= 0.0) {
        return invalid(format!(
            "the sky is {} cd/m2, which is negative or not finite; mend it or leave it out",
            scene.sky
        ));
    }
    let emits = scene.surfaces.iter().any(|surface| surface.casts && scene.materials[surface.material].is_emissive());
    if !scene.lights.iter().any(|light| light.source.strength().max_element() > 0.0)
        && !emits
        && scene.sky_of_patches().iter().all(|radiance| (scene.sky * radiance).max_element() <= 0.0)
    {
        return Err(BakeError::NoLight);
    }
    Ok(())
}

fn check_light(light: &Light) -> Result<(), BakeError> {
    let (strength, place) = (light.source.strength(), place(&light.source));
    if strength.is_finite() && strength.min_element() >= 0.0 && place.is_finite() {
        return Ok(());
    }
    invalid(format!(
        "light \"{}\" has a position, direction or strength that is negative or not finite; mend it or leave it out",
        light.name
    ))
}

/// The sum of all vectors and lengths that place a light: finite if all are.
fn place(source: &LightSource) -> Vec3 {
    match source {
        LightSource::Point(light) => light.position + light.radius,
        LightSource::Spot(SpotLight { point, direction, inner_angle, outer_angle }) => {
            point.position + *direction + (point.radius + inner_angle + outer_angle)
        }
        LightSource::Directional(light) => light.direction + light.angular_diameter,
        LightSource::Rect(light) => light.center + light.half_width + light.half_height,
    }
}

fn check_settings(settings: &BakeSettings) -> Result<(), BakeError> {
    let error = settings.target_error;
    if !(error >= 0.0 && error.is_finite()) {
        return invalid(format!("an error of {error} cannot be reached; 0.02 is 2 %, 0 asks for none"));
    }
    match settings.layout.resolution {
        Resolution::TexelsPerMeter(density) if !(density > 0.0 && density.is_finite()) => {
            invalid(format!("{density} texels per meter cannot be; 4 to 64 are usual"))
        }
        Resolution::Texels(0) => invalid(String::from("a bake needs at least one texel")),
        _ => Ok(()),
    }
}

fn check_mesh(mesh: &Mesh) -> Result<(), BakeError> {
    let vertices = mesh.positions.len();
    let lists = [mesh.normals.len(), mesh.uv_0.len(), mesh.uv_1.len(), mesh.colors.len()]
        .map(|len| len == 0 || len == vertices);
    if lists.contains(&false) {
        return invalid(format!(
            "mesh \"{}\" has {vertices} positions and another number of normals, coordinates or colors",
            mesh.name
        ));
    }
    match mesh.triangles.iter().flatten().max() {
        Some(&last) if last as usize >= vertices => {
            invalid(format!("mesh \"{}\" has {vertices} vertices, and a triangle names vertex {last}", mesh.name))
        }
        _ => Ok(()),
    }
}

fn invalid<T>(what: String) -> Result<T, BakeError> {
    Err(BakeError::Invalid(what))
}
