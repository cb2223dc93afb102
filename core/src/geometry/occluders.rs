//! What stands in the way of light: any set of triangles that can be asked where a ray meets it.

use glam::Vec3;

use super::triangle::ShearedRay;
use super::{Hit, Ray};

/// A set of triangles. Of several hits at the same distance the lowest triangle index wins, whatever the tree.
pub trait Occluders: Sync {
    /// The nearest hit among those that `accept` does not let through.
    fn nearest(&self, ray: &Ray, accept: impl Fn(&Hit) -> bool) -> Option<Hit>;

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
    fn nearest(&self, ray: &Ray, accept: impl Fn(&Hit) -> bool) -> Option<Hit> {
        self.hits(ray).filter(accept).reduce(|nearest, hit| if is_before(&hit, &nearest) { hit } else { nearest })
    }

    fn any(&self, ray: &Ray, mut stop: impl FnMut(&Hit) -> bool) -> bool {
        self.hits(ray).any(|hit| stop(&hit))
    }
}

/// The order of hits along a ray.
#[inline]
pub(super) fn is_before(hit: &Hit, other: &Hit) -> bool {
    hit.distance < other.distance || (hit.distance == other.distance && hit.triangle < other.triangle)
}
