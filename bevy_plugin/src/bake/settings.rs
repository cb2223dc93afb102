//! How a bake inside an app is to be made.

use std::thread::available_parallelism;

use bevy::prelude::*;
use radiosity::bake;
use radiosity::lightmap::{self, LayoutSettings};

/// How a bake is to be made. The resource counts for `BakeOnLoad`; `StartBake` brings its own.
#[derive(Resource, Reflect, Clone, Debug, PartialEq)]
#[reflect(Resource, Default)]
pub struct BakeSettings {
    /// How many rays.
    pub quality: Quality,
    /// How many texels.
    pub resolution: Resolution,
    /// What becomes of the lightmap coordinates that meshes bring along.
    pub uv: UvMode,
    /// Longest side of an image in texels, a multiple of 4, at most 4096.
    pub max_image_size: u32,
    /// Worker threads; 0: one for each core but one, which the app keeps. The result does not depend on it.
    pub threads: usize,
    /// What the bake may use at most, in bytes; it fails with the numbers where that is too little.
    pub memory_bytes: u64,
    /// Of all random decisions. The same seed gives the same bits.
    pub seed: u64,
    /// Whether lightmaps are looked up with a wider, smoother filter, which costs time and blurs over two texels.
    pub bicubic_sampling: bool,
}

impl Default for BakeSettings {
    /// Medium quality and about a million texels.
    fn default() -> Self {
        let core = bake::BakeSettings::default();
        Self {
            quality: Quality::default(),
            resolution: Resolution::default(),
            uv: UvMode::default(),
            max_image_size: core.layout.max_image_size,
            threads: core.threads,
            memory_bytes: core.memory_bytes,
            seed: core.seed,
            bicubic_sampling: false,
        }
    }
}

/// How many rays are spent; noise falls and time grows from top to bottom.
#[derive(Reflect, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[reflect(Default)]
pub enum Quality {
    /// To see where the light goes.
    Draft,
    /// For a game.
    #[default]
    Medium,
    /// For the last bake before shipping.
    High,
}

/// How many texels a bake has.
#[derive(Reflect, Clone, Copy, Debug, Default, PartialEq)]
#[reflect(Default)]
pub enum Resolution {
    /// As the quality asks: 2^18, 2^20 or 2^22 in all images together, between 1 and 64 per meter.
    #[default]
    OfQuality,
    /// As many per meter as give about this many texels in all images together, between 1 and 64 per meter.
    Texels(u32),
    /// The same density everywhere; 4 to 64 are usual.
    TexelsPerMeter(f32),
    /// One square image of this side in texels.
    SingleImage(u32),
}

/// What becomes of the lightmap coordinates that a mesh brings along.
#[derive(Reflect, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[reflect(Default)]
pub enum UvMode {
    /// Usable ones are kept, the rest is unwrapped.
    #[default]
    Auto,
    /// A mesh without usable ones is an error.
    Keep,
    /// All meshes are unwrapped anew.
    Unwrap,
}

impl From<&BakeSettings> for bake::BakeSettings {
    fn from(settings: &BakeSettings) -> Self {
        let cores = available_parallelism().map_or(1, usize::from);
        Self {
            layout: LayoutSettings {
                resolution: core_resolution(settings),
                uv: core_uv_mode(settings.uv),
                max_image_size: settings.max_image_size,
            },
            quality: core_quality(settings.quality),
            threads: if settings.threads == 0 { (cores - 1).max(1) } else { settings.threads },
            memory_bytes: settings.memory_bytes,
            seed: settings.seed,
            ..Default::default()
        }
    }
}

fn core_quality(quality: Quality) -> bake::Quality {
    match quality {
        Quality::Draft => bake::Quality::Draft,
        Quality::Medium => bake::Quality::Medium,
        Quality::High => bake::Quality::High,
    }
}

fn core_resolution(settings: &BakeSettings) -> lightmap::Resolution {
    match (settings.resolution, settings.quality) {
        (Resolution::OfQuality, Quality::Draft) => lightmap::Resolution::Texels(1 << 18),
        (Resolution::OfQuality, Quality::Medium) => lightmap::Resolution::Texels(1 << 20),
        (Resolution::OfQuality, Quality::High) => lightmap::Resolution::Texels(1 << 22),
        (Resolution::Texels(count), _) => lightmap::Resolution::Texels(count),
        (Resolution::TexelsPerMeter(density), _) => lightmap::Resolution::TexelsPerMeter(density),
        (Resolution::SingleImage(side), _) => lightmap::Resolution::SingleImage(side),
    }
}

fn core_uv_mode(uv: UvMode) -> lightmap::UvMode {
    match uv {
        UvMode::Auto => lightmap::UvMode::Auto,
        UvMode::Keep => lightmap::UvMode::Keep,
        UvMode::Unwrap => lightmap::UvMode::Unwrap,
    }
}
