//! Sorting by digits, within the slice.

use core::cmp::Ordering;

use super::Draw;

/// Fewer entries are compared with each other.
const FEW: usize = 192;

/// Values of a digit.
const DIGITS: usize = 256;

impl Draw {
    /// By key; among equals by rank, and among new ones by index.
    #[inline]
    pub(super) fn is_before(&self, other: &Self) -> bool {
        self.order(other) == Ordering::Less
    }

    #[inline]
    fn order(&self, other: &Self) -> Ordering {
        let by_key = self.key.cmp(&other.key);
        by_key.then_with(|| (self.rank, self.index).cmp(&(other.rank, other.index)))
    }
}

/// Sorts by keys from their highest digit that differs: McIlroy, Bostic and McIlroy, "Engineering Radix Sort", 1993. A digit
/// is eight bits from the highest one in which any two keys differ, so that none is spent on what all have in common: a
/// layer, a sign, most of an exponent.
pub fn radix_sort(draws: &mut [Draw]) {
    let first = draws.first().map_or(0, |draw| draw.key.bits());
    let differing = draws.iter().fold(0, |differing, draw| differing | (draw.key.bits() ^ first));
    if draws.len() <= FEW || differing == 0 {
        draws.sort_unstable_by(Draw::order);
        return;
    }
    let shift = (u64::BITS - differing.leading_zeros()).saturating_sub(8);
    let digit = |draw: &Draw| (draw.key.bits() >> shift) as u8 as usize;
    let mut rest = draws;
    for count in distribute(rest, digit) {
        let (bucket, others) = rest.split_at_mut(count as usize);
        radix_sort(bucket);
        rest = others;
    }
}

/// Puts each entry into the bucket of its digit, one bucket after the other, and returns how long they are.
fn distribute(draws: &mut [Draw], digit: impl Fn(&Draw) -> usize) -> [u32; DIGITS] {
    let mut counts = [0_u32; DIGITS];
    draws.iter().for_each(|draw| counts[digit(draw)] += 1);
    let (mut next, mut ends) = ([0_u32; DIGITS], [0_u32; DIGITS]);
    let mut sum = 0;
    for k in 0..DIGITS {
        next[k] = sum;
        sum += counts[k];
        ends[k] = sum;
    }
    for k in 0..DIGITS {
        while next[k] < ends[k] {
            let place = next[k] as usize;
            let home = digit(&draws[place]);
            draws.swap(place, next[home] as usize);
            next[home] += 1;
        }
    }
    counts
}
