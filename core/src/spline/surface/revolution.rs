//! Surfaces of revolution: curves that turn around an axis.

use alloc::vec::Vec;

use super::{OwnedSurface, SurfacePoint};
use crate::math::{Real, Vector, VectorSpace};
use crate::spline::{BSpline, Homogeneous, OwnedBSpline, SplineError};

/// A line in space with a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis<V> {
    /// A point on it.
    pub origin: V,
    /// Of any length but zero.
    pub direction: V,
}

/// The surface over which a curve sweeps that turns around an axis by an angle in radians, at most a full turn either
/// way; `u` runs around the axis, `v` along the curve.
///
/// The circles are exact: rational arcs of at most a quarter, of degree 2. Piegl and Tiller, "The NURBS Book", section
/// 8.5. For an axis that points up and a curve that rises, the front is outside.
///
/// # Errors
///
/// Where the axis has no direction, or the angle is zero or more than a full turn.
pub fn revolution<P: SurfacePoint>(
    curve: &BSpline<P>,
    axis: Axis<P::Point>,
    angle: P::Scalar,
) -> Result<OwnedSurface<Homogeneous<P::Point>>, SplineError> {
    let direction = axis.direction.normalize_or_zero();
    let full = P::Scalar::PI + P::Scalar::PI;
    if !(direction.length() > P::Scalar::ZERO && axis.origin.is_finite()) {
        return Err(SplineError::NoAxis);
    }
    if !(angle.abs() > P::Scalar::ZERO && angle.abs() <= full) {
        return Err(SplineError::Turn { angle: angle.to_f64() });
    }
    let profile = OwnedBSpline::clamped(curve);
    let arcs = Arcs::new(angle);
    let points = profile.points.iter().flat_map(|point| arcs.around(*point, axis.origin, direction)).collect();
    OwnedSurface::new([arcs.knots(), profile.knots], [2, profile.degree], points)
}

/// A turn in equal parts of at most a quarter.
struct Arcs<R> {
    count: usize,
    angle: R,
    is_closed: bool,
}

impl<R: Real> Arcs<R> {
    fn new(angle: R) -> Self {
        let quarters = angle.abs().to_f64() / core::f64::consts::FRAC_PI_2;
        // Rounding shall not make a fifth quarter.
        let count = (1..4).find(|&count| quarters <= count as f64 * (1.0 + 1e-6)).unwrap_or(4);
        Self { count, angle, is_closed: quarters >= 4.0 * (1.0 - 1e-7) }
    }

    /// Two of each inner knot, at whole numbers.
    fn knots(&self) -> Vec<R> {
        let inner = (0..=self.count).flat_map(|k| [R::from_usize(k); 2]);
        [R::ZERO].into_iter().chain(inner).chain([R::from_usize(self.count)]).collect()
    }

    /// The control points of the circle through a point; those between the ends of arcs lie on their tangents.
    fn around<P: SurfacePoint<Scalar = R>>(
        &self,
        point: P,
        origin: P::Point,
        direction: P::Point,
    ) -> impl Iterator<Item = Homogeneous<P::Point>> + '_ {
        let (position, weight) = (point.project(), point.weight());
        let height = direction * (position - origin).dot(direction);
        let x = position - origin - height;
        let y = direction.cross(x);
        let half = self.angle.to_f64() / (2 * self.count) as f64;
        let cosine = R::from_f64(Real::cos(half));
        (0..=2 * self.count).map(move |k| {
            if k == 0 || (k == 2 * self.count && self.is_closed) {
                return Homogeneous::new(position, weight);
            }
            let (sin, cos) = (R::from_f64(Real::sin(half * k as f64)), R::from_f64(Real::cos(half * k as f64)));
            let on_circle = x * cos + y * sin;
            match k % 2 {
                0 => Homogeneous::new(origin + height + on_circle, weight),
                _ => Homogeneous::new(origin + height + on_circle / cosine, weight * cosine),
            }
        })
    }
}
