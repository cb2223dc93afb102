//! What a bake will need, before it needs it; and in how many parts it must be made to need less.

use alloc::vec::Vec;
use core::iter;
use core::ops::Range;

use super::rays::RayBudget;
use super::{BakeError, BakeSettings, Keep};
use crate::lightmap::{BLOCK, Layout};
use crate::scene::{Receiver, Scene};

/// For each triangle: corners twice, normal, source, corners in the image, and its part of the tree while it is built.
const TRIANGLE: u64 = 420;
/// For each texel of an image that is being worked on: what covers it, its index, the finished lightmap with its states,
/// the texel, direct, incident and gathered light, its patch and the lists that make these.
const TEXEL: u64 = 230;
/// The same where there are several parts, each of which keeps less.
const TEXEL_OF_PART: u64 = 215;
/// For each texel of a finished lightmap.
const FINISHED: u64 = 29;
/// Texels of finished lightmaps that whoever takes them from [`super::bake_into`] may keep.
pub const KEPT_TEXELS: usize = 1 << 22;
/// For each texel of the largest lightmap: copies in other forms.
const COPY: u64 = 24;
/// For each texel while others are worked on: its patch, whether it is valid and which walls part it from others, its
/// direct light and how far that may be off.
const ELSEWHERE: u64 = 12;
/// For each patch: itself, its materials, and lists.
const PATCH: u64 = 190;
/// For each ray of a row of form factors, if all end on patches of their own.
const ENTRY: u64 = 4;
/// For each covered texel of a transport: how it is mixed, its places, and what lamps give it.
const KEPT: u64 = 200;
/// For each ray of a texel, while rows of transport are made one after the other.
const KEPT_ENTRY: u64 = 6;
/// Whatever the scene.
const ALWAYS: u64 = 16 << 20;

/// How a bake fits into the memory that it may use.
pub(super) struct MemoryPlan {
    /// Images that are worked on together.
    pub parts: Vec<Range<usize>>,
    /// Texels along the side of the widest patches.
    pub cell: u32,
    /// An upper estimate of what the bake needs beside the scene, in bytes.
    pub needed: u64,
}

/// What becomes of finished images.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Finished {
    /// They stay until the end.
    Collected,
    /// They are handed over one by one.
    HandedOver,
}

impl MemoryPlan {
    /// In as few parts as possible.
    ///
    /// # Errors
    ///
    /// With the numbers where the least that the bake needs is more than allowed.
    pub fn new(
        scene: &Scene,
        layout: &Layout,
        budget: &RayBudget,
        settings: &BakeSettings,
        finished: Finished,
    ) -> Result<Self, BakeError> {
        let needs = Needs::new(scene, layout, budget, settings, finished);
        let whole = Self { parts: iter::once(0..layout.images.len()).collect(), cell: BLOCK, needed: 0 };
        let whole = Self { needed: needs.of(&whole), ..whole };
        let allowed = settings.memory_bytes;
        if whole.needed <= allowed {
            return Ok(whole);
        }
        let plan = match settings.keep {
            Keep::Lightmaps => {
                let fine = needs.plan(BLOCK, allowed);
                if fine.needed <= allowed || fine.parts.len() == 1 { fine } else { needs.plan(2 * BLOCK, allowed) }
            }
            // It holds all texels at once.
            Keep::Transport => whole,
        };
        if plan.needed > allowed { Err(BakeError::OutOfMemory { needed: plan.needed, allowed }) } else { Ok(plan) }
    }
}

/// What the pieces of a bake need, in bytes.
struct Needs {
    /// Texels of each image.
    images: Vec<u64>,
    /// Triangles, and patches of them with their rows.
    scene: u64,
    /// At least so many patches of texels.
    least_patches: u64,
    /// For each cell that becomes a patch, or one for each side.
    patch: u64,
    /// For each texel whose transport is kept.
    kept: u64,
    finished: Finished,
}

impl Needs {
    fn new(scene: &Scene, layout: &Layout, budget: &RayBudget, settings: &BakeSettings, finished: Finished) -> Self {
        let count = |surface: &crate::scene::Surface| scene.meshes[surface.mesh].triangles.len() as u64;
        let triangles: u64 = scene.surfaces.iter().map(count).sum();
        let without = scene.surfaces.iter().filter(|surface| surface.receiver == Receiver::Nothing);
        let sides = if scene.materials.iter().any(|material| material.double_sided) { 2 } else { 1 };
        let patch = sides * (PATCH + u64::from(budget.row) * ENTRY);
        Self {
            images: layout.images.iter().map(|&[width, height]| u64::from(width) * u64::from(height)).collect(),
            scene: triangles * TRIANGLE + without.map(count).sum::<u64>() * patch + ALWAYS,
            least_patches: budget.patches as u64,
            patch,
            kept: match settings.keep {
                Keep::Lightmaps => 0,
                Keep::Transport => KEPT + u64::from(budget.kept) * KEPT_ENTRY,
            },
            finished,
        }
    }

    /// In as few parts as fit, filled image by image; an image that does not fit is a part of its own.
    fn plan(&self, cell: u32, allowed: u64) -> MemoryPlan {
        let room = allowed.saturating_sub(self.scene + self.patches(cell) + self.beside()) / TEXEL_OF_PART;
        let mut parts: Vec<Range<usize>> = Vec::new();
        for image in 0..self.images.len() {
            match parts.last_mut() {
                Some(part) if self.texels(part.start..image + 1) <= room => part.end = image + 1,
                _ => parts.push(image..image + 1),
            }
        }
        let plan = MemoryPlan { parts, cell, needed: 0 };
        MemoryPlan { needed: self.of(&plan), ..plan }
    }

    /// What a bake by a plan needs.
    fn of(&self, plan: &MemoryPlan) -> u64 {
        let largest = plan.parts.iter().map(|part| self.texels(part.clone())).max().unwrap_or(0);
        let texels = match plan.parts.len() {
            1 => largest * (TEXEL + self.kept),
            _ => largest * TEXEL_OF_PART + self.beside(),
        };
        self.scene + self.patches(plan.cell) + texels
    }

    /// Patches of texels, with their rows: half as many again as there are cells, since charts cut them.
    fn patches(&self, cell: u32) -> u64 {
        let all = self.texels(0..self.images.len());
        let cells = (all / u64::from(cell * cell)).max(self.least_patches).min(all);
        (cells + cells / 2) * self.patch
    }

    /// All texels while a part is worked on, and finished images.
    fn beside(&self) -> u64 {
        let all = self.texels(0..self.images.len());
        let finished = match self.finished {
            Finished::Collected => all * FINISHED,
            Finished::HandedOver => {
                all.min(KEPT_TEXELS as u64) * FINISHED + self.images.iter().copied().max().unwrap_or(0) * COPY
            }
        };
        all * ELSEWHERE + finished
    }

    fn texels(&self, images: Range<usize>) -> u64 {
        self.images[images].iter().sum()
    }
}
