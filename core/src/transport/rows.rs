//! Shares as counts: sparse rows of four bytes an entry, each exact in its sum.
//!
//! Rays that went through colored glass or came from colored mirrors kept some of the channels. They end on columns of
//! their own: see [`through`].

use alloc::boxed::Box;
use alloc::vec::Vec;
use core::ops::Range;

use crate::solve::FormFactors;
use crate::spectrum::Spectrum;

/// The bits of an entry that count; the others are the distance from the column before.
const COUNT_BITS: u32 = 8;
const MOST_COUNT: u32 = (1 << COUNT_BITS) - 1;
const MOST_DISTANCE: u32 = (1 << (32 - COUNT_BITS)) - 1;

/// The channels that a whole ray has: bit 0 is red.
const ALL_CHANNELS: u32 = 0b111;

/// The column of a matrix with so many `columns` for a ray that kept only these `channels`, at least one: after all
/// columns for whole rays come as many for each other set of channels.
pub fn through(channels: u32, column: u32, columns: u32) -> u32 {
    (ALL_CHANNELS - channels) * columns + column
}

/// A sparse matrix whose rows sum to one: each entry is a count over the count of its row.
///
/// An entry is a `u32`: 24 bits for how far its column lies behind the one before it, 8 bits for the count. Larger
/// counts and distances take several entries.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rows {
    /// Where in `entries` each row ends.
    pub(super) ends: Vec<u64>,
    pub(super) entries: Vec<u32>,
    /// The counts of each row together; 0: the row is empty.
    pub(super) totals: Vec<u32>,
    /// How many columns there are for whole rays; 0: there are no others.
    pub(super) columns: u32,
}

/// One row of [`Rows`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Row {
    entries: Box<[u32]>,
    total: u32,
}

impl Row {
    /// Counts how often each column occurs; `columns` gets sorted.
    pub fn count(columns: &mut [u32]) -> Self {
        columns.sort_unstable();
        Self::new(columns.chunk_by(|a, b| a == b).map(|same| (same[0], same.len() as u32)))
    }

    /// A row of weights that are not negative, each rounded to 1/255 of the largest; `weights` gets sorted.
    pub fn weigh(weights: &mut [(u32, f32)]) -> Self {
        weights.sort_unstable_by_key(|&(column, _)| column);
        let of_column = |same: &[(u32, f32)]| (same[0].0, same.iter().map(|&(_, weight)| weight).sum::<f32>());
        let sums = weights.chunk_by(|a, b| a.0 == b.0).map(of_column);
        let largest = sums.clone().map(|(_, weight)| weight).fold(f32::MIN_POSITIVE, f32::max);
        let rounded = sums.map(|(column, weight)| (column, (weight / largest * MOST_COUNT as f32 + 0.5) as u32));
        Self::new(rounded.filter(|&(_, count)| count > 0))
    }

    /// The counts of two rows together.
    pub fn merge(&self, other: &Self) -> Self {
        let mut all: Vec<(u32, u32)> = decode(&self.entries).chain(decode(&other.entries)).collect();
        all.sort_unstable_by_key(|&(column, _)| column);
        let sum = |same: &[(u32, u32)]| (same[0].0, same.iter().map(|&(_, count)| count).sum());
        Self::new(all.chunk_by(|a, b| a.0 == b.0).map(sum))
    }

    /// What the row takes, in bytes.
    pub fn bytes(&self) -> usize {
        size_of::<Self>() + 4 * self.entries.len()
    }

    /// A row of columns, in their order, and counts.
    fn new(counts: impl Iterator<Item = (u32, u32)>) -> Self {
        let (mut entries, mut total, mut last) = (Vec::new(), 0, 0);
        for (column, count) in counts {
            push(column - last, count, &mut entries);
            (total, last) = (total + count, column);
        }
        Self { entries: entries.into(), total }
    }
}

fn push(mut distance: u32, mut count: u32, entries: &mut Vec<u32>) {
    while distance > MOST_DISTANCE {
        entries.push(MOST_DISTANCE << COUNT_BITS);
        distance -= MOST_DISTANCE;
    }
    while count > MOST_COUNT {
        entries.push(distance << COUNT_BITS | MOST_COUNT);
        (distance, count) = (0, count - MOST_COUNT);
    }
    entries.push(distance << COUNT_BITS | count);
}

impl From<Vec<Row>> for Rows {
    fn from(rows: Vec<Row>) -> Self {
        let mut all = Self::default();
        all.append(rows);
        all
    }
}

impl Rows {
    /// The same rows, where columns from this number on are those of [`through`].
    pub fn through(self, columns: u32) -> Self {
        Self { columns, ..self }
    }

