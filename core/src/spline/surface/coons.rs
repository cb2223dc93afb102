//! Coons patches: surfaces that fill four curves.

use alloc::vec;

use super::compatible::compatible;
use super::extrusion::between;
use super::{Direction, OwnedSurface, SurfacePoint};
use crate::math::Real;
use crate::spline::{BSpline, OwnedBSpline, SplineError};

/// How far corners may lie apart, in the size of the patch.
const APART: f64 = 1e-5;

/// The bilinearly blended surface between four curves: `bottom` and `top` along `u`, `left` and `right` along `v`.
///
/// The ruled surface between each pair, added, less the bilinear surface through the corners, all with the same degrees
/// and knots. Coons 1967; Farin, "Curves and Surfaces for CAGD", chapter 22. Rational curves are blended with their
/// weights.
///
/// # Errors
///
/// Where curves do not meet at a corner, with the same weight, or a weight inside would not be positive.
pub fn coons<P: SurfacePoint>([bottom, right, top, left]: [&BSpline<P>; 4]) -> Result<OwnedSurface<P>, SplineError> {
    let [along, across] =
        [[bottom, top], [left, right]].map(|pair| compatible(pair.map(OwnedBSpline::clamped).to_vec()));
    check_corners(&along, &across)?;
    let ends = |k: usize| {
        let points = &along[k].points;
        OwnedBSpline { points: vec![points[0], points[points.len() - 1]], ..line() }
    };
    let bilinear = between(vec![ends(0), ends(1)])?;
    let from_bottom = between(along)?;
    let from_left = between(across)?.transposed();
    OwnedSurface::blended(from_bottom, from_left, bilinear)
}

/// The knots of a straight line, without points.
fn line<P: SurfacePoint>() -> OwnedBSpline<P> {
    let (zero, one) = (P::Scalar::ZERO, P::Scalar::ONE);
    OwnedBSpline { knots: vec![zero, zero, one, one], degree: 1, points: vec![] }
}

fn check_corners<P: SurfacePoint>(along: &[OwnedBSpline<P>], across: &[OwnedBSpline<P>]) -> Result<(), SplineError> {
    let corner = |curves: &[OwnedBSpline<P>], k: usize, end: usize| {
        let points = &curves[k].points;
        points[end * (points.len() - 1)]
    };
    let size =
        (corner(along, 1, 1) - corner(along, 0, 0)).length() + (corner(along, 1, 0) - corner(along, 0, 1)).length();
    for index in 0..4 {
        let [i, j] = [index % 2, index / 2];
        let distance = (corner(along, j, i) - corner(across, i, j)).length();
        if distance.partial_cmp(&(size * P::Scalar::from_f64(APART))).is_none_or(core::cmp::Ordering::is_gt) {
            return Err(SplineError::Corner { index, distance: distance.to_f64() });
        }
    }
    Ok(())
}

impl<P: SurfacePoint> OwnedSurface<P> {
    /// The sum of two surfaces over the unit square less a third one.
    fn blended(mut a: Self, mut b: Self, mut c: Self) -> Result<Self, SplineError> {
        for direction in [Direction::U, Direction::V] {
            [a, b, c] = Self::alike([a, b, c], direction);
        }
        let others = b.points().iter().zip(c.points());
        let points: alloc::vec::Vec<P> = a.points().iter().zip(others).map(|(&a, (&b, &c))| a + b - c).collect();
        a.set_points(&points)?;
        Ok(a)
    }
}
