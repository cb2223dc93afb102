//! Lofted surfaces: a skin over curves.

use alloc::vec;
use alloc::vec::Vec;

use super::compatible::compatible;
use super::{OwnedSurface, SurfacePoint};
use crate::math::{Real, VectorSpace as _};
use crate::spline::{BSpline, KnotVector, OwnedBSpline, SplineError, averaged_knots, band, interpolate};

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
