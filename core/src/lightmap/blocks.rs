//! Blocks of texels with their neighbors: what is found out for all texels of a block at once.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use super::{BLOCK, NONE, Texel, Texels};

/// The covered texels of all images, block by block.
pub(super) struct Blocks {
    /// The texels of each block, as a range of the list of texels.
    pub list: Vec<Range<u32>>,
    /// For each image and each of its blocks, row by row, the index of the block, or [`NONE`].
    grids: Vec<Vec<u32>>,
    /// For each image the blocks in a row.
    widths: Vec<u32>,
}

impl Blocks {
    pub fn new(texels: &Texels) -> Self {
        let sizes = || texels.sizes.iter().map(|size| size.map(|side| side.div_ceil(BLOCK)));
        let mut blocks = Self {
            list: Vec::new(),
            grids: sizes().map(|[width, height]| vec![NONE; (width * height) as usize]).collect(),
            widths: sizes().map(|[width, _]| width).collect(),
        };
        let mut start = 0;
        for group in texels.list.chunk_by(|a, b| block_of(a) == block_of(b)) {
            let (image, at) = (usize::from(group[0].image), blocks.place(&group[0]));
            blocks.grids[image][at] = blocks.list.len() as u32;
            blocks.list.push(start..start + group.len() as u32);
            start += group.len() as u32;
        }
        blocks
    }

    fn place(&self, texel: &Texel) -> usize {
        let [x, y] = texel.pixel.map(|position| u32::from(position) / BLOCK);
        (y * self.widths[usize::from(texel.image)] + x) as usize
    }

    /// The block in which a texel lies.
    pub fn of(&self, texel: &Texel) -> u32 {
        self.grids[usize::from(texel.image)][self.place(texel)]
    }
}

fn block_of(texel: &Texel) -> [u16; 3] {
    [texel.image, texel.pixel[0] / BLOCK as u16, texel.pixel[1] / BLOCK as u16]
}

/// The bit of a texel in the masks of its block.
pub(super) fn bit(texel: &Texel) -> u64 {
    let [x, y] = texel.pixel.map(|position| u32::from(position) % BLOCK);
    1 << (y * BLOCK + x)
}
