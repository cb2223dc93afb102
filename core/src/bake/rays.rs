//! What each quality spends.

use super::{BakeSettings, Keep, Quality};
use crate::lightmap::{Enough, GatherSettings, ShadowRays};
use crate::math;

/// What a texel may get at most where an error is to be reached.
const MOST_RAYS: u32 = 8192;

/// The share of the square of a wanted error that is spent: an estimate is not the error itself.
const LEFT_OF_ERROR: f32 = 0.8;

/// Rays for each purpose. Counts are powers of two, as Sobol points like them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RayBudget {
    /// For the row of form factors of a patch.
    pub row: u32,
    /// Patches that a bake has at least, if it has as many texels.
    pub patches: usize,
    pub shadow: ShadowRays,
    pub gather: GatherSettings,
    /// How many rays share the hemisphere where a gathered ray is taken for a cone.
    pub cone: u32,
    /// Rays of a texel whose row is kept.
    pub kept: u32,
}

impl RayBudget {
    /// What a bake spends.
    ///
    /// Where the transport is kept, where and how often nodes look must not depend on the light of the bake: it would be
    /// too little for another.
    pub fn new(settings: &BakeSettings) -> Self {
        let budget = Self::from(settings.quality);
        let gather = match settings.keep {
            Keep::Lightmaps if settings.target_error > 0.0 => return budget.until(settings.target_error),
            Keep::Lightmaps => budget.gather,
            Keep::Transport => {
                GatherSettings { contrast: f32::INFINITY, enough: Enough::Rays(budget.kept), ..budget.gather }
            }
        };
        Self { gather, ..budget }
    }

    /// What is spent until the error is no larger: a quarter of its square may be noise of direct light. What no rays mend
    /// is as fine as a quality of that error has it.
    fn until(self, error: f32) -> Self {
        let fit = Self::from(match error {
            ..0.008 => Quality::High,
            ..0.025 => Quality::Medium,
            _ => Quality::Draft,
        });
        let gather = GatherSettings {
            rays: Self::from(Quality::Draft).gather.rays,
            most_rays: MOST_RAYS,
            spacing: self.gather.spacing.min(fit.gather.spacing),
            contrast: self.gather.contrast.min(fit.gather.contrast),
            enough: Enough::Rms(error),
        };
        let shadow = ShadowRays {
            first: self.shadow.first.max(fit.shadow.first),
            sharp: self.shadow.sharp.max(fit.shadow.sharp),
            most: MOST_RAYS,
            noise: 0.5 * error,
        };
        let (row, patches, cone) = (self.row.max(fit.row), self.patches.max(fit.patches), self.cone.max(fit.cone));
        Self { row, patches, shadow, gather, cone, ..self }
    }

    /// How to gather where an error is wanted of which direct light and what lies between texels make up so much already:
    /// the rest may be noise of indirect light, and at least a quarter of the square.
    pub fn gather_beside(&self, known: f32) -> GatherSettings {
        let enough = match self.gather.enough {
            Enough::Rms(error) => {
                let wanted = error * error;
                Enough::Rms(math::sqrt((LEFT_OF_ERROR * wanted - known * known).max(0.25 * wanted)))
            }
            other => other,
        };
        GatherSettings { enough, ..self.gather }
    }

    /// Width of the cone that one gathered ray stands for, at a distance of one meter: `2 / sqrt(cone)`.
    pub fn spread(&self) -> f32 {
        2.0 / math::sqrt(self.cone as f32)
    }
}

impl From<Quality> for RayBudget {
    fn from(quality: Quality) -> Self {
        match quality {
            Quality::Draft => Self {
                row: 64,
                patches: 1024,
                shadow: ShadowRays { first: 8, sharp: 4, most: 32, noise: 0.05 },
                cone: 16,
                kept: 32,
                gather: GatherSettings {
                    rays: 16,
                    most_rays: 128,
                    spacing: 0.25,
                    contrast: 0.15,
                    enough: Enough::Error(0.05),
                },
            },
            Quality::Medium => Self {
                row: 128,
                patches: 4096,
                shadow: ShadowRays { first: 16, sharp: 8, most: 256, noise: 0.02 },
                cone: 64,
                kept: 128,
                gather: GatherSettings {
                    rays: 64,
                    most_rays: 1024,
                    spacing: 0.12,
                    contrast: 0.08,
                    enough: Enough::Error(0.02),
                },
            },
            Quality::High => Self {
                row: 256,
                patches: 16384,
                shadow: ShadowRays { first: 32, sharp: 16, most: 1024, noise: 0.01 },
                cone: 256,
                kept: 512,
                gather: GatherSettings {
                    rays: 256,
                    most_rays: 4096,
                    spacing: 0.06,
                    contrast: 0.04,
                    enough: Enough::Error(0.01),
                },
            },
        }
    }
}
