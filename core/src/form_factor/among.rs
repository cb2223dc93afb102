//! Polygon to polygon among blockers, by the method that fits.

use crate::geometry::PolygonOccluders;
use crate::math::{Real, Vector};

use super::shadow::{area_vector, fans};
use super::shaft::Shaft;
use super::visible::contour_error;
use super::{Estimate, polygon_to_polygon, visible_polygon_to_polygon, visible_polygon_to_polygon_by_rays};

/// Blockers between two polygons up to which exact clipping is faster than rays at an accuracy of 1e-4.
const FEW: usize = 8;
/// Rays reach no better accuracy than this in reasonable time.
const FINE: f64 = 1e-4;

/// Share of the power leaving `a` that lands on `b` among planar `blockers` of any shape, by the method that fits.
///
/// `a` and `b` are convex, run counter-clockwise seen from their fronts and exchange light there only; a blocker stops
/// light from both sides. `accuracy` is the absolute error to aim for. In `[0, 1]`.
///
/// - Nothing in the shaft between the two: [`polygon_to_polygon`], exact.
/// - Convex blockers, at most 8 of them or an accuracy below 1e-4: [`visible_polygon_to_polygon`].
/// - Otherwise [`visible_polygon_to_polygon_by_rays`], in single precision; the error is four standard ones then.
pub fn polygon_to_polygon_among<V: Vector>(
    a: &[V],
    b: &[V],
    blockers: &[&[V]],
    accuracy: V::Scalar,
) -> Estimate<V::Scalar> {
    if a.len() < 3 || b.len() < 3 {
        return Estimate::default();
    }
    let shaft = Shaft::new(a, b);
    // The parts of a polygon that is not convex lie in its hull and together cover it.
    let near = || blockers.iter().filter(|blocker| fans(blocker).any(|part| shaft.meets(&part)));
    if near().next().is_none() {
        return Estimate { value: polygon_to_polygon(a, b), error: contour_error() };
    }
    let is_few = near().nth(FEW).is_none() || accuracy < V::Scalar::from_f64(FINE);
    if is_few && near().all(|blocker| is_convex(blocker)) {
        return visible_polygon_to_polygon(a, b, blockers, accuracy);
    }
    visible_polygon_to_polygon_by_rays(a, b, &PolygonOccluders(blockers), accuracy)
}

/// Whether a simple polygon is planar and turns one way only, up to rounding.
fn is_convex<V: Vector>(polygon: &[V]) -> bool {
    let normal = area_vector(polygon.iter().copied()).normalize_or_zero();
    let count = polygon.len();
    (0..count).all(|i| {
        let [from, corner, to] = [0, 1, 2].map(|k| polygon[(i + k) % count]);
        let (arrival, departure) = (corner - from, to - corner);
        let rounding = V::Scalar::from_f64(64.0) * V::Scalar::EPSILON;
        let size = arrival.length() * departure.length();
        let is_planar =
            normal.dot(departure).abs() <= rounding * (corner - polygon[0]).length().max(departure.length());
        is_planar && arrival.cross(departure).dot(normal) >= -rounding * size
    })
}
