//! Packs rectangles: charts into the rectangle of a mesh, surfaces into images.
//!
//! Rectangles are placed from the highest to the lowest, each where its top edge ends up lowest on the skyline of those
//! before it (bottom-left skyline, as in Jylänki 2010, "A thousand ways to pack the bin").

use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Reverse;

use crate::progress::{Cancelled, Progress};

/// Where a rectangle lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Place {
    pub image: usize,
    /// Upper left corner in texels.
    pub corner: [u32; 2],
}

/// Where rectangles lie within one.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Packed {
    /// For each rectangle its upper left corner.
    pub corners: Vec<[u32; 2]>,
    /// What they take up from the origin.
    pub size: [u32; 2],
}

/// Widths that are tried, as multiples of the side of a square of the same area.
const WIDTHS: [f32; 5] = [0.8, 0.95, 1.05, 1.2, 1.5];

/// Packs all rectangles into the smallest and squarest one that the widths tried lead to, with sides of at most `max`.
///
/// If all sizes are multiples of a number, so are the corners and the result.
pub(super) fn pack(sizes: &[[u32; 2]], max: u32, progress: &Progress) -> Result<Option<Packed>, Cancelled> {
    let order = order(sizes);
    let area: f32 = sizes.iter().map(|size| size[0] as f32 * size[1] as f32).sum();
    let widest = sizes.iter().map(|size| size[0]).max().unwrap_or(0);
    let mut widths: Vec<u32> =
        WIDTHS.iter().map(|factor| ((crate::math::sqrt(area) * factor) as u32).clamp(widest.min(max), max)).collect();
    widths.push(max);
    widths.dedup();
    let mut best: Option<Packed> = None;
    for (index, &width) in widths.iter().enumerate() {
        if index + 1 == widths.len() && best.is_some() {
            break;
        }
        if let Some(packed) = pack_within(sizes, &order, [width, max], progress)? {
            let cost = |[w, h]: [u32; 2]| (u64::from(w) * u64::from(h), w.max(h));
            if best.as_ref().is_none_or(|best| cost(packed.size) < cost(best.size)) {
                best = Some(packed);
            }
        }
    }
    Ok(best)
}

/// Whether and how all rectangles fit into one of this size.
pub(super) fn pack_into(sizes: &[[u32; 2]], room: [u32; 2], progress: &Progress) -> Result<Option<Packed>, Cancelled> {
    pack_within(sizes, &order(sizes), room, progress)
}

/// Packs rectangles into as many images as it takes, each at most `max` texels wide and high, and gives their sizes.
///
/// No rectangle is larger than that.
pub(super) fn pack_images(
    sizes: &[[u32; 2]],
    max: u32,
    progress: &Progress,
) -> Result<(Vec<Place>, Vec<[u32; 2]>), Cancelled> {
    let (mut places, mut images) = (vec![Place::default(); sizes.len()], Vec::new());
    let mut left = order(sizes);
    while !left.is_empty() {
        let rest: Vec<[u32; 2]> = left.iter().map(|&index| sizes[index]).collect();
        let area: u64 = rest.iter().map(|size| size[0] as u64 * size[1] as u64).sum();
        let all = if area <= max as u64 * max as u64 { pack(&rest, max, progress)? } else { None };
        let (corners, size) = match all {
            Some(packed) => (packed.corners.into_iter().map(Some).collect(), packed.size),
            None => fill(&rest, max, progress)?,
        };
        let mut later = Vec::new();
        for (&index, corner) in left.iter().zip(corners) {
            match corner {
                Some(corner) => places[index] = Place { image: images.len(), corner },
                None => later.push(index),
            }
        }
        images.push(size);
        left = later;
    }
    Ok((places, images))
}

/// From the highest to the lowest, wide ones first among equals.
fn order(sizes: &[[u32; 2]]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_unstable_by_key(|&index| (Reverse(sizes[index][1]), Reverse(sizes[index][0]), index));
    order
}

fn pack_within(
    sizes: &[[u32; 2]],
    order: &[usize],
    room: [u32; 2],
    progress: &Progress,
) -> Result<Option<Packed>, Cancelled> {
    let mut skyline = Skyline::new(room);
    let mut packed = Packed { corners: vec![[0; 2]; sizes.len()], size: [0; 2] };
    for &index in order {
        progress.check()?;
        let Some(corner) = skyline.place(sizes[index]) else { return Ok(None) };
        packed.corners[index] = corner;
        packed.size = [0, 1].map(|axis| packed.size[axis].max(corner[axis] + sizes[index][axis]));
    }
    Ok(Some(packed))
}

/// Corners of those that fit.
type Filled = (Vec<Option<[u32; 2]>>, [u32; 2]);

/// Packs into one image what fits into it, in the order given.
fn fill(sizes: &[[u32; 2]], max: u32, progress: &Progress) -> Result<Filled, Cancelled> {
    let mut skyline = Skyline::new([max; 2]);
    let mut used = [0; 2];
    let mut corners = Vec::with_capacity(sizes.len());
    for &size in sizes {
        progress.check()?;
        let corner = skyline.place(size);
        if let Some(corner) = corner {
            used = [0, 1].map(|axis| used[axis].max(corner[axis] + size[axis]));
        }
        corners.push(corner);
    }
    Ok((corners, used))
}

/// The lower border of what is taken, as steps from left to right.
struct Skyline {
    room: [u32; 2],
    steps: Vec<Step>,
}

#[derive(Clone, Copy)]
struct Step {
    x: u32,
    y: u32,
}

impl Skyline {
    fn new(room: [u32; 2]) -> Self {
        Self { room, steps: vec![Step { x: 0, y: 0 }] }
    }

    /// Takes the place where a rectangle lies highest, of those the leftmost.
    fn place(&mut self, size: [u32; 2]) -> Option<[u32; 2]> {
        let (mut best, mut best_y) = (None, u32::MAX);
        for index in 0..self.steps.len() {
            let step = self.steps[index];
            if step.x + size[0] > self.room[0] {
                break;
            }
            if step.y < best_y {
                let y = self.rest(index, size[0], best_y);
                if y < best_y && y + size[1] <= self.room[1] {
                    (best, best_y) = (Some(index), y);
                }
            }
        }
        let index = best?;
        let corner = [self.steps[index].x, best_y];
        self.raise(index, corner, size);
        Some(corner)
    }

    /// How high a rectangle lies whose left edge is at a step; at least `limit` as soon as it reaches it.
    fn rest(&self, index: usize, width: u32, limit: u32) -> u32 {
        let end = self.steps[index].x + width;
        let mut y = 0;
        for step in self.steps[index..].iter().take_while(|step| step.x < end) {
            y = y.max(step.y);
            if y >= limit {
                break;
            }
        }
        y
    }

    fn raise(&mut self, index: usize, corner: [u32; 2], size: [u32; 2]) {
        let end = corner[0] + size[0];
        let covered = self.steps[index..].iter().take_while(|step| step.x < end).count();
        let last = self.steps[index + covered - 1];
        let goes_on = self.steps.get(index + covered).map_or(self.room[0], |step| step.x) > end;
        let mut raised = vec![Step { x: corner[0], y: corner[1] + size[1] }];
        if goes_on {
            raised.push(Step { x: end, y: last.y });
        }
        self.steps.splice(index..index + covered, raised);
    }
}
