//! A scene as its bake takes it: all that is reflected is reflected diffusely, but for mirrors.

use glam::{Vec2, Vec3};

use super::Optics;
use crate::geometry::{Hit, Occluders, Ray};
use crate::light::PlaneMirror;
use crate::scatter::{Lambert, Matter, Mirror};
use crate::transport::{LARGEST_REFLECTANCE, Tracer};

/// A scene of which the bake is an approximation: smooth metal is a mirror and other metal black beside its diffuse share;
/// what is blended is there with the probability of its alpha; glass colors light and does not bend it.
pub struct Diffuse<'a, O>(Tracer<'a, O>);

impl<'a, O: Occluders> Diffuse<'a, O> {
    /// Of a world in which rays are traced.
    pub fn new(tracer: Tracer<'a, O>) -> Self {
        Self(tracer)
    }
}

impl<O: Occluders> Optics<Vec3> for Diffuse<'_, O> {
    type Scatter = Matter<Vec3>;

    fn corners(&self) -> &[[Vec3; 3]] {
        &self.0.world.corners[..self.0.world.blockers]
    }

    fn nearest(&self, ray: &Ray, seed: u32) -> (Option<Hit>, Vec3) {
        self.0.nearest_tinted(ray, seed)
    }

    fn visibility(&self, ray: &Ray) -> Vec3 {
        self.0.transmittance(ray)
    }

    fn shown_by(&self, mirror: &PlaneMirror, ray: &Ray) -> Vec3 {
        self.0.shown_by(mirror, ray)
    }

    fn opacity(&self, hit: &Hit) -> f32 {
        self.0.world.opacity(hit)
    }

    fn surface(&self, hit: &Hit) -> (Vec3, Matter<Vec3>) {
        let world = self.0.world;
        let possible = |reflectance: Vec3| reflectance.min(Vec3::splat(LARGEST_REFLECTANCE));
        let matter = match world.mirror(hit) {
            Some(tint) => Matter::Mirror(Mirror { reflectance: possible(tint) }),
            None => Matter::Lambert(Lambert { reflectance: possible(world.reflectance(hit)) }),
        };
        (world.shading_normal(hit), matter)
    }

    fn emission(&self, hit: &Hit) -> Vec3 {
        self.0.world.emission(hit)
    }

    fn both_sides(&self, triangle: u32) -> bool {
        self.0.world.sides[triangle as usize].both
    }

    fn sky(&self, direction: Vec3) -> Vec3 {
        self.0.world.scene.sky_radiance(direction)
    }

    fn toward_sky(&self, numbers: Vec2) -> Option<Vec3> {
        self.0.world.scene.sky_image.as_ref()?.sample(numbers)
    }

    fn density_of_sky(&self, direction: Vec3) -> f32 {
        self.0.world.scene.sky_image.as_ref().map_or(0.0, |image| image.density(direction))
    }
}
