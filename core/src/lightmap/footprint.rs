//! The points of a texel from which light is looked for.

use glam::{Vec2, Vec3};

use super::{Texel, Texels, quarter};
use crate::geometry::Sobol;
use crate::scene::World;

/// The points of a texel from which light is looked for.
pub(super) struct Footprint {
    center: Vec3,
    steps: [Vec3; 2],
    /// Centers of the covered quarters, as offsets from the center of the texel.
    quarters: [Vec2; 4],
    covered: usize,
}

impl Footprint {
    pub fn new(texel: &Texel, texels: &Texels, world: &World) -> Self {
        let mut footprint = Self {
            center: texel.position,
            steps: texels.steps(world, texel.triangle),
            quarters: [Vec2::ZERO; 4],
            covered: 0,
        };
        for k in (0..4).filter(|k| texel.quarters >> k & 1 == 1) {
            footprint.quarters[footprint.covered] = quarter(k) - Vec2::splat(0.5);
            footprint.covered += 1;
        }
        footprint
    }

    /// The middle of a texel alone.
    pub fn middle(texel: &Texel) -> Self {
        Self { center: texel.position, steps: [Vec3::ZERO; 2], quarters: [Vec2::ZERO; 4], covered: 0 }
    }

    /// Point `k`: all over a texel that is covered, else one of the middles of its covered quarters, else its own. Two
    /// dimensions of the sequence are used, from `dimension` on.
    pub fn point(&self, sequence: &Sobol, k: u32, dimension: usize) -> Vec3 {
        let offset = match self.covered {
            4 => Vec2::new(sequence.dimension(k, dimension), sequence.dimension(k, dimension + 1)) - Vec2::splat(0.5),
            0 => Vec2::ZERO,
            covered => self.quarters[k as usize % covered],
        };
        self.center + self.steps[0] * offset.x + self.steps[1] * offset.y
    }

    /// No point is farther than this from the center along any axis.
    pub fn reach(&self) -> f32 {
        0.5 * (self.steps[0].abs() + self.steps[1].abs()).max_element()
    }
}
