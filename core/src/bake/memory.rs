//! What a bake will need, before it needs it.

use super::BakeError;
use crate::lightmap::Layout;
use crate::scene::{Receiver, Scene};

/// For each triangle: corners, normal, source, corners in the image, and its part of the tree.
const TRIANGLE: u64 = 220;
/// For each texel of an image: what covers it, its index, and the finished lightmap with its states.
const TEXEL: u64 = 45;
/// For each covered texel: the texel, direct, incident and gathered light, its patch and the lists that make these.
const COVERED: u64 = 190;
/// For each patch: itself, its materials, and lists.
const PATCH: u64 = 150;
/// For each ray of a row of form factors, if all end on patches of their own.
const ENTRY: u64 = 16;

/// An upper estimate of the memory that a bake needs beside the scene, in bytes.
///
/// # Errors
///
/// With the numbers where that is more than allowed.
pub(super) fn check(
    scene: &Scene,
    layout: &Layout,
    row_rays: u32,
    patches: usize,
    allowed: u64,
) -> Result<u64, BakeError> {
    let triangles: u64 = scene.surfaces.iter().map(|surface| scene.meshes[surface.mesh].triangles.len() as u64).sum();
    let texels: u64 = layout.images.iter().map(|&[width, height]| u64::from(width) * u64::from(height)).sum();
    let without: u64 = scene
        .surfaces
        .iter()
        .filter(|surface| surface.receiver == Receiver::Nothing)
        .map(|surface| scene.meshes[surface.mesh].triangles.len() as u64)
        .sum();
    let patches = (texels / 64).max(patches as u64).min(texels) * 2 + without;
    let needed = triangles * TRIANGLE
        + texels * (TEXEL + COVERED)
        + patches * (PATCH + u64::from(row_rays) * ENTRY)
        + (16 << 20);
    if needed > allowed { Err(BakeError::OutOfMemory { needed, allowed }) } else { Ok(needed) }
}
