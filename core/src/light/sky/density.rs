//! Directions chosen by how bright the sky is there.

use alloc::vec::Vec;
use core::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::{SkyImage, at};

/// Sums of what the texels of a sky give, to choose among them: rows first, then the texels of a row.
///
/// Pharr, Jakob and Humphreys, "Physically Based Rendering", 2023, section 12.5, where a texel covers the solid angle that
/// it has.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Densities {
    /// For each row what all rows up to and with it give.
    rows: Vec<f32>,
    /// For each texel the sum of the levels of its row up to and with it.
    texels: Vec<f32>,
    /// One over what all texels give; 0 of a black sky.
    pub scale: f32,
}

impl Densities {
    pub fn new(sky: &SkyImage) -> Self {
        let width = sky.width as usize;
        let mut whole = Self { rows: Vec::new(), texels: Vec::with_capacity(sky.texels.len()), scale: 0.0 };
        let mut sum = 0.0_f64;
        for (row, texels) in sky.texels.chunks_exact(width).enumerate() {
            let mut level = 0.0_f64;
            whole.texels.extend(texels.iter().map(|texel| {
                level += f64::from(texel.max_element());
                level as f32
            }));
            sum += level * f64::from(sky.solid_angle(row as u32));
            whole.rows.push(sum as f32);
        }
        whole.scale = if sum > 0.0 { (1.0 / sum) as f32 } else { 0.0 };
        whole
    }

    /// A direction of the image, by two numbers in `[0, 1)`.
    pub fn sample(&self, sky: &SkyImage, numbers: Vec2) -> Option<Vec3> {
        let (row, down) = choose(&self.rows, numbers.y)?;
        let width = sky.width as usize;
        let (column, along) = choose(&self.texels[row * width..(row + 1) * width], numbers.x)?;
        let [top, bottom] = sky.heights(row as u32);
        let longitude = TAU * ((column as f32 + along) / sky.width as f32 - 0.5);
        Some(at(longitude, top + (bottom - top) * down))
    }
}

/// Which of some sums a number in `[0, 1)` belongs to, and where it lies between that and the one before.
fn choose(sums: &[f32], number: f32) -> Option<(usize, f32)> {
    let whole = *sums.last().filter(|whole| **whole > 0.0)?;
    // The last that adds anything: rounding may take a number to the very end.
    let last = sums.partition_point(|&sum| sum < whole);
    let index = sums.partition_point(|&sum| sum <= number * whole).min(last);
    let before = if index == 0 { 0.0 } else { sums[index - 1] };
    let along = (number * whole - before) / (sums[index] - before);
    Some((index, along.clamp(0.0, 1.0 - f32::EPSILON)))
}

#[cfg(test)]
mod tests {
    use alloc::vec;

    use super::*;
    use crate::geometry::Sobol;

    /// How often samples fall into a part of the sky is the integral of the density over it, and means weighed by it are
    /// those of the light.
    #[test]
    fn samples_follow_their_density() {
        let bright =
            |direction: Vec3| Vec3::splat(if direction.dot(Vec3::new(0.6, 0.64, -0.48)) > 0.9 { 40.0 } else { 1.0 });
        let sky = SkyImage::from_fn(256, 128, bright).unwrap();
        let (sequence, count) = (Sobol::new(3), 1 << 15);
        let (mut within, mut upward, mut even) = (0.0, 0.0, 0.0);
        for k in 0..count {
            let direction = sky.sample(sequence.square(k)).unwrap();
            let density = sky.density(direction);
            within += f32::from(u8::from(sky.radiance(direction).x > 2.0)) / count as f32;
            upward += sky.radiance(direction).x * direction.y.max(0.0) / (density * count as f32);
            even += 1.0 / (density * count as f32);
        }
        // A cap of cos > 0.9 has a tenth of the half sphere's 2 pi; the light of it goes with its height 0.64 and its mean cosine 0.95.
        let cap = TAU * 0.1;
        let share = 40.0 * cap / (39.0 * cap + 2.0 * TAU);
        assert!((within - share).abs() < 5e-3, "{within} {share}");
        let irradiance = 39.0 * cap * 0.95 * 0.64 + TAU / 2.0;
        assert!((upward / irradiance - 1.0).abs() < 5e-3, "{upward} {irradiance}");
        assert!((even / (2.0 * TAU) - 1.0).abs() < 5e-3, "{even}");
    }

    #[test]
    fn what_is_black_is_never_chosen() {
        let mut texels = vec![Vec3::ZERO; 8 * 4];
        assert_eq!(SkyImage::new(8, 4, texels.clone()).unwrap().sample(Vec2::splat(0.5)), None);
        texels[13] = Vec3::Y;
        let sky = SkyImage::new(8, 4, texels).unwrap();
        for k in 0..64 {
            let direction = sky.sample(Sobol::new(1).square(k)).unwrap();
            assert!(sky.density(direction) > 0.0, "{direction}");
        }
        for edge in [0.0, 1.0 - f32::EPSILON] {
            assert!(sky.sample(Vec2::splat(edge)).is_some_and(|direction| direction.is_finite()));
        }
    }
}
