//! What a bake will need, before it needs it; and in how many parts it must be made to need less.

use alloc::vec::Vec;
use core::iter;
use core::ops::Range;

use super::rays::RayBudget;
use super::{BakeError, BakeSettings, Keep};
use crate::lightmap::Layout;
use crate::scene::{Receiver, Scene};

/// For each triangle: corners twice, normal, source, corners in the image, and its part of the tree while it is built.
const TRIANGLE: u64 = 420;
/// For each texel of an image that is being worked on: what covers it, its index, the finished lightmap with its states,
/// the texel, direct, incident and gathered light, its patch and the lists that make these.
const TEXEL: u64 = 259;
/// For each texel of a finished lightmap.
const FINISHED: u64 = 29;
/// For each texel while others are worked on: its patch, whether it is valid and which walls part it from others, its
/// direct light and how far that may be off.
const ELSEWHERE: u64 = 16;
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
        let (allowed, count) = (settings.memory_bytes, layout.images.len());
        let whole: Vec<Range<usize>> = iter::once(0..count).collect();
        let needed = needs.of(&whole);
        if needed <= allowed {
            return Ok(Self { parts: whole, needed });
        }
        let parts = match settings.keep {
            Keep::Lightmaps => needs.parts(allowed),
            // It holds all texels at once.
            Keep::Transport => whole,
        };
        let needed = needs.of(&parts);
        if needed > allowed { Err(BakeError::OutOfMemory { needed, allowed }) } else { Ok(Self { parts, needed }) }
    }
}

/// What the pieces of a bake need, in bytes.
struct Needs {
    /// Texels of each image.
    images: Vec<u64>,
    /// Triangles, patches and their rows.
    scene: u64,
    /// For each texel that is worked on.
    texel: u64,
    /// For each texel of a finished image that stays.
    finished: u64,
}

impl Needs {
    fn new(scene: &Scene, layout: &Layout, budget: &RayBudget, settings: &BakeSettings, finished: Finished) -> Self {
        let count = |surface: &crate::scene::Surface| scene.meshes[surface.mesh].triangles.len() as u64;
        let triangles: u64 = scene.surfaces.iter().map(count).sum();
        let without = scene.surfaces.iter().filter(|surface| surface.receiver == Receiver::Nothing);
        let images: Vec<u64> =
            layout.images.iter().map(|&[width, height]| u64::from(width) * u64::from(height)).collect();
        let texels: u64 = images.iter().sum();
        let patches = (texels / 64).max(budget.patches as u64).min(texels) * 2 + without.map(count).sum::<u64>();
        let kept = match settings.keep {
            Keep::Lightmaps => 0,
            Keep::Transport => KEPT + u64::from(budget.kept) * KEPT_ENTRY,
        };
        Self {
            images,
            scene: triangles * TRIANGLE + patches * (PATCH + u64::from(budget.row) * ENTRY) + ALWAYS,
            texel: TEXEL + kept,
            finished: match finished {
                Finished::Collected => FINISHED,
                Finished::HandedOver => 0,
            },
        }
    }

    /// What a bake in such parts needs.
    fn of(&self, parts: &[Range<usize>]) -> u64 {
        let of_part = |part: &Range<usize>| self.texels(part.clone()) * self.texel;
        let (all, largest) = (self.texels(0..self.images.len()), parts.iter().map(of_part).max());
        let elsewhere = if parts.len() > 1 { all * (ELSEWHERE + self.finished) } else { 0 };
        self.scene + largest.unwrap_or(0) + elsewhere
    }

    /// As few parts as fit, filled image by image; an image that does not fit is a part of its own.
    fn parts(&self, allowed: u64) -> Vec<Range<usize>> {
        let all = self.texels(0..self.images.len());
        let room = allowed.saturating_sub(self.scene + all * (ELSEWHERE + self.finished)) / self.texel;
        let mut parts: Vec<Range<usize>> = Vec::new();
        for image in 0..self.images.len() {
            match parts.last_mut() {
                Some(part) if self.texels(part.start..image + 1) <= room => part.end = image + 1,
                _ => parts.push(image..image + 1),
            }
        }
        parts
    }

    fn texels(&self, images: Range<usize>) -> u64 {
        self.images[images].iter().sum()
    }
}
