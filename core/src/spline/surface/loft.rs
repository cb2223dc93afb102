//! Lofted surfaces: a skin over curves, or over rows of points.

use alloc::vec;
use alloc::vec::Vec;

use super::compatible::compatible;
use super::{OwnedSurface, SurfacePoint};
use crate::math::{Real, VectorSpace as _};
use crate::spline::control_point::check_highest;
use crate::spline::{
    BSpline, ControlPoint, KnotVector, OwnedBSpline, SplineError, averaged_knots, band, chord_times, interpolate,
};

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
    check_highest(degree)?;
    if curves.len() < 2 || degree == 0 || degree >= curves.len() {
        return Err(SplineError::PointCount { points: curves.len(), wanted: degree.max(1) + 1 });
    }
    let curves = compatible(curves.iter().map(OwnedBSpline::clamped).collect());
    let parameters = parameters(&curves)?;
    let mut knots = vec![P::Scalar::ZERO; curves.len() + degree + 1];
    averaged_knots(&parameters, degree, &mut knots)?;
    let vector = KnotVector::new(&knots, degree)?;
    let mut scratch = vec![P::Scalar::ZERO; band(curves.len(), degree)];
    let (mut column, mut solved) = (vec![P::default(); curves.len()], vec![P::default(); curves.len()]);
    let mut rows = curves.clone();
    for i in 0..curves[0].points.len() {
        column.iter_mut().zip(&curves).for_each(|(to, curve)| *to = curve.points[i]);
        interpolate(vector, &parameters, &column, &mut scratch, &mut solved)?;
        rows.iter_mut().zip(&solved).for_each(|(row, &point)| row.points[i] = point);
    }
    OwnedSurface::from_rows(rows, knots, degree)
}

impl<V: SurfacePoint + ControlPoint<Point = V>> OwnedSurface<V> {
    /// The surface of degrees along `u` and `v` through rows of points, each with so many columns.
    ///
    /// All points of a column have the same `u`, all of a row the same `v`: those that follow the mean distances between
    /// columns and between rows. Piegl and Tiller, "The NURBS Book", section 9.2.5.
    ///
    /// # Errors
    ///
    /// Where the points do not fill rows, there are not more columns and rows than the degrees, or two rows or columns that
    /// follow each other are the same.
    pub fn through(points: &[V], columns: usize, [p, q]: [usize; 2]) -> Result<Self, SplineError> {
        check_highest(p)?;
        if columns == 0 || !points.len().is_multiple_of(columns) {
            return Err(SplineError::Ragged { points: points.len(), columns });
        }
        let (mut parameters, mut of_row) = (vec![V::Scalar::ZERO; columns], vec![V::Scalar::ZERO; columns]);
        for row in points.chunks_exact(columns) {
            chord_times(row, V::Scalar::ONE, &mut of_row)?;
            parameters.iter_mut().zip(&of_row).for_each(|(sum, &time)| *sum += time);
        }
        let mut knots = vec![V::Scalar::ZERO; columns + p + 1];
        averaged_knots(&parameters, p, &mut knots)?;
        let mut scratch = vec![V::Scalar::ZERO; band(columns, p)];
        let mut rows = Vec::new();
        for row in points.chunks_exact(columns) {
            let mut control_points = vec![V::default(); columns];
            interpolate(KnotVector::new(&knots, p)?, &parameters, row, &mut scratch, &mut control_points)?;
            rows.push(OwnedBSpline::new(knots.clone(), p, control_points)?);
        }
        loft(&rows.iter().map(OwnedBSpline::curve).collect::<Vec<_>>(), q)
    }
}

/// From 0 to 1, at the mean over all control points of the share of the way that is done.
fn parameters<P: SurfacePoint>(curves: &[OwnedBSpline<P>]) -> Result<Vec<P::Scalar>, SplineError> {
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
