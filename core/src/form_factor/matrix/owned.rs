//! Sparse rows that grow.

use alloc::vec;
use alloc::vec::Vec;

use super::{Matrix, MatrixError, SparseRows};
use crate::math::Real;

/// Sparse rows on the heap, pushed one after the other; [`SparseMatrix::rows`] lends them to all that works on rows.
#[derive(Clone, Debug, PartialEq)]
pub struct SparseMatrix<R> {
    starts: Vec<usize>,
    columns: Vec<u32>,
    factors: Vec<R>,
}

impl<R> Default for SparseMatrix<R> {
    fn default() -> Self {
        Self { starts: vec![0], columns: Vec::new(), factors: Vec::new() }
    }
}

impl<R: Real> SparseMatrix<R> {
    /// Adds the next row; columns must increase. Zeros are not stored.
    pub fn push_row(&mut self, row: impl IntoIterator<Item = (usize, R)>) {
        for (column, factor) in row.into_iter().filter(|&(_, factor)| factor != R::ZERO) {
            self.columns.push(column as u32);
            self.factors.push(factor);
        }
        self.starts.push(self.factors.len());
    }

    /// The rows, to be read and changed.
    ///
    /// # Errors
    ///
    /// Where the columns of a row do not increase or lead out of the matrix.
    pub fn rows(&mut self) -> Result<SparseRows<'_, R>, MatrixError> {
        SparseRows::new(&self.starts, &self.columns, &mut self.factors)
    }

    /// The same rows with a zero wherever the partner of an entry is missing, as [`enforce_reciprocity`] and
    /// [`repair_closure`] need it.
    ///
    /// [`enforce_reciprocity`]: super::enforce_reciprocity
    /// [`repair_closure`]: super::repair_closure
    ///
    /// # Errors
    ///
    /// As [`SparseMatrix::rows`].
    pub fn with_partners(&mut self) -> Result<Self, MatrixError> {
        let rows = self.rows()?;
        let mut partners: Vec<Vec<(u32, R)>> = vec![Vec::new(); rows.count()];
        for i in 0..rows.count() {
            for k in 0..rows.width(i) {
                let (j, factor) = rows.entry(i, k);
                partners[i].push((j as u32, factor));
                if rows.find(j, i).is_none() {
                    partners[j].push((i as u32, R::ZERO));
                }
            }
        }
        let mut all = Self::default();
        for row in &mut partners {
            row.sort_by_key(|&(column, _)| column);
            all.columns.extend(row.iter().map(|&(column, _)| column));
            all.factors.extend(row.iter().map(|&(_, factor)| factor));
            all.starts.push(all.factors.len());
        }
        Ok(all)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{closure, enforce_reciprocity};
    use super::*;
    use crate::form_factor::Bins;

    /// What only one of two patches sees of the other is shared between them.
    #[test]
    fn partners_are_added() {
        let mut matrix = SparseMatrix::default();
        matrix.push_row([(1, 0.5), (2, 0.25)]);
        matrix.push_row([(0, 0.5), (2, 0.0)]);
        matrix.push_row([]);
        let areas = [1.0; 3];
        let missing = enforce_reciprocity(&areas, &mut matrix.rows().unwrap());
        assert_eq!(missing, Err(MatrixError::NoPartner { row: 0, column: 2 }));
        let mut whole = matrix.with_partners().unwrap();
        let mut rows = whole.rows().unwrap();
        enforce_reciprocity(&areas, &mut rows).unwrap();
        assert_eq!((rows.row(0), rows.row(2)), ((&[1, 2][..], &[0.5, 0.125][..]), (&[0][..], &[0.125][..])));
        assert_eq!(closure(&rows, &[Bins::default(); 3]).unwrap().error, 0.875);
    }

    #[test]
    fn order_matters() {
        let mut matrix = SparseMatrix::default();
        matrix.push_row([(1, 0.5), (0, 0.5)]);
        matrix.push_row([]);
        assert_eq!(matrix.rows().err(), Some(MatrixError::Order { row: 0 }));
    }
}
