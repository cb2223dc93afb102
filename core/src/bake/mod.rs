//! The whole pipeline.

mod error;
mod report;
mod settings;

pub use error::*;
pub use report::*;
pub use settings::*;

use alloc::vec::Vec;

use crate::lightmap::{LightmapImage, LightmapUv, Placement};
use crate::progress::Progress;
use crate::scene::Scene;

/// A finished bake.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bake {
    /// The lightmaps.
    pub images: Vec<LightmapImage>,
    /// For each mesh of the scene its lightmap coordinates, if a surface with a lightmap uses it.
    pub uvs: Vec<Option<LightmapUv>>,
    /// For each surface of the scene where its lightmap lies, if it has one.
    pub placements: Vec<Option<Placement>>,
    /// What was done and how good it is.
    pub report: Report,
}

/// Bakes the lightmaps of a scene.
///
/// # Errors
///
/// See [`BakeError`]; nothing is lost, and the text of an error says what to do.
pub fn bake(_scene: &Scene, _settings: &BakeSettings, _progress: &Progress) -> Result<Bake, BakeError> {
    Err(BakeError::NothingToBake)
}
