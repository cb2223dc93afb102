//! The texels of a bake part by part: those of one part are here at a time, the others are made again when needed.

use alloc::vec::Vec;
use core::ops::Range;

use super::pieces::Pieces;
use crate::geometry::Occluders;
use crate::lightmap::{Layout, Links, Patches, Texel, Texels, check};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::transport::Tracer;

/// The images of a bake in groups, the parts; all texels of one of them; all patches.
pub(super) struct Parts<'a, O> {
    pub tracer: &'a Tracer<'a, O>,
    pub layout: &'a Layout,
    pub workers: &'a Workers,
    pub progress: &'a Progress,
    /// Of the rows of form factors.
    pub seed: u32,
    /// The images of each part.
    pub images: Vec<Range<usize>>,
    /// Texels along the side of the widest patches.
    cell: u32,
    records: Vec<Record>,
    /// The part that is here.
    number: usize,
    /// Its texels.
    pub texels: Texels,
    /// For each of them whether it is valid.
    pub is_valid: Vec<bool>,
    /// The patches of all parts.
    pub patches: Patches,
}

/// What is known of a part whose texels are not here.
#[derive(Default)]
struct Record {
    patches: Range<usize>,
    /// A bit for each texel.
    is_valid: Vec<u8>,
    /// Texels that the check has moved.
    moved: Vec<(u32, Texel)>,
    links: Links,
}

impl Record {
    /// Of texels that are here, with what they were before the check.
    fn new(patches: Range<usize>, before: &[Texel], texels: &Texels, is_valid: &[bool]) -> Self {
        let moved = before.iter().zip(&texels.list).enumerate().filter(|(_, (before, after))| before != after);
        let bits = |eight: &[bool]| eight.iter().enumerate().map(|(k, &bit)| u8::from(bit) << k).sum();
        Self {
            patches,
            is_valid: is_valid.chunks(8).map(bits).collect(),
            moved: moved.map(|(index, (_, after))| (index as u32, *after)).collect(),
            links: texels.links.clone(),
        }
    }
}

impl<'a, O: Occluders> Parts<'a, O> {
    /// Makes the texels of all parts, finds out which are valid, and cuts all surfaces into at least `wanted` patches;
    /// the last part is here then.
    pub fn new(
        (images, cell): (Vec<Range<usize>>, u32),
        tracer: &'a Tracer<'a, O>,
        layout: &'a Layout,
        wanted: usize,
        seeds: [u32; 2],
        workers: &'a Workers,
        progress: &'a Progress,
    ) -> Result<Self, Cancelled> {
        let patches = Patches::new(tracer.world, layout.images.len());
        let [seed_of_check, seed] = seeds;
        let (number, texels, is_valid, records) = Default::default();
        let mut parts =
            Self { tracer, layout, workers, progress, seed, images, cell, records, number, texels, is_valid, patches };
        for number in 0..parts.len() {
            progress.enter_group(number, parts.len());
            parts.add(number, wanted, seed_of_check)?;
        }
        let size = parts.patches.cell as f32 / layout.texels_per_meter;
        let clusters = parts.patches.add_triangles(tracer.world, &parts.texels, size);
        parts.records[parts.number].patches.end = clusters.end;
        Ok(parts)
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.images.len()
    }

    /// Brings the texels of a part here; those of the one that was are gone.
    pub fn turn_to(&mut self, number: usize) -> Result<(), Cancelled> {
        if number == self.number {
            return Ok(());
        }
        // The memory of the old ones first.
        self.texels = Texels::default();
        let Record { patches, is_valid, moved, links } = &self.records[number];
        self.texels = Texels::new(self.tracer.world, self.layout, self.images[number].clone(), self.progress)?;
        moved.iter().for_each(|&(index, texel)| self.texels.list[index as usize] = texel);
        self.texels.links = links.clone();
        self.is_valid = (0..self.texels.list.len()).map(|k| is_valid[k / 8] >> (k % 8) & 1 == 1).collect();
        self.patches.turn_to(&self.texels, patches.clone());
        self.number = number;
        Ok(())
    }

    /// What is here.
    pub fn pieces(&self) -> Pieces<'_, O> {
        let Self { tracer, workers, progress, seed, texels, patches, .. } = self;
        Pieces { tracer, texels, patches, own: self.own(), workers, progress, seed: *seed }
    }

    /// The patches of the part that is here.
    pub fn own(&self) -> Range<usize> {
        self.records[self.number].patches.clone()
    }

    fn add(&mut self, number: usize, wanted: usize, seed: u32) -> Result<(), Cancelled> {
        self.texels = Texels::default();
        let (world, images) = (self.tracer.world, self.images[number].clone());
        self.texels = Texels::new(world, self.layout, images.clone(), self.progress)?;
        let before = if self.len() > 1 { self.texels.list.clone() } else { Vec::new() };
        self.is_valid = check(&mut self.texels, self.tracer, self.workers, seed, self.progress)?;
        let wanted = self.share_of(wanted, images);
        let patches = self.patches.add_texels(world, &self.texels, &self.is_valid, self.cell, wanted);
        self.records.push(match self.len() {
            1 => Record { patches, ..Record::default() },
            _ => Record::new(patches, &before, &self.texels, &self.is_valid),
        });
        self.number = number;
        Ok(())
    }

    /// The share of a number that falls to some images by their texels.
    fn share_of(&self, number: usize, images: Range<usize>) -> usize {
        let texels =
            |images: &[[u32; 2]]| images.iter().map(|[width, height]| (width * height) as usize).sum::<usize>();
        (number * texels(&self.layout.images[images])).div_ceil(texels(&self.layout.images).max(1))
    }
}
