//! Texels between light and darkness: a lightmap has one texel where a wall has two sides.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use super::Texels;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};

/// Light beyond a wall is dark where it is less than this share of that before it.
///
/// A bright texel that is the nearest one to a thin wall leaks over up to a texel on the dark side, which is wrong by a
/// multiple of what is there; a dark one misses up to two texels of light on the bright side, which is wrong by less
/// than all that is there. Squared, the leak of a texel that the wall cuts outweighs the loss from a ratio of five on.
const DARK: f32 = 0.1;
/// Darkness that covers less than this of a surface, in square meters, is no room: nobody looks behind furniture and
/// books.
const ROOM: f32 = 0.5;
/// So many dark texels are enough in any case: what is lost before them is narrow.
const MANY: usize = 256;

/// The ways from a texel to the one on its right without leaving the texels around: right (0), down (1), left (2), up
/// (3).
const BESIDE: [&[usize]; 3] = [&[0], &[1, 0, 3], &[3, 0, 1]];
/// The same to the one at its lower right corner.
const ACROSS: [&[usize]; 2] = [&[0, 1], &[1, 0]];

/// Which texels keep light of their own: valid ones, without those that lookups beyond a wall mix in where it is dark.
/// Such are filled like those inside geometry, from the dark side.
///
/// `light` is that of each texel, mean over the channels.
///
/// # Errors
///
/// Where the progress was told to cancel.
pub fn without_torn(
    texels: &Texels,
    is_valid: &[bool],
    light: &[f32],
    workers: &Workers,
    progress: &Progress,
) -> Result<Vec<bool>, Cancelled> {
    let sides = Sides { texels, is_valid, light };
    workers.map(is_valid.len(), 1024, progress, |range| {
        range.map(|texel| is_valid[texel] && !sides.is_torn(texel as u32)).collect()
    })
}

/// What lies on both sides of walls.
struct Sides<'a> {
    texels: &'a Texels,
    is_valid: &'a [bool],
    light: &'a [f32],
}

impl Sides<'_> {
    /// Whether a wall parts a texel from a far darker one next to it.
    fn is_torn(&self, texel: u32) -> bool {
        !self.texels.links.is_clear(texel, 1)
            && (0..4).any(|turn| self.is_dark(texel, turn, &BESIDE) || self.is_dark(texel, turn, &ACROSS))
    }

    /// Whether the texel to which these ways lead after so many quarter turns lies in a far darker room, and walls bar
    /// all of them.
    fn is_dark(&self, texel: u32, turn: usize, ways: &[&[usize]]) -> bool {
        let is_dark = |other: u32| {
            let [own, beyond] = [texel, other].map(|texel| &self.texels.list[texel as usize]);
            let is_darker = self.light[other as usize] < DARK * self.light[texel as usize];
            self.is_valid[other as usize] && own.chart == beyond.chart && is_darker
        };
        let beside = |texel: u32, &side: &usize| self.texels.beside(texel, (side + turn) % 4);
        let Some(other) = ways[0].iter().try_fold(texel, beside).filter(|&other| is_dark(other)) else { return false };
        ways.iter().all(|way| self.way(texel, turn, way).is_none()) && self.is_room(other, &is_dark)
    }

    /// Whether darkness goes on around a texel.
    fn is_room(&self, texel: u32, is_dark: &impl Fn(u32) -> bool) -> bool {
        let (mut known, mut area, mut front) = (BTreeSet::from([texel]), 0.0, Vec::from([texel]));
        while let Some(texel) = front.pop() {
            area += self.texels.list[texel as usize].area;
            if area >= ROOM || known.len() >= MANY {
                return true;
            }
            let around = (0..4).filter_map(|side| self.way(texel, side, &[0]));
            front.extend(around.filter(|&other| is_dark(other) && known.insert(other)));
        }
        false
    }

    /// Where a way leads, if no wall bars it.
    fn way(&self, texel: u32, turn: usize, way: &[usize]) -> Option<u32> {
        way.iter().map(|side| (side + turn) % 4).try_fold(texel, |texel, side| {
            self.texels.beside(texel, side).filter(|_| self.texels.links.is_open(texel, side))
        })
    }
}
