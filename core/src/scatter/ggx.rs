//! The rough metal or varnish that Bevy draws.

use core::f32::consts::PI;

use glam::Vec3;

use super::{Colored, Density, Scatter, Scattered, is_reflected, mirrored};
use crate::geometry::disc;
use crate::math;

/// Mirrors so small that only their mean is seen: the specular lobe of Bevy's `StandardMaterial`, `D V F`.
///
/// `D` is the distribution of Trowbridge and Reitz (GGX), `V` the visibility of Smith with heights correlated, `F` the
/// Fresnel term of Schlick with `f90` 1 from 2 % on. The gain that Bevy adds for light that bounces between the mirrors
/// depends on the eye alone: it would make the lobe unsymmetric, and is left out, as light that bounces twice is.
/// Directions are chosen among visible mirrors: Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 2018.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx<S> {
    /// Reflectance along the normal, in `[0, 1]`: the base color of metals, 0.04 for most else.
    pub f0: S,
    /// Squared perceptual roughness, in `(0, 1]`.
    alpha: f32,
}

/// Bevy's least perceptual roughness.
const SMOOTHEST: f32 = 0.089;

impl<S: Colored> Ggx<S> {
    /// Of a reflectance along the normal, in `[0, 1]`, and the perceptual roughness of Bevy's material, held between 0.089
    /// and 1 as there.
    pub fn new(f0: S, perceptual_roughness: f32) -> Self {
        let roughness = perceptual_roughness.clamp(SMOOTHEST, 1.0);
        Self { f0, alpha: roughness * roughness }
    }

    /// Schlick's approximation for light that meets a mirror under this cosine.
    fn fresnel(&self, cos: f32) -> S {
        let rest = (1.0 - cos).max(0.0);
        let fifth = rest * rest * (rest * rest) * rest;
        self.f0.zip(S::default(), |f0, _| {
            let f90 = (49.5 * f0).min(1.0);
            f0 + (f90 - f0) * fifth
        })
    }

    /// Density of the normals of the mirrors, in 1/sr.
    fn distribution(&self, half: Vec3) -> f32 {
        let a = half.z * self.alpha;
        let k = self.alpha / (half.x * half.x + half.y * half.y + a * a);
        k * k / PI
    }

    /// `sqrt(a^2 + (1 - a^2) cos^2)`
    fn root(&self, cos: f32) -> f32 {
        let squared = self.alpha * self.alpha;
        math::sqrt(squared + (1.0 - squared) * cos * cos)
    }

    /// Share of the mirrors that a direction sees.
    fn visible(&self, cos: f32) -> f32 {
        2.0 * cos / (cos + self.root(cos))
    }

    /// Visibility of both directions over four times both cosines.
    fn visibility(&self, arrival: Vec3, departure: Vec3) -> f32 {
        0.5 / (arrival.z * self.root(departure.z) + departure.z * self.root(arrival.z))
    }

    /// The normal of a visible mirror.
    fn visible_normal(&self, departure: Vec3, numbers: Vec3) -> Vec3 {
        let view = Vec3::new(self.alpha * departure.x, self.alpha * departure.y, departure.z).normalize();
        let across = Vec3::new(-view.y, view.x, 0.0).try_normalize().unwrap_or(Vec3::X);
        let foot = disc(numbers.truncate());
        let lens = 0.5 * (1.0 + view.z);
        let edge = math::sqrt((1.0 - foot.x * foot.x).max(0.0));
        let up = (1.0 - lens) * edge + lens * foot.y;
        let height = math::sqrt((1.0 - foot.x * foot.x - up * up).max(0.0));
        let normal = across * foot.x + view.cross(across) * up + view * height;
        Vec3::new(self.alpha * normal.x, self.alpha * normal.y, normal.z.max(1e-6)).normalize()
    }
}

impl<S: Colored> Scatter<S> for Ggx<S> {
    fn evaluate(&self, arrival: Vec3, departure: Vec3) -> S {
        if !is_reflected(arrival, departure) {
            return S::default();
        }
        let half = (arrival + departure).normalize();
        self.fresnel(half.dot(departure)) * (self.distribution(half) * self.visibility(arrival, departure))
    }

    fn density(&self, arrival: Vec3, departure: Vec3) -> f32 {
        if !is_reflected(arrival, departure) {
            return 0.0;
        }
        let half = (arrival + departure).normalize();
        self.visible(departure.z) * self.distribution(half) / (4.0 * departure.z)
    }

    fn sample(&self, departure: Vec3, numbers: Vec3) -> Option<Scattered<S>> {
        if departure.z <= 0.0 {
            return None;
        }
        let half = self.visible_normal(departure, numbers);
        let arrival = (half * (2.0 * half.dot(departure)) - departure).normalize_or(mirrored(departure));
        let density = self.density(arrival, departure);
        let shares = 4.0 * self.visibility(arrival, departure) * arrival.z * departure.z / self.visible(departure.z);
        let weight = self.fresnel(half.dot(departure)) * shares;
        (density > 0.0).then_some(Scattered { arrival, weight, density: Density::PerSteradian(density) })
    }
}
