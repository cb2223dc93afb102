//! Direct light smoothed where it is noisy: in penumbrae.

use alloc::vec::Vec;

use glam::Vec3;

use super::filter::neighbor;
use super::{DirectError, DirectTexel, Texels};
use crate::math;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};

/// Width of the filter, as a standard deviation in texels.
const WIDTH: f32 = 1.25;
/// Texels to each side that are looked at.
const REACH: i32 = 3;
/// Two opposite texels count less where their mean is off by more than so many standard errors.
const TOLERANCE: f32 = 1.2;

/// Smooths direct light where shadow rays leave it noisy, as far as noise hides its shape.
///
/// Texels count in pairs that lie opposite, by whether their mean agrees with the texel between: the slope of a penumbra
/// stays, and so do its edges. Bilateral filters ask how alike pixels are (Tomasi and Manduchi, "Bilateral Filtering for
/// Gray and Color Images", ICCV 1998); here the noise of each is known.
pub(super) fn smooth_penumbrae(
    light: &[DirectTexel],
    texels: &Texels,
    is_valid: &[bool],
    workers: &Workers,
    progress: &Progress,
) -> Result<Vec<DirectTexel>, Cancelled> {
    workers
        .map(light.len(), 1024, progress, |range| range.map(|index| smoothed(index, light, texels, is_valid)).collect())
}

fn smoothed(index: usize, light: &[DirectTexel], texels: &Texels, is_valid: &[bool]) -> DirectTexel {
    let (own, texel) = (light[index], &texels.list[index]);
    let is_edge = own.error.spread > 0.0;
    if own.error.noise <= 0.0 || is_edge {
        return own;
    }
    let at =
        |x: i32, y: i32| neighbor(texel, texels, is_valid, x, y).filter(|_| texels.is_connected(index as u32, x, y));
    let noise = pooled(own.error.noise, |x, y| at(x, y).map(|other| light[other].error.noise));
    let (mut sum, mut weights, mut variance) = (own.irradiance, 1.0, noise);
    for y in 0..=REACH {
        for x in if y == 0 { 1 } else { -REACH }..=REACH {
            let (Some(one), Some(other)) = (at(x, y), at(-x, -y)) else { continue };
            let (one, other) = (&light[one], &light[other]);
            // Light on one side and shadow on the other, without doubt: nobody can tell the edge between from its noise.
            if one.error.noise.max(other.error.noise) <= 0.0 {
                continue;
            }
            let both = one.irradiance + other.irradiance;
            let off = level(both * 0.5 - own.irradiance);
            let noise_of_both = (one.error.noise + other.error.noise).max(2.0 * noise);
            let expected = noise + 0.25 * noise_of_both;
            let far = (x * x + y * y) as f32 / (2.0 * WIDTH * WIDTH);
            let weight = math::exp(-far - off * off / (2.0 * TOLERANCE * TOLERANCE * expected));
            sum += both * weight;
            weights += 2.0 * weight;
            variance += noise_of_both * weight * weight;
        }
    }
    let error = DirectError { noise: variance / (weights * weights), ..own.error };
    DirectTexel { irradiance: sum / weights, error }
}

/// The noise of a texel and of those around it: few rays agree now and then by chance.
fn pooled(own: f32, noise: impl Fn(i32, i32) -> Option<f32>) -> f32 {
    let around = (0..9).filter(|&k| k != 4).filter_map(|k| noise(k % 3 - 1, k / 3 - 1));
    let (sum, count) = around.fold((own, 1.0), |(sum, count), noise| (sum + noise, count + 1.0));
    own.max(sum / count)
}

fn level(irradiance: Vec3) -> f32 {
    irradiance.element_sum() / 3.0
}
