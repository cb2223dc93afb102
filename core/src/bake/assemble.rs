//! Texels back into images.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3;

use crate::lightmap::{LightmapImage, NONE, Smooth, TexelState, Texels, dilate};
use crate::parallel::Workers;
use crate::patch::Patches;
use crate::progress::{Cancelled, Progress};

/// The finished images: direct and indirect light together, what is missing filled in.
pub(super) fn images(
    texels: &Texels,
    is_valid: &[bool],
    patches: &Patches,
    direct: &[Vec3],
    indirect: &[Smooth],
    workers: &Workers,
    progress: &Progress,
) -> Result<Vec<LightmapImage>, Cancelled> {
    workers.map(texels.sizes.len(), 1, progress, |range| {
        range
            .map(|image| {
                let mut image = empty(texels, image);
                for (at, &texel) in texels.index[image.0].iter().enumerate().filter(|(_, texel)| **texel != NONE) {
                    let index = texel as usize;
                    image.1.charts[at] = texels.list[index].chart;
                    image.1.patches[at] = patches.of_texel[index];
                    image.1.states[at] = if is_valid[index] { TexelState::Valid } else { TexelState::Invalid };
                    if is_valid[index] {
                        image.1.texels[at] = (direct[index] + indirect[index].irradiance).max(Vec3::ZERO);
                    }
                }
                dilate(&mut image.1);
                image.1
            })
            .collect()
    })
}

fn empty(texels: &Texels, index: usize) -> (usize, LightmapImage) {
    let [width, height] = texels.sizes[index];
    let count = (width * height) as usize;
    let image = LightmapImage {
        width,
        height,
        texels: vec![Vec3::ZERO; count],
        states: vec![TexelState::Empty; count],
        charts: vec![NONE; count],
        patches: vec![NONE; count],
    };
    (index, image)
}