    /// Puts more rows after these.
    pub fn append(&mut self, rows: Vec<Row>) {
        self.ends.reserve(rows.len());
        self.entries.reserve(rows.iter().map(|row| row.entries.len()).sum());
        self.totals.reserve(rows.len());
        for Row { entries, total } in rows {
            self.entries.extend(entries);
            self.ends.push(self.entries.len() as u64);
            self.totals.push(total);
        }
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The number of entries of all rows.
    pub fn entries(&self) -> usize {
        self.entries.len()
    }

    /// What the rows take, in bytes.
    pub fn bytes(&self) -> usize {
        4 * self.entries.len() + 12 * self.ends.len()
    }

    /// The mean of `values` by the shares of row `i`; zero where it is empty.
    #[inline]
    pub fn mean<S: Spectrum<Scalar = f32>>(&self, i: usize, values: &[S]) -> S {
        if self.columns > 0 {
            return self.mean_through(i, values);
        }
        // Four sums at a time: an addition need not wait for the one before it.
        let mut sums = [S::default(); 4];
        let (fours, rest) = self.row_entries(i).as_chunks::<4>();
        let mut column = 0_u32;
        for four in fours {
            let counts = four.map(|entry| (entry & MOST_COUNT) as f32);
            for k in 0..4 {
                column = column.wrapping_add(four[k] >> COUNT_BITS);
                sums[k] += values[column as usize] * counts[k];
            }
        }
        for &entry in rest {
            column = column.wrapping_add(entry >> COUNT_BITS);
            sums[0] += values[column as usize] * (entry & MOST_COUNT) as f32;
        }
        let [a, b, c, d] = sums;
        ((a + b) + (c + d)) * (1.0 / self.totals[i].max(1) as f32)
    }

    /// The same where some rays kept only some of the channels.
    fn mean_through<S: Spectrum<Scalar = f32>>(&self, i: usize, values: &[S]) -> S {
        let mut sum = S::default();
        for (column, channels, count) in self.seen(i) {
            sum += values[column as usize].keep(channels) * count as f32;
        }
        sum * (1.0 / self.totals[i].max(1) as f32)
    }

    /// The share of some columns in row `i`, by the channels that get there.
    pub fn share<S: Spectrum<Scalar = f32>>(&self, i: usize, columns: Range<u32>) -> S {
        let of_columns = self.seen(i).filter(|(column, ..)| columns.contains(column));
        self.sum_of(i, of_columns.map(|(_, channels, count)| (channels, count)))
    }

    /// The share of row `i` that is absorbed on the way, by channels.
    pub fn absorbed<S: Spectrum<Scalar = f32>>(&self, i: usize) -> S {
        self.sum_of(i, self.seen(i).map(|(_, channels, count)| (!channels, count)))
    }

    fn sum_of<S: Spectrum<Scalar = f32>>(&self, i: usize, counts: impl Iterator<Item = (u32, u32)>) -> S {
        let sum = counts.fold(S::default(), |sum, (channels, count)| sum + S::splat(count as f32).keep(channels));
        sum.zip(S::splat(self.totals[i].max(1) as f32), |count, total| count / total)
    }

    /// The columns of a row, which channels get there, and counts.
    fn seen(&self, i: usize) -> impl Iterator<Item = (u32, u32, u32)> + '_ {
        decode(self.row_entries(i)).map(move |(column, count)| match column.checked_div(self.columns) {
            Some(set @ 1..) => (column - set * self.columns, ALL_CHANNELS & ALL_CHANNELS.wrapping_sub(set), count),
            _ => (column, u32::MAX, count),
        })
    }

    /// The largest difference between one and the sum of the shares of a row that is not empty.
    pub fn closure_error(&self) -> f32 {
        let sum = |i: usize| decode(self.row_entries(i)).map(|(_, count)| count).sum::<u32>() as f32;
        let rows = (0..self.len()).filter(|&i| self.totals[i] > 0);
        rows.map(|i| (1.0 - sum(i) / self.totals[i] as f32).abs()).fold(0.0, f32::max)
    }

    /// Whether all rows lie within the entries and all columns are below `columns`: what a file must show.
    pub(super) fn is_sound(&self, columns: usize) -> bool {
        let sets = if self.columns == 0 { 1 } else { u64::from(ALL_CHANNELS) };
        let fits = self.columns == 0 || self.columns as usize == columns;
        let in_order =
            fits && self.ends.is_sorted() && self.ends.last().map_or(0, |&end| end) == self.entries.len() as u64;
        let is_sound = |i: usize| {
            let entries = self.row_entries(i);
            let last: u64 = entries.iter().map(|entry| u64::from(entry >> COUNT_BITS)).sum();
            let total: u64 = entries.iter().map(|entry| u64::from(entry & MOST_COUNT)).sum();
            (entries.is_empty() || last < sets * columns as u64) && total == u64::from(self.totals[i])
        };
        in_order && self.totals.len() == self.len() && (0..self.len()).all(is_sound)
    }

