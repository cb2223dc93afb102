//! A full square matrix.

use super::{Matrix, MatrixError, check_areas, check_length, is_share};
use crate::math::Real;

/// All form factors of `count` patches on the caller's slice, row after row: `F_ij` stands at `i x count + j`.
#[derive(Debug)]
pub struct DenseRows<'a, R> {
    count: usize,
    factors: &'a mut [R],
}

impl<'a, R: Real> DenseRows<'a, R> {
    /// A matrix of `count` rows with the factors that stand in the slice.
    ///
    /// # Errors
    ///
    /// Where the slice does not have `count x count` entries.
    pub fn new(count: usize, factors: &'a mut [R]) -> Result<Self, MatrixError> {
        check_length("factors", factors.len(), count.saturating_mul(count))?;
        Ok(Self { count, factors })
    }

    /// One row.
    pub fn row(&self, i: usize) -> &[R] {
        &self.factors[i * self.count..(i + 1) * self.count]
    }

    /// One row, to be filled.
    pub fn row_mut(&mut self, i: usize) -> &mut [R] {
        &mut self.factors[i * self.count..(i + 1) * self.count]
    }
}

impl<R: Real> Matrix for DenseRows<'_, R> {
    type Scalar = R;

    fn count(&self) -> usize {
        self.count
    }

    fn width(&self, _: usize) -> usize {
        self.count
    }

    fn entry(&self, i: usize, k: usize) -> (usize, R) {
        (k, self.factors[i * self.count + k])
    }

    fn set(&mut self, i: usize, k: usize, factor: R) {
        self.factors[i * self.count + k] = factor;
    }

    fn find(&self, _: usize, j: usize) -> Option<usize> {
        Some(j)
    }
}

/// Fills a matrix from `pair(i, j) = F_ij`, which is asked for `i < j` only; the others follow by reciprocity. Patches do
/// not see themselves.
///
/// # Errors
///
/// Where an area is not positive, or the number of areas or a factor is unsuitable.
pub fn fill_dense<R: Real>(
    areas: &[R],
    rows: &mut DenseRows<R>,
    mut pair: impl FnMut(usize, usize) -> R,
) -> Result<(), MatrixError> {
    let count = rows.count;
    check_areas(areas, count)?;
    for i in 0..count {
        rows.factors[i * count + i] = R::ZERO;
        for j in i + 1..count {
            let factor = pair(i, j);
            if !is_share(factor) {
                return Err(MatrixError::Factor { row: i, column: j });
            }
            rows.factors[i * count + j] = factor;
            rows.factors[j * count + i] = factor * areas[i] / areas[j];
        }
    }
    Ok(())
}
