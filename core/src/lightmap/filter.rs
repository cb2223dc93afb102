//! Indirect light smoothed where it was gathered texel by texel, as far as what is seen is far away.

use alloc::vec::Vec;

use glam::Vec3;

use super::{Gathered, Texel, Texels};
use crate::math;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};

/// Width of the filter as a share of the harmonic mean distance of what a texel sees.
const WIDTH: f32 = 0.06;
/// Widest filter, as a standard deviation in texels.
const WIDEST: f32 = 3.0;
/// Texels to each side that are looked at.
const REACH: i32 = 6;

/// Indirect light after filtering.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Smooth {
    /// Irradiance / pi.
    pub irradiance: Vec3,
    /// Variance of `irradiance`, mean over the channels.
    pub variance: f32,
}

/// Smooths gathered irradiance by a Gaussian whose width follows the distance of what each texel sees.
///
/// Contact shadows stay as sharp as they are, because contacts see near things. Only texels of the same chart with
/// similar normals and without a wall between them mix.
pub fn filter(
    gathered: &[Gathered],
    texels: &Texels,
    is_valid: &[bool],
    workers: &Workers,
    progress: &Progress,
) -> Result<Vec<Smooth>, Cancelled> {
    let variances: Vec<f32> = workers.map(gathered.len(), 1024, progress, |range| {
        range.map(|index| pooled_variance(index, gathered, texels, is_valid)).collect()
    })?;
    workers.map(gathered.len(), 1024, progress, |range| {
        range.map(|index| filtered(index, gathered, &variances, texels, is_valid)).collect()
    })
}

/// Variance of what a texel gathered, from those around it: two halves alone agree now and then by chance.
///
/// Nodes have the variance of one ray in common, as strata of a survey are pooled (Cochran, "Sampling Techniques", 1977,
/// section 5.7). Those of wide cells lie as far apart as the cells are wide.
fn pooled_variance(index: usize, gathered: &[Gathered], texels: &Texels, is_valid: &[bool]) -> f32 {
    let Texel { pixel: [x, y], image, chart, .. } = texels.list[index];
    let Gathered { rays, width, .. } = gathered[index];
    let step = i32::from(width.max(1));
    let (mut sum, mut count) = (0.0, 0.0_f32);
    for k in 0..9 {
        let (x, y) = (i32::from(x) + (k % 3 - 1) * step, i32::from(y) + (k / 3 - 1) * step);
        let Some(other) = texels.at_pixel(u32::from(image), x, y) else { continue };
        let node = &gathered[other as usize];
        let is_same_kind = (node.rays > 0) == (rays > 0) && texels.list[other as usize].chart == chart;
        if is_valid[other as usize] && is_same_kind {
            sum += node.variance * node.rays.max(1) as f32;
            count += 1.0;
        }
    }
    sum / (count.max(1.0) * rays.max(1) as f32)
}

fn filtered(index: usize, gathered: &[Gathered], variances: &[f32], texels: &Texels, is_valid: &[bool]) -> Smooth {
    let (mut sum, mut variance, mut weights) = (Vec3::ZERO, 0.0, 0.0);
    stencil(index, gathered, texels, is_valid, |other, weight| {
        sum += gathered[other].irradiance * weight;
        variance += variances[other] * weight * weight;
        weights += weight;
    });
    let apart = variance / (weights * weights);
    // The texels of a cell have their noise in common; but filtering adds none.
    let side = f32::from(gathered[index].width.max(1));
    let variance = (apart * side * side).min(variances[index].max(apart));
    Smooth { irradiance: sum / weights, variance }
}

/// Visits the texels that are mixed into one, each with its weight: at least itself.
pub fn stencil(
    index: usize,
    gathered: &[Gathered],
    texels: &Texels,
    is_valid: &[bool],
    mut visit: impl FnMut(usize, f32),
) {
    let (own, texel) = (&gathered[index], &texels.list[index]);
    let sigma = (WIDTH * own.distance / math::sqrt(texel.area.max(1e-12))).min(WIDEST);
    // Between the corners of cells wider than the filter light is smooth already.
    let is_wide = own.width != 1 && f32::from(own.width) > sigma;
    if is_wide || sigma < 0.3 {
        return visit(index, 1.0);
    }
    let reach = (math::ceil(2.0 * sigma) as i32).min(REACH);
    // Neither of two texels mixes far into what the other sees near.
    let width = |x: i32, y: i32| {
        let other = neighbor(texel, texels, is_valid, x, y).filter(|_| texels.is_connected(index as u32, x, y))?;
        Some((other, sigma.min(sigma * gathered[other].distance / own.distance.max(1e-9)).max(0.2)))
    };
    // What lies opposite counts as much: one that looks to one side only is wrong wherever light changes.
    for y in 0..=reach {
        for x in if y == 0 { 1 } else { -reach }..=reach {
            let (Some((one, width)), Some((other, opposite))) = (width(x, y), width(-x, -y)) else { continue };
            let narrow = width.min(opposite);
            let weight = math::exp(-((x * x + y * y) as f32) / (2.0 * narrow * narrow));
            [one, other].into_iter().for_each(|texel| visit(texel, weight));
        }
    }
    visit(index, 1.0);
}

/// The texel so many columns and rows away, if it is valid and lies on the same chart in about the same direction.
pub(super) fn neighbor(texel: &Texel, texels: &Texels, is_valid: &[bool], x: i32, y: i32) -> Option<usize> {
    let [column, row] = texel.pixel.map(i32::from);
    let other = texels.at_pixel(u32::from(texel.image), column + x, row + y)? as usize;
    let is_near = texels.list[other].chart == texel.chart && texels.list[other].normal.dot(texel.normal) > 0.95;
    (is_valid[other] && is_near).then_some(other)
}
