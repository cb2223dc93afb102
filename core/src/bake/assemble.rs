//! Texels back into images, and what is kept beside them.

use alloc::vec;
use alloc::vec::Vec;

use glam::{Vec3, Vec3A};

use crate::lightmap::{Gathered, LightmapImage, NONE, Patches, Seams, Smooth, TexelState, Texels, blend, dilate};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::scene::Scene;
use crate::transport::{Contact, Fills, LampLight, Lighting, Rows, StoredImage, Surfaces, Transport};

/// What finished images are made of.
pub(super) struct Assembly<'a> {
    pub texels: &'a Texels,
    pub is_valid: &'a [bool],
    pub patches: &'a Patches,
    pub workers: &'a Workers,
    pub progress: &'a Progress,
}

/// What gathered light.
pub(super) struct Gatherers {
    /// For each texel.
    pub gathered: Vec<Gathered>,
    /// What nodes see.
    pub rows: Rows,
    pub contacts: Vec<Contact>,
}

/// What is done to finished images.
pub(super) struct Repairs {
    /// For each image how missing texels are filled.
    pub fills: Vec<Fills>,
    pub seams: Seams,
}

impl Assembly<'_> {
    /// The finished images of the texels that are here: direct and indirect light together, what is missing filled in;
    /// and how it was filled.
    pub fn images(
        &self,
        direct: &[Vec3A],
        indirect: &[Smooth],
        errors: &[f32],
    ) -> Result<(Vec<LightmapImage>, Vec<Fills>), Cancelled> {
        let first = self.texels.here.start;
        let finished = self.workers.map(self.texels.here.len(), 1, self.progress, |range| {
            range
                .map(|index| {
                    let mut image = self.image(first + index, direct, indirect, errors);
                    dilate(&mut image, self.progress).map(|fills| (image, fills))
                })
                .collect()
        })?;
        finished.into_iter().collect()
    }

    fn image(&self, index: usize, direct: &[Vec3A], indirect: &[Smooth], errors: &[f32]) -> LightmapImage {
        let mut image = empty(self.texels.sizes[index]);
        for (at, &texel) in self.texels.index[index].iter().enumerate().filter(|(_, texel)| **texel != NONE) {
            let texel = texel as usize;
            image.charts[at] = self.texels.list[texel].chart;
            image.errors[at] = errors[texel];
            image.patches[at] = self.patches.of_texel[texel];
            image.states[at] = if self.is_valid[texel] { TexelState::Valid } else { TexelState::Invalid };
            if self.is_valid[texel] {
                image.texels[at] = (Vec3::from(direct[texel]) + indirect[texel].irradiance).max(Vec3::ZERO);
            }
        }
        image
    }

    /// All that other light needs.
    pub fn transport(
        &self,
        surfaces: Surfaces,
        lamps: Vec<LampLight>,
        patches: Rows,
        Gatherers { gathered, rows: nodes, contacts }: Gatherers,
        Repairs { fills, seams }: Repairs,
        scene: &Scene,
    ) -> Result<Transport, Cancelled> {
        let texels = blend(&gathered, self.texels, self.is_valid, self.workers, self.progress)?;
        let images = fills.into_iter().enumerate().map(|(index, fills)| self.stored(index, fills)).collect();
        Ok(Transport {
            surfaces,
            lamps,
            patches,
            nodes,
            contacts,
            texels,
            images,
            seams,
            lighting: Lighting::from(scene),
            lamp_names: scene.lights.iter().map(|light| light.name.clone()).collect(),
            material_names: scene.materials.iter().map(|material| material.name.clone()).collect(),
        })
    }

    fn stored(&self, index: usize, fills: Fills) -> StoredImage {
        let [width, height] = self.texels.sizes[index];
        let of_image =
            self.texels.list.iter().zip(self.is_valid).filter(|(texel, _)| usize::from(texel.image) == index);
        let places = of_image.map(|(texel, &is_valid)| {
            let [column, row] = texel.pixel.map(u32::from);
            if is_valid { row * width + column } else { StoredImage::NOWHERE }
        });
        StoredImage { width, height, places: places.collect(), fills }
    }
}

fn empty([width, height]: [u32; 2]) -> LightmapImage {
    let count = (width * height) as usize;
    LightmapImage {
        width,
        height,
        texels: vec![Vec3::ZERO; count],
        states: vec![TexelState::Empty; count],
        charts: vec![NONE; count],
        patches: vec![NONE; count],
        errors: vec![0.0; count],
    }
}
