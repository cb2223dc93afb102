//! A ratio of sums over a stratified square, and how far it may be off.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec2;

use crate::math;

/// Variance of a net over that of a grid with one point in each cell, where an edge cuts the square: nets are stratified
/// in strips too. Measured over edges of all directions for 4 to 256 points: between 0.27 and 1; an edge parallel to a
/// side has less than a tenth of what is claimed.
const NET: f32 = 0.5;

/// Samples at points of the unit square of which a power of two fills a grid, one in each cell: a `(0, m, 2)` net.
///
/// Their mean is `sum of values / sum of weights`.
#[derive(Default)]
pub(super) struct Samples {
    list: Vec<(Vec2, [f32; 2])>,
    /// Whether cells are columns of the square instead of a grid.
    layout: Cells,
}

#[derive(Clone, Copy, Default)]
enum Cells {
    #[default]
    Grid,
    Columns,
}

impl Samples {
    /// None yet, of which only the first coordinates tell where they belong.
    pub fn line() -> Self {
        Self { list: Vec::new(), layout: Cells::Columns }
    }

    /// Adds the sample at a point of the unit square.
    pub fn put(&mut self, square: Vec2, weight: f32, value: f32) {
        self.list.push((square, [weight, value]));
    }

    /// How many there are.
    pub fn count(&self) -> u32 {
        self.list.len() as u32
    }

    fn values(&self) -> impl Iterator<Item = [f32; 2]> {
        self.list.iter().map(|(_, sample)| *sample)
    }

    fn sums(&self) -> [f32; 2] {
        self.values().fold([0.0; 2], |sums, sample| [sums[0] + sample[0], sums[1] + sample[1]])
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
    /// along the edge of a shadow rather than across: in the direction in which they differ less. Where all of them agree
    /// by chance the other half of the estimate remains: an edge crosses about `sqrt(n)` of `n` cells, so that a grid has
    /// `1 / sqrt(n)` of the variance of `n` random samples.
    pub fn variance(&self) -> f32 {
        let ([weights, _], mean) = (self.sums(), self.mean());
        if weights <= 0.0 {
            return 0.0;
        }
        let bits = self.count().next_power_of_two().trailing_zeros();
        let (column_bits, factor) = match self.layout {
            Cells::Grid => (bits.div_ceil(2), NET),
            Cells::Columns => (bits, 1.0),
        };
        let (columns, rows) = (1_usize << column_bits, 1_usize << (bits - column_bits));
        let mut rests = vec![0.0; columns * rows];
        for &(square, [weight, value]) in &self.list {
            let (column, row) = ((square.x * columns as f32) as usize, (square.y * rows as f32) as usize);
            rests[row.min(rows - 1) * columns + column.min(columns - 1)] += value - mean * weight;
        }
        let squares = |step: usize, first: &dyn Fn(usize) -> usize| {
            let pairs = (0..rests.len() / 2).map(|pair| rests[first(pair)] - rests[first(pair) + step]);
            pairs.map(|difference| difference * difference).sum::<f32>()
        };
        let along_rows = squares(1, &|pair| 2 * pair);
        let along_columns = match rows {
            1 => along_rows,
            _ => squares(columns, &|pair| pair / columns * 2 * columns + pair % columns),
        };
        let pairs = factor * along_rows.min(along_columns);
        let noise = match self.layout {
            Cells::Grid => {
                let squares: f32 = rests.iter().map(|rest| rest * rest).sum();
                0.5 * (pairs + squares / math::sqrt(rests.len() as f32))
            }
            Cells::Columns => pairs,
        };
        noise / (weights * weights)
    }

    /// Variance of the values themselves around their mean, all of the same weight.
    pub fn spread(&self) -> f32 {
        let mean = self.mean();
        let squares = self.values().map(|[weight, value]| (value - mean * weight) * (value - mean * weight));
        squares.sum::<f32>() / self.list.len().saturating_sub(1).max(1) as f32
    }

    /// The least value.
    pub fn least(&self) -> f32 {
        self.values().map(|[_, value]| value).fold(f32::INFINITY, f32::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Sobol;

    /// An edge cuts the square: what is claimed over many sequences is the error that is made, to a factor of 1.8.
    #[test]
    fn variance_of_an_edge() {
        const SEEDS: u32 = 1000;
        for count in [4, 8, 16, 32, 64, 256] {
            for (slope, share) in [(0.2, 0.47), (0.7, 0.5), (1.0, 0.5), (-0.4, 0.62)] {
                let (mut claimed, mut made) = (0.0, 0.0);
                for seed in 0..SEEDS {
                    let (sequence, mut samples) = (Sobol::new(seed), Samples::default());
                    for square in (0..count).map(|k| sequence.square(k)) {
                        let is_lit = square.x + slope * (square.y - 0.5) < share;
                        samples.put(square, 1.0, if is_lit { 1.0 } else { 0.0 });
                    }
                    claimed += samples.variance();
                    made += (samples.mean() - share) * (samples.mean() - share);
                }
                let ratio = math::sqrt(claimed / made);
                assert!((1.0 / 1.8..1.8).contains(&ratio), "{ratio} of {count} samples at {slope}, {share}");
            }
        }
    }

    /// What is the same everywhere is certain; two values of the same share are half their distance from their mean.
    #[test]
    fn spread_and_least() {
        let (mut same, mut halves) = (Samples::default(), Samples::default());
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
