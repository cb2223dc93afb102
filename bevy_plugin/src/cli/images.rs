//! Finished lightmaps on their way into files, and what is kept of them for pictures.

use radiosity::bake::{Bake, KEPT_TEXELS};
use radiosity::lightmap::LightmapImage;

use super::error::CliError;
use super::exr;
use super::output::Staging;
use crate::baked::ktx2;
use crate::baked::manifest;

/// The lightmaps of a bake.
#[derive(Default)]
pub(super) struct Images {
    /// Width and height of each.
    pub sizes: Vec<[u32; 2]>,
    /// Each as it is, or halved so often that all of them are not too many texels.
    kept: Vec<LightmapImage>,
    halvings: u32,
}

impl Images {
    /// Writes a lightmap into its files, and keeps what there is room for. They come in any order.
    pub fn take(&mut self, index: usize, image: LightmapImage, staging: &mut Staging) -> Result<(), CliError> {
        let name = manifest::image_file(index);
        staging.write(&name, &ktx2::encode(&image))?;
        staging.write(&exr_name(&name), &exr::encode(&image)?)?;
        if self.kept.len() <= index {
            self.kept.resize(index + 1, LightmapImage::default());
            self.sizes.resize(index + 1, [0; 2]);
        }
        self.sizes[index] = [image.width, image.height];
        self.kept[index] = (0..self.halvings).fold(image, |image, _| image.halved());
        while self.kept.iter().map(|image| image.texels.len()).sum::<usize>() > KEPT_TEXELS {
            self.kept.iter_mut().for_each(|image| *image = image.halved());
            self.halvings += 1;
        }
        Ok(())
    }

    /// Puts what was kept into a bake; returns the sizes of the lightmaps as they are in the files.
    pub fn put_into(self, bake: &mut Bake) -> Vec<[u32; 2]> {
        for seam in &mut bake.seams {
            let (kept, [width, _]) = (&self.kept[seam.image as usize], self.sizes[seam.image as usize]);
            let [x, y] = [seam.texel % width, seam.texel / width].map(|position| position >> self.halvings);
            seam.texel = y.min(kept.height - 1) * kept.width + x.min(kept.width - 1);
        }
        bake.images = self.kept;
        self.sizes
    }
}

/// The name of the other file of a lightmap.
pub(super) fn exr_name(ktx2_name: &str) -> String {
    format!("{}.exr", ktx2_name.trim_end_matches(".ktx2"))
}
