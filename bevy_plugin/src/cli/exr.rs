//! Lightmaps as OpenEXR, 32-bit floats.

use std::io::Cursor;

use exr::prelude::{Encoding, Image, SpecificChannels, WritableImage};
use radiosity::lightmap::LightmapImage;

use super::error::CliError;

/// The bytes of an EXR file with red, green and blue.
pub(super) fn encode(lightmap: &LightmapImage) -> Result<Vec<u8>, CliError> {
    let width = lightmap.width as usize;
    let channels = SpecificChannels::rgb(|position: exr::math::Vec2<usize>| {
        let texel = lightmap.texels[position.y() * width + position.x()];
        (texel.x, texel.y, texel.z)
    });
    let size = (width, lightmap.height as usize);
    let mut file = Cursor::new(Vec::new());
    let image = Image::from_encoded_channels(size, Encoding::SMALL_LOSSLESS, channels);
    image.write().to_buffered(&mut file).map_err(|error| CliError::new(format!("cannot encode EXR: {error}")))?;
    Ok(file.into_inner())
}

#[cfg(test)]
mod tests {
    use exr::prelude::{ReadChannels, ReadLayers};

    use super::*;

    /// Every bit comes back, above 1 and below too.
    #[test]
    fn reads_back() {
        let texel = |i: u32| [i as f32 * 0.1, 1e5 / (i + 1) as f32, 1e-7 * i as f32].into();
        let lightmap =
            LightmapImage { width: 8, height: 4, texels: (0..32).map(texel).collect(), ..Default::default() };
        let file = encode(&lightmap).unwrap();
        let image = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .rgb_channels(
                |size, _| vec![bevy::math::Vec3::ZERO; size.area()],
                |texels, position, (r, g, b): (f32, f32, f32)| {
                    texels[position.y() * 8 + position.x()] = [r, g, b].into()
                },
            )
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(file))
            .unwrap();
        assert_eq!(image.layer_data.channel_data.pixels, lightmap.texels);
    }
}
