//! What happens to light where it meets a surface: the `rho` of the rendering equation.
//!
//! Light that leaves `p''` towards `p'''` is what is emitted there and what arrives from all visible `p'`:
//!
//! ```text
//! f(p'', p''') = e(p'', p''') + ∫ f(p', p'') rho(p', p'', p''') dp'
//! ```
//!
//! The integral runs over surfaces, so that `rho` holds the geometry between `p'` and `p''` beside what the surface does:
//!
//! ```text
//! rho(p', p'', p''') = v(p', p'') s(arrival, departure) cos cos' / r^2
//! ```
//!
//! `r` is the distance from `p'` to `p''`, `cos` and `cos'` are measured at `p''` and `p'` between the line and the
//! normals, `v` is 1 where the two see each other and else 0, and `s` is the bidirectional scattering distribution
//! function (BSDF), in 1/sr: `arrival` points from `p''` to `p'`, `departure` from `p''` to `p'''`. The solid angle that
//! `dp'` fills seen from `p''` is `dω = cos' / r^2 dp'`. With it the same integral runs over directions, without any
//! distance: `∫ f s cos dω`. [`Scatter`] is `s`; the factor `cos` belongs to the integral.
//!
//! A **perfect mirror** is given in two cases: `rho` is infinite where the line from `p'` leaves `p''` reflected towards
//! `p'''`, and 0 elsewhere. That is meant as a Dirac delta: the reflectance times `δ(arrival - mirrored departure) / cos`,
//! so that the integral over all directions is the reflectance times the light from the one direction. No point chosen
//! elsewhere can hit it. [`Scatter::evaluate`] and [`Scatter::density`] leave such parts out, [`Scatter::sample`] chooses
//! them and says so by [`Density::Dirac`].
//!
//! All directions have length 1 and are seen from the surface, in a frame in which `z` is the normal: light goes on below
//! 0 where it passes. What is carried is radiance over the square of the index of refraction, which refraction leaves as
//! it is: in air that is the radiance.

mod coated;
mod ggx;
mod glass;
mod lambert;
mod matter;
mod mirror;
mod mixture;
mod phong;

pub use coated::*;
pub use ggx::*;
pub use glass::*;
pub use lambert::*;
pub use matter::*;
pub use mirror::*;
pub use mixture::Mixture;
pub use phong::*;

use glam::Vec3;

use crate::spectrum::Spectrum;

/// A spectrum in single precision.
pub trait Colored: Spectrum<Scalar = f32> {}

impl<S: Spectrum<Scalar = f32>> Colored for S {}

/// How a surface scatters light: its BSDF. Symmetric in its two directions and without gain.
pub trait Scatter<S: Colored> {
    /// The BSDF without Dirac parts, in 1/sr, not negative.
    fn evaluate(&self, arrival: Vec3, departure: Vec3) -> S;

    /// With which density, in 1/sr, [`Scatter::sample`] chooses this arrival; Dirac parts left out.
    fn density(&self, arrival: Vec3, departure: Vec3) -> f32;

    /// Chooses where light comes from, by three numbers in `[0, 1)`; nothing where the light is absorbed.
    fn sample(&self, departure: Vec3, numbers: Vec3) -> Option<Scattered<S>>;

    /// The share of light that is left after a way in meters behind the surface, in `[0, 1]`.
    fn transmittance(&self, _distance: f32) -> S {
        S::splat(1.0)
    }
}

/// One direction that light comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattered<S> {
    /// Where the light comes from, of length 1.
    pub arrival: Vec3,
    /// BSDF times cosine over density: what the light that arrives is to be multiplied by.
    pub weight: S,
    /// How likely the direction was.
    pub density: Density,
}

/// How likely a direction was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Density {
    /// In 1/sr, positive.
    PerSteradian(f32),
    /// The only one of its kind, or one of two: no other way leads there.
    Dirac,
}

/// The direction mirrored at the surface.
fn mirrored(direction: Vec3) -> Vec3 {
    Vec3::new(-direction.x, -direction.y, direction.z)
}

/// Whether light stays on the front of the surface.
fn is_reflected(arrival: Vec3, departure: Vec3) -> bool {
    arrival.z > 0.0 && departure.z > 0.0
}
