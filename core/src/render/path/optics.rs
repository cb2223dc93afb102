//! What paths of light meet.

use glam::{Vec2, Vec3};

use crate::geometry::{Hit, Ray};
use crate::light::PlaneMirror;
use crate::scatter::{Colored, Scatter};

/// Surfaces and surroundings as light meets them.
pub trait Optics<S: Colored>: Sync {
    /// What the surfaces are made of.
    type Scatter: Scatter<S>;

    /// Corners of all triangles, counter-clockwise seen from the front.
    fn corners(&self) -> &[[Vec3; 3]];

    /// The nearest thing along a ray, and what is left of light that comes from there. What lets a share of the light
    /// through is met with the rest as probability, decided by `seed`.
    fn nearest(&self, ray: &Ray, seed: u32) -> (Option<Hit>, S);

    /// The share of light that passes along a ray straight on, in `[0, 1]`.
    fn visibility(&self, ray: &Ray) -> S;

    /// The share that arrives of light at the end of a ray, where that is the image of a lamp behind a plane mirror:
    /// nothing in surroundings that know no such images.
    fn shown_by(&self, _mirror: &PlaneMirror, _ray: &Ray) -> S {
        S::default()
    }

    /// The share of light that does not pass straight on at a hit, in `[0, 1]`.
    fn opacity(&self, hit: &Hit) -> f32;

    /// The normal on the front, of length 1, and what scatters light there.
    fn surface(&self, hit: &Hit) -> (Vec3, Self::Scatter);

    /// Emitted radiance of the front in cd/m2, not negative.
    fn emission(&self, hit: &Hit) -> S;

    /// Whether the back of a triangle scatters and emits as its front does.
    fn both_sides(&self, triangle: u32) -> bool;

    /// Radiance in cd/m2 that arrives from outside of the scene in a direction that leads there, of any length.
    fn sky(&self, direction: Vec3) -> S;

    /// A direction of length 1 to ask for light of the surroundings, by two numbers in `[0, 1)`: nothing where they are
    /// even enough to be met by chance.
    fn toward_sky(&self, _numbers: Vec2) -> Option<Vec3> {
        None
    }

    /// With which density [`Optics::toward_sky`] gives a direction, in 1/sr.
    fn density_of_sky(&self, _direction: Vec3) -> f32 {
        0.0
    }
}
