//! The solved light as rays see it: what radiance leaves a surface where a ray meets it.

use alloc::vec::Vec;

use glam::Vec3;

use super::bounce::{Bounce, LARGEST_REFLECTANCE};
use crate::geometry::Hit;
use crate::lightmap::{NONE, Patches, Texel, Texels};
use crate::math;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::scene::World;

/// The solved light of a bake.
pub(super) struct Field<'a> {
    pub world: &'a World<'a>,
    pub texels: &'a Texels,
    pub patches: &'a Patches,
    pub bounce: &'a Bounce,
    /// For each surface whether its emission is a light of its own, so that rays must not see it again.
    pub is_light: &'a [bool],
    /// Width of what one ray stands for at a distance of one meter, in meters.
    pub spread: f32,
    pub incident: Incident,
}

/// For each texel irradiance / pi: its own direct light and what its patch and the patches around it receive.
pub(super) struct Incident {
    fine: Vec<Vec3>,
    /// The mean over 3 x 3 texels of the same chart.
    coarse: Vec<Vec3>,
}

impl Field<'_> {
    /// Radiance that leaves a hit towards the ray, in cd/m2.
    ///
    /// A ray of many stands for a cone. What is met far away is looked at as coarsely as the cone is wide there: by
    /// texels, by 3 x 3 of them, or by patches. That is less noise for the same light.
    pub fn radiance(&self, hit: &Hit) -> Vec3 {
        let Some(index) = self.patches.at(self.world, self.texels, hit) else { return Vec3::ZERO };
        let (patch, bounce) = (&self.patches.list[index as usize], self.bounce);
        let width = hit.distance * self.spread;
        if width * width > patch.area {
            return bounce.radiance[index as usize];
        }
        let incident = match self.texels.at(hit) {
            Some(texel) if patch.side > 0.0 => self.incident.at(texel, width, &self.texels.list[texel as usize]),
            _ => bounce.direct[index as usize] + bounce.indirect[index as usize],
        };
        let surface = self.world.sources[hit.triangle as usize].surface;
        let emission = if self.is_light[surface as usize] { Vec3::ZERO } else { self.world.emission(hit) };
        emission + incident * self.world.reflectance(hit).min(Vec3::splat(LARGEST_REFLECTANCE))
    }
}

impl Incident {
    pub fn new(
        direct: &[Vec3],
        texels: &Texels,
        patches: &Patches,
        bounce: &Bounce,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<Self, Cancelled> {
        let fine = workers.map(direct.len(), 4096, progress, |range| {
            range.map(|texel| direct[texel] + interpolated(texel, texels, patches, &bounce.indirect)).collect()
        })?;
        let coarse = workers.map(direct.len(), 4096, progress, |range| {
            range.map(|texel| mean_around(texel, texels, patches, &fine)).collect()
        })?;
        Ok(Self { fine, coarse })
    }

    fn at(&self, index: u32, width: f32, texel: &Texel) -> Vec3 {
        let values = if width * width > 2.0 * texel.area { &self.coarse } else { &self.fine };
        values[index as usize]
    }
}

/// The mean over the 3 x 3 texels around one that belong to its chart and to a patch.
fn mean_around(index: usize, texels: &Texels, patches: &Patches, values: &[Vec3]) -> Vec3 {
    let Texel { pixel, image, chart, .. } = texels.list[index];
    let (mut sum, mut count) = (values[index], 1.0);
    for k in (0..9).filter(|&k| k != 4) {
        let (x, y) = (i32::from(pixel[0]) + k % 3 - 1, i32::from(pixel[1]) + k / 3 - 1);
        let Some(other) = texels.at_pixel(u32::from(image), x, y) else { continue };
        if texels.list[other as usize].chart == chart && patches.of_texel[other as usize] != NONE {
            sum += values[other as usize];
            count += 1.0;
        }
    }
    sum / count
}

/// Bilinear between the cells around a texel, as far as they belong to its chart.
fn interpolated(index: usize, texels: &Texels, patches: &Patches, indirect: &[Vec3]) -> Vec3 {
    let Texel { pixel, image, chart, .. } = texels.list[index];
    if patches.of_texel[index] == NONE {
        return Vec3::ZERO;
    }
    let (cell, half) = (patches.cell as f32, (patches.cell / 2) as i32);
    let along = pixel.map(|position| {
        let shifted = (f32::from(position) + 0.5) / cell + 0.5;
        shifted - math::floor(shifted)
    });
    let (mut sum, mut weights) = (Vec3::ZERO, 0.0);
    for k in 0..4 {
        let (right, lower) = (k & 1, k >> 1);
        let (x, y) = (i32::from(pixel[0]) + (2 * right - 1) * half, i32::from(pixel[1]) + (2 * lower - 1) * half);
        let Some(other) = texels.at_pixel(u32::from(image), x, y) else { continue };
        let patch = patches.of_texel[other as usize];
        if patch == NONE || texels.list[other as usize].chart != chart {
            continue;
        }
        let share = |along: f32, side: i32| if side == 1 { along } else { 1.0 - along };
        let weight = share(along[0], right) * share(along[1], lower);
        sum += indirect[patch as usize] * weight;
        weights += weight;
    }
    if weights > 0.0 { sum / weights } else { indirect[patches.of_texel[index] as usize] }
}
