//! The boundary of a planar polygon, cut where another plane cuts it.

use glam::DVec3;

use super::shadow::area_vector;
use crate::math::{Real, Vector};

/// A planar polygon, measured.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// A point in the plane.
    pub anchor: DVec3,
    /// Of length 1, toward the front.
    pub normal: DVec3,
    /// Of the polygon.
    pub area: f64,
    /// The mean of the corners.
    pub center: DVec3,
    /// From the center to the farthest corner.
    pub radius: f64,
}

impl Plane {
    /// The plane of a polygon that runs counter-clockwise seen from its front; none without a finite area.
    pub fn of<V: Vector>(polygon: &[V]) -> Option<Self> {
        let anchor = polygon.first()?.to_dvec3();
        let offsets = polygon.iter().map(|corner| corner.to_dvec3() - anchor);
        let twice = area_vector(offsets.clone());
        let center = anchor + offsets.sum::<DVec3>() / polygon.len() as f64;
        let squared = polygon.iter().map(|corner| corner.to_dvec3().distance_squared(center)).fold(0.0, f64::max);
        let length = Real::sqrt(twice.length_squared());
        let has_area = length.is_finite() && length > 1e-14 * squared;
        let radius = Real::sqrt(squared);
        has_area.then(|| Self { anchor, normal: twice / length, area: 0.5 * length, center, radius })
    }

    /// Calls `each` with the ends of the edges of the part of a polygon in front of this plane, in order.
    ///
    /// Corners that lie in the plane up to the rounding of their coordinates lie in it exactly, so that edges in the
    /// plane stay what they are.
    pub fn edges_in_front<V: Vector>(&self, polygon: &[V], mut each: impl FnMut(DVec3, DVec3)) {
        let count = polygon.len();
        let Some(start) = (0..count).find(|&i| self.height(polygon[i]) > 0.0) else { return };
        let (mut from, mut from_height) = (polygon[start].to_dvec3(), self.height(polygon[start]));
        let mut exit = from;
        for k in 1..=count {
            let corner = polygon[(start + k) % count];
            let (to, to_height) = (corner.to_dvec3(), self.height(corner));
            match (from_height > 0.0, to_height > 0.0) {
                (true, true) => each(from, to),
                (true, false) => {
                    exit = crossing(from, from_height, to, to_height);
                    each(from, exit);
                }
                (false, true) => {
                    let entry = crossing(to, to_height, from, from_height);
                    each(exit, entry);
                    each(entry, to);
                }
                (false, false) => {}
            }
            (from, from_height) = (to, to_height);
        }
    }

    /// Height above the plane, 0 within rounding.
    fn height<V: Vector>(&self, corner: V) -> f64 {
        let corner = corner.to_dvec3();
        let height = (corner - self.anchor).dot(self.normal);
        let size = corner.abs().max_element().max(self.anchor.abs().max_element()).max(self.radius);
        if height.abs() <= 8.0 * V::Scalar::EPSILON.to_f64() * size { 0.0 } else { height }
    }
}

/// Where the edge from a corner above the plane to one that is not meets the plane.
fn crossing(above: DVec3, height: f64, other: DVec3, other_height: f64) -> DVec3 {
    if other_height == 0.0 { other } else { above + (other - above) * (height / (height - other_height)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [DVec3; 4] = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];

    fn area_in_front(normal: DVec3, anchor: DVec3, polygon: &[DVec3]) -> f64 {
        let plane = Plane { anchor, normal, ..Plane::of(&SQUARE).unwrap() };
        let mut sum = 0.0;
        plane.edges_in_front(polygon, |from, to| sum += 0.5 * from.cross(to).z);
        sum
    }

    #[test]
    fn the_plane_of_a_square() {
        let plane = Plane::of(&SQUARE).unwrap();
        assert_eq!((plane.normal, plane.area, plane.center), (DVec3::Z, 1.0, DVec3::new(0.5, 0.5, 0.0)));
        assert!(Plane::of(&SQUARE[..2]).is_none());
        assert!(Plane::of(&[DVec3::ZERO, DVec3::X, DVec3::NAN]).is_none());
    }

    #[test]
    fn cut_in_half_and_not_at_all() {
        let middle = DVec3::new(0.5, 0.0, 0.0);
        assert!((area_in_front(DVec3::X, middle, &SQUARE) - 0.5).abs() < 1e-15);
        assert_eq!(area_in_front(DVec3::X, DVec3::ZERO, &SQUARE), 1.0);
        assert_eq!(area_in_front(DVec3::NEG_X, DVec3::ZERO, &SQUARE), 0.0);
    }

    /// A polygon with two arms, cut across both: the parts are closed each on its own, in any order.
    #[test]
    fn concave_polygons() {
        let arms = [(0.0, 0.0), (5.0, 0.0), (5.0, 3.0), (4.0, 3.0), (4.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)];
        let polygon = arms.map(|(x, y)| DVec3::new(x, y, 0.0));
        assert!((area_in_front(DVec3::Y, DVec3::Y * 1.5, &polygon) - 2.0).abs() < 1e-14);
    }
}
