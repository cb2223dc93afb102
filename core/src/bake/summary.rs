//! What was done and how good it is, from what a bake leaves behind.

use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3A;

use super::estimate::Estimate;
use super::{EstimatedError, Report};
use crate::lightmap::{Layout, Nodes, Smooth, Texels};
use crate::scene::World;
use crate::transport::{LARGEST_REFLECTANCE, Lighting, Rows, Solution, Surfaces};

/// Most surfaces that a warning names.
const NAMED: usize = 8;

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
        estimate: &Estimate,
        nodes: &Nodes,
        indirect: &[Smooth],
    ) -> Report {
        let valid_texels = self.valid().count();
        let mut warnings = layout.warnings.clone();
        warnings.extend(self.warnings(lighting, &estimate.light));
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
            estimated_error: EstimatedError {
                rms: estimate.rms,
                noise: estimate.noise,
                bias: self.bias(estimate.mean, indirect),
            },
            warnings,
            ..Report::default()
        }
    }

    fn valid(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.is_valid.len()).filter(|&index| self.is_valid[index])
    }

    /// What texels gathered against what their patches received, over the mean light.
    ///
    /// The patches hold one value for a whole cell, and the texels see them at the last bounce only: an error of the
    /// patches reaches a texel times the reflectance.
    fn bias(&self, mean: f32, indirect: &[Smooth]) -> f32 {
        let difference = |index: usize| {
            // The black reflects nothing.
            let patch = self.surfaces.patch_of[index] as usize;
            let difference = self.solution.received[patch] - Vec3A::from(indirect[index].irradiance);
            f64::from((difference * self.solution.reflectance[patch]).element_sum() / 3.0)
        };
        let count = self.valid().count().max(1) as f64;
        let sum: f64 = self.valid().map(difference).sum();
        if mean > 0.0 { (sum / count / f64::from(mean)) as f32 } else { 0.0 }
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
        warnings.extend(self.hidden());
        let lowered = self.surfaces.count_lowered(lighting);
        if lowered > 0 {
            warnings.push(format!(
                "{lowered} of {} patches reflect more than {LARGEST_REFLECTANCE} and were taken to reflect that; lower the base color of their materials",
                self.surfaces.areas.len(),
            ));
        }
        warnings
    }

    /// A warning that names the surfaces of which charts lie inside geometry with all their texels.
    fn hidden(&self) -> Option<String> {
        let charts = self.texels.list.iter().map(|texel| texel.chart as usize + 1).max()?;
        let (mut is_seen, mut surfaces) = (vec![false; charts], vec![u32::MAX; charts]);
        for (texel, &is_valid) in self.texels.list.iter().zip(self.is_valid) {
            is_seen[texel.chart as usize] |= is_valid;
            surfaces[texel.chart as usize] = self.world.sources[texel.triangle as usize].surface;
        }
        let with_seen = surfaces.into_iter().zip(is_seen);
        let hidden: Vec<u32> = with_seen
            .filter(|&(surface, is_seen)| surface != u32::MAX && !is_seen)
            .map(|(surface, _)| surface)
            .collect();
        let mut named = hidden.clone();
        named.dedup();
        let names = named
            .iter()
            .take(NAMED)
            .map(|&surface| format!("\"{}\"", self.world.scene.surfaces[surface as usize].name));
        let names: Vec<String> = names.collect();
        (!names.is_empty()).then(|| {
            format!(
                "{} charts of {} surfaces ({}{}) lie inside others and took the light beside them in the lightmap; remove what nobody can see",
                hidden.len(),
                named.len(),
                names.join(", "),
                if named.len() > NAMED { ", ..." } else { "" },
            )
        })
    }
}
