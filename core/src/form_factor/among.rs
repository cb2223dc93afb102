//! Polygon to polygon among blockers, by the method that fits.

use crate::geometry::PolygonOccluders;
use crate::math::{Real, Vector};

use super::shadow::{area_vector, fans};
use super::shaft::Shaft;
use super::visible::{MOST_CELLS, contour_error, within};
use super::visible_rays::{MOST_RAYS, cast};
use super::{Estimate, polygon_to_polygon};

/// Blockers between two polygons up to which exact clipping is faster than rays.
const FEW: usize = 8;
/// Blockers up to which exact clipping may take all its triangles.
const ALL_CELLS: usize = 4;
/// Blockers up to which exact clipping may reach what rays do not.
const SOME: usize = 32;
/// Blockers past which as many rays are cast as are ever cast; past more of them it is fewer rays.
const MANY: u32 = 64;
/// Rays reach no better accuracy than this in reasonable time.
const FINE: f64 = 1e-4;

/// Share of the power leaving `a` that lands on `b` among planar `blockers` of any shape, by the method that fits.
///
/// `a` and `b` are convex, run counter-clockwise seen from their fronts and exchange light there only; a blocker stops
/// light from both sides. `accuracy` is the absolute error to aim for. In `[0, 1]`.
///
/// - Nothing in the shaft between the two: [`polygon_to_polygon`], exact.
/// - Convex blockers, at most 8 of them in the shaft, or 32 for an accuracy below 1e-4:
///   [`visible_polygon_to_polygon`](super::visible_polygon_to_polygon).
/// - Otherwise [`visible_polygon_to_polygon_by_rays`](super::visible_polygon_to_polygon_by_rays), in single precision;
///   the error is four standard ones then.
/// - Where one of the two misses `accuracy` among at most 32 convex blockers, the other one too; the smaller error
///   counts.
///
/// Work is bounded by 65536 triangles, fewer among more than 4 blockers, and by a million rays, fewer past more than 64
/// blockers, where hundreds are known to about 1e-3. If that does not do, the error is larger than `accuracy`; rays past
/// a tree of the blockers go further.
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
    let most_rays = u64::from(MOST_RAYS * MANY) / (blockers.len() as u64).max(MANY.into());
    let by_rays = || cast(a, b, &PolygonOccluders(blockers), accuracy, most_rays as u32);
    let count = near().take(SOME + 1).count();
    if count > SOME || !near().all(|blocker| is_convex(blocker)) {
        return by_rays();
    }
    // Each triangle takes time with the square of the number of blockers.
    let most_cells = MOST_CELLS * ALL_CELLS * ALL_CELLS / (count * count).max(ALL_CELLS * ALL_CELLS);
    let clipped = || within(a, b, blockers, accuracy, most_cells);
    if count > FEW && accuracy >= V::Scalar::from_f64(FINE) {
        better(accuracy, by_rays, clipped)
    } else {
        better(accuracy, clipped, by_rays)
    }
}

/// The first result if it reaches the accuracy, else that of both with the smaller error.
fn better<R: Real>(accuracy: R, first: impl Fn() -> Estimate<R>, second: impl Fn() -> Estimate<R>) -> Estimate<R> {
    let found = first();
    if found.error <= accuracy {
        return found;
    }
    let other = second();
    if other.error < found.error { other } else { found }
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
