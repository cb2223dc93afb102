//! A flat piece of a patch that has one radiosity.

use super::Patch;
use crate::math::{Real, Vector, VectorSpace};

/// A place in the domain of a patch.
pub type Parameters<V> = [<V as VectorSpace>::Scalar; 2];

/// A convex planar polygon of three or four corners, counter-clockwise seen from the front.
///
/// A cell of a curved patch is replaced by its projection onto the plane that fits its corners best, so neighbors of a
/// curved surface touch up to an error that falls with the square of their size. An element without area, as of
/// corners in a line, exchanges no light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element<V: Vector> {
    /// Index of the shape that it is a piece of.
    pub shape: usize,
    /// Index of the patch within the shape.
    pub patch: usize,
    /// The centroid.
    pub center: V,
    /// Of length 1; zero where there is no area.
    pub normal: V,
    /// In square meters.
    pub area: V::Scalar,
    parameters: [Parameters<V>; 4],
    sides: usize,
    corners: [V; 4],
    count: usize,
}

impl<V: Vector> Element<V> {
    /// The piece of `patch` between the first three or four of these places in its domain, counter-clockwise.
    pub fn new(shape: usize, index: usize, patch: &Patch<V>, places: [Parameters<V>; 4], sides: usize) -> Self {
        let sides = sides.clamp(3, 4);
        let (corners, count) = distinct(places.map(|place| patch.point(place)), sides);
        let area_vector = match (count, corners) {
            (3, [a, b, c, _]) => (b - a).cross(c - a),
            (4, [a, b, c, d]) => (c - a).cross(d - b),
            _ => V::default(),
        } * V::Scalar::from_f64(0.5);
        let normal = area_vector.normalize_or_zero();
        let corners = flat(corners, count, normal);
        Self {
            shape,
            patch: index,
            center: centroid(&corners[..count], normal),
            normal,
            area: area_vector.length(),
            parameters: places,
            sides,
            corners,
            count,
        }
    }

    /// All of a patch.
    pub fn whole(shape: usize, index: usize, patch: &Patch<V>) -> Self {
        let mut places = [Parameters::<V>::default(); 4];
        for (place, corner) in places.iter_mut().zip(patch.domain()) {
            *place = corner.map(|x| V::Scalar::from_usize(usize::from(x)));
        }
        Self::new(shape, index, patch, places, patch.domain().len())
    }

    /// The corners of the polygon.
    pub fn corners(&self) -> &[V] {
        &self.corners[..self.count]
    }

    /// The corners in the domain of the patch: a triangle or a rectangle.
    pub fn parameters(&self) -> &[Parameters<V>] {
        &self.parameters[..self.sides]
    }

    /// Whether a part of another element lies in front of this one.
    pub fn faces(&self, other: &Self) -> bool {
        let scale = (other.center - self.center).length() * V::Scalar::EPSILON * V::Scalar::from_f64(64.0);
        other.corners().iter().any(|&corner| (corner - self.center).dot(self.normal) > scale)
    }

    /// Four pieces, cut at the middles of the sides in the domain of the patch.
    pub fn split(&self, patch: &Patch<V>) -> [Self; 4] {
        let side = |k: usize| middle::<V>(self.parameters[k], self.parameters[(k + 1) % self.sides]);
        let piece = |places| Self::new(self.shape, self.patch, patch, places, self.sides);
        if self.sides == 3 {
            let [a, b, c] = [side(0), side(1), side(2)];
            let [p, q, r, _] = self.parameters;
            return [[p, a, c, c], [a, q, b, b], [c, b, r, r], [a, b, c, c]].map(piece);
        }
        let center = middle::<V>(side(0), side(2));
        core::array::from_fn(|k| {
            let mut places = [center; 4];
            // The corner with which a piece starts corresponds to the one with which the whole starts.
            places[k] = self.parameters[k];
            places[(k + 1) % 4] = side(k);
            places[(k + 3) % 4] = side((k + 3) % 4);
            piece(places)
        })
    }
}

/// Halfway between two places of a domain.
pub(super) fn middle<V: Vector>(a: Parameters<V>, b: Parameters<V>) -> Parameters<V> {
    let half = V::Scalar::from_f64(0.5);
    [(a[0] + b[0]) * half, (a[1] + b[1]) * half]
}

/// The corners that differ from the one before: a collapsed edge of a surface leaves a triangle.
fn distinct<V: Vector>(corners: [V; 4], sides: usize) -> ([V; 4], usize) {
    let mut kept = corners;
    let mut count = 0;
    for k in 0..sides {
        if corners[k] != corners[(k + 1) % sides] {
            kept[count] = corners[k];
            count += 1;
        }
    }
    (kept, count)
}

