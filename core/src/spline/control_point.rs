//! What curves and surfaces are made of: points, or points with weights.

use glam::{DVec2, DVec3, DVec4, Vec2, Vec3, Vec3A, Vec4};

use super::{Jet, MAX_DEGREE, SplineError};
use crate::math::{Real, VectorSpace};

/// A point that curves are computed with: a number or a vector, or a [`Homogeneous`](super::Homogeneous) point.
pub trait ControlPoint: VectorSpace {
    /// Where the point lies.
    type Point: VectorSpace<Scalar = Self::Scalar>;

    /// The point in the space in which the curve lies.
    fn project(self) -> Self::Point;
    /// The point with its derivatives there, given both in the space of the control points.
    fn project_jet(jet: Jet<Self>) -> Jet<Self::Point>;
    /// The derivatives of order 0, 1, 2 ... there, given those in the space of the control points.
    ///
    /// As many as both slices have.
    fn project_derivatives(derivatives: &[Self], projected: &mut [Self::Point]);
    /// The weight; 1 for a point without.
    fn weight(self) -> Self::Scalar;
}

macro_rules! plain {
    ($($vector:ident),*) => {$(
        impl ControlPoint for $vector {
            type Point = Self;

            #[inline(always)]
            fn project(self) -> Self {
                self
            }
            #[inline(always)]
            fn project_jet(jet: Jet<Self>) -> Jet<Self> {
                jet
            }
            #[inline]
            fn project_derivatives(derivatives: &[Self], projected: &mut [Self]) {
                projected.iter_mut().zip(derivatives).for_each(|(to, &from)| *to = from);
            }
            #[inline(always)]
            fn weight(self) -> Self::Scalar {
                1.0
            }
        }
    )*};
}

plain!(f32, f64, Vec2, Vec3, Vec3A, Vec4, DVec2, DVec3, DVec4);

/// Whether as many points make a curve with one polynomial.
pub(super) fn check_degree(count: usize) -> Result<(), SplineError> {
    match count {
        0 => Err(SplineError::Empty),
        _ if count > MAX_DEGREE + 1 => Err(SplineError::Degree { degree: count - 1 }),
        _ => Ok(()),
    }
}

/// Whether a degree is not above the highest one; asked before anything is counted with it.
pub(super) fn check_highest(degree: usize) -> Result<(), SplineError> {
    if degree <= MAX_DEGREE { Ok(()) } else { Err(SplineError::Degree { degree }) }
}

/// Whether all coordinates are finite.
pub(super) fn check_finite<V: VectorSpace>(points: &[V]) -> Result<(), SplineError> {
    match points.iter().position(|point| !point.is_finite()) {
        Some(index) => Err(SplineError::NotFinite { index }),
        None => Ok(()),
    }
}

/// Whether all coordinates are finite, before and after projection, and all weights positive.
pub(super) fn check_points<P: ControlPoint>(points: &[P]) -> Result<(), SplineError> {
    check_finite(points)?;
    let zero = P::Scalar::ZERO;
    if let Some(index) = points.iter().position(|point| point.weight() <= zero) {
        return Err(SplineError::Weight { index, weight: points[index].weight().to_f64() });
    }
    match points.iter().position(|point| !point.project().is_finite()) {
        Some(index) => Err(SplineError::NotFinite { index }),
        None => Ok(()),
    }
}
