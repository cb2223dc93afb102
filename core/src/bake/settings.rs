//! How a bake is to be made.

/// How a bake is to be made.
#[derive(Clone, Debug, PartialEq)]
pub struct BakeSettings {
    /// How many texels.
    pub resolution: Resolution,
    /// What becomes of the lightmap coordinates that the meshes bring along.
    pub uv: UvMode,
    /// How many rays.
    pub quality: Quality,
    /// Worker threads; 0: one for each core. The result does not depend on it.
    pub threads: usize,
    /// What the bake may use at most, in bytes; it fails with the numbers where that is too little.
    pub memory_bytes: u64,
    /// Of all random decisions. The same seed gives the same bits.
    pub seed: u64,
    /// Longest side of an image in texels, a multiple of 4, at most 4096.
    pub max_image_size: u32,
}

impl Default for BakeSettings {
    /// Medium quality, density chosen by it, coordinates kept where they are usable, no limit of memory.
    fn default() -> Self {
        Self {
            resolution: Resolution::Auto,
            uv: UvMode::Auto,
            quality: Quality::Medium,
            threads: 0,
            memory_bytes: u64::MAX,
            seed: 0,
            max_image_size: 4096,
        }
    }
}

/// How many texels a bake has.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Resolution {
    /// As many per meter as give 2^18, 2^20 or 2^22 texels for draft, medium and high, between 1 and 64 per meter.
    #[default]
    Auto,
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
