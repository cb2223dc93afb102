//! How light travels through a baked scene, kept so that other lamps and colors need no ray.

use alloc::string::String;
use alloc::vec::Vec;

use super::{Contact, Fills, LampLight, Lighting, Rows, Seams, Surfaces};

/// How light travels through a baked scene: with it, lamps, colors and the sky can change without a ray.
///
/// With `D` the direct light of the lamps, `F` the form factors between patches, `G` what nodes see of surfaces and `W`
/// how texels are mixed from nodes, a lightmap is `D + W G (e + rho (D + F b))`, where `b = e + rho (D + F b)`; at
/// contacts the light of their own takes the place of `F b`. Only `e`, `rho` and the strengths in `D` depend on the
/// [`Lighting`]: what mirrors and glass do with light is part of `D`, `F` and `G`, in the colors of the bake, and does not
/// change.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transport {
    /// What surfaces do with light: `e` and `rho`.
    pub surfaces: Surfaces,
    /// `D`, of each lamp for strength 1.
    pub lamps: Vec<LampLight>,
    /// `F`: a row for each patch, of patches.
    pub patches: Rows,
    /// `G`: a row for each node, of pieces of surface.
    pub nodes: Rows,
    /// The nodes that touch what they see.
    pub contacts: Vec<Contact>,
    /// `W`: a row for each texel, of nodes.
    pub texels: Rows,
    /// The images, in the order of the bake; the texels of each follow those of the one before.
    pub images: Vec<StoredImage>,
    /// Where texels of different charts show the same place.
    pub seams: Seams,
    /// The lamps and colors of the bake.
    pub lighting: Lighting,
    /// Of each lamp.
    pub lamp_names: Vec<String>,
    /// Of each material.
    pub material_names: Vec<String>,
}

/// Where the texels of an image lie.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StoredImage {
    /// Texels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Where in the image the texels lie whose light is computed; [`StoredImage::NOWHERE`] for others that are covered.
    pub places: Vec<u32>,
    /// How the others are filled.
    pub fills: Fills,
}

impl StoredImage {
    /// The place of a texel whose light is not computed.
    pub const NOWHERE: u32 = u32::MAX;
}

/// What the parts of a transport take, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TransportBytes {
    /// Form factors between patches.
    pub patches: usize,
    /// What nodes see.
    pub nodes: usize,
    /// How texels are mixed from nodes.
    pub texels: usize,
    /// Direct light.
    pub lamps: usize,
    /// Materials, areas, places and what fills the rest of the images.
    pub surfaces: usize,
    /// Seams.
    pub seams: usize,
}

impl TransportBytes {
    /// All of it.
    pub fn total(&self) -> usize {
        self.patches + self.nodes + self.texels + self.lamps + self.surfaces + self.seams
    }
}

impl Transport {
    /// What it takes.
    pub fn bytes(&self) -> TransportBytes {
        let images = self.images.iter().map(|image| 4 * image.places.len() + image.fills.bytes());
        TransportBytes {
            patches: self.patches.bytes(),
            nodes: self.nodes.bytes() + size_of::<Contact>() * self.contacts.len(),
            texels: self.texels.bytes(),
            lamps: self.lamps.iter().map(LampLight::bytes).sum(),
            surfaces: self.surfaces.bytes() + images.sum::<usize>(),
            seams: self.seams.bytes(),
        }
    }
}
