//! The sky in patches of equal size, as far away as it is.

use alloc::vec;
use alloc::vec::Vec;
use core::f32::consts::FRAC_PI_2;

use glam::{Vec2, Vec3};

use super::{SkyImage, direction};
use crate::math;

/// Rows of patches from the zenith to the horizon, roughly.
const SIDE: u32 = 10;

/// How many patches a [`SkyImage`] has for the bake: each covers as much as a square of 5.9 degrees, and its light is of one
/// radiance.
pub const SKY_PATCHES: u32 = 12 * SIDE * SIDE;

/// Points of the image in a patch whose mean is its light, at least, on average.
const POINTS: u32 = 64;

/// The patch of a direction of any length but 0: all have the same solid angle.
///
/// Gorski et al., "HEALPix: A Framework for High-Resolution Discretization and Fast Analysis of Data Distributed on the
/// Sphere", The Astrophysical Journal 2005, in the order of its rings.
pub fn sky_patch(direction: Vec3) -> u32 {
    let height = direction.y / direction.length().max(f32::MIN_POSITIVE);
    // In quarters of a turn, from 0 to 4.
    let quarters = math::atan2(direction.z, direction.x) / FRAC_PI_2;
    let quarters = if quarters < 0.0 { quarters + 4.0 } else { quarters };
    let side = SIDE as f32;
    if height.abs() <= 2.0 / 3.0 {
        let (rising, falling) = (side * (0.5 + quarters - 0.75 * height), side * (0.5 + quarters + 0.75 * height));
        let [rising, falling] = [rising, falling].map(|line| math::floor(line) as i32);
        let (side, ring) = (SIDE as i32, SIDE as i32 + 1 + rising - falling);
        let shift = 1 - (ring & 1);
        let place = ((rising + falling - side + shift + 1) / 2).rem_euclid(4 * side);
        let before = 2 * side * (side - 1) + (ring - 1) * 4 * side;
        return (before + place).clamp(0, SKY_PATCHES as i32 - 1) as u32;
    }
    let along = quarters - math::floor(quarters);
    let away = side * math::sqrt(3.0 * (1.0 - height.abs()).max(0.0));
    let [rising, falling] = [along, 1.0 - along].map(|share| ((share * away) as u32).min(SIDE - 1));
    let ring = (rising + falling + 1).min(SIDE);
    let place = ((quarters * ring as f32) as u32).min(4 * ring - 1);
    if height > 0.0 { 2 * ring * (ring - 1) + place } else { SKY_PATCHES - 2 * ring * (ring + 1) + place }
}

impl SkyImage {
    /// The mean relative radiance of each patch.
    pub fn of_patches(&self) -> Vec<Vec3> {
        let texels = (self.width * self.height).max(1);
        let steps = math::sqrt((SKY_PATCHES * POINTS) as f32 / texels as f32) as u32 + 1;
        let mut sums = vec![(Vec3::ZERO, 0.0); SKY_PATCHES as usize];
        let size = Vec2::new((self.width * steps) as f32, (self.height * steps) as f32);
        for row in 0..self.height * steps {
            let around = direction((Vec2::new(0.0, row as f32) + 0.5) / size);
            let weight = math::sqrt(around.x * around.x + around.z * around.z);
            for column in 0..self.width * steps {
                let texel = (row / steps) as usize * self.width as usize + (column / steps) as usize;
                let direction = direction((Vec2::new(column as f32, row as f32) + 0.5) / size);
                let (sum, whole) = &mut sums[sky_patch(self.rotation * direction) as usize];
                *sum += self.texels[texel] * weight;
                *whole += weight;
            }
        }
        sums.into_iter().map(|(sum, weight)| if weight > 0.0 { sum / weight } else { Vec3::ZERO }).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Sobol;

    /// Uniform directions meet all patches equally often, and neighbors in direction are neighbors in the sky.
    #[test]
    fn patches_have_the_same_size() {
        let (count, sequence) = (1 << 19, Sobol::new(5));
        let mut hits = vec![0_u32; SKY_PATCHES as usize];
        let mut middles = vec![Vec3::ZERO; SKY_PATCHES as usize];
        let uniform = |k: u32| {
            let square = sequence.square(k);
            super::super::at(4.0 * FRAC_PI_2 * square.x, 1.0 - 2.0 * square.y)
        };
        for direction in (0..count).map(uniform) {
            let patch = sky_patch(direction) as usize;
            hits[patch] += 1;
            middles[patch] += direction;
        }
        let mean = (count / SKY_PATCHES) as f32;
        let off = hits.iter().map(|&hits| (hits as f32 / mean - 1.0).abs()).fold(0.0, f32::max);
        assert!(off < 0.05, "{off}");
        let farthest = (0..count).map(uniform).map(|direction| {
            let middle = middles[sky_patch(direction) as usize].normalize();
            direction.dot(middle)
        });
        // Corners of diamonds at the poles' caps lie farthest from their middles.
        let farthest = farthest.fold(1.0, f32::min);
        assert!(farthest > 0.994, "{farthest}");
    }

    /// Their light is that of the image, whatever its size.
    #[test]
    fn patches_keep_the_light() {
        for (width, height) in [(4, 2), (64, 32), (1024, 512)] {
            let sky =
                SkyImage::from_fn(width, height, |direction| Vec3::new(1.0, 2.0 + direction.y, direction.x.max(0.0)));
            let sky = sky.unwrap().turned(glam::Quat::from_rotation_x(0.3));
            let mean = sky.of_patches().iter().sum::<Vec3>() / SKY_PATCHES as f32;
            let solid_angles = (0..height).flat_map(|row| [sky.solid_angle(row)].repeat(width as usize));
            let expected: Vec3 = sky.texels.iter().zip(solid_angles).map(|(&texel, angle)| texel * angle).sum();
            let expected = expected / (8.0 * FRAC_PI_2);
            assert!((mean - expected).abs().max_element() < 4e-3, "{width}: {mean} {expected}");
        }
    }
}
