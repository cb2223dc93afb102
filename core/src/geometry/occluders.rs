//! What stands in the way of light: any set of triangles that can be asked where a ray meets it.

use glam::Vec3;

use super::triangle::ShearedRay;
use super::{Hit, Ray};

/// A set of triangles. Of several hits at the same place the lowest triangle index wins, whatever the tree.
pub trait Occluders: Sync {
    /// The hit that comes first among those to which `place` gives a place along the ray, which is at or beyond the
    /// distance of the hit; usually it is that distance.
    fn first(&self, ray: &Ray, place: impl Fn(&Hit) -> Option<f32>) -> Option<Hit>;

    /// The nearest hit.
    fn nearest(&self, ray: &Ray) -> Option<Hit> {
        self.first(ray, |hit| Some(hit.distance))
    }

    /// Calls `stop` with hits in any order until it returns true, and tells whether it did.
    fn any(&self, ray: &Ray, stop: impl FnMut(&Hit) -> bool) -> bool;
}

/// Tries every triangle of a list or slice: for a few triangles, small targets and tests.
#[derive(Clone, Copy, Debug)]
pub struct BruteForce<T>(pub T);

impl<T: AsRef<[[Vec3; 3]]>> BruteForce<T> {
    fn hits<'a>(&'a self, ray: &Ray) -> impl Iterator<Item = Hit> + 'a {
        let (sheared, end) = (ShearedRay::new(ray), ray.end);
        self.0.as_ref().iter().enumerate().filter_map(move |(index, corners)| sheared.hit(corners, index as u32, end))
    }
}

impl<T: AsRef<[[Vec3; 3]]> + Sync> Occluders for BruteForce<T> {
    fn first(&self, ray: &Ray, place: impl Fn(&Hit) -> Option<f32>) -> Option<Hit> {
        first_of(self.hits(ray), place)
    }

    fn any(&self, ray: &Ray, mut stop: impl FnMut(&Hit) -> bool) -> bool {
        self.hits(ray).any(|hit| stop(&hit))
    }
}

/// The first of some hits by their places; hits without a place do not count.
pub(super) fn first_of(hits: impl Iterator<Item = Hit>, place: impl Fn(&Hit) -> Option<f32>) -> Option<Hit> {
    let placed = hits.filter_map(|hit| Some((place(&hit)?, hit)));
    let first = placed.reduce(|first, other| if is_before(&other, &first) { other } else { first });
    first.map(|(_, hit)| hit)
}

/// The order of placed hits along a ray.
#[inline]
pub(super) fn is_before(hit: &(f32, Hit), other: &(f32, Hit)) -> bool {
    hit.0 < other.0 || (hit.0 == other.0 && hit.1.triangle < other.1.triangle)
}
