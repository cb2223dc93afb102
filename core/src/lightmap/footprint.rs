//! The points of a texel from which light is looked for.

use glam::{Vec2, Vec3};

use super::{ALL_QUARTERS, Texel, Texels, quarter};
use crate::geometry::Sobol;
use crate::scene::World;

/// The share of a texel's sides over which points lie: none lies in a wall on its border.
const INSIDE: f32 = 0.98;

/// The points of a texel from which light is looked for.
pub(super) struct Footprint {
    position: Vec3,
    middle: Vec3,
    steps: [Vec3; 2],
    /// Centers of the visible quarters, as offsets from the middle of the texel.
    quarters: [Vec2; 4],
    visible: usize,
    /// Whether all of the texel is covered and nothing stands in it.
    is_whole: bool,
}

impl Footprint {
    pub fn new(texel: &Texel, texels: &Texels, world: &World) -> Self {
        let mut footprint = Self {
            position: texel.position,
            middle: texels.middle(world, texel),
            steps: texels.steps(world, texel.triangle),
            quarters: [Vec2::ZERO; 4],
            visible: 0,
            is_whole: texel.quarters == ALL_QUARTERS,
        };
        for k in (0..4).filter(|k| texel.quarters >> k & 1 == 1) {
            footprint.quarters[footprint.visible] = quarter(k) - Vec2::splat(0.5);
            footprint.visible += 1;
        }
        footprint
    }

    /// The position of a texel alone.
    pub fn middle(texel: &Texel) -> Self {
        Self {
            position: texel.position,
            middle: texel.position,
            steps: [Vec3::ZERO; 2],
            quarters: [Vec2::ZERO; 4],
            visible: 0,
            is_whole: false,
        }
    }

    /// Point `k`: all over a texel that is whole, else one of the middles of its visible quarters, else its own. Two
    /// dimensions of the sequence are used, from `dimension` on.
    pub fn point(&self, sequence: &Sobol, k: u32, dimension: usize) -> Vec3 {
        let square = || Vec2::new(sequence.dimension(k, dimension), sequence.dimension(k, dimension + 1));
        let offset = match self.visible {
            0 => return self.position,
            _ if self.is_whole => (square() - 0.5) * INSIDE,
            visible => self.quarters[k as usize % visible],
        };
        self.middle + self.steps[0] * offset.x + self.steps[1] * offset.y
    }

    /// No point is farther than this from the position of the texel along any axis.
    pub fn reach(&self) -> f32 {
        let aside = (self.position - self.middle).abs();
        (0.5 * (self.steps[0].abs() + self.steps[1].abs()) + aside).max_element()
    }
}
