//! A mean of independent values, and how far it is off.

use crate::math;
use crate::scatter::Colored;

/// The mean of values that come one after the other, with its standard error.
///
/// Welford, "Note on a method for calculating corrected sums of squares and products", Technometrics 1962.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate<S> {
    /// How many values there were.
    pub count: u32,
    /// Their mean; zero where there was none.
    pub mean: S,
    /// Sum of their squared distances from the mean.
    squares: S,
}

impl<S: Colored> Estimate<S> {
    /// Takes in one more value.
    pub fn add(&mut self, value: S) {
        self.count += 1;
        let before = value - self.mean;
        self.mean += before * (1.0 / self.count as f32);
        self.squares += before * (value - self.mean);
    }

    /// Standard deviation of the mean in each band; infinite for less than two values.
    pub fn standard_error(&self) -> S {
        if self.count < 2 {
            return S::splat(f32::INFINITY);
        }
        let scale = 1.0 / (self.count as f32 * (self.count - 1) as f32);
        self.squares.zip(S::default(), |squares, _| math::sqrt((squares * scale).max(0.0)))
    }
}
