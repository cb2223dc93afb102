//! Whether a straight edge or a flat triangle is near enough to the surface.

use super::Tolerance;
use super::vertices::Vertex;
use crate::math::{Real, Vector};

/// The share of the tolerance that is used where the surface is looked at; between these places it may be further away.
const CHECKED: f64 = 0.93;
/// So many times the angle of the tolerance may lie between a triangle and the surface.
const FACING: f64 = 2.0;

impl<R: Real> Tolerance<R> {
    /// Whether the normals along an edge inside the surface are near enough to each other.
    pub(super) fn holds_turn_inside<V: Vector<Scalar = R>>(&self, edge: [&Vertex<V>; 3]) -> bool {
        let [a, middle, b] = edge.map(|vertex| vertex.normal);
        ![(a, b), (a, middle), (middle, b)].iter().any(|&(a, b)| angle_above(a, b, self.angle))
    }

    /// Whether an edge inside the surface, with the points of the surface below its quarters, is near enough to it.
    ///
    /// Only the distance along the normal in the middle counts: a curve that bends inside a flat surface is no reason to
    /// cut it.
    pub(super) fn holds_chord_inside<V: Vector<Scalar = R>>(&self, points: [V; 5], normal: V) -> bool {
        self.holds_chord(points, |offset| offset.dot(normal).abs())
    }

    /// Whether an edge is near enough to a curve with these points at its ends and quarters, in whichever direction it is
    /// seen.
    pub(super) fn holds_at_border<V: Vector<Scalar = R>>(&self, mut points: [V; 5]) -> bool {
        let [a, _, middle, _, b] = points;
        if a.to_array().partial_cmp(&b.to_array()) == Some(core::cmp::Ordering::Greater) {
            points.reverse();
        }
        let half = self.angle * R::from_f64(0.5);
        !angle_above(middle - a, b - middle, half) && self.holds_chord(points, |offset| offset.length())
    }

    /// Whether the quarters of a curve, which see one that crosses the edge in its middle too, lie near the edge. `size` is
    /// that of a distance.
    fn holds_chord<V: Vector<Scalar = R>>(&self, [a, inner @ .., b]: [V; 5], size: impl Fn(V) -> R) -> bool {
        inner.iter().all(|&point| size(from_line(point, a, b)) <= self.chord * R::from_f64(CHECKED))
    }

    /// Whether a triangle is near enough to a point of the surface.
    pub(super) fn holds_distance<V: Vector<Scalar = R>>(&self, corners: [&Vertex<V>; 3], point: V) -> bool {
        let [a, b, c] = corners.map(|corner| corner.point);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        (point - a).dot(normal).abs() <= self.chord * R::from_f64(CHECKED)
    }

    /// Whether the mean of its normals is near enough to the normal there, and the triangle itself faces that way.
    ///
    /// Slender triangles whose corners lie on the surface may stand across it however near they are: H. A. Schwarz's
    /// lantern, 1880.
    pub(super) fn holds_normal<V: Vector<Scalar = R>>(&self, corners: [&Vertex<V>; 3], center: &Vertex<V>) -> bool {
        let mean = corners[0].normal + corners[1].normal + corners[2].normal;
        let [a, b, c] = corners.map(|corner| corner.point);
        let facing = (b - a).cross(c - a);
        !angle_above(mean, center.normal, self.angle * R::from_f64(0.25))
            && !angle_above(facing, center.normal, self.angle * R::from_f64(FACING))
    }
}

/// Whether two directions lie more than an angle apart; directions of length zero do not.
pub(super) fn angle_above<V: Vector>(a: V, b: V, angle: V::Scalar) -> bool {
    let (sine, cosine) = (a.cross(b).length(), a.dot(b));
    sine.atan2(cosine) > angle
}

/// The shortest way to a point from the line through two others, or from both where they are one.
fn from_line<V: Vector>(point: V, a: V, b: V) -> V {
    let (along, from_a) = (b - a, point - a);
    let squared = along.length_squared();
    if squared > V::Scalar::ZERO { from_a - along * (from_a.dot(along) / squared) } else { from_a }
}
