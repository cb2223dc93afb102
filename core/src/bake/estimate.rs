//! What remains wrong, as far as a bake itself can tell.

use glam::Vec3;

use super::EstimatedError;
use super::bounce::Bounce;
use crate::lightmap::{NONE, Smooth, Texels};
use crate::math;
use crate::patch::Patches;

/// Noise from the two halves of the rays; bias from what texels gathered against what their patches received.
///
/// The patches hold one value for a whole cell, and the texels see them at the last bounce only: an error of the
/// patches reaches a texel times the reflectance.
pub(super) fn estimate(
    texels: &Texels,
    is_valid: &[bool],
    patches: &Patches,
    bounce: &Bounce,
    direct: &[Vec3],
    indirect: &[Smooth],
) -> EstimatedError {
    let valid = || (0..texels.list.len()).filter(|&index| is_valid[index]);
    let count = valid().count().max(1) as f64;
    let level = |value: Vec3| f64::from(value.element_sum() / 3.0);
    let mean = valid().map(|index| level(direct[index] + indirect[index].irradiance)).sum::<f64>() / count;
    if mean <= 0.0 {
        return EstimatedError::default();
    }
    let squares: f64 = valid()
        .map(|index| {
            let value = level(direct[index] + indirect[index].irradiance) + 0.1 * mean;
            f64::from(indirect[index].variance) / (value * value)
        })
        .sum();
    let difference: f64 = valid()
        .filter(|&index| patches.of_texel[index] != NONE)
        .map(|index| {
            let patch = patches.of_texel[index] as usize;
            level((bounce.indirect[patch] - indirect[index].irradiance) * bounce.reflectance[patch])
        })
        .sum();
    EstimatedError { rms: math::sqrt((squares / count) as f32), bias: (difference / count / mean) as f32 }
}
