//! Form factors as counts of rays: a row for each patch, exact in its sum.

use alloc::vec::Vec;

use crate::solve::FormFactors;

/// Where a ray from a patch ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// On a patch.
    Patch(u32),
    /// Nowhere: it leaves the scene and sees the sky.
    Sky,
    /// On a surface that reflects nothing.
    Black,
}

/// The form factors between patches. Each row sums to one with its sky and its black bin: both are counts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    starts: Vec<usize>,
    entries: Vec<Entry>,
    rows: Vec<Row>,
}

/// How many rays of a row end on one patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Entry {
    patch: u32,
    count: u32,
}

/// What of a row does not end on a patch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// Rays that leave the scene.
    pub sky: u32,
    /// Rays that end on a surface that reflects nothing.
    pub black: u32,
    /// All rays of the row.
    pub total: u32,
}

/// The rays of one patch, sorted and counted.
#[derive(Clone, Debug, Default)]
pub struct RowCounts {
    entries: Vec<Entry>,
    row: Row,
}

impl RowCounts {
    /// Counts the ends of the rays of one patch; `ends` gets sorted.
    pub fn new(ends: &mut [End]) -> Self {
        ends.sort_unstable();
        let mut counts = Self { entries: Vec::new(), row: Row { total: ends.len() as u32, ..Row::default() } };
        for same in ends.chunk_by(|a, b| a == b) {
            let count = same.len() as u32;
            match same[0] {
                End::Patch(patch) => counts.entries.push(Entry { patch, count }),
                End::Sky => counts.row.sky = count,
                End::Black => counts.row.black = count,
            }
        }
        counts
    }
}

impl FromIterator<RowCounts> for Rows {
    fn from_iter<I: IntoIterator<Item = RowCounts>>(rows: I) -> Self {
        let mut all = Self { starts: alloc::vec![0], ..Self::default() };
        for RowCounts { entries, row } in rows {
            all.entries.extend(entries);
            all.starts.push(all.entries.len());
            all.rows.push(row);
        }
        all
    }
}

impl Rows {
    /// What of row `i` does not end on a patch.
    pub fn row(&self, i: usize) -> Row {
        self.rows[i]
    }

    /// The form factor from patch `i` to the sky.
    pub fn sky(&self, i: usize) -> f32 {
        self.rows[i].sky as f32 / self.rows[i].total.max(1) as f32
    }

    /// The form factor from patch `i` to all that reflects nothing, the sky not included.
    pub fn black(&self, i: usize) -> f32 {
        self.rows[i].black as f32 / self.rows[i].total.max(1) as f32
    }

    /// The largest difference between one and the sum of a row with its bins.
    pub fn closure_error(&self) -> f32 {
        let error = |i: usize| {
            let Row { sky, black, total } = self.rows[i];
            let hits: u32 = self.entries[self.starts[i]..self.starts[i + 1]].iter().map(|entry| entry.count).sum();
            (1.0 - (hits + sky + black) as f32 / total.max(1) as f32).abs()
        };
        (0..self.rows.len()).filter(|&i| self.rows[i].total > 0).map(error).fold(0.0, f32::max)
    }
}

impl FormFactors for Rows {
    type Scalar = f32;

    fn row(&self, i: usize, mut entry: impl FnMut(usize, f32)) {
        let share = 1.0 / self.rows[i].total.max(1) as f32;
        let entries = &self.entries[self.starts[i]..self.starts[i + 1]];
        entries.iter().for_each(|&Entry { patch, count }| entry(patch as usize, count as f32 * share));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_counts() {
        let mut ends = [End::Patch(3), End::Sky, End::Patch(1), End::Patch(3), End::Black, End::Patch(3)];
        let rows: Rows = [RowCounts::new(&mut ends), RowCounts::new(&mut [])].into_iter().collect();
        assert_eq!(rows.row(0), Row { sky: 1, black: 1, total: 6 });
        assert!((rows.receive(0, &[0.0_f32, 2.0, 0.0, 4.0]) - (2.0 + 3.0 * 4.0) / 6.0).abs() < 1e-6);
        assert_eq!(rows.receive(1, &[1.0_f32; 4]), 0.0);
        assert_eq!(rows.closure_error(), 0.0);
    }
}
