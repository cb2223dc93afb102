//! What each quality spends.

use super::{BakeSettings, Keep, Quality};
use crate::lightmap::{GatherSettings, ShadowRays};
use crate::math;

/// Rays for each purpose. Counts are powers of two, as Sobol points like them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RayBudget {
    /// For the row of form factors of a patch.
    pub row: u32,
    /// Patches that a bake has at least, if it has as many texels.
    pub patches: usize,
    pub shadow: ShadowRays,
    pub gather: GatherSettings,
}

impl RayBudget {
    /// What a bake spends.
    ///
    /// Where the transport is kept, where and how often nodes look must not depend on the light of the bake: it would be
    /// too little for another.
    pub fn new(settings: &BakeSettings) -> Self {
        let budget = Self::from(settings.quality);
        let gather = match settings.keep {
            Keep::Lightmaps => budget.gather,
            Keep::Transport => GatherSettings { contrast: f32::INFINITY, noise: 0.0, ..budget.gather },
        };
        Self { gather, ..budget }
    }

    /// Width of the cone that one gathered ray stands for, at a distance of one meter: `2 / sqrt(rays)`.
    pub fn spread(&self) -> f32 {
        2.0 / math::sqrt(self.gather.rays as f32)
    }
}

impl From<Quality> for RayBudget {
    fn from(quality: Quality) -> Self {
        match quality {
            Quality::Draft => Self {
                row: 64,
                patches: 1024,
                shadow: ShadowRays { first: 8, sharp: 4, most: 32, noise: 0.05 },
                gather: GatherSettings { rays: 16, most_rays: 128, spacing: 0.25, contrast: 0.15, noise: 0.06 },
            },
            Quality::Medium => Self {
                row: 128,
                patches: 4096,
                shadow: ShadowRays { first: 16, sharp: 8, most: 256, noise: 0.02 },
                gather: GatherSettings { rays: 64, most_rays: 1024, spacing: 0.12, contrast: 0.08, noise: 0.02 },
            },
            Quality::High => Self {
                row: 256,
                patches: 16384,
                shadow: ShadowRays { first: 32, sharp: 16, most: 1024, noise: 0.01 },
                gather: GatherSettings { rays: 256, most_rays: 4096, spacing: 0.06, contrast: 0.04, noise: 0.01 },
            },
        }
    }
}
