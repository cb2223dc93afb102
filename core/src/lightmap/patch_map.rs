//! Which patch each texel of an image belongs to, in little more than a byte for each texel.

use alloc::vec;
use alloc::vec::Vec;

use super::{BLOCK, NONE, Texels};

/// Which patch each texel of an image belongs to.
///
/// A block of 8 x 8 texels has at most 64 patches: each texel tells which of those of its block is its own.
#[derive(Clone, Debug, Default)]
pub struct PatchMap {
    width: usize,
    /// For each texel, row by row, its place in the list of its block, or [`NOWHERE`].
    places: Vec<u8>,
    /// For each block, row by row, where its list begins.
    firsts: Vec<u32>,
    /// The patches of the blocks, list after list.
    patches: Vec<u32>,
}

/// The texel belongs to no patch.
const NOWHERE: u8 = u8::MAX;

impl PatchMap {
    /// Of an image whose texels are here, from the patch of each texel or [`NONE`].
    pub(super) fn new(texels: &Texels, image: usize, of_texel: &[u32]) -> Self {
        let [width, height] = texels.sizes[image].map(|side| side as usize);
        let mut map = Self { width, places: vec![NOWHERE; width * height], ..Self::default() };
        for top in (0..height).step_by(BLOCK as usize) {
            for left in (0..width).step_by(BLOCK as usize) {
                let first = map.patches.len();
                map.firsts.push(first as u32);
                for y in top..(top + BLOCK as usize).min(height) {
                    for x in left..(left + BLOCK as usize).min(width) {
                        let texel = texels.index[image][y * width + x];
                        let patch = if texel == NONE { NONE } else { of_texel[texel as usize] };
                        if patch != NONE {
                            map.places[y * width + x] = map.place(first, patch);
                        }
                    }
                }
            }
        }
        map
    }

    /// The patch of a texel; [`NONE`] where there is none, and outside.
    #[inline]
    pub fn at(&self, x: usize, y: usize) -> u32 {
        if x >= self.width {
            return NONE;
        }
        match self.places.get(y * self.width + x) {
            None | Some(&NOWHERE) => NONE,
            Some(&place) => {
                let block = y / BLOCK as usize * self.width.div_ceil(BLOCK as usize) + x / BLOCK as usize;
                self.patches[self.firsts[block] as usize + usize::from(place)]
            }
        }
    }

    /// The place of a patch in the list of the last block, which begins at `first`.
    fn place(&mut self, first: usize, patch: u32) -> u8 {
        let list = &self.patches[first..];
        let place = list.iter().position(|&known| known == patch).unwrap_or_else(|| {
            self.patches.push(patch);
            self.patches.len() - 1 - first
        });
        place as u8
    }
}
