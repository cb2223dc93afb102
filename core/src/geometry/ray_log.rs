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

/// Takes down nothing, at no cost.
#[derive(Clone, Copy, Debug)]
pub struct NoLog;

impl RayLog for NoLog {
    #[inline]
    fn record(&self, _: &Ray, _: RayKind) {}
}

/// Occluders whose rays are taken down.
#[derive(Clone, Copy, Debug)]
pub struct Logged<'a, O, L> {
    /// What is asked for hits.
    pub occluders: O,
    /// What takes down the rays.
    pub log: &'a L,
}

impl<O: Occluders, L: RayLog> Occluders for Logged<'_, O, L> {
    #[inline]
    fn first(&self, ray: &Ray, place: impl Fn(&Hit) -> Option<f32>) -> Option<Hit> {
        self.log.record(ray, RayKind::Closest);
        self.occluders.first(ray, place)
    }

    #[inline]
    fn any(&self, ray: &Ray, stop: impl FnMut(&Hit) -> bool) -> bool {
        self.log.record(ray, RayKind::AnyHit);
        self.occluders.any(ray, stop)
    }
}
