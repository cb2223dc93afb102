//! Blocks of texels of one chart: what is found out for many texels at once.

use alloc::vec;
use alloc::vec::Vec;

use super::{BLOCK, Texel, Texels};

/// The covered texels of all images, by blocks and charts.
#[derive(Clone, Debug)]
pub struct Blocks {
    /// The texels, block by block.
    order: Vec<u32>,
    /// Where in that order each block begins, and the end of the last one.
    starts: Vec<u32>,
    /// For each texel its block.
    pub(super) of_texel: Vec<u32>,
}

impl Blocks {
    /// Puts the texels of each block and chart together.
    pub fn new(texels: &Texels) -> Self {
        let mut order: Vec<u32> = (0..texels.list.len() as u32).collect();
        let key = |index: &u32| {
            let Texel { image, pixel, chart, .. } = texels.list[*index as usize];
            (image, pixel.map(|position| position / BLOCK as u16), chart)
        };
        // Texels come block by block already.
        order
            .chunk_by_mut(|a, b| (key(a).0, key(a).1) == (key(b).0, key(b).1))
            .for_each(|block| block.sort_by_key(key));
        let mut blocks = Self { starts: vec![0], of_texel: vec![0; order.len()], order: Vec::new() };
        for (number, block) in order.chunk_by(|a, b| key(a) == key(b)).enumerate() {
            block.iter().for_each(|&index| blocks.of_texel[index as usize] = number as u32);
            blocks.starts.push(blocks.starts[number] + block.len() as u32);
        }
        blocks.order = order;
        blocks
    }

    pub(super) fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The texels of a block, ascending.
    pub(super) fn texels(&self, block: usize) -> &[u32] {
        &self.order[self.starts[block] as usize..self.starts[block + 1] as usize]
    }

    /// What is listed block by block in the order of the texels.
    pub(super) fn scatter<T: Copy + Default>(&self, listed: &[T]) -> Vec<T> {
        let mut scattered = vec![T::default(); listed.len()];
        self.order.iter().zip(listed).for_each(|(&index, value)| scattered[index as usize] = *value);
        scattered
    }
}

/// The bit of a texel in the masks of its block.
pub(super) fn bit(texel: &Texel) -> u64 {
    let [x, y] = texel.pixel.map(|position| u32::from(position) % BLOCK);
    1 << (y * BLOCK + x)
}
