//! Sparse rows of form factors for the solvers.

use super::FormFactors;
use crate::form_factor::SparseRows;
use crate::math::Real;

impl<R: Real> FormFactors for SparseRows<'_, R> {
    type Scalar = R;

    fn row(&self, i: usize, mut entry: impl FnMut(usize, R)) {
        let (columns, factors) = SparseRows::row(self, i);
        columns.iter().zip(factors).for_each(|(&j, &factor)| entry(j as usize, factor));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::form_factor::{DenseRows, fill_dense, fill_sparse};

    /// Two walls that see each other and a third one that sees the sky only.
    #[test]
    fn rows_are_read_as_they_are() {
        let (mut starts, mut columns, mut factors) = ([0; 4], [0; 2], [0.0; 2]);
        let pair = |i: usize, j: usize| if i + j == 1 { 0.5_f64 } else { 0.0 };
        fill_sparse(&[1.0, 2.0, 1.0], &mut starts, &mut columns, &mut factors, pair).unwrap();
        let rows = SparseRows::new(&starts, &columns, &mut factors).unwrap();
        assert_eq!(rows.receive(1, &[4.0, 0.0, 0.0]), 1.0);
        assert_eq!((rows.receive(0, &[0.0, 4.0, 0.0]), rows.receive(2, &[1.0; 3])), (2.0, 0.0));
        assert_eq!(rows.row_sum(1), 0.25);
    }

    /// The same walls with their zeros.
    #[test]
    fn dense_rows_are_read_as_they_are() {
        let mut factors = [9.0_f64; 9];
        let mut rows = DenseRows::new(3, &mut factors).unwrap();
        fill_dense(&[1.0, 2.0, 1.0], &mut rows, |i, j| if i + j == 1 { 0.5 } else { 0.0 }).unwrap();
        assert_eq!(rows.receive(1, &[4.0, 0.0, 0.0]), 1.0);
        assert_eq!((rows.receive(0, &[0.0, 4.0, 0.0]), rows.receive(2, &[1.0; 3])), (2.0, 0.0));
        assert_eq!(FormFactors::row_sum(&rows, 1), 0.25);
    }
}
