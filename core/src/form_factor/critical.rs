//! Where the view of a polygon past blockers changes its form: critical planes.
//!
//! From one point to the next the visible part changes smoothly, until a corner of a blocker moves across an edge of
//! the polygon, an edge of a blocker across a corner of the polygon, or a blocker is seen edge-on. Those points lie in
//! planes through an edge and a corner, as in aspect graphs and discontinuity meshing (Heckbert 1992; Lischinski,
//! Tampieri and Greenberg 1992). What happens where the edges of two blockers and an edge of the polygon meet lies on
//! quadrics and is left out.

use crate::math::{Real, Vector};

use super::shadow::{Fan, area_vector};

/// A plane on which the view changes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Critical<V: Vector> {
    pub(super) normal: V,
    pub(super) point: V,
    /// How far it runs through the triangle.
    length: V::Scalar,
}

/// The critical plane that runs farthest through a triangle, if there is one.
pub(super) fn longest<'a, V: Vector + 'a>(
    triangle: &[V; 3],
    receivers: impl Iterator<Item = Fan<'a, V>> + Clone,
    blockers: impl Iterator<Item = Fan<'a, V>> + Clone,
) -> Option<Critical<V>> {
    let mut search = Search::new(triangle);
    for (i, blocker) in blockers.clone().enumerate() {
        search.edge_on(&blocker);
        for receiver in receivers.clone() {
            search.pair(&blocker, &receiver);
        }
        for other in blockers.clone().skip(i + 1) {
            search.pair(&blocker, &other);
        }
    }
    search.longest
}

struct Search<'a, V: Vector> {
    triangle: &'a [V; 3],
    /// Planes nearer than this to all corners on one side run along the border.
    tolerance: V::Scalar,
    longest: Option<Critical<V>>,
}

impl<'a, V: Vector> Search<'a, V> {
    fn new(triangle: &'a [V; 3]) -> Self {
        let [a, b, c] = *triangle;
        let size = (b - a).length().max((c - b).length()).max((a - c).length());
        Self { triangle, tolerance: V::Scalar::EPSILON.sqrt() * size, longest: None }
    }

    /// The plane of a blocker.
    fn edge_on(&mut self, blocker: &Fan<V>) {
        let Some(point) = blocker.corners().next() else { return };
        let normal = area_vector(blocker.corners()).normalize_or_zero();
        if let Some([from, to]) = self.line(normal, point) {
            self.keep(normal, point, (to - from).length());
        }
    }

    /// Corners of each polygon with edges of the other.
    fn pair(&mut self, near: &Fan<V>, far: &Fan<V>) {
        for (corners, edges) in [(near, far), (far, near)] {
            for corner in corners.corners() {
                for (from, to) in edges.edges() {
                    self.sector(corner, from - corner, to - corner);
                }
            }
        }
    }

    /// The part of a plane that an edge spans with a corner, on both sides of the corner.
    fn sector(&mut self, corner: V, from: V, to: V) {
        let normal = from.cross(to).normalize_or_zero();
        let Some(line) = self.line(normal, corner) else { return };
        // Both are positive beyond the edge and negative on the other side of the corner.
        let shares = line.map(|point| {
            let offset = point - corner;
            [offset.cross(to).dot(normal), from.cross(offset).dot(normal)]
        });
        let one_side = overlap(shares, V::Scalar::ONE);
        let other_side = overlap(shares, -V::Scalar::ONE);
        let length = (line[1] - line[0]).length() * one_side.max(other_side);
        self.keep(normal, corner, length);
    }

    /// Where a plane enters and leaves the triangle.
    fn line(&self, normal: V, point: V) -> Option<[V; 2]> {
        let heights = self.triangle.map(|corner| normal.dot(corner - point));
        let is_split = heights.iter().any(|&height| height > self.tolerance)
            && heights.iter().any(|&height| height < -self.tolerance);
        if !is_split {
            return None;
        }
        let mut ends = (0..3).filter_map(|i| {
            let j = (i + 1) % 3;
            let is_crossed = (heights[i] > V::Scalar::ZERO) != (heights[j] > V::Scalar::ZERO);
            is_crossed.then(|| self.triangle[i].lerp(self.triangle[j], heights[i] / (heights[i] - heights[j])))
        });
        Some([ends.next()?, ends.next()?])
    }

    fn keep(&mut self, normal: V, point: V, length: V::Scalar) {
        let least = self.longest.map_or(self.tolerance * V::Scalar::from_f64(64.0), |longest| longest.length);
        if length > least {
            self.longest = Some(Critical { normal, point, length });
        }
    }
}

/// The share of a line on which two linear functions, given at its ends, both have a sign.
fn overlap<R: Real>(ends: [[R; 2]; 2], sign: R) -> R {
    let (mut start, mut end) = (R::ZERO, R::ONE);
    for k in 0..2 {
        let (from, to) = (ends[0][k] * sign, ends[1][k] * sign);
        if from < R::ZERO && to < R::ZERO {
            return R::ZERO;
        }
        let crossing = from / (from - to);
        if from < R::ZERO {
            start = start.max(crossing);
        } else if to < R::ZERO {
            end = end.min(crossing);
        }
    }
    (end - start).max(R::ZERO)
}
