//! Surfaces as rays see them: which piece of them stands for a hit.

use alloc::vec::Vec;

use glam::Vec3;

use super::pieces::Pieces;
use crate::geometry::{Hit, Occluders};
use crate::lightmap::{NONE, Patches, Seen, Texels};
use crate::transport::{Size, Surfaces, Tracer};

/// A ray looks at a square of 4 x 4 texels where its cone is wider than so many of their sides.
const FOUR: f32 = 2.8;
/// The same for 2 x 2.
const TWO: f32 = 1.4;

/// All surfaces of a bake.
pub(super) struct Field<'a, O> {
    tracer: &'a Tracer<'a, O>,
    texels: &'a Texels,
    patches: &'a Patches,
    surfaces: &'a Surfaces,
    /// Width of what one ray stands for at a distance of one meter, in meters.
    spread: f32,
    /// For each texel all that a ray usually wants to know, in one place: hits lie anywhere in memory, and waiting for it
    /// takes as long as traversing a tree.
    looks: Vec<Look>,
}

/// What is seen of a texel.
#[derive(Clone, Copy)]
struct Look {
    /// In square meters; 0 where a wall parts the texel or no light leaves it, so that more has to be asked.
    area: f32,
    patch: u32,
    /// Columns of its cells of 4 x 4 and of 2 x 2 texels.
    cells: [u32; 2],
}

impl<'a, O: Occluders> Field<'a, O> {
    /// `spread` is the width of what one ray stands for at a distance of one meter, in meters.
    pub fn new(pieces: &Pieces<'a, O>, surfaces: &'a Surfaces, spread: f32) -> Self {
        let Pieces { tracer, texels, patches, .. } = *pieces;
        let look = |texel: u32| {
            let patch = patches.of_texel[texel as usize];
            let is_plain = patch != NONE && !texels.links.is_cut(texel);
            let area = if is_plain { texels.list[texel as usize].area } else { 0.0 };
            Look { area, patch, cells: [Size::Four, Size::Two].map(|size| surfaces.column(texel, size)) }
        };
        let looks = (0..texels.list.len() as u32).map(look).collect();
        Self { tracer, texels, patches, surfaces, spread, looks }
    }

    /// What a ray in a direction sees: the sky where it hits nothing.
    ///
    /// A ray of many stands for a cone. What is met far away is looked at as coarsely as the cone is wide there. That is
    /// less noise for the same light.
    #[inline]
    pub fn look(&self, direction: Vec3, hit: Option<&Hit>) -> Seen {
        let Some(hit) = hit else { return unknown(self.surfaces.sky() + self.tracer.world.sky_patch(direction)) };
        let texel = if hit.front { self.texels.at(hit) } else { None };
        match texel.map(|texel| (texel, self.looks[texel as usize])) {
            Some((texel, look)) if look.area > 0.0 => self.of_texel(texel, look, hit.distance),
            _ => self.look_closely(hit),
        }
    }

    #[inline]
    fn of_texel(&self, texel: u32, look: Look, distance: f32) -> Seen {
        Seen { column: self.column(texel, look, distance), texel }
    }

    #[inline]
    fn column(&self, texel: u32, look: Look, distance: f32) -> u32 {
        let Look { area, patch, cells: [four, two] } = look;
        let width = distance * self.spread;
        if width * width > self.patches.list[patch as usize].area {
            return patch;
        }
        match width * width / area {
            texels if texels > FOUR * FOUR => four,
            texels if texels > TWO * TWO => two,
            _ => self.surfaces.column(texel, Size::Texel),
        }
    }

    #[inline(never)]
    fn look_closely(&self, hit: &Hit) -> Seen {
        match self.patches.at(self.tracer, self.texels, hit) {
            None => unknown(self.surfaces.black()),
            Some((patch, Some(texel))) if self.patches.list[patch as usize].side > 0.0 => {
                let look = Look { area: self.texels.list[texel as usize].area, ..self.looks[texel as usize] };
                self.of_texel(texel, look, hit.distance)
            }
            Some((patch, _)) => unknown(patch),
        }
    }
}

/// What has no texel that is here.
fn unknown(column: u32) -> Seen {
    Seen { column, texel: NONE }
}
