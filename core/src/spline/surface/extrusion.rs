//! Extrusions: curves that are moved.

use alloc::vec;
use alloc::vec::Vec;

use super::{OwnedSurface, SurfacePoint};
use crate::math::Real;
use crate::spline::{BSpline, OwnedBSpline, SplineError};

/// The surface over which a curve sweeps on its straight way `along` a vector; `u` runs along the curve.
///
/// # Errors
///
/// Where a coordinate is not finite.
pub fn extrusion<P: SurfacePoint>(curve: &BSpline<P>, along: P::Point) -> Result<OwnedSurface<P>, SplineError> {
    let first = OwnedBSpline::clamped(curve);
    let mut last = first.clone();
    last.points.iter_mut().for_each(|point| *point = point.moved(along));
    between(vec![first, last])
}

/// The surface over which the straight line sweeps that joins the points of two curves with the same share of their
/// domains; `u` runs along the curves, `v` from the first to the second.
///
/// The curves get the same degree and the same knots first.
///
/// # Errors
///
/// Where more than `degree + 1` knots are equal.
pub fn ruled<P: SurfacePoint>(first: &BSpline<P>, second: &BSpline<P>) -> Result<OwnedSurface<P>, SplineError> {
    between(super::compatible::compatible(vec![OwnedBSpline::clamped(first), OwnedBSpline::clamped(second)]))
}

/// Straight lines from the first to the second of two curves with the same knots.
pub(super) fn between<P: SurfacePoint>(curves: Vec<OwnedBSpline<P>>) -> Result<OwnedSurface<P>, SplineError> {
    let (zero, one) = (P::Scalar::ZERO, P::Scalar::ONE);
    OwnedSurface::from_rows(curves, vec![zero, zero, one, one], 1)
}