    #[inline]
    fn row_entries(&self, i: usize) -> &[u32] {
        let start = if i == 0 { 0 } else { self.ends[i - 1] };
        &self.entries[start as usize..self.ends[i] as usize]
    }
}

/// The columns and counts of a row.
#[inline]
fn decode(entries: &[u32]) -> impl Iterator<Item = (u32, u32)> + Clone + '_ {
    entries.iter().scan(0_u32, |column, &entry| {
        *column = column.wrapping_add(entry >> COUNT_BITS);
        Some((*column, entry & MOST_COUNT))
    })
}

impl FormFactors for Rows {
    type Scalar = f32;

    /// Rays that kept only some channels count as whole ones here.
    fn row(&self, i: usize, mut entry: impl FnMut(usize, f32)) {
        let share = 1.0 / self.totals[i].max(1) as f32;
        self.seen(i).for_each(|(column, _, count)| entry(column as usize, count as f32 * share));
    }

    fn receive<S: Spectrum<Scalar = f32>>(&self, i: usize, radiosity: &[S]) -> S {
        self.mean(i, radiosity)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;
    use glam::Vec3A;

    #[test]
    fn rows_are_counts() {
        let rows = Rows::from(vec![Row::count(&mut [3, 4, 1, 3, 5, 3]), Row::count(&mut [])]);
        let share = |i, j| rows.share::<f32>(i, j..j + 1);
        assert_eq!((share(0, 3), share(0, 0), share(1, 0)), (0.5, 0.0, 0.0));
        let values = [0.0, 2.0, 0.0, 4.0, 0.0, 6.0].map(Vec3A::splat);
        assert!((rows.mean(0, &values).x - (2.0 + 3.0 * 4.0 + 6.0) / 6.0).abs() < 1e-6);
        assert_eq!(rows.mean(1, &values), Vec3A::ZERO);
        assert!((rows.receive::<f32>(0, &[0.0, 2.0, 0.0, 4.0, 0.0, 6.0]) - 20.0 / 6.0).abs() < 1e-6);
        assert_eq!(rows.closure_error(), 0.0);
        assert!(rows.is_sound(6) && !rows.is_sound(5));
    }

    /// Counts above 8 bits and distances above 24 bits are as good as small ones.
    #[test]
    fn large_counts_and_distances() {
        let far = 3 * MOST_DISTANCE + 7;
        let mut columns = vec![far; 1000];
        columns.push(2);
        let row = Row::count(&mut columns);
        assert_eq!(row.entries.len(), 1 + 3 + 4);
        let rows = Rows::from(vec![row.merge(&Row::count(&mut [2, 2]))]);
        let share = |j| rows.share::<f32>(0, j..j + 1);
        assert_eq!((share(2), share(far)), (3.0 / 1003.0, 1000.0 / 1003.0));
        assert_eq!(rows.closure_error(), 0.0);
    }

    /// Rays that kept some channels bring those; what they lost is absorbed, and with that each channel sums to one.
    #[test]
    fn channels() {
        let mut ends = vec![0, 1, 1, through(0b001, 1, 3), through(0b110, 0, 3), through(0b100, 2, 3), 2, 2];
        let rows = Rows::from(vec![Row::count(&mut ends)]).through(3);
        let values = [Vec3A::new(1.0, 2.0, 4.0), Vec3A::new(8.0, 16.0, 32.0), Vec3A::new(64.0, 128.0, 256.0)];
        let expected = [1.0 + 24.0 + 128.0, 4.0 + 32.0 + 256.0, 8.0 + 64.0 + 768.0];
        assert!(rows.mean(0, &values).abs_diff_eq(Vec3A::from_array(expected) / 8.0, 1e-4));
        let shares: Vec3A = rows.share(0, 0..3);
        assert_eq!(rows.absorbed::<Vec3A>(0), Vec3A::new(2.0, 2.0, 1.0) / 8.0);
        assert_eq!(shares + rows.absorbed::<Vec3A>(0), Vec3A::ONE);
        assert_eq!(rows.closure_error(), 0.0);
        assert!(rows.is_sound(3) && !rows.is_sound(4));
    }

    #[test]
    fn weights_are_shares_to_a_part_of_the_largest() {
        let rows = Rows::from(vec![Row::weigh(&mut [(7, 0.3), (2, 0.5), (7, 0.1), (9, 0.0001), (4, 0.1)])]);
        for (column, share) in [(2, 0.5), (7, 0.4), (9, 0.0), (4, 0.1)] {
            assert!((rows.share::<f32>(0, column..column + 1) - share).abs() < 0.002);
        }
    }
}
