//! What was done and how good it is, from what a bake leaves behind.

use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3A;

use super::estimate::{Estimate, warning};
use super::{BakeSettings, EstimatedError, Report};
use crate::lightmap::{Layout, SeamReport, SeamTexel, Smooth, Texels};
use crate::math;
use crate::scene::World;
use crate::transport::{LARGEST_REFLECTANCE, Rows, Solution, Surfaces};

/// Most surfaces that a warning names.
const NAMED: usize = 8;

/// What a part of a bake leaves behind. Lists of texels have one entry for each covered texel; light is irradiance / pi.
pub(super) struct Done<'a> {
    pub world: &'a World<'a>,
    pub texels: &'a Texels,
    pub is_valid: &'a [bool],
    pub surfaces: &'a Surfaces,
    pub solution: &'a Solution,
}

/// What the parts of a bake say together.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    pub valid_texels: usize,
    pub invalid_texels: usize,
    pub nodes: usize,
    /// The most that rows of nodes took in a part, in bytes.
    pub row_bytes: usize,
    /// Patches that would reflect more than anything real does.
    pub lowered: usize,
    /// Surfaces of charts that lie inside geometry, one for each chart.
    pub hidden: Vec<u32>,
    /// Light of all valid texels, mean over the channels.
    pub light: f64,
    pub error: EstimatedError,
    pub seams: SeamReport,
    pub seam_texels: Vec<SeamTexel>,
    /// Points of seams between images of different parts.
    pub split_seams: usize,
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
        self.error = EstimatedError {
            rms: mean_root([self.error.rms, part.error.rms], by_texels),
            noise: mean_root([self.error.noise, part.error.noise], by_texels),
            bias: mix([self.error.bias, part.error.bias], share(self.light, part.light)),
        };
        let by_pairs = share(self.seams.pairs as f64, part.seams.pairs as f64);
        self.seams = SeamReport {
            pairs: self.seams.pairs + part.seams.pairs,
            step_before: mean_root([self.seams.step_before, part.seams.step_before], by_pairs),
            step_after: mean_root([self.seams.step_after, part.seams.step_after], by_pairs),
            largest_before: self.seams.largest_before.max(part.seams.largest_before),
            largest_after: self.seams.largest_after.max(part.seams.largest_after),
        };
        self.valid_texels += part.valid_texels;
        self.invalid_texels += part.invalid_texels;
        self.hidden.extend(&part.hidden);
        self.seam_texels.extend(&part.seam_texels);
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

/// The mean of two numbers, of which the second has this share.
fn mix([own, other]: [f32; 2], share: f32) -> f32 {
    own * (1.0 - share) + other * share
}

/// The root of the mean of two squares, of which the second has this share.
fn mean_root(roots: [f32; 2], share: f32) -> f32 {
    math::sqrt(mix(roots.map(|root| root * root), share))
}

impl Done<'_> {
    /// What this part says, beside its nodes and its patches.
    pub fn tally(&self, estimate: &Estimate, indirect: &[Smooth]) -> Tally {
        let valid_texels = self.valid().count();
        Tally {
            valid_texels,
            invalid_texels: self.is_valid.len() - valid_texels,
            hidden: self.hidden(),
            light: valid_texels as f64 * f64::from(estimate.mean),
            error: EstimatedError {
                rms: estimate.rms,
                noise: estimate.noise,
                bias: self.bias(estimate.mean, indirect),
            },
            ..Tally::default()
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

    /// The surfaces of charts that lie inside geometry with all their texels, one for each chart.
    fn hidden(&self) -> Vec<u32> {
        let Some(charts) = self.texels.list.iter().map(|texel| texel.chart as usize + 1).max() else {
            return Vec::new();
        };
        let (mut is_seen, mut surfaces) = (vec![false; charts], vec![u32::MAX; charts]);
        for (texel, &is_valid) in self.texels.list.iter().zip(self.is_valid) {
            is_seen[texel.chart as usize] |= is_valid;
            surfaces[texel.chart as usize] = self.world.sources[texel.triangle as usize].surface;
        }
        let with_seen = surfaces.into_iter().zip(is_seen);
        with_seen.filter(|&(surface, is_seen)| surface != u32::MAX && !is_seen).map(|(surface, _)| surface).collect()
    }
}

/// What the user should know about the scene and how it was baked.
pub(super) fn warnings(
    world: &World,
    layout: &Layout,
    tally: &Tally,
    [patches, parts, cell]: [usize; 3],
    settings: &BakeSettings,
) -> Vec<String> {
    let mut warnings = layout.warnings.clone();
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
    warnings.extend(hidden(world, &tally.hidden));
    let lowered = tally.lowered;
    if lowered > 0 {
        warnings.push(format!(
            "{lowered} of {patches} patches reflect more than {LARGEST_REFLECTANCE} and were taken to reflect that; lower the base color of their materials",
        ));
    }
    warnings.extend(warning(&tally.error, settings, layout.texels_per_meter));
    if parts > 1 {
        warnings.push(format!(
            "the images did not fit into the memory together and were baked in {parts} parts: where surfaces in different parts lie close together, their light on each other is as coarse as patches of {cell} x {cell} texels; allow more memory to bake them at once"
        ));
    }
    let (split, all) = (tally.split_seams, tally.split_seams + tally.seams.pairs);
    if split > 0 {
        warnings.push(format!(
            "{split} of {all} points at which seams are seen lie between images of different parts, where their two sides were not made to agree; allow more memory to bake them at once"
        ));
    }
    warnings
}

/// A warning that names the surfaces of which charts lie inside geometry.
fn hidden(world: &World, charts: &[u32]) -> Option<String> {
    let mut named = charts.to_vec();
    named.sort_unstable();
    named.dedup();
    let name = |&surface: &u32| format!("\"{}\"", world.scene.surfaces[surface as usize].name);
    let names: Vec<String> = named.iter().take(NAMED).map(name).collect();
    (!names.is_empty()).then(|| {
        format!(
            "{} charts of {} surfaces ({}{}) lie inside others and took the light beside them in the lightmap; remove what nobody can see",
            charts.len(),
            named.len(),
            names.join(", "),
            if named.len() > NAMED { ", ..." } else { "" },
        )
    })
}
