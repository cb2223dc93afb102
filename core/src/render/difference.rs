//! How far the picture of a bake is from the truth.

use alloc::vec::Vec;

use glam::Vec3;

use super::legend::{draw_scale, heat};
use super::{Estimate, PathPicture};
use crate::math;

/// Differences of this size and larger ones have the first or the last color.
const LARGEST: f32 = 0.1;
/// So much noise may be seen, root mean square.
const NOISE: f32 = 0.01;
/// Pixels to each side that are mixed at most.
const FARTHEST: usize = 8;

/// What is too dark or too bright in a picture of radiance in cd/m2: from blue for 10 % less over green to red for 10 %
/// more than paths of light say, relative to these plus a tenth of their mean. A scale at the lower edge tells it.
///
/// Both have the same number of pixels. Each is mixed with its neighbors, more of them the fewer paths there were, to see
/// more than noise.
pub fn difference(radiance: &[Vec3], truth: &PathPicture<Vec3>) -> Vec<[u8; 3]> {
    let count = truth.pixels.len().max(1) as f32;
    let floor = 0.1 * truth.pixels.iter().map(|pixel| gray(pixel.mean)).sum::<f32>() / count;
    let relative = |error: f32, level: f32| error / (level + floor).max(f32::MIN_POSITIVE);
    let noise = |pixel: &Estimate<Vec3>| relative(gray(pixel.standard_error()), gray(pixel.mean));
    let noise = math::sqrt(truth.pixels.iter().map(|pixel| noise(pixel) * noise(pixel)).sum::<f32>() / count);
    let far = ((0.5 * noise / NOISE) as usize).min(FARTHEST);
    let size = truth.size.map(|side| side as usize);
    let levels: Vec<f32> = truth.pixels.iter().map(|pixel| gray(pixel.mean)).collect();
    let errors: Vec<f32> = radiance.iter().zip(&levels).map(|(&shown, level)| gray(shown) - level).collect();
    // Each on its own: the mean of quotients by noisy numbers is too large.
    let mixed = mixed(&errors, size, far).into_iter().zip(mixed(&levels, size, far));
    let mut rgb: Vec<[u8; 3]> =
        mixed.map(|(error, level)| heat(0.5 + 0.5 * relative(error, level) / LARGEST)).collect();
    draw_scale(&mut rgb, truth.size[0] as usize, [-100.0 * LARGEST, 100.0 * LARGEST], "%");
    rgb
}

/// The means of each pixel and those not farther away, along rows and columns.
fn mixed(pixels: &[f32], [width, height]: [usize; 2], far: usize) -> Vec<f32> {
    let around = |at: usize, end: usize| at.saturating_sub(far)..(at + far + 1).min(end);
    let mean = |at: usize| {
        let (rows, columns) = (around(at / width, height), around(at % width, width));
        let count = rows.len() * columns.len();
        let row = |y: usize| pixels[y * width..][columns.clone()].iter().sum::<f32>();
        rows.map(row).sum::<f32>() / count as f32
    };
    (0..pixels.len()).map(mean).collect()
}

fn gray(color: Vec3) -> f32 {
    color.element_sum() / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    /// A picture of 1 everywhere, of which pixels are off by a tenth of what they are measured against, or not at all.
    #[test]
    fn too_dark_is_blue_and_too_bright_is_red() {
        let mut truth = PathPicture::new([3, 1], 0);
        truth.pixels.iter_mut().for_each(|pixel| (0..2).for_each(|_| pixel.add(Vec3::ONE)));
        let rgb = difference(&[0.89, 1.0, 1.11].map(Vec3::splat), &truth);
        assert_eq!(rgb, vec![heat(0.0), heat(0.5), heat(1.0)]);
    }

    /// Noise of 50 % is not seen where pixels are mixed, an error of 10 % is.
    #[test]
    fn noise_is_mixed_away() {
        let mut truth = PathPicture::new([64, 64], 0);
        for (index, pixel) in truth.pixels.iter_mut().enumerate() {
            let noise = if (index + index / 64) % 2 == 0 { 0.5 } else { -0.5 };
            [0.6 * noise, 1.4 * noise].into_iter().for_each(|off| pixel.add(Vec3::splat(1.0 + off)));
        }
        let color = |light: f32| difference(&[Vec3::splat(light); 64 * 64], &truth)[32 * 64 + 32];
        let [dark, right, bright] = [0.7, 1.0, 1.7].map(color);
        assert_eq!((dark, bright), (heat(0.0), heat(1.0)));
        assert!(right != dark && right != bright, "{right:?}");
    }
}
