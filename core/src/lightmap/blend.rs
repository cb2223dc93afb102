//! How each texel is mixed from the nodes that gathered: interpolation and filter in one row of weights.

use alloc::vec::Vec;

use super::{Gathered, NONE, Texels, stencil};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::transport::{Row, Rows};

/// For each texel that gathered light, or got it interpolated, the nodes it is mixed from: those with rays, numbered in
/// the order of the texels. Mixing by these rows is what [`super::filter`] does, to 1/255 of the weights.
pub fn blend(
    gathered: &[Gathered],
    texels: &Texels,
    is_valid: &[bool],
    workers: &Workers,
    progress: &Progress,
) -> Result<Rows, Cancelled> {
    let numbers = numbers(gathered);
    let blending = Blending { gathered, numbers: &numbers, texels, is_valid };
    let rows: Vec<Row> =
        workers.map(numbers.len(), 1024, progress, |range| range.map(|texel| blending.row(texel)).collect())?;
    Ok(rows.into())
}

/// For each texel its number among the nodes, or [`NONE`].
fn numbers(gathered: &[Gathered]) -> Vec<u32> {
    let mut next = 0;
    let number = |node: &Gathered| {
        let is_node = u32::from(node.rays > 0);
        next += is_node;
        if is_node > 0 { next - 1 } else { NONE }
    };
    gathered.iter().map(number).collect()
}

struct Blending<'a> {
    gathered: &'a [Gathered],
    numbers: &'a [u32],
    texels: &'a Texels,
    is_valid: &'a [bool],
}

impl Blending<'_> {
    fn row(&self, texel: usize) -> Row {
        let mut weights = Vec::new();
        if self.gathered[texel].width > 0 {
            stencil(texel, self.gathered, self.texels, self.is_valid, |other, weight| {
                self.push(other, weight, &mut weights);
            });
        }
        Row::weigh(&mut weights)
    }

    /// Adds a texel, or the corners that it is interpolated from; they may lie between those of wider cells.
    fn push(&self, texel: usize, weight: f32, weights: &mut Vec<(u32, f32)>) {
        if self.numbers[texel] != NONE {
            return weights.push((self.numbers[texel], weight));
        }
        let (at, width) = (&self.texels.list[texel], u16::from(self.gathered[texel].width));
        if width == 0 {
            return;
        }
        let inside = at.pixel.map(|position| position % width);
        for k in 0..4 {
            let corner: [u16; 2] = core::array::from_fn(|axis| at.pixel[axis] - inside[axis] + (k >> axis & 1) * width);
            let share = |axis: usize| {
                let along = f32::from(inside[axis]) / f32::from(width);
                if k >> axis & 1 == 1 { along } else { 1.0 - along }
            };
            let other = self.texels.at_pixel(u32::from(at.image), i32::from(corner[0]), i32::from(corner[1]));
            if let Some(other) = other {
                self.push(other as usize, weight * share(0) * share(1), weights);
            }
        }
    }
}
