//! What was done and how good it is, from what a bake leaves behind.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use glam::{Vec3, Vec3A};

use super::{EstimatedError, Report};
use crate::lightmap::{DirectError, Layout, Nodes, Smooth, Texel, Texels};
use crate::math;
use crate::scene::World;
use crate::transport::{LARGEST_REFLECTANCE, Lighting, Rows, Solution, Surfaces};

/// What a bake leaves behind. Lists of texels have one entry for each covered texel; light is irradiance / pi.
pub(super) struct Done<'a> {
    pub world: &'a World<'a>,
    pub texels: &'a Texels,
    pub is_valid: &'a [bool],
    pub surfaces: &'a Surfaces,
    pub solution: &'a Solution,
    pub rows: &'a Rows,
}

impl Done<'_> {
    /// All that these say.
    pub fn report(
        &self,
        layout: &Layout,
        lighting: &Lighting,
        (direct, direct_errors): (&[Vec3A], &[DirectError]),
        nodes: &Nodes,
        indirect: &[Smooth],
    ) -> Report {
        let valid_texels = self.valid().count();
        let lights = direct.iter().zip(indirect);
        let total: Vec<f32> =
            lights.map(|(direct, indirect)| (Vec3::from(*direct) + indirect.irradiance).element_sum() / 3.0).collect();
        let mut warnings = layout.warnings.clone();
        warnings.extend(self.warnings(lighting, &total));
        Report {
            triangles: self.world.blockers,
            surfaces: layout.placements.iter().flatten().count(),
            valid_texels,
            invalid_texels: self.is_valid.len() - valid_texels,
            patches: self.surfaces.areas.len(),
            nodes: nodes.gathered.iter().filter(|node| node.rays > 0).count(),
            texels_per_meter: layout.texels_per_meter,
            closure_error: self.rows.closure_error(),
            energy_balance: self.solution.energy_balance(self.surfaces, self.rows),
            estimated_error: self.estimated_error(&total, direct_errors, indirect),
            warnings,
            ..Report::default()
        }
    }

    fn valid(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.is_valid.len()).filter(|&index| self.is_valid[index])
    }

    /// Noise from the two halves of the rays and of penumbrae, and what lies between texels; bias from what texels gathered against what
    /// their patches received.
    ///
    /// Between two texels of a step a lightmap is a ramp: its mean square error is 1/12 of the step squared, which is
    /// 1/24 of the squared second differences of both texels. The patches hold one value for a whole cell, and the
    /// texels see them at the last bounce only: an error of the patches reaches a texel times the reflectance.
    fn estimated_error(&self, total: &[f32], direct: &[DirectError], indirect: &[Smooth]) -> EstimatedError {
        let count = self.valid().count().max(1) as f64;
        let mean = self.valid().map(|index| f64::from(total[index])).sum::<f64>() / count;
        if mean <= 0.0 {
            return EstimatedError::default();
        }
        let relative = |index: usize| {
            let scale = f64::from(total[index]) + 0.1 * mean;
            let between = f64::from(self.squared_second_differences(index, total)) / 24.0;
            (f64::from(indirect[index].variance + direct[index].noise) + between) / (scale * scale)
        };
        let difference = |index: usize| {
            // The black reflects nothing.
            let patch = self.surfaces.patch_of[index] as usize;
            let difference = self.solution.received[patch] - Vec3A::from(indirect[index].irradiance);
            f64::from((difference * self.solution.reflectance[patch]).element_sum() / 3.0)
        };
        EstimatedError {
            rms: math::sqrt((self.valid().map(relative).sum::<f64>() / count) as f32),
            bias: (self.valid().map(difference).sum::<f64>() / count / mean) as f32,
        }
    }

    /// The sum over rows and columns of the squared second difference at a texel, within its chart.
    fn squared_second_differences(&self, index: usize, total: &[f32]) -> f32 {
        let Texel { pixel: [x, y], image, chart, .. } = self.texels.list[index];
        let at = |dx: i32, dy: i32| {
            let other = self.texels.at_pixel(u32::from(image), i32::from(x) + dx, i32::from(y) + dy)? as usize;
            (self.is_valid[other] && self.texels.list[other].chart == chart).then(|| total[other])
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
    fn warnings(&self, lighting: &Lighting, total: &[f32]) -> Vec<String> {
        let mut warnings = Vec::new();
        for broken in self.world.not_finite.chunk_by(|a, b| a.surface == b.surface) {
            warnings.push(format!(
                "{} triangles of \"{}\" have a corner that is not finite (NaN or infinite) and were left out; mend its mesh",
                broken.len(),
                self.world.scene.surfaces[broken[0].surface as usize].name
            ));
        }
        if total.iter().all(|&light| light == 0.0) {
            warnings.push(String::from("every texel is black: no light reaches a surface with a lightmap"));
        }
        let lowered = self.surfaces.count_lowered(lighting);
        if lowered > 0 {
            warnings.push(format!(
                "{lowered} of {} patches reflect more than {LARGEST_REFLECTANCE} and were taken to reflect that; lower the base color of their materials",
                self.surfaces.areas.len(),
            ));
        }
        warnings
    }
}
