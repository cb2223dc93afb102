//! Sorting by digits, between two slices.

use super::Draw;

/// Fewer entries are compared with each other.
const FEW: usize = 256;

/// Values of a digit, and its bits.
const VALUES: usize = 256;
const BITS: u32 = 8;

/// Sorts by the lowest digit, then by the next one, and so on, each time stably: from one slice to the other and back.
/// Digits that are the same in all keys, as mostly those of layer and priority, cost nothing. Without room for that, and
/// where entries are few, by comparisons.
pub fn radix_sort(draws: &mut [Draw], scratch: &mut [Draw]) {
    let Some(scratch) = scratch.get_mut(..draws.len()).filter(|_| draws.len() > FEW) else {
        return sort_by_comparisons(draws);
    };
    let first = draws[0].key.bits();
    let differing = draws.iter().fold(0, |differing, draw| differing | (draw.key.bits() ^ first));
    let (mut from, mut to) = (draws, scratch);
    let mut is_swapped = false;
    for shift in (0..u64::BITS).step_by(BITS as usize).filter(|&shift| (differing >> shift) as u8 > 0) {
        distribute(from, to, |draw| (draw.key.bits() >> shift) as u8 as usize);
        (from, to) = (to, from);
        is_swapped = !is_swapped;
    }
    if is_swapped {
        to.copy_from_slice(from);
    }
}

/// Puts entries in the order of a digit.
fn distribute(from: &[Draw], to: &mut [Draw], digit: impl Fn(&Draw) -> usize) {
    let mut counts = [0_u32; VALUES];
    from.iter().for_each(|draw| counts[digit(draw)] += 1);
    let mut next = [0_u32; VALUES];
    (1..VALUES).for_each(|k| next[k] = next[k - 1] + counts[k - 1]);
    for draw in from {
        let place = &mut next[digit(draw)];
        to[*place as usize] = *draw;
        *place += 1;
    }
}

/// Equal keys by rank, and new ones by index: which is the order in which they stand.
fn sort_by_comparisons(draws: &mut [Draw]) {
    draws.sort_unstable_by_key(|draw| draw.key);
    for equal in draws.chunk_by_mut(|a, b| a.key == b.key).filter(|equal| equal.len() > 1) {
        equal.sort_unstable_by_key(|draw| (draw.rank, draw.index));
    }
}
