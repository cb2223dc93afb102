//! Surfaces nearest to a grid of points.

use alloc::vec;
use alloc::vec::Vec;

use super::{OwnedSurface, SurfacePoint};
use crate::math::Real;
use crate::spline::{ControlPoint, KnotVector, SplineError, band, fit};

impl<V: SurfacePoint + ControlPoint<Point = V>> OwnedSurface<V> {
    /// The surface of given knots and degrees nearest to rows of points at given parameters, `[u, v]`: the sum of the
    /// squares of all distances is the least. Also the root of the mean of those squares.
    ///
    /// On a grid the best surface is the best fit across the rows to the best fits of the rows, since its equations are
    /// the product of those of the curves. Piegl and Tiller, "The NURBS Book", section 9.4.3.
    ///
    /// # Errors
    ///
    /// Where there are not as many points as both counts of parameters demand, and as [`KnotVector::new`] and [`fit`].
    pub fn near(
        knots: [Vec<V::Scalar>; 2],
        degrees: [usize; 2],
        parameters: [&[V::Scalar]; 2],
        points: &[V],
    ) -> Result<(Self, V::Scalar), SplineError> {
        let [us, vs] = parameters;
        if points.len() != us.len() * vs.len() {
            return Err(SplineError::PointCount { points: points.len(), wanted: us.len() * vs.len() });
        }
        let [along, across] = [0, 1].map(|k| KnotVector::new(&knots[k], degrees[k]));
        let (along, across) = (along?, across?);
        let rows = fitted(along, us, points)?;
        let columns = fitted(across, vs, &transposed(&rows, along.count()))?;
        let surface = Self::new(knots.clone(), degrees, transposed(&columns, across.count()))?;
        let mut found = vec![V::default(); points.len()];
        surface.surface().sample(us, vs, &mut found)?;
        let squares = found.iter().zip(points).map(|(&found, &point)| (found - point).length_squared());
        let mean = squares.sum::<V::Scalar>() / V::Scalar::from_usize(points.len().max(1));
        Ok((surface, mean.sqrt()))
    }
}

/// The control points of the curves nearest to rows of points.
fn fitted<V: ControlPoint<Point = V>>(
    knots: KnotVector<V::Scalar>,
    parameters: &[V::Scalar],
    points: &[V],
) -> Result<Vec<V>, SplineError> {
    let mut scratch = vec![V::Scalar::ZERO; band(knots.count(), knots.degree())];
    let mut fits = Vec::new();
    for row in points.chunks_exact(parameters.len().max(1)) {
        let mut control_points = vec![V::default(); knots.count()];
        fit(knots, parameters, row, &mut scratch, &mut control_points)?;
        fits.extend(control_points);
    }
    Ok(fits)
}

fn transposed<V: Copy>(points: &[V], columns: usize) -> Vec<V> {
    (0..columns).flat_map(|column| points.iter().skip(column).step_by(columns).copied()).collect()
}
