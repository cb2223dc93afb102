//! Starts that know more than zero: patches as local lighting shows them.

use super::System;
use crate::form_factor::point_to_point;
use crate::math::{Real, Vector};
use crate::spectrum::Spectrum;

/// A point light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp<V, S> {
    /// Where it is.
    pub position: V,
    /// Power per solid angle, so that `intensity / r^2` is an irradiance; where radiosities are given as radiances,
    /// divided by pi.
    pub intensity: S,
}

/// A patch as a flat piece of surface at its center.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet<V, R> {
    /// Where it is.
    pub center: V,
    /// Where it looks, length 1.
    pub normal: V,
    /// In the square of the unit of the positions.
    pub area: R,
}

/// Sets `radiosity` to what local lighting gives: `b_i = e_i + rho_i E_i`, where `E_i` is the irradiance from the lamps
/// and from the patches that emit, with nothing in between. A start that is nearer to the solution than zero or `e`.
///
/// The diffuse part of Phong's lighting model (1975), with the square of the distance. An emitting patch counts as a
/// disc, `F = cos a cos b A / (pi r^2 + A)`, which is the formula for two points where it is far away, and never above
/// 1 where it is near. There is a facet for each patch; radiosities beyond them stay what they are.
pub fn phong_start<S, V, F>(
    system: &System<S, F>,
    facets: &[Facet<V, S::Scalar>],
    lamps: &[Lamp<V, S>],
    radiosity: &mut [S],
) where
    S: Spectrum,
    V: Vector<Scalar = S::Scalar>,
{
    for (i, (radiosity, facet)) in radiosity.iter_mut().zip(facets).enumerate() {
        let mut irradiance = S::default();
        lamps.iter().for_each(|lamp| irradiance += lamp.irradiance(facet));
        for (emitter, &exitance) in facets.iter().zip(system.exitance).filter(|(_, e)| **e != S::default()) {
            irradiance += exitance * emitter.seen_from(facet);
        }
        *radiosity = system.exitance[i] + system.reflectance[i] * irradiance;
    }
}

impl<V: Vector<Scalar = S::Scalar>, S: Spectrum> Lamp<V, S> {
    /// `I cos a / r^2`; zero behind the facet and at the lamp itself.
    fn irradiance(&self, facet: &Facet<V, S::Scalar>) -> S {
        let towards = self.position - facet.center;
        let cosine = facet.normal.dot(towards.normalize_or_zero());
        if cosine > S::Scalar::ZERO { self.intensity * (cosine / towards.length_squared()) } else { S::default() }
    }
}

impl<V: Vector> Facet<V, V::Scalar> {
    /// The form factor from another facet to this one; zero where one is behind the other.
    fn seen_from(&self, other: &Self) -> V::Scalar {
        let squared = (self.center - other.center).length_squared();
        let of_points = point_to_point(other.center, other.normal, self.center, self.normal, self.area);
        if of_points > V::Scalar::ZERO {
            of_points / (V::Scalar::ONE + self.area / (V::Scalar::PI * squared))
        } else {
            V::Scalar::ZERO
        }
    }
}
