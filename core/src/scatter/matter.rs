//! Any of the surfaces here.

use glam::Vec3;

use super::{Coated, Colored, Ggx, Glass, Lambert, Mirror, Mixture, Phong, Scatter, Scattered};

/// What a surface of a scene is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Matter<S> {
    /// Diffuse.
    Lambert(Lambert<S>),
    /// A perfect mirror.
    Mirror(Mirror<S>),
    /// A glossy lobe.
    Phong(Phong<S>),
    /// Rough metal or varnish.
    Ggx(Ggx<S>),
    /// The border of something clear.
    Glass(Glass<S>),
    /// Rough metal in places, diffuse in others.
    Glossy(Mixture<Ggx<S>, Lambert<S>>),
    /// Diffuse below a varnish.
    Coated(Coated<Ggx<S>, Lambert<S>>),
}

impl<S: Colored> Matter<S> {
    fn as_scatter(&self) -> &dyn Scatter<S> {
        match self {
            Self::Lambert(surface) => surface,
            Self::Mirror(surface) => surface,
            Self::Phong(surface) => surface,
            Self::Ggx(surface) => surface,
            Self::Glass(surface) => surface,
            Self::Glossy(surface) => surface,
            Self::Coated(surface) => surface,
        }
    }
}

impl<S: Colored> Scatter<S> for Matter<S> {
    fn evaluate(&self, arrival: Vec3, departure: Vec3) -> S {
        self.as_scatter().evaluate(arrival, departure)
    }

    fn density(&self, arrival: Vec3, departure: Vec3) -> f32 {
        self.as_scatter().density(arrival, departure)
    }

    fn sample(&self, departure: Vec3, numbers: Vec3) -> Option<Scattered<S>> {
        self.as_scatter().sample(departure, numbers)
    }

    fn transmittance(&self, distance: f32) -> S {
        self.as_scatter().transmittance(distance)
    }
}
