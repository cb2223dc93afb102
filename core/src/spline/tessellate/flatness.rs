//! Whether a straight edge or a flat triangle is near enough to the surface.

use super::Tolerance;
use super::vertices::Vertex;
use crate::math::{Real, Vector};

/// The share of the tolerance that is used where the surface is looked at; between these places it may be further away.
const CHECKED: f64 = 0.93;

impl<R: Real> Tolerance<R> {
    /// Whether the normals along an edge inside the surface are near enough to each other.
    pub(super) fn holds_turn_inside<V: Vector<Scalar = R>>(&self, edge: [&Vertex<V>; 3]) -> bool {
        let [a, middle, b] = edge.map(|vertex| vertex.normal);
        ![(a, b), (a, middle), (middle, b)].iter().any(|&(a, b)| angle_above(a, b, self.angle))
    }

    /// Whether an edge inside the surface is near enough to the surface below it.
    ///
    /// Only the distance along the normal counts: a curve that bends inside a flat surface is no reason to cut it.
    pub(super) fn holds_chord_inside<V: Vector<Scalar = R>>(&self, [a, middle, b]: [&Vertex<V>; 3]) -> bool {
        let step = [0, 1].map(|k| b.uv[k] - a.uv[k]);
        let tangents = [a, b].map(|end| end.du * step[0] + end.dv * step[1]);
        let height = |offset: V| offset.dot(middle.normal).abs();
        self.holds_chord([a.point, middle.point, b.point], tangents, height)
    }

    /// Whether an edge is near enough to a curve with these derivatives at its ends, in whichever direction it is seen.
    pub(super) fn holds_at_border<V: Vector<Scalar = R>>(&self, [a, middle, b]: [V; 3], [from, to]: [V; 2]) -> bool {
        let is_turned = a.to_array().partial_cmp(&b.to_array()) == Some(core::cmp::Ordering::Greater);
        let (points, tangents) = if is_turned { ([b, middle, a], [-to, -from]) } else { ([a, middle, b], [from, to]) };
        let half = self.angle * R::from_f64(0.5);
        !angle_above(points[1] - points[0], points[2] - points[1], half)
            && self.holds_chord(points, tangents, |offset| offset.length())
    }

    /// Whether the middle of an edge lies near it, and the cubic through its ends at a quarter and at three quarters,
    /// which sees curves that cross the edge in their middle. `size` is that of a distance.
    fn holds_chord<V: Vector<Scalar = R>>(
        &self,
        [a, middle, b]: [V; 3],
        [from, to]: [V; 2],
        size: impl Fn(V) -> R,
    ) -> bool {
        let [near, far, steep, flat] = [0.843_75, 0.156_25, 0.140_625, 0.046_875].map(R::from_f64);
        let quarter = a * near + b * far + (from * steep - to * flat);
        let three_quarters = a * far + b * near + (from * flat - to * steep);
        [middle, quarter, three_quarters]
            .iter()
            .all(|&point| size(from_line(point, a, b)) <= self.chord * R::from_f64(CHECKED))
    }

    /// Whether a triangle is near enough to a point of the surface.
    pub(super) fn holds_distance<V: Vector<Scalar = R>>(&self, corners: [&Vertex<V>; 3], point: V) -> bool {
        let [a, b, c] = corners.map(|corner| corner.point);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        (point - a).dot(normal).abs() <= self.chord * R::from_f64(CHECKED)
    }

    /// Whether the mean of its normals is near enough to the normal there.
    pub(super) fn holds_normal<V: Vector<Scalar = R>>(&self, corners: [&Vertex<V>; 3], center: &Vertex<V>) -> bool {
        let mean = corners[0].normal + corners[1].normal + corners[2].normal;
        !angle_above(mean, center.normal, self.angle * R::from_f64(0.25))
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
