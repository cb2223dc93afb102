//! What was done and how good it is, from what a bake leaves behind.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use glam::{Vec3, Vec3A};

use super::{EstimatedError, Report};
use crate::lightmap::{Nodes, Smooth, Texel, Texels};
use crate::math;
use crate::scene::World;
use crate::transport::{LARGEST_REFLECTANCE, Lighting, Rows, Solution, Surfaces};

/// What a part of a bake leaves behind. Lists of texels have one entry for each covered texel; light is irradiance / pi.
pub(super) struct Done<'a> {
    pub texels: &'a Texels,
    pub is_valid: &'a [bool],
    pub surfaces: &'a Surfaces,
    pub solution: &'a Solution,
}

/// What the parts of a bake say together.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
    pub valid_texels: usize,
    pub invalid_texels: usize,
    pub nodes: usize,
    /// Patches that would reflect more than anything real does.
    pub lowered: usize,
    /// Light of all valid texels, mean over the channels.
    pub light: f64,
    pub error: EstimatedError,
    pub closure_error: f32,
    pub energy_balance: f32,
}

impl Tally {
    /// Of no part yet; what the rows and the solution say of the whole bake.
    pub fn new(rows: &Rows, energy_balance: f32) -> Self {
        Self { closure_error: rows.closure_error(), energy_balance, ..Self::default() }
    }

    /// Takes in what another part says: errors by texels and by light.
    pub fn add(&mut self, part: &Self) {
        let share = |own: f64, other: f64| if other > 0.0 { (other / (own + other)) as f32 } else { 0.0 };
        let by_texels = share(self.valid_texels as f64, part.valid_texels as f64);
        let squares = [self.error.rms, part.error.rms].map(|rms| rms * rms);
        let mix = |[own, other]: [f32; 2], share: f32| own * (1.0 - share) + other * share;
        self.error = EstimatedError {
            rms: math::sqrt(mix(squares, by_texels)),
            bias: mix([self.error.bias, part.error.bias], share(self.light, part.light)),
        };
        self.valid_texels += part.valid_texels;
        self.invalid_texels += part.invalid_texels;
        self.nodes += part.nodes;
        self.lowered += part.lowered;
        self.light += part.light;
    }

    /// The lines of the report that are known here.
    pub fn report(&self) -> Report {
        Report {
            valid_texels: self.valid_texels,
            invalid_texels: self.invalid_texels,
            nodes: self.nodes,
            closure_error: self.closure_error,
            energy_balance: self.energy_balance,
            estimated_error: self.error,
            ..Report::default()
        }
    }
}

impl Done<'_> {
    /// What this part says.
    pub fn tally(&self, lighting: &Lighting, direct: &[Vec3A], nodes: &Nodes, indirect: &[Smooth]) -> Tally {
        let valid_texels = self.valid().count();
        let lights = direct.iter().zip(indirect);
        let total: Vec<f32> =
            lights.map(|(direct, indirect)| (Vec3::from(*direct) + indirect.irradiance).element_sum() / 3.0).collect();
        Tally {
            valid_texels,
            invalid_texels: self.is_valid.len() - valid_texels,
            nodes: nodes.gathered.iter().filter(|node| node.rays > 0).count(),
            lowered: self.surfaces.count_lowered(lighting),
            light: self.valid().map(|index| f64::from(total[index])).sum(),
            error: self.estimated_error(&total, indirect),
            ..Tally::default()
        }
    }

    fn valid(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.is_valid.len()).filter(|&index| self.is_valid[index])
    }

    /// Noise from the two halves of the rays, and what lies between texels; bias from what texels gathered against what
    /// their patches received.
    ///
    /// Between two texels of a step a lightmap is a ramp: its mean square error is 1/12 of the step squared, which is
    /// 1/24 of the squared second differences of both texels. The patches hold one value for a whole cell, and the
    /// texels see them at the last bounce only: an error of the patches reaches a texel times the reflectance.
    fn estimated_error(&self, total: &[f32], indirect: &[Smooth]) -> EstimatedError {
        let count = self.valid().count().max(1) as f64;
        let mean = self.valid().map(|index| f64::from(total[index])).sum::<f64>() / count;
        if mean <= 0.0 {
            return EstimatedError::default();
        }
        let relative = |index: usize| {
            let scale = f64::from(total[index]) + 0.1 * mean;
            let between = f64::from(self.squared_second_differences(index, total)) / 24.0;
            (f64::from(indirect[index].variance) + between) / (scale * scale)
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
}

/// What the user should know about the scene and how it was baked.
pub(super) fn warnings(world: &World, tally: &Tally, patches: usize, parts: usize) -> Vec<String> {
    let mut warnings = Vec::new();
    for broken in world.not_finite.chunk_by(|a, b| a.surface == b.surface) {
        warnings.push(format!(
            "{} triangles of \"{}\" have a corner that is not finite (NaN or infinite) and were left out; mend its mesh",
            broken.len(),
            world.scene.surfaces[broken[0].surface as usize].name
        ));
    }
    if tally.light == 0.0 {
        warnings.push(String::from("every texel is black: no light reaches a surface with a lightmap"));
    }
    let lowered = tally.lowered;
    if lowered > 0 {
        warnings.push(format!(
            "{lowered} of {patches} patches reflect more than {LARGEST_REFLECTANCE} and were taken to reflect that; lower the base color of their materials",
        ));
    }
    if parts > 1 {
        warnings.push(format!(
            "the images did not fit into the memory together and were baked in {parts} parts: where surfaces in different parts lie close together, their light on each other is as coarse as patches of 8 x 8 texels; allow more memory to bake them at once"
        ));
    }
    warnings
}
