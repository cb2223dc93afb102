//! More rays where filtered light is still too noisy.

use alloc::vec::Vec;

use glam::Vec3;

use super::cells::Cell;
use super::{Enough, Gather, Gathered, Nodes, Seen, Smooth, filter};
use crate::geometry::{Hit, Occluders};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};

/// The first round whose rays are not those that nodes began with.
const FIRST_ROUND: u32 = 2;

/// So many rays bring a texel just to the error that is wanted; those that are worse keep a larger one with more rays.
const BALANCED: f32 = 160.0;

impl<O: Occluders, C: Fn(Vec3, Option<&Hit>) -> Seen + Sync> Gather<'_, O, C> {
    /// Doubles the rays of nodes, round after round, until they are enough.
    pub(super) fn refine(
        &self,
        direct: &[f32],
        cells: &[Cell],
        nodes: &mut Nodes,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<(), Cancelled> {
        let mut wanted: Vec<usize> =
            (0..nodes.gathered.len()).filter(|&texel| nodes.gathered[texel].rays > 0).collect();
        for round in FIRST_ROUND.. {
            wanted = self.short_of_rays(wanted, direct, nodes, workers, progress)?;
            if wanted.is_empty() {
                break;
            }
            let more = wanted.iter().map(|&texel| (texel, nodes.gathered[texel].rays)).collect();
            self.add(more, round, nodes, workers, progress)?;
            self.interpolate(cells, &mut nodes.gathered);
        }
        Ok(())
    }

    /// Those of some nodes that need more rays.
    fn short_of_rays(
        &self,
        mut among: Vec<usize>,
        direct: &[f32],
        nodes: &Nodes,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<Vec<usize>, Cancelled> {
        let gathered = &nodes.gathered;
        let limit = match self.settings.enough {
            Enough::Rays(rays) => {
                among.retain(|&texel| gathered[texel].width == 1 && gathered[texel].rays < rays);
                return Ok(among);
            }
            Enough::Error(limit) | Enough::Rms(limit) => limit * limit,
        };
        let smooth = filter(gathered, self.texels, self.is_valid, workers, progress)?;
        let errors = self.squared_errors(direct, &smooth);
        let is_enough = match self.settings.enough {
            Enough::Rms(_) => {
                errors.iter().map(|&error| f64::from(error)).sum::<f64>() <= f64::from(limit) * self.count()
            }
            _ => false,
        };
        let is_short = |&texel: &usize| {
            let Gathered { rays, width, .. } = gathered[texel];
            let width = u32::from(width.max(1));
            let gain = errors[texel] * (width * width) as f32 / rays as f32;
            gain > limit / BALANCED && rays < self.settings.most_rays * width
        };
        among.retain(|texel| !is_enough && is_short(texel));
        Ok(among)
    }

    fn count(&self) -> f64 {
        self.is_valid.iter().filter(|is_valid| **is_valid).count().max(1) as f64
    }

    /// For each texel the variance of its indirect light over the square of all its light and a tenth of the mean.
    fn squared_errors(&self, direct: &[f32], smooth: &[Smooth]) -> Vec<f32> {
        let light = |texel: usize| direct[texel] + smooth[texel].irradiance.element_sum() / 3.0;
        let valid = (0..smooth.len()).filter(|&texel| self.is_valid[texel]);
        let mean = (valid.map(|texel| f64::from(light(texel))).sum::<f64>() / self.count()) as f32;
        let error = |texel: usize| {
            let scale = light(texel) + 0.1 * mean;
            if self.is_valid[texel] && scale > 0.0 { smooth[texel].variance / (scale * scale) } else { 0.0 }
        };
        (0..smooth.len()).map(error).collect()
    }
}
