//! How a bake is to be made.

use crate::lightmap::LayoutSettings;
pub use crate::transport::Keep;

/// How a bake is to be made.
#[derive(Clone, Debug, PartialEq)]
pub struct BakeSettings {
    /// How many texels, and where.
    pub layout: LayoutSettings,
    /// How many rays.
    pub quality: Quality,
    /// Rays are added until the estimated error, a root mean square relative to the light and a tenth of its mean, is no
    /// larger, or until texels have as many rays as they get at most: then a warning says what is left. 0.02 is good;
    /// 0: none are added beyond what the quality asks for. It does nothing where the transport is kept.
    pub target_error: f32,
    /// Worker threads, at most 256; 0: one for each core. The result does not depend on it.
    pub threads: usize,
    /// What the bake may use at most, in bytes; it fails with the numbers where that is too little.
    pub memory_bytes: u64,
    /// Of all random decisions. The same seed gives the same bits.
    pub seed: u64,
    /// Whether lamps and colors shall be changed later without a bake.
    pub keep: Keep,
}

impl Default for BakeSettings {
    /// Medium quality, density chosen by it, coordinates kept where they are usable, no limit of memory, nothing kept.
    fn default() -> Self {
        Self {
            layout: LayoutSettings::default(),
            quality: Quality::Medium,
            target_error: 0.0,
            threads: 0,
            memory_bytes: u64::MAX,
            seed: 0,
            keep: Keep::Lightmaps,
        }
    }
}

/// How many rays are spent; noise falls and time grows from left to right.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// To see where the light goes.
    Draft,
    /// For a game.
    #[default]
    Medium,
    /// For the last bake before shipping.
    High,
}
