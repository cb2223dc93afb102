//! What a bake did and how good it is.

use alloc::string::String;
use alloc::vec::Vec;

pub use crate::lightmap::SeamReport;

/// What a bake did and how good it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Triangles that block light.
    pub triangles: usize,
    /// Surfaces with a lightmap.
    pub surfaces: usize,
    /// Meshes that got new lightmap coordinates, since theirs could not be used.
    pub unwrapped: usize,
    /// Texels of all images.
    pub texels: usize,
    /// Texels that a surface covers and whose light was computed.
    pub valid_texels: usize,
    /// Texels that a surface covers but that lie inside geometry; they were filled from their neighbors.
    pub invalid_texels: usize,
    /// Patches that bounce light.
    pub patches: usize,
    /// Points at which indirect light was gathered.
    pub nodes: usize,
    /// Lightmaps.
    pub images: usize,
    /// Parts that the images were baked in, one after the other, to stay within the memory.
    pub parts: usize,
    /// Density of the bake.
    pub texels_per_meter: f32,
    /// Threads that worked.
    pub threads: usize,
    /// Of all random decisions.
    pub seed: u64,
    /// What the bake was expected to need at most, in bytes.
    pub estimated_memory_bytes: u64,
    /// What the transport takes, in bytes; 0: none was kept.
    pub transport_bytes: u64,
    /// Time and rays of each stage, in their order.
    pub stages: Vec<StageReport>,
    /// Largest difference between 1 and the sum of a row of form factors, sky and void included.
    pub closure_error: f32,
    /// (Emitted - absorbed - escaped) / emitted power: 0 when no light is lost or made.
    pub energy_balance: f32,
    /// What remains wrong, as far as the bake itself can tell.
    pub estimated_error: EstimatedError,
    /// How far the two sides of seams differ, before they were made to agree and after.
    pub seams: SeamReport,
    /// What the user should know, each with the remedy.
    pub warnings: Vec<String>,
}

/// Time and rays of one stage.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StageReport {
    /// The name of the stage.
    pub name: &'static str,
    /// Wall-clock time in seconds.
    pub seconds: f64,
    /// Rays that were traced.
    pub rays: u64,
}

/// Errors relative to the true value plus a tenth of the mean.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EstimatedError {
    /// Root mean square of all that is known: noise, what changes within and between texels, what the file rounds.
    pub rms: f32,
    /// The part of it that more rays make smaller.
    pub noise: f32,
    /// Mean signed error over the mean, from patches against texels.
    pub bias: f32,
}
