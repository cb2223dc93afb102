//! The shaft between two convex polygons: what lies outside of it cannot hide one from the other.
//!
//! Haines and Wallace, "Shaft Culling for Efficient Ray-Traced Radiosity", 1991, with the planes of the convex hull.

use crate::math::{Real, Vector};

use super::shadow::{Fan, area_vector};

/// Planes of the hull that are remembered; with fewer of them more blockers are kept.
const PLANES: usize = 24;

/// Planes that have two polygons on their positive side.
pub(super) struct Shaft<V: Vector> {
    /// Inner normals of length 1, and the distance at which the inside begins.
    planes: heapless::Vec<(V, V::Scalar), PLANES>,
}

impl<V: Vector> Shaft<V> {
    /// The shaft between the front sides of two polygons.
    pub(super) fn new(a: &[V], b: &[V]) -> Self {
        let mut shaft = Self { planes: heapless::Vec::new() };
        for polygon in [a, b] {
            let normal = area_vector(polygon.iter().copied());
            shaft.push(normal, polygon[0], tolerance(a, b));
        }
        shaft.support(a, b);
        shaft.support(b, a);
        shaft
    }

    /// Whether a blocker may stop light between the two.
    pub(super) fn meets(&self, blocker: &Fan<V>) -> bool {
        let is_outside =
            |&(normal, start): &(V, V::Scalar)| blocker.corners().all(|corner| normal.dot(corner) <= start);
        !self.planes.iter().any(is_outside)
    }

    fn push(&mut self, normal: V, point: V, tolerance: V::Scalar) {
        let normal = normal.normalize_or_zero();
        if normal != V::default() {
            let _ = self.planes.push((normal, normal.dot(point) + tolerance));
        }
    }

    /// Planes through an edge of `a` and a corner of `b` with both polygons on one side.
    fn support(&mut self, a: &[V], b: &[V]) {
        let tolerance = tolerance(a, b);
        for i in 0..a.len() {
            let (from, to) = (a[i], a[(i + 1) % a.len()]);
            for &corner in b {
                let normal = (to - from).cross(corner - from).normalize_or_zero();
                let heights = || a.iter().chain(b).map(|&other| normal.dot(other - from));
                if heights().all(|height| height >= -tolerance) {
                    self.push(normal, from, tolerance);
                } else if heights().all(|height| height <= tolerance) {
                    self.push(-normal, from, tolerance);
                }
            }
        }
    }
}

/// Distances that are rounding errors at the size of two polygons.
fn tolerance<V: Vector>(a: &[V], b: &[V]) -> V::Scalar {
    let reach = a.iter().chain(b).fold(V::Scalar::ZERO, |reach, &corner| reach.max((corner - a[0]).length_squared()));
    V::Scalar::from_f64(16.0) * V::Scalar::EPSILON * reach.sqrt()
}
