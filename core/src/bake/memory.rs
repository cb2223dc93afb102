//! What a bake will need, before it needs it; and in how many parts it must be made to need less.

use alloc::vec::Vec;
use core::iter;
use core::ops::Range;

use super::rays::RayBudget;
use super::{BakeError, BakeSettings, Keep};
use crate::lightmap::{BLOCK, Layout};
use crate::scene::{Receiver, Scene, Surface};

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
/// Of a ray that goes through colored glass each channel may end elsewhere, and what is absorbed on its way.
const ENDS_OF_COLORED: u64 = 4;
/// For each covered texel of a transport: how it is mixed, and its places.
const KEPT: u64 = 200;
/// For each covered texel of a transport and each lamp: what the lamp gives it, if it shines on all, with the gaps.
const KEPT_LAMP: u64 = 3;
/// The same of an emissive surface, whose colors may differ from place to place.
const KEPT_EMITTER: u64 = 3 * KEPT_LAMP;
/// For each ray of a texel, while rows of transport are made one after the other.
const KEPT_ENTRY: u64 = 6;
/// For each row of contacts, while it stands alone.
const ROW: u64 = 64;
/// Rows are there twice while they are put after each other.
pub(super) const COPIES_OF_ROWS: u64 = 2;
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
    /// What rows of contacts may take beside that, in bytes: what is left, and no more than all texels would take.
    pub room: usize,
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
        let whole = Self { parts: iter::once(0..layout.images.len()).collect(), cell: BLOCK, needed: 0, room: 0 };
        let whole = Self { needed: needs.of(&whole), ..whole };
        let allowed = settings.memory_bytes;
        if whole.needed <= allowed {
            return Ok(needs.with_contacts(whole, allowed, settings.keep));
        }
        let plan = match settings.keep {
            Keep::Lightmaps => {
                let fine = needs.plan(BLOCK, allowed);
                if fine.needed <= allowed || fine.parts.len() == 1 { fine } else { needs.plan(2 * BLOCK, allowed) }
            }
            // It holds all texels at once.
            Keep::Transport => whole,
        };
        if plan.needed > allowed {
            return Err(BakeError::OutOfMemory { needed: plan.needed, allowed });
        }
        Ok(needs.with_contacts(plan, allowed, settings.keep))
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
    /// For each texel that touches something.
    contact: u64,
    finished: Finished,
}

