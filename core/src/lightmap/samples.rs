//! A ratio of sums over a stratified square, and how far it may be off.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec2;

/// Variance of a net over that of a grid with one point in each cell, where an edge cuts the square: nets are stratified
/// in strips too. Measured over edges of all directions for 4 to 256 points: between 0.27 and 1; an edge parallel to a side has less than a tenth of what is claimed.
const NET: f32 = 0.5;

/// Samples at points of the unit square of which a power of two fills a grid, one in each cell: a `(0, m, 2)` net.
///
/// Their mean is `sum of values / sum of weights`.
pub(super) struct Samples {
    /// Cells along both axes.
    columns: u32,
    rows: u32,
    /// Cell by cell weight and value; cells along a row are neighbors.
    cells: Vec<[f32; 2]>,
}

impl Samples {
    /// None yet of `count` samples, which is taken to the next power of two.
    pub fn new(count: u32) -> Self {
        let bits = count.max(1).next_power_of_two().trailing_zeros();
        let (columns, rows) = (1 << bits.div_ceil(2), 1 << (bits / 2));
        Self { columns, rows, cells: vec![[0.0; 2]; (columns * rows) as usize] }
    }

    /// Adds the sample at a point of the unit square.
    pub fn put(&mut self, square: Vec2, weight: f32, value: f32) {
        let (column, row) = ((square.x * self.columns as f32) as u32, (square.y * self.rows as f32) as u32);
        let cell = row.min(self.rows - 1) * self.columns + column.min(self.columns - 1);
        let [weights, values] = &mut self.cells[cell as usize];
        *weights += weight;
        *values += value;
    }

    fn sums(&self) -> [f32; 2] {
        self.cells.iter().fold([0.0; 2], |sums, cell| [sums[0] + cell[0], sums[1] + cell[1]])
    }

    /// The sum of the values over that of the weights; 0 without weights.
    pub fn mean(&self) -> f32 {
        let [weights, values] = self.sums();
        if weights > 0.0 { values / weights } else { 0.0 }
    }

    /// Variance of the mean.
    ///
    /// Each cell is a stratum of its own with one sample; two neighbors tell the variance of both, and more where their
    /// means differ: the collapsed strata of Cochran, "Sampling Techniques", 1977, section 5A.12. Neighbors are taken
    /// along the edge of a shadow rather than across: in the direction in which they differ less.
    pub fn variance(&self) -> f32 {
        let ([weights, _], mean) = (self.sums(), self.mean());
        if weights <= 0.0 {
            return 0.0;
        }
        let rest = |cell: u32| {
            let [weight, value] = self.cells[cell as usize];
            value - mean * weight
        };
        let squares = |step: u32, first: &dyn Fn(u32) -> u32| {
            let pairs = (0..self.cells.len() as u32 / 2).map(|pair| (rest(first(pair)), rest(first(pair) + step)));
            pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f32>()
        };
        let columns = self.columns;
        let along_rows = squares(1, &|pair| 2 * pair);
        let along_columns = match self.rows {
            1 => along_rows,
            _ => squares(columns, &|pair| pair / columns * 2 * columns + pair % columns),
        };
        NET * along_rows.min(along_columns) / (weights * weights)
    }

    /// Variance of the values themselves around their mean, all of the same weight.
    pub fn spread(&self) -> f32 {
        let mean = self.mean();
        let squares = self.cells.iter().map(|&[weight, value]| (value - mean * weight) * (value - mean * weight));
        squares.sum::<f32>() / (self.cells.len() - 1).max(1) as f32
    }

    /// The least value.
    pub fn least(&self) -> f32 {
        self.cells.iter().map(|cell| cell[1]).fold(f32::INFINITY, f32::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Sobol;
    use crate::math;

    /// An edge cuts the square: what is claimed over many sequences is the error that is made, to a factor of 1.6.
    #[test]
    fn variance_of_an_edge() {
        const SEEDS: u32 = 1000;
        for count in [4, 8, 16, 32, 64, 256] {
            for (slope, share) in [(0.2, 0.47), (0.7, 0.5), (1.0, 0.5), (-0.4, 0.62)] {
                let (mut claimed, mut made) = (0.0, 0.0);
                for seed in 0..SEEDS {
                    let (sequence, mut samples) = (Sobol::new(seed), Samples::new(count));
                    for square in (0..count).map(|k| sequence.square(k)) {
                        let is_lit = square.x + slope * (square.y - 0.5) < share;
                        samples.put(square, 1.0, if is_lit { 1.0 } else { 0.0 });
                    }
                    claimed += samples.variance();
                    made += (samples.mean() - share) * (samples.mean() - share);
                }
                let ratio = math::sqrt(claimed / made);
                assert!((1.0 / 1.6..1.6).contains(&ratio), "{ratio} of {count} samples at {slope}, {share}");
            }
        }
    }

    /// What is the same everywhere is certain; two values of the same share are half their distance from their mean.
    #[test]
    fn spread_and_least() {
        let (mut same, mut halves) = (Samples::new(16), Samples::new(16));
        let sequence = Sobol::new(5);
        for square in (0..16).map(|k| sequence.square(k)) {
            same.put(square, 0.5, 0.25);
            halves.put(square, 1.0, if square.y < 0.5 { 1.0 } else { 3.0 });
        }
        assert_eq!((same.mean(), same.variance(), same.spread()), (0.5, 0.0, 0.0));
        assert_eq!((halves.mean(), halves.least()), (2.0, 1.0));
        assert!((halves.spread() - 16.0 / 15.0).abs() < 1e-6);
    }
}
