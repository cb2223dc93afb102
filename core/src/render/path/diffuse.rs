//! A scene as its bake takes it: all that is reflected is reflected diffusely, but for mirrors.

use glam::{Vec2, Vec3};

use super::Optics;
use crate::geometry::{Hit, Occluders, Ray};
use crate::light::PlaneMirror;
use crate::scatter::{Coated, Ggx, Lambert, Matter, Mirror};
use crate::transport::{LARGEST_REFLECTANCE, Tracer};

/// A scene of which the bake is an approximation: smooth metal is a mirror and other metal black beside its diffuse share;
/// what is blended is there with the probability of its alpha; glass colors light and does not bend it.
///
/// With gloss it is what Bevy draws of these materials: rough metal and varnish reflect.
pub struct Diffuse<'a, O> {
    tracer: Tracer<'a, O>,
    gloss: bool,
}

impl<'a, O: Occluders> Diffuse<'a, O> {
    /// Of a world in which rays are traced.
    pub fn new(tracer: Tracer<'a, O>) -> Self {
        Self { tracer, gloss: false }
    }

    /// The same with the lobes that no lightmap has.
    pub fn with_gloss(tracer: Tracer<'a, O>) -> Self {
        Self { tracer, gloss: true }
    }
}

impl<O: Occluders> Diffuse<'_, O> {
    /// What is diffuse below what reflects; the lobe is chosen by how much it gives along the normal.
    fn coated(&self, hit: &Hit) -> Matter<Vec3> {
        let world = self.tracer.world;
        let (f0, roughness) = world.gloss(hit);
        let reflectance = (world.reflectance(hit) * (Vec3::ONE - f0)).min(Vec3::splat(LARGEST_REFLECTANCE));
        let (coat, base) = (Ggx::new(f0.min(Vec3::splat(LARGEST_REFLECTANCE)), roughness), Lambert { reflectance });
        let [lobe, diffuse] = [f0, reflectance].map(|color| color.max_element());
        Matter::Coated(Coated { coat, base, chance: (lobe / (lobe + diffuse)).clamp(0.1, 0.9) })
    }
}

impl<O: Occluders> Optics<Vec3> for Diffuse<'_, O> {
    type Scatter = Matter<Vec3>;

    fn corners(&self) -> &[[Vec3; 3]] {
        &self.tracer.world.corners[..self.tracer.world.blockers]
    }

    fn nearest(&self, ray: &Ray, seed: u32) -> (Option<Hit>, Vec3) {
        self.tracer.nearest_tinted(ray, seed)
    }

    fn visibility(&self, ray: &Ray) -> Vec3 {
        self.tracer.transmittance(ray)
    }

    fn shown_by(&self, mirror: &PlaneMirror, ray: &Ray) -> Vec3 {
        self.tracer.shown_by(mirror, ray)
    }

    fn opacity(&self, hit: &Hit) -> f32 {
        self.tracer.world.opacity(hit)
    }

    fn surface(&self, hit: &Hit) -> (Vec3, Matter<Vec3>) {
        let world = self.tracer.world;
        let possible = |reflectance: Vec3| reflectance.min(Vec3::splat(LARGEST_REFLECTANCE));
        let matter = match world.mirror(hit) {
            Some(tint) => Matter::Mirror(Mirror { reflectance: possible(tint) }),
            None if self.gloss => self.coated(hit),
            None => Matter::Lambert(Lambert { reflectance: possible(world.reflectance(hit)) }),
        };
        (world.shading_normal(hit), matter)
    }

    fn emission(&self, hit: &Hit) -> Vec3 {
        self.tracer.world.emission(hit)
    }

    fn both_sides(&self, triangle: u32) -> bool {
        self.tracer.world.sides[triangle as usize].both
    }

    fn sky(&self, direction: Vec3) -> Vec3 {
        self.tracer.world.scene.sky_radiance(direction)
    }

    fn toward_sky(&self, numbers: Vec2) -> Option<Vec3> {
        self.tracer.world.scene.sky_image.as_ref()?.sample(numbers)
    }

    fn density_of_sky(&self, direction: Vec3) -> f32 {
        self.tracer.world.scene.sky_image.as_ref().map_or(0.0, |image| image.density(direction))
    }
}
