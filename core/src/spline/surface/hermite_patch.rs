//! Bicubic Hermite patches: corners with tangents and twists.

use crate::math::{Real, VectorSpace};

/// What a bicubic patch is at one of its corners. Ferguson, "Multivariable Curve Interpolation", 1964.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HermiteCorner<V> {
    /// The corner.
    pub point: V,
    /// The derivative by `u`.
    pub du: V,
    /// The derivative by `v`.
    pub dv: V,
    /// The twist: the mixed derivative. Zero makes flat corners, which show on surfaces that bend in both directions.
    pub duv: V,
}

/// The control points of a [`BezierSurface`](super::BezierSurface) with 4 columns, the patch with such corners at
/// `u` and `v` of 0 and 1, `corners[v][u]`.
///
/// Two patches that share the corners of an edge meet there with equal tangent planes.
pub fn hermite_patch<V: VectorSpace>(corners: [[HermiteCorner<V>; 2]; 2]) -> [V; 16] {
    let third = V::Scalar::ONE / V::Scalar::from_f64(3.0);
    core::array::from_fn(|k| {
        let (i, j) = (k % 4, k / 4);
        let HermiteCorner { point, du, dv, duv } = corners[j / 2][i / 2];
        // The way from the corner, in thirds of the patch.
        let [s, t] = [inwards(i), inwards(j)].map(|step| V::Scalar::from_f64(step) * third);
        point + du * s + dv * t + duv * (s * t)
    })
}

/// The corners of a patch of 4 columns and rows of control points, so that [`hermite_patch`] gives it back.
pub fn hermite_corners<V: VectorSpace>(points: &[V; 16]) -> [[HermiteCorner<V>; 2]; 2] {
    let corner = |side: usize| 3 * side;
    let (three, nine) = (V::Scalar::from_f64(3.0), V::Scalar::from_f64(9.0));
    [0, 1].map(|row| {
        [0, 1].map(|column| {
            let (i, j) = (corner(column), corner(row));
            let (next_i, next_j) = (1 + column, 1 + row);
            let at = |i: usize, j: usize| points[4 * j + i];
            let [s, t] = [column, row].map(|side| V::Scalar::from_f64(1.0 - 2.0 * side as f64));
            let point = at(i, j);
            HermiteCorner {
                point,
                du: (at(next_i, j) - point) * (three * s),
                dv: (at(i, next_j) - point) * (three * t),
                duv: (at(next_i, next_j) - at(next_i, j) - at(i, next_j) + point) * (nine * s * t),
            }
        })
    })
}

/// From the nearest corner to a control point, in thirds.
fn inwards(index: usize) -> f64 {
    [0.0, 1.0, -1.0, 0.0][index]
}
