//! Rows that store only what is seen.

use super::{Matrix, MatrixError, check_areas, check_length, is_share};
use crate::math::Real;

/// The form factors that are not zero, row after row, on the caller's slices.
///
/// Row `i` has the entries `starts[i]..starts[i + 1]`; their columns increase.
#[derive(Debug)]
pub struct SparseRows<'a, R> {
    starts: &'a [usize],
    columns: &'a [u32],
    factors: &'a mut [R],
}

impl<'a, R: Real> SparseRows<'a, R> {
    /// The matrix that stands in these slices; `starts` has one entry more than there are rows.
    ///
    /// # Errors
    ///
    /// Where starts decrease or lead out of the entries, or columns do not increase within a row or lead out of the matrix.
    pub fn new(starts: &'a [usize], columns: &'a [u32], factors: &'a mut [R]) -> Result<Self, MatrixError> {
        let count = starts.len().saturating_sub(1);
        check_length("factors", factors.len(), columns.len())?;
        for row in 0..count {
            let columns = columns.get(starts[row]..starts[row + 1]).ok_or(MatrixError::Order { row })?;
            let leads_out = columns.last().is_some_and(|&last| last as usize >= count);
            if leads_out || !columns.is_sorted_by(|a, b| a < b) {
                return Err(MatrixError::Order { row });
            }
        }
        Ok(Self { starts, columns, factors })
    }

    /// The columns and the form factors of a row.
    pub fn row(&self, i: usize) -> (&[u32], &[R]) {
        let entries = self.starts[i]..self.starts[i + 1];
        (&self.columns[entries.clone()], &self.factors[entries])
    }
}

impl<R: Real> Matrix for SparseRows<'_, R> {
    type Scalar = R;

    fn count(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    fn width(&self, i: usize) -> usize {
        self.starts[i + 1] - self.starts[i]
    }

    fn entry(&self, i: usize, k: usize) -> (usize, R) {
        let index = self.starts[i] + k;
        (self.columns[index] as usize, self.factors[index])
    }

    fn set(&mut self, i: usize, k: usize, factor: R) {
        self.factors[self.starts[i] + k] = factor;
    }

    fn find(&self, i: usize, j: usize) -> Option<usize> {
        self.row(i).0.binary_search(&(j as u32)).ok()
    }
}

/// Fills sparse rows from `pair(i, j) = F_ij`, which is asked for `i < j` only; the others follow by reciprocity. Returns
/// how many entries there are. Pairs that do not see each other are not stored.
///
/// `starts` gets one entry more than there are areas; `columns` and `factors` are as long as there is room.
///
/// # Errors
///
/// Where an area is not positive, a factor is unsuitable, or the room is used up.
pub fn fill_sparse<R: Real>(
    areas: &[R],
    starts: &mut [usize],
    columns: &mut [u32],
    factors: &mut [R],
    mut pair: impl FnMut(usize, usize) -> R,
) -> Result<usize, MatrixError> {
    let count = areas.len();
    check_areas(areas, count)?;
    check_length("starts", starts.len(), count + 1)?;
    check_length("factors", factors.len(), columns.len())?;
    let mut length = 0;
    starts[0] = 0;
    for i in 0..count {
        for j in (0..count).filter(|&j| j != i) {
            let factor = if j < i {
                let row = starts[j]..starts[j + 1];
                let back = columns[row.clone()].binary_search(&(i as u32));
                back.map_or(R::ZERO, |k| factors[row.start + k] * areas[j] / areas[i])
            } else {
                pair(i, j)
            };
            if !is_share(factor) {
                return Err(MatrixError::Factor { row: i, column: j });
            }
            if factor > R::ZERO {
                let full = MatrixError::Full { row: i, capacity: factors.len() };
                *columns.get_mut(length).ok_or(full)? = j as u32;
                factors[length] = factor;
                length += 1;
            }
        }
        starts[i + 1] = length;
    }
    Ok(length)
}
