//! Texels back into images.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3;

use crate::lightmap::{LightmapImage, NONE, Patches, Smooth, TexelState, Texels, dilate};
use crate::parallel::Workers;
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
    let finished = workers.map(texels.sizes.len(), 1, progress, |range| {
        range
            .map(|index| {
                let mut image = empty(texels.sizes[index]);
                for (at, &texel) in texels.index[index].iter().enumerate().filter(|(_, texel)| **texel != NONE) {
                    let texel = texel as usize;
                    image.charts[at] = texels.list[texel].chart;
                    image.patches[at] = patches.of_texel[texel];
                    image.states[at] = if is_valid[texel] { TexelState::Valid } else { TexelState::Invalid };
                    if is_valid[texel] {
                        image.texels[at] = (direct[texel] + indirect[texel].irradiance).max(Vec3::ZERO);
                    }
                }
                dilate(&mut image, progress).map(|()| image)
            })
            .collect()
    })?;
    finished.into_iter().collect()
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
    }
}