/// The corners projected onto the plane through their mean; planar corners stay what they are.
fn flat<V: Vector>(corners: [V; 4], count: usize, normal: V) -> [V; 4] {
    if count < 4 {
        return corners;
    }
    let mean = (corners[0] + corners[1] + corners[2] + corners[3]) * V::Scalar::from_f64(0.25);
    let rounding = (mean.length() + (corners[0] - mean).length()) * V::Scalar::EPSILON * V::Scalar::from_f64(16.0);
    corners.map(|corner| {
        let height = (corner - mean).dot(normal);
        if height.abs() > rounding { corner - normal * height } else { corner }
    })
}

/// The mean of all points of a planar polygon; of its corners if it has no area.
fn centroid<V: Vector>(corners: &[V], normal: V) -> V {
    let Some((&first, rest)) = corners.split_first() else { return V::default() };
    let third = V::Scalar::ONE / V::Scalar::from_f64(3.0);
    let (mut sum, mut area) = (V::default(), V::Scalar::ZERO);
    for pair in rest.windows(2) {
        let share = (pair[0] - first).cross(pair[1] - first).dot(normal);
        sum += (pair[0] - first + (pair[1] - first)) * (share * third);
        area += share;
    }
    if area > V::Scalar::ZERO {
        return first + sum / area;
    }
    let total = rest.iter().fold(first, |total, &corner| total + corner);
    total / V::Scalar::from_usize(corners.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spline::BezierSurface;
    use glam::DVec3;

    const TRIANGLE: Patch<DVec3> = Patch::Triangle([DVec3::ZERO, DVec3::new(2.0, 0.0, 0.0), DVec3::new(0.5, 1.0, 0.0)]);
    const QUAD: Patch<DVec3> =
        Patch::Quad([DVec3::ZERO, DVec3::new(3.0, 0.0, 0.0), DVec3::new(2.0, 1.0, 0.0), DVec3::new(0.0, 1.0, 0.0)]);

    /// A trapezoid with parallel sides 3 and 2 at distance 1.
    #[test]
    fn area_normal_and_center_of_known_polygons() {
        let quad = Element::whole(4, 2, &QUAD);
        assert_eq!((quad.shape, quad.patch, quad.normal, quad.area), (4, 2, DVec3::Z, 2.5));
        assert!((quad.center - DVec3::new(19.0 / 15.0, 7.0 / 15.0, 0.0)).length() < 1e-15);
        let triangle = Element::whole(0, 0, &TRIANGLE);
        assert_eq!((triangle.normal, triangle.area, triangle.corners().len()), (DVec3::Z, 1.0, 3));
        assert!((triangle.center - DVec3::new(2.5 / 3.0, 1.0 / 3.0, 0.0)).length() < 1e-15);
    }

    /// The pieces have the area and the centroid of the whole, face the same side and are pieces of the same patch.
    #[test]
    fn pieces_add_up() {
        for patch in [TRIANGLE, QUAD] {
            let whole = Element::whole(1, 0, &patch);
            for level in whole.split(&patch).map(|piece| piece.split(&patch)).as_flattened().chunks(16) {
                let area: f64 = level.iter().map(|piece| piece.area).sum();
                let center = level.iter().map(|piece| piece.center * piece.area).sum::<DVec3>() / area;
                assert!((area - whole.area).abs() < 1e-14 && (center - whole.center).length() < 1e-14);
                assert!(level.iter().all(|piece| piece.normal == DVec3::Z && piece.parameters().len() == whole.sides));
            }
        }
    }

    /// An octant of a sphere-like dome: the pieces at its collapsed edge are triangles, and all of them are planar.
    #[test]
    fn pieces_of_a_dome() {
        let ring = |height: f64, radius: f64| {
            [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec3::new(radius * x, radius * y, height))
        };
        let points = [ring(0.0, 1.0), ring(1.0, 1.0), ring(1.0, 0.0)].concat();
        let dome = Patch::Spline(BezierSurface::new(&points, 3).unwrap());
        let whole = Element::whole(0, 0, &dome);
        assert_eq!(whole.corners().len(), 3);
        let pieces = whole.split(&dome).map(|piece| piece.split(&dome));
        let triangles = pieces.as_flattened().iter().filter(|piece| piece.corners().len() == 3).count();
        assert_eq!(triangles, 4);
        for piece in pieces.as_flattened() {
            assert!(piece.corners().iter().all(|&corner| (corner - piece.center).dot(piece.normal).abs() < 1e-12));
            assert!(piece.normal.dot(piece.center) > 0.0 && (piece.normal.length() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn no_area_is_no_error() {
        let line = Element::whole(0, 0, &Patch::Triangle([DVec3::ZERO, DVec3::X, DVec3::X * 2.0]));
        assert_eq!((line.area, line.normal, line.center), (0.0, DVec3::ZERO, DVec3::X));
        let point = Element::whole(0, 0, &Patch::Quad([DVec3::ONE; 4]));
        assert_eq!((point.area, point.corners().len()), (0.0, 0));
    }
}
