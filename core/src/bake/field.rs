//! Surfaces as rays see them: which piece of them stands for a hit.

use crate::geometry::{Hit, Occluders};
use crate::lightmap::{Patches, Texels};
use crate::transport::{Size, Surfaces, Tracer};

/// A ray looks at a square of 4 x 4 texels where its cone is wider than so many of their sides.
const FOUR: f32 = 2.8;
/// The same for 2 x 2.
const TWO: f32 = 1.4;

/// All surfaces of a bake.
pub(super) struct Field<'a, O> {
    pub tracer: &'a Tracer<'a, O>,
    pub texels: &'a Texels,
    pub patches: &'a Patches,
    pub surfaces: &'a Surfaces,
    /// Width of what one ray stands for at a distance of one meter, in meters.
    pub spread: f32,
}

impl<O: Occluders> Field<'_, O> {
    /// The column that a ray sees: the sky where it hits nothing.
    ///
    /// A ray of many stands for a cone. What is met far away is looked at as coarsely as the cone is wide there. That is
    /// less noise for the same light.
    pub fn column(&self, hit: Option<&Hit>) -> u32 {
        let Some(hit) = hit else { return self.surfaces.sky() };
        let Some((index, texel)) = self.patches.at(self.tracer, self.texels, hit) else { return self.surfaces.black() };
        let patch = &self.patches.list[index as usize];
        let width = hit.distance * self.spread;
        match texel {
            Some(texel) if patch.side > 0.0 && width * width <= patch.area => {
                let texels = width * width / self.texels.list[texel as usize].area;
                self.surfaces.column(texel, size(texels))
            }
            _ => index,
        }
    }
}

/// How finely a cone looks that is as wide as so many texels are large.
fn size(texels: f32) -> Size {
    if texels > FOUR * FOUR {
        Size::Four
    } else if texels > TWO * TWO {
        Size::Two
    } else {
        Size::Texel
    }
}
