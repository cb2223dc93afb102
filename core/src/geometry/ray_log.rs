//! Rays written down as they are traced, to trace them again elsewhere.

use super::{Hit, Occluders, Ray};

/// What a ray was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// The nearest hit.
    Closest,
    /// Whether there is a hit.
    AnyHit,
}

/// Takes down rays.
pub trait RayLog: Sync {
    /// Takes down a ray before it is traced.
    fn record(&self, ray: &Ray, kind: RayKind);
}

/// Occluders whose rays are taken down.
#[derive(Clone, Copy)]
pub struct Logged<'a, O> {
    /// What is asked for hits.
    pub occluders: O,
    /// What takes down the rays, if anything does.
    pub log: Option<&'a dyn RayLog>,
}

impl<O> Logged<'_, O> {
    #[inline]
    fn record(&self, ray: &Ray, kind: RayKind) {
        if let Some(log) = self.log {
            log.record(ray, kind);
        }
    }
}

impl<O: Occluders> Occluders for Logged<'_, O> {
    #[inline]
    fn first(&self, ray: &Ray, place: impl Fn(&Hit) -> Option<f32>) -> Option<Hit> {
        self.record(ray, RayKind::Closest);
        self.occluders.first(ray, place)
    }

    #[inline]
    fn any(&self, ray: &Ray, stop: impl FnMut(&Hit) -> bool) -> bool {
        self.record(ray, RayKind::AnyHit);
        self.occluders.any(ray, stop)
    }
}
