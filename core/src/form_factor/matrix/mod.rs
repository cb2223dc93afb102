//! The matrix of form factors: dense or sparse rows, their reciprocity and their closure.
//!
//! Two laws tie the form factors of a scene together: reciprocity, `A_i F_ij = A_j F_ji`, and closure, that a row sums
//! to one with its [`Bins`]. Reciprocity saves half of the work ([`fill_dense`], [`fill_sparse`]); sampled factors obey
//! neither and are made to by [`enforce_reciprocity`] and [`repair_closure`]. All of it works on the caller's memory.

mod closure;
mod dense;
mod error;
#[cfg(feature = "alloc")]
mod owned;
mod sparse;
mod symmetric;

pub use closure::*;
pub use dense::*;
pub use error::*;
#[cfg(feature = "alloc")]
pub use owned::*;
pub use sparse::*;
pub use symmetric::*;

use crate::math::Real;

/// Rows of form factors that can be changed, dense or sparse.
pub trait Matrix {
    /// Single or double precision.
    type Scalar: Real;

    /// The number of rows, and of columns.
    fn count(&self) -> usize;
    /// How many entries of row `i` are stored.
    fn width(&self, i: usize) -> usize;
    /// The column of entry `k` of row `i`, and `F_ij`. Columns increase with `k`.
    fn entry(&self, i: usize, k: usize) -> (usize, Self::Scalar);
    /// Changes entry `k` of row `i`.
    fn set(&mut self, i: usize, k: usize, factor: Self::Scalar);
    /// Which entry of row `i` stands in column `j`, if one is stored.
    fn find(&self, i: usize, j: usize) -> Option<usize>;

    /// The sum of a row.
    fn row_sum(&self, i: usize) -> Self::Scalar {
        (0..self.width(i)).map(|k| self.entry(i, k).1).sum()
    }
}

/// Makes `A_i F_ij = A_j F_ji` hold to rounding: both become the mean of the two.
///
/// `areas` has one positive entry for each row.
///
/// # Errors
///
/// Where an area or a factor is unsuitable, or a sparse row lacks the partner of an entry that is not zero. Nothing is
/// changed then.
pub fn enforce_reciprocity<M: Matrix>(areas: &[M::Scalar], matrix: &mut M) -> Result<(), MatrixError> {
    check(areas, matrix)?;
    check_partners(matrix)?;
    let half = M::Scalar::from_f64(0.5);
    for i in 0..matrix.count() {
        for k in 0..matrix.width(i) {
            let (j, factor) = matrix.entry(i, k);
            if let Some(back) = matrix.find(j, i).filter(|_| i < j) {
                let exchange = half * (areas[i] * factor + areas[j] * matrix.entry(j, back).1);
                matrix.set(i, k, exchange / areas[i]);
                matrix.set(j, back, exchange / areas[j]);
            }
        }
    }
    Ok(())
}

/// The largest `|A_i F_ij - A_j F_ji|`, relative to the smaller area: how far a factor may be from what reciprocity asks.
///
/// # Errors
///
/// Where an area or a factor is unsuitable.
pub fn reciprocity_error<M: Matrix>(areas: &[M::Scalar], matrix: &M) -> Result<M::Scalar, MatrixError> {
    check(areas, matrix)?;
    let mut largest = M::Scalar::ZERO;
    for i in 0..matrix.count() {
        for k in 0..matrix.width(i) {
            let (j, factor) = matrix.entry(i, k);
            let partner = matrix.find(j, i).map_or(M::Scalar::ZERO, |back| matrix.entry(j, back).1);
            largest = largest.max((areas[i] * factor - areas[j] * partner).abs() / areas[i].min(areas[j]));
        }
    }
    Ok(largest)
}

/// Areas are positive, factors not negative, and all are finite.
fn check<M: Matrix>(areas: &[M::Scalar], matrix: &M) -> Result<(), MatrixError> {
    check_areas(areas, matrix.count())?;
    for row in 0..matrix.count() {
        for k in 0..matrix.width(row) {
            let (column, factor) = matrix.entry(row, k);
            if !is_share(factor) {
                return Err(MatrixError::Factor { row, column });
            }
        }
    }
    Ok(())
}

/// Each entry that is not zero has a partner that can be set.
fn check_partners<M: Matrix>(matrix: &M) -> Result<(), MatrixError> {
    for row in 0..matrix.count() {
        for k in 0..matrix.width(row) {
            let (column, factor) = matrix.entry(row, k);
            if factor != M::Scalar::ZERO && matrix.find(column, row).is_none() {
                return Err(MatrixError::NoPartner { row, column });
            }
        }
    }
    Ok(())
}

fn check_areas<R: Real>(areas: &[R], count: usize) -> Result<(), MatrixError> {
    check_length("areas", areas.len(), count)?;
    match areas.iter().position(|&area| area == R::ZERO || !is_share(area)) {
        Some(index) => Err(MatrixError::Area { index }),
        None => Ok(()),
    }
}

fn check_length(what: &'static str, length: usize, expected: usize) -> Result<(), MatrixError> {
    if length == expected { Ok(()) } else { Err(MatrixError::Length { what, length, expected }) }
}

fn is_share<R: Real>(factor: R) -> bool {
    factor >= R::ZERO && factor < R::INFINITY
}
