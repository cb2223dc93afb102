//! Lofted surfaces: a skin over curves.

use alloc::vec;
use alloc::vec::Vec;

use super::owned_curve::compatible;
use super::{OwnedCurve, OwnedSurface, SurfacePoint};
use crate::math::{Real, VectorSpace as _};
use crate::spline::{BSpline, KnotVector, SplineError};

/// The surface through curves, one after the other, of a degree along `v` that is at most one less than their number.
///
/// The curves get the same degree and the same knots; their control points are interpolated at parameters that follow
/// the mean distances between curves. Piegl and Tiller, "The NURBS Book", section 10.3.
///
/// # Errors
///
/// Where there are less than two curves, the degree is 0 or as large as their number, or two that follow each other are
/// the same; also where interpolated weights are not positive.
pub fn loft<P: SurfacePoint>(curves: &[BSpline<P>], degree: usize) -> Result<OwnedSurface<P>, SplineError> {
    if curves.len() < 2 || degree == 0 || degree >= curves.len() {
        return Err(SplineError::PointCount { points: curves.len(), wanted: degree.max(1) + 1 });
    }
    let curves = compatible(curves.iter().map(OwnedCurve::new).collect());
    let parameters = parameters(&curves)?;
    let knots = averaged_knots(&parameters, degree);
    let matrix = collocation(&KnotVector::new(&knots, degree)?, &parameters);
    let mut rows: Vec<Vec<P>> = curves.iter().map(|curve| curve.points.clone()).collect();
    solve(matrix, &mut rows)?;
    let first = &curves[0];
    let lines = rows.into_iter().map(|points| OwnedCurve { knots: first.knots.clone(), degree: first.degree, points });
    OwnedSurface::from_rows(lines.collect(), knots, degree)
}

/// From 0 to 1, at the mean over all control points of the share of the way that is done.
fn parameters<P: SurfacePoint>(curves: &[OwnedCurve<P>]) -> Result<Vec<P::Scalar>, SplineError> {
    let mut distances = vec![P::Scalar::ZERO];
    for (index, pair) in curves.windows(2).enumerate() {
        let pairs = pair[0].points.iter().zip(&pair[1].points);
        let distance = pairs.map(|(a, b)| (b.project() - a.project()).length()).sum::<P::Scalar>();
        if distance.partial_cmp(&P::Scalar::ZERO).is_none_or(core::cmp::Ordering::is_le) {
            return Err(SplineError::Singular { index: index + 1 });
        }
        distances.push(distances[index] + distance);
    }
    let whole = distances[distances.len() - 1];
    Ok(distances.into_iter().map(|distance| distance / whole).collect())
}

/// Inner knots are means of as many parameters as the degree: equation 9.8 of the book.
fn averaged_knots<R: Real>(parameters: &[R], degree: usize) -> Vec<R> {
    let inner = parameters[1..parameters.len() - 1].windows(degree);
    let means = inner.map(|window| window.iter().copied().sum::<R>() / R::from_usize(degree));
    vec![R::ZERO; degree + 1].into_iter().chain(means).chain(vec![R::ONE; degree + 1]).collect()
}

/// The basis functions at the parameters.
fn collocation<R: Real>(knots: &KnotVector<R>, parameters: &[R]) -> Vec<Vec<R>> {
    let row = |&t: &R| {
        let mut row = vec![R::ZERO; parameters.len()];
        let span = knots.span(t);
        let basis = super::basis::basis_at::<_, 1>(knots, span, t)[0];
        row[span - knots.degree()..=span].copy_from_slice(&basis[..=knots.degree()]);
        row
    };
    parameters.iter().map(row).collect()
}

/// Gauss elimination. No pivoting is needed: the matrix is totally positive (de Boor, "A Practical Guide to Splines").
fn solve<P: SurfacePoint>(mut matrix: Vec<Vec<P::Scalar>>, rows: &mut [Vec<P>]) -> Result<(), SplineError> {
    for k in 0..rows.len() {
        let pivot = matrix[k][k];
        if pivot.partial_cmp(&P::Scalar::ZERO).is_none_or(core::cmp::Ordering::is_le) {
            return Err(SplineError::Singular { index: k });
        }
        for i in k + 1..rows.len() {
            let factor = matrix[i][k] / pivot;
            if factor != P::Scalar::ZERO {
                let (above, below) = matrix.split_at_mut(i);
                below[0].iter_mut().zip(&above[k]).for_each(|(a, &b)| *a -= factor * b);
                subtract(rows, i, k, factor);
            }
        }
    }
    for k in (0..rows.len()).rev() {
        (k + 1..rows.len()).for_each(|j| subtract(rows, k, j, matrix[k][j]));
        let pivot = matrix[k][k];
        rows[k].iter_mut().for_each(|point| *point = *point / pivot);
    }
    Ok(())
}

/// Row `i` less a multiple of row `j`.
fn subtract<P: SurfacePoint>(rows: &mut [Vec<P>], i: usize, j: usize, factor: P::Scalar) {
    for column in 0..rows[i].len() {
        let other = rows[j][column];
        rows[i][column] = rows[i][column] - other * factor;
    }
}
