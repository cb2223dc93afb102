//! What a bake will need, before it needs it.

use super::rays::RayBudget;
use super::{BakeError, BakeSettings, Keep};
use crate::lightmap::Layout;
use crate::scene::{Receiver, Scene};

/// For each triangle: corners twice, normal, source, corners in the image, and its part of the tree while it is built.
const TRIANGLE: u64 = 420;
/// For each texel of an image: what covers it, its index, and the finished lightmap with its states.
const TEXEL: u64 = 49;
/// For each covered texel: the texel, direct, incident and gathered light, its patch and the lists that make these.
const COVERED: u64 = 198;
/// For each patch: itself, its materials, and lists.
const PATCH: u64 = 150;
/// For each ray of a row of form factors, if all end on patches of their own.
const ENTRY: u64 = 8;
/// For each covered texel of a transport: how it is mixed, its places, and what lamps give it.
const KEPT: u64 = 200;
/// For each ray of a texel, while rows of transport are made one after the other.
const KEPT_ENTRY: u64 = 6;

/// An upper estimate of the memory that a bake needs beside the scene, in bytes.
///
/// # Errors
///
/// With the numbers where that is more than allowed.
pub(super) fn check(
    scene: &Scene,
    layout: &Layout,
    budget: &RayBudget,
    settings: &BakeSettings,
) -> Result<u64, BakeError> {
    let triangles: u64 = scene.surfaces.iter().map(|surface| scene.meshes[surface.mesh].triangles.len() as u64).sum();
    let texels: u64 = layout.images.iter().map(|&[width, height]| u64::from(width) * u64::from(height)).sum();
    let without: u64 = scene
        .surfaces
        .iter()
        .filter(|surface| surface.receiver == Receiver::Nothing)
        .map(|surface| scene.meshes[surface.mesh].triangles.len() as u64)
        .sum();
    let patches = (texels / 64).max(budget.patches as u64).min(texels) * 2 + without;
    let kept = match settings.keep {
        Keep::Lightmaps => 0,
        Keep::Transport => KEPT + u64::from(budget.kept) * KEPT_ENTRY,
    };
    let needed = triangles * TRIANGLE
        + texels * (TEXEL + COVERED + kept)
        + patches * (PATCH + u64::from(budget.row) * ENTRY)
        + (16 << 20);
    let allowed = settings.memory_bytes;
    if needed > allowed { Err(BakeError::OutOfMemory { needed, allowed }) } else { Ok(needed) }
}
