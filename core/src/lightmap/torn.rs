//! Texels between light and darkness: a lightmap has one texel where a wall has two sides.

use alloc::vec::Vec;

use super::links::{Place, is_open};
use super::{CROSSED, Texels};
use crate::geometry::Occluders;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::transport::Tracer;

/// Light beyond a wall is dark where it is less than this share of that before it.
///
/// A bright texel that a wall cuts near its middle leaks over half a texel on the dark side, which is wrong by a
/// multiple of what is there; a dark one misses up to a texel and a half of light on the bright side, which is wrong by
/// less than all that is there. Squared, the leak outweighs the loss from a ratio of five on; twice that leaves the gaps
/// behind furniture alone, where nobody looks.
const DARK: f32 = 0.1;
/// From the middle of a texel to the places in it that are asked for, in texels.
const NEARLY_OUT: f32 = 0.45;

/// Which texels keep light of their own: valid ones, without those that a wall cuts and in which the dark side of the
/// wall is seen. Such are filled like those inside geometry, from the dark side.
///
/// `light` is that of each texel, mean over the channels.
///
/// # Errors
///
/// Where the progress was told to cancel.
pub fn without_torn<O: Occluders>(
    texels: &Texels,
    is_valid: &[bool],
    light: &[f32],
    tracer: &Tracer<O>,
    workers: &Workers,
    progress: &Progress,
) -> Result<Vec<bool>, Cancelled> {
    let sides = Sides { texels, is_valid, light, tracer };
    workers.map(is_valid.len(), 1024, progress, |range| {
        range.map(|texel| is_valid[texel] && !sides.is_torn(texel as u32)).collect()
    })
}

/// What lies on both sides of walls.
struct Sides<'a, O> {
    texels: &'a Texels,
    is_valid: &'a [bool],
    light: &'a [f32],
    tracer: &'a Tracer<'a, O>,
}

impl<O: Occluders> Sides<'_, O> {
    /// Whether a texel reaches through a wall into the darkness of one beside it.
    fn is_torn(&self, texel: u32) -> bool {
        let is_cut = self.texels.list[texel as usize].quarters & CROSSED != 0;
        is_cut && (0..4).any(|side| self.is_dark(texel, side) && self.reaches(texel, side))
    }

    /// Whether a wall parts a texel from a far darker one on a side of it.
    fn is_dark(&self, texel: u32, side: usize) -> bool {
        let Some(beside) = self.texels.beside(texel, side) else { return false };
        let [own, other] = [texel, beside].map(|texel| &self.texels.list[texel as usize]);
        let [light, beyond] = [texel, beside].map(|texel| self.light[texel as usize]);
        let are_parted = !self.texels.links.is_open(texel, side);
        self.is_valid[beside as usize] && own.chart == other.chart && are_parted && beyond < DARK * light
    }

    /// Whether a place near that border of a texel is seen from the texel beyond.
    fn reaches(&self, texel: u32, side: usize) -> bool {
        let Some(beside) = self.texels.beside(texel, side) else { return false };
        let [own, other] = [texel, beside].map(|texel| &self.texels.list[texel as usize]);
        let world = self.tracer.world;
        let steps = self.texels.steps(world, own.triangle);
        let ahead = steps[side % 2] * if side < 2 { NEARLY_OUT } else { -NEARLY_OUT };
        let across = steps[1 - side % 2] * 0.25;
        let border = self.texels.middle(world, own) + ahead;
        let from = Place::of(self.tracer, other);
        // The middle of a border may lie in a wall.
        [border - across, border + across]
            .into_iter()
            .any(|at| is_open(self.tracer, &from, &Place::new(self.tracer, own.triangle, at)))
    }
}
