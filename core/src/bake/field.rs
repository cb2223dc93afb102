//! The solved light as rays see it: what radiance leaves a surface where a ray meets it.

use alloc::vec::Vec;

use glam::Vec3;

use super::bounce::{Bounce, LARGEST_REFLECTANCE};
use crate::geometry::Hit;
use crate::lightmap::{NONE, Texel, Texels};
use crate::math;
use crate::parallel::Workers;
use crate::patch::Patches;
use crate::progress::{Cancelled, Progress};
use crate::scene::World;

/// Within so many sides of a patch, what is met is looked at texel by texel.
const NEAR: f32 = 4.0;

/// The solved light of a bake.
pub(super) struct Field<'a> {
    pub world: &'a World<'a>,
    pub texels: &'a Texels,
    pub patches: &'a Patches,
    pub bounce: &'a Bounce,
    /// For each surface whether its emission is a light of its own, so that rays must not see it again.
    pub is_light: &'a [bool],
    /// For each texel irradiance / pi: its own direct light and what its patch and the patches around it receive.
    pub incident: Vec<Vec3>,
}

impl Field<'_> {
    /// Radiance that leaves a hit towards the ray, in cd/m2.
    pub fn radiance(&self, hit: &Hit) -> Vec3 {
        let Some(index) = self.patches.at(self.world, self.texels, hit) else { return Vec3::ZERO };
        let patch = &self.patches.list[index as usize];
        if hit.distance * hit.distance > NEAR * NEAR * patch.area {
            return self.bounce.radiance[index as usize];
        }
        let incident = match self.texels.at(hit) {
            Some(texel) if patch.side > 0.0 => self.incident[texel as usize],
            _ => self.bounce.direct[index as usize] + self.bounce.indirect[index as usize],
        };
        let surface = self.world.sources[hit.triangle as usize].surface;
        let emission = if self.is_light[surface as usize] { Vec3::ZERO } else { self.world.emission(hit) };
        emission + incident * self.world.reflectance(hit).min(Vec3::splat(LARGEST_REFLECTANCE))
    }
}

/// For each texel its own direct light and the indirect light of the patches around it, interpolated.
pub(super) fn incident(
    direct: &[Vec3],
    texels: &Texels,
    patches: &Patches,
    bounce: &Bounce,
    workers: &Workers,
    progress: &Progress,
) -> Result<Vec<Vec3>, Cancelled> {
    workers.map(direct.len(), 4096, progress, |range| {
        range.map(|texel| direct[texel] + interpolated(texel, texels, patches, &bounce.indirect)).collect()
    })
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