impl Needs {
    fn new(scene: &Scene, layout: &Layout, budget: &RayBudget, settings: &BakeSettings, finished: Finished) -> Self {
        let count = |surface: &Surface| scene.meshes[surface.mesh].triangles.len() as u64;
        let triangles: u64 = scene.surfaces.iter().map(count).sum();
        let without = scene.surfaces.iter().filter(|surface| surface.receiver == Receiver::Nothing);
        let sides = if scene.materials.iter().any(|material| material.double_sided) { 2 } else { 1 };
        let ends = ends_of_ray(scene);
        let patch = sides * (PATCH + u64::from(budget.row) * ENTRY * ends);
        Self {
            images: layout.images.iter().map(|&[width, height]| u64::from(width) * u64::from(height)).collect(),
            scene: triangles * TRIANGLE + without.map(count).sum::<u64>() * patch + ALWAYS,
            least_patches: budget.patches as u64,
            patch,
            kept: match settings.keep {
                Keep::Lightmaps => 0,
                Keep::Transport => KEPT + u64::from(budget.kept) * KEPT_ENTRY * ends + kept_light(scene),
            },
            contact: ROW + u64::from(budget.gather.rays) * ENTRY * ends,
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
        let plan = MemoryPlan { parts, cell, needed: 0, room: 0 };
        MemoryPlan { needed: self.of(&plan), ..plan }
    }

    /// A plan with room for the rows of contacts, as much as is left. A transport has it already: it keeps all rows.
    fn with_contacts(&self, plan: MemoryPlan, allowed: u64, keep: Keep) -> MemoryPlan {
        match keep {
            Keep::Lightmaps => {
                let left = (allowed - plan.needed) / COPIES_OF_ROWS;
                MemoryPlan { room: left.min(self.largest(&plan) * self.contact) as usize, ..plan }
            }
            Keep::Transport => MemoryPlan { room: usize::MAX, ..plan },
        }
    }

    /// Texels of the largest part.
    fn largest(&self, plan: &MemoryPlan) -> u64 {
        plan.parts.iter().map(|part| self.texels(part.clone())).max().unwrap_or(0)
    }

    /// What a bake by a plan needs.
    fn of(&self, plan: &MemoryPlan) -> u64 {
        let largest = self.largest(plan);
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

/// On how many columns a ray may end.
fn ends_of_ray(scene: &Scene) -> u64 {
    let colors = |surface: &Surface| {
        let material = &scene.materials[surface.material];
        material.may_be_mirror() || material.may_filter(!scene.meshes[surface.mesh].colors.is_empty())
    };
    if scene.surfaces.iter().any(colors) { ENDS_OF_COLORED } else { 1 }
}

/// What a transport keeps of the lamps for each texel, in bytes. A mirror may show each of them to each texel, colored.
fn kept_light(scene: &Scene) -> u64 {
    let mirrors = scene.surfaces.iter().any(|surface| scene.materials[surface.material].may_be_mirror());
    let lists = if mirrors { 1 + 3 } else { 1 };
    let emits = |surface: &&Surface| surface.casts && scene.materials[surface.material].is_emissive();
    let emitters = scene.surfaces.iter().filter(emits).count() as u64;
    lists * (scene.lights.len() as u64 * KEPT_LAMP + emitters * KEPT_EMITTER)
}

#[cfg(test)]
mod tests {
    use alloc::vec;

    use glam::Vec3;

    use super::*;
    use crate::bake::Quality;
    use crate::light::{DirectionalLight, Light, LightSource};
    use crate::scene::cornell_box;

    const GIB: u64 = 1 << 30;

    fn planned(
        scene: &Scene,
        images: Vec<[u32; 2]>,
        settings: &BakeSettings,
        finished: Finished,
    ) -> Result<MemoryPlan, BakeError> {
        let layout = Layout { images, ..Layout::default() };
        MemoryPlan::new(scene, &layout, &RayBudget::new(settings), settings, finished)
    }

    /// Sixteen of the largest images fit into 8 GiB part by part, if somebody takes them; the rows of high quality need
    /// one more.
    #[test]
    fn sixteen_large_images_in_eight_gibibytes() {
        for (quality, gibibytes) in [(Quality::Draft, 8), (Quality::Medium, 8), (Quality::High, 9)] {
            let settings = BakeSettings { quality, memory_bytes: gibibytes * GIB, ..Default::default() };
            let plan = planned(&cornell_box(), vec![[4096; 2]; 16], &settings, Finished::HandedOver).expect("it fits");
            assert!(
                plan.needed <= gibibytes * GIB && plan.parts.len() > 1,
                "{} in {} parts",
                plan.needed,
                plan.parts.len()
            );
            assert_eq!(plan.parts.iter().cloned().flatten().collect::<Vec<_>>(), (0..16).collect::<Vec<_>>());
        }
    }

    /// Finished images alone are more than that.
    #[test]
    fn what_is_kept_counts() {
        let settings = BakeSettings { memory_bytes: 8 * GIB, ..Default::default() };
        let refused = planned(&cornell_box(), vec![[4096; 2]; 16], &settings, Finished::Collected).err();
        let Some(BakeError::OutOfMemory { needed, allowed }) = refused else { panic!("{refused:?}") };
        let texels = 16 * 4096 * 4096;
        assert!(allowed == 8 * GIB && needed > texels * (FINISHED + ELSEWHERE));
    }

    /// With less memory there are no fewer parts, none needs more than is allowed, and what needs too much is refused.
    #[test]
    fn less_memory_is_more_parts() {
        let images: Vec<[u32; 2]> = (1..9).map(|k| [256 * k, 1024]).collect();
        let (mut last, mut refused) = (1, false);
        for mebibytes in (0..2048).rev().step_by(16) {
            let settings = BakeSettings { memory_bytes: mebibytes << 20, ..Default::default() };
            match planned(&cornell_box(), images.clone(), &settings, Finished::HandedOver) {
                Ok(plan) => {
                    assert!(!refused && plan.needed <= mebibytes << 20);
                    // Wider patches leave more memory to texels.
                    assert!(plan.parts.len() >= last || plan.cell > BLOCK);
                    last = plan.parts.len();
                }
                Err(_) => refused = true,
            }
        }
        assert!(refused && last > 1);
    }

    /// A transport keeps a row for each texel, and a list for each lamp.
    #[test]
    fn a_transport_counts_lamps_and_rows() {
        let mut scene = cornell_box();
        let needed = |scene: &Scene, quality| {
            let settings = BakeSettings { quality, keep: Keep::Transport, ..Default::default() };
            planned(scene, vec![[1024; 2]], &settings, Finished::Collected).expect("no limit").needed
        };
        let [draft, high] = [Quality::Draft, Quality::High].map(|quality| needed(&scene, quality));
        assert!(high - draft >= 4 * (1 << 20) * (512 - 32));
        let (direction, illuminance) = (Vec3::NEG_Y, Vec3::ONE);
        let sun = LightSource::Directional(DirectionalLight { direction, illuminance, angular_diameter: 0.0 });
        scene.lights.extend(vec![Light { name: "sun".into(), source: sun }; 100]);
        assert!(needed(&scene, Quality::Draft) - draft >= 2 * 100 * (1 << 20));
    }
}
