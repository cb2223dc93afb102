//! The order in which transparent things are drawn: keys, and sorting by them.
//!
//! [`ViewDepth`] measures how near a thing is, [`DrawKey`] puts layer, priority and depth into one number, [`sort`] orders
//! from scratch and [`resort`] from the order of the frame before. All of it happens in the caller's slices.
//!
//! Nanoseconds for each thing, measured in one run (`core/benches/composite_rivals`, `--bench sort`); coherent: few have
//! changed places since the frame before, calm: with a tolerance, so that equal depths do not flicker.
//!
//! | keys | things | [`sort`] | [`resort`] | calm | radsort | `sort_unstable` |
//! |---|---|---|---|---|---|---|
//! | random | 1 000 | 7.2 | 8.7 | 10.6 | 7.1 | 7.8 |
//! | random | 10 000 | 7.6 | 9.1 | 11.2 | 12.1 | 16.8 |
//! | random | 100 000 | 10.1 | 10.7 | 14.8 | 14.1 | 19.4 |
//! | random | 1 000 000 | 32.3 | 37.6 | 62.8 | 38.3 | 50.5 |
//! | coherent | 1 000 | 7.2 | 1.7 | 3.5 | 7.2 | 7.1 |
//! | coherent | 10 000 | 7.5 | 1.7 | 3.6 | 7.2 | 9.6 |
//! | coherent | 100 000 | 10.9 | 4.4 | 7.8 | 10.1 | 14.9 |
//! | coherent | 1 000 000 | 36.1 | 5.7 | 38.9 | 44.6 | 44.0 |
//!
//! Without room for a copy ([`sort`] with an empty `scratch`) it takes about twice as long as with it.

mod depth;
mod key;
mod radix;

pub use depth::*;
pub use key::*;

use radix::radix_sort;

/// So many comparisons and moves per entry may the order of the frame before cost; then it was not worth keeping.
const PATIENCE: usize = 4;

/// Of the entries whose depths are all but equal so many are looked at to find the one that was first before.
const WINDOW: usize = 32;

/// One thing to be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Draw {
    /// When it is drawn.
    pub key: DrawKey,
    /// Its place in the order of the frame before: among equals it decides.
    pub rank: u32,
    /// Which thing it is; anything that the caller finds it by.
    pub index: u32,
}

/// By how much depths may differ and count as equal.
///
/// What rounding does to a depth goes with it: what is far away, or moved there by a bias, must not make equal what is near.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tolerance {
    /// Of any two, in m; not negative.
    pub least: f32,
    /// More than that by this share of the depth of the farther one, in `[0, 1)`.
    pub share: f32,
}

impl Tolerance {
    /// Only equal depths are equal.
    pub const NONE: Self = Self { least: 0.0, share: 0.0 };

    /// The nearest depth that counts as equal to one. It grows with that one.
    pub fn end(&self, depth: f32) -> f32 {
        depth + (self.least + self.share * depth.abs())
    }
}

/// Sorts things to be drawn: lower layers first, then lower priorities, then from far to near. Equal ones stay in the
/// order in which they stand. Ranks are then the places in the new order.
///
/// With `scratch` as long as `draws` it is a radix sort, in time proportional to their number; what stands there does not
/// matter. A shorter one, even none, is enough for a sort by comparisons.
///
/// ```
/// use radiosity::composite::{Draw, DrawKey, sort};
///
/// let mut draws = [(0, -2.0), (1, -9.0), (2, -5.0)]
///     .map(|(index, depth)| Draw { key: DrawKey::new(0, 0, depth), rank: 0, index });
/// sort(&mut draws, &mut []);
/// assert_eq!(draws.map(|draw| draw.index), [1, 2, 0], "from far to near");
/// ```
pub fn sort(draws: &mut [Draw], scratch: &mut [Draw]) {
    renumber(draws);
    radix_sort(draws, scratch);
    renumber(draws);
}

/// Sorts things that stand in the order of the frame before, ranks and all, with new keys: in linear time where few have
/// changed places, as [`sort`] otherwise.
///
/// Things whose depths differ by no more than the tolerance of the farther one keep the order that they had, unless a third
/// one forces them apart; so that things at the same depth do not flicker when rounding, or a camera that trembles, favors
/// now one and now the other. That holds among 32 of them, and among any number that lie apart from all others. All others
/// are in true order, without exception. New things are appended, with the rank `u32::MAX`; others may be left out.
pub fn resort(draws: &mut [Draw], scratch: &mut [Draw], tolerance: Tolerance) {
    if !insertion_sort(draws, PATIENCE * draws.len()) {
        radix_sort(draws, scratch);
    }
    if tolerance != Tolerance::NONE {
        draws.chunk_by_mut(|a, b| a.key.group() == b.key.group()).for_each(|group| keep_order(group, tolerance));
    }
    renumber(draws);
}

fn renumber(draws: &mut [Draw]) {
    draws.iter_mut().zip(0..).for_each(|(draw, rank)| draw.rank = rank);
}

/// Whether it is done after so many moves. Equal entries stay in the order of their ranks.
fn insertion_sort(draws: &mut [Draw], mut moves: usize) -> bool {
    for k in 1..draws.len() {
        let draw = draws[k];
        let mut place = k;
        while place > 0 && draw.key < draws[place - 1].key {
            draws[place] = draws[place - 1];
            place -= 1;
        }
        draws[place] = draw;
        let Some(left) = moves.checked_sub(k - place) else { return false };
        moves = left;
    }
    true
}

/// Brings those back into the order of their ranks whose depths differ by no more than the tolerance.
///
/// Of what is left, all that is farther by more than the tolerance than others must come before them: a semiorder. Those
/// within the tolerance of the farthest may come next, and of them the one comes that was first before.
fn keep_order(group: &mut [Draw], tolerance: Tolerance) {
    let mut next = 0;
    let mut end = 0;
    while next < group.len() {
        let limit = tolerance.end(group[next].key.depth());
        if group.get(next + 1).is_none_or(|draw| draw.key.depth() > limit) {
            next += 1;
            continue;
        }
        end = end.max(next + 1);
        end += group[end..].iter().take_while(|draw| draw.key.depth() <= limit).count();
        let last = tolerance.end(group[end - 1].key.depth());
        let is_apart = group.get(end).is_none_or(|draw| draw.key.depth() > last);
        if is_apart {
            group[next..end].sort_unstable_by_key(|draw| draw.rank);
            next = end;
            continue;
        }
        let window = &mut group[next..end.min(next + WINDOW)];
        let first = (0..window.len()).min_by_key(|&k| window[k].rank).unwrap_or(0);
        window[..=first].rotate_right(1);
        next += 1;
    }
}
