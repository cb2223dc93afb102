//! What was done and how good it is, from what a bake leaves behind.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use glam::Vec3;

use super::bounce::LARGEST_REFLECTANCE;
use super::field::Field;
use super::{EstimatedError, Report};
use crate::lightmap::{Layout, NONE, Smooth, Texel};
use crate::math;
use crate::transport::Rows;

/// What a bake leaves behind. Lists of texels have one entry for each covered texel; light is irradiance / pi.
pub(super) struct Done<'a> {
    pub field: &'a Field<'a>,
    pub is_valid: &'a [bool],
    pub rows: &'a Rows,
    pub direct: &'a [Vec3],
    pub indirect: &'a [Smooth],
}

impl Done<'_> {
    /// All that these say.
    pub fn report(&self, layout: &Layout) -> Report {
        let valid_texels = self.valid().count();
        let mut warnings = layout.warnings.clone();
        warnings.extend(self.warnings());
        Report {
            triangles: self.field.world.blockers,
            surfaces: layout.placements.iter().flatten().count(),
            valid_texels,
            invalid_texels: self.is_valid.len() - valid_texels,
            patches: self.field.patches.list.len(),
            texels_per_meter: layout.texels_per_meter,
            closure_error: self.rows.closure_error(),
            energy_balance: self.field.bounce.energy_balance(self.field.patches, self.rows, self.field.world.scene.sky),
            estimated_error: self.estimated_error(),
            warnings,
            ..Report::default()
        }
    }

    fn valid(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.is_valid.len()).filter(|&index| self.is_valid[index])
    }

    /// All light of each texel, mean of the channels.
    fn total(&self) -> impl Iterator<Item = f32> + '_ {
        self.direct
            .iter()
            .zip(self.indirect)
            .map(|(direct, indirect)| (*direct + indirect.irradiance).element_sum() / 3.0)
    }

    /// Noise from the two halves of the rays, and what lies between texels; bias from what texels gathered against what
    /// their patches received.
    ///
    /// Between two texels of a step a lightmap is a ramp: its mean square error is 1/12 of the step squared, which is
    /// 1/24 of the squared second differences of both texels. The patches hold one value for a whole cell, and the
    /// texels see them at the last bounce only: an error of the patches reaches a texel times the reflectance.
    fn estimated_error(&self) -> EstimatedError {
        let level = |value: Vec3| f64::from(value.element_sum() / 3.0);
        let total: Vec<f32> = self.total().collect();
        let count = self.valid().count().max(1) as f64;
        let mean = self.valid().map(|index| f64::from(total[index])).sum::<f64>() / count;
        if mean <= 0.0 {
            return EstimatedError::default();
        }
        let relative = |index: usize| {
            let scale = f64::from(total[index]) + 0.1 * mean;
            let between = f64::from(self.squared_second_differences(index, &total)) / 24.0;
            (f64::from(self.indirect[index].variance) + between) / (scale * scale)
        };
        let difference = |index: usize| match self.field.patches.of_texel[index] {
            NONE => 0.0,
            patch => {
                let patch = patch as usize;
                let difference = self.field.bounce.indirect[patch] - self.indirect[index].irradiance;
                level(difference * self.field.bounce.reflectance[patch])
            }
        };
        EstimatedError {
            rms: math::sqrt((self.valid().map(relative).sum::<f64>() / count) as f32),
            bias: (self.valid().map(difference).sum::<f64>() / count / mean) as f32,
        }
    }

    /// The sum over rows and columns of the squared second difference at a texel, within its chart.
    fn squared_second_differences(&self, index: usize, total: &[f32]) -> f32 {
        let Texel { pixel: [x, y], image, chart, .. } = self.field.texels.list[index];
        let at = |dx: i32, dy: i32| {
            let other = self.field.texels.at_pixel(u32::from(image), i32::from(x) + dx, i32::from(y) + dy)? as usize;
            (self.is_valid[other] && self.field.texels.list[other].chart == chart).then(|| total[other])
        };
        let squared = |before: Option<f32>, after: Option<f32>| match (before, after) {
            (Some(before), Some(after)) => {
                (before + after - 2.0 * total[index]) * (before + after - 2.0 * total[index])
            }
            _ => 0.0,
        };
        squared(at(-1, 0), at(1, 0)) + squared(at(0, -1), at(0, 1))
    }

    /// What the user should know about the scene.
    fn warnings(&self) -> Vec<String> {
        let (world, bounce) = (self.field.world, self.field.bounce);
        let mut warnings = Vec::new();
        for broken in world.not_finite.chunk_by(|a, b| a.surface == b.surface) {
            warnings.push(format!(
                "{} triangles of \"{}\" have a corner that is not finite (NaN or infinite) and were left out; mend its mesh",
                broken.len(),
                world.scene.surfaces[broken[0].surface as usize].name
            ));
        }
        if self.total().all(|light| light == 0.0) {
            warnings.push(String::from("every texel is black: no light reaches a surface with a lightmap"));
        }
        if bounce.lowered > 0 {
            warnings.push(format!(
            "{} of {} patches reflect more than {} and were taken to reflect that; lower the base color of their materials",
            bounce.lowered,
            bounce.reflectance.len(),
            LARGEST_REFLECTANCE
        ));
        }
        warnings
    }
}
