//! Polygons in the way of light, without a list of their triangles.

use crate::math::Vector;

use super::occluders::first_of;
use super::triangle::ShearedRay;
use super::{Hit, Occluders, Ray};

/// Planar polygons of any shape, convex or not, with edges that do not cross; every one is tried.
///
/// A hit names the polygon in place of a triangle and one of the triangles that it has with its first corner.
#[derive(Clone, Copy, Debug)]
pub struct PolygonOccluders<'a, V>(pub &'a [&'a [V]]);

impl<'a, V: Vector> PolygonOccluders<'a, V> {
    fn hits(&self, ray: &Ray) -> impl Iterator<Item = Hit> + 'a {
        let (sheared, end) = (ShearedRay::new(ray), ray.end);
        self.0.iter().zip(0..).filter_map(move |(polygon, index)| meet(polygon, index, &sheared, end))
    }
}

/// Where the ray meets a polygon: inside, the triangles at its first corner wind around the place, each in its sense.
fn meet<V: Vector>(polygon: &[V], index: u32, ray: &ShearedRay, end: f32) -> Option<Hit> {
    let mut winding = 0;
    let mut met = None;
    for pair in polygon.windows(2).skip(1) {
        let corners = [polygon[0], pair[0], pair[1]].map(|corner| corner.to_dvec3().as_vec3());
        if let Some(hit) = ray.hit(&corners, index, end) {
            winding += if hit.front { 1 } else { -1 };
            met = Some(hit);
        }
    }
    met.filter(|_| winding != 0)
}

impl<V: Vector> Occluders for PolygonOccluders<'_, V> {
    fn first(&self, ray: &Ray, place: impl Fn(&Hit) -> Option<f32>) -> Option<Hit> {
        first_of(self.hits(ray), place)
    }

    fn any(&self, ray: &Ray, mut stop: impl FnMut(&Hit) -> bool) -> bool {
        self.hits(ray).any(|hit| stop(&hit))
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};

    use super::*;

    /// A ray down through an L-shaped polygon, through its notch, its inner corner and the diagonals of its triangles.
    #[test]
    fn concave_polygons() {
        let shape = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)];
        for turn in 0..shape.len() {
            let mut corners = shape.map(|(x, y)| DVec3::new(x, y, 0.0));
            corners.rotate_left(turn);
            let polygons: [&[DVec3]; 1] = [&corners];
            let down = |x, y| Ray { origin: Vec3::new(x, y, 3.0), direction: Vec3::NEG_Z, end: 10.0 };
            let meets = |x, y| PolygonOccluders(&polygons).nearest(&down(x, y)).map(|hit| hit.distance);
            for (x, y) in [(0.5, 0.5), (1.5, 0.5), (0.5, 1.5), (0.7, 0.9), (1.2, 0.1)] {
                assert!(meets(x, y).is_some_and(|distance| (distance - 3.0).abs() < 1e-5), "{x} {y} {turn}");
            }
            for (x, y) in [(1.5, 1.5), (1.1, 1.9), (2.5, 0.5), (-0.1, 1.0)] {
                assert_eq!(meets(x, y), None, "{x} {y} {turn}");
            }
        }
    }
}
