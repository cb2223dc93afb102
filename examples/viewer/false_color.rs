//! Pictures of how a lightmap is cut, one pixel for each texel.

use bevy::asset::RenderAssetUsages;
use bevy::image::{ImageFilterMode, ImageSampler, ImageSamplerDescriptor};
use bevy::prelude::*;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};
use radiosity::geometry::hash;
use radiosity::lightmap::{LightmapImage, NONE, TexelState};

use crate::views::View;

const INVALID: [u8; 4] = [220, 30, 30, 255];
const GUTTER: [u8; 4] = [40, 70, 220, 255];
const NOTHING: [u8; 4] = [0, 0, 0, 255];
/// The two grays of neighboring texels.
const GRAYS: [[u8; 4]; 2] = [[190, 190, 190, 255], [110, 110, 110, 255]];

/// What a view shows of a lightmap, if it is about more than its light.
pub fn image(view: View, lightmap: &LightmapImage) -> Option<Image> {
    let of_indices =
        |indices: &[u32], hue: fn(u32) -> f32| indices.iter().flat_map(|&index| of_index(index, hue)).collect();
    let pixels = match view {
        View::Texels => (0..lightmap.texels.len()).flat_map(|at| of_state(lightmap, at)).collect(),
        View::Charts => of_indices(&lightmap.charts, golden_hue),
        View::Patches => of_indices(&lightmap.patches, random_hue),
        View::Lit | View::Lightmap | View::Albedo => return None,
    };
    let size = Extent3d { width: lightmap.width, height: lightmap.height, depth_or_array_layers: 1 };
    let format = TextureFormat::Rgba8UnormSrgb;
    let mut image = Image::new(size, TextureDimension::D2, pixels, format, RenderAssetUsages::RENDER_WORLD);
    image.sampler = ImageSampler::Descriptor(ImageSamplerDescriptor {
        mag_filter: ImageFilterMode::Nearest,
        min_filter: ImageFilterMode::Linear,
        ..default()
    });
    Some(image)
}

fn of_state(lightmap: &LightmapImage, at: usize) -> [u8; 4] {
    let (column, row) = (at % lightmap.width as usize, at / lightmap.width as usize);
    match lightmap.states[at] {
        TexelState::Valid => GRAYS[(column + row) % 2],
        TexelState::Invalid => INVALID,
        TexelState::Gutter => GUTTER,
        TexelState::Empty => NOTHING,
    }
}

fn of_index(index: u32, hue: fn(u32) -> f32) -> [u8; 4] {
    if index == NONE {
        return NOTHING;
    }
    let lightness = 0.4 + 0.4 * (hash(index, 0) % 256) as f32 / 256.0;
    Color::hsl(hue(index), 0.65, lightness).to_srgba().to_u8_array()
}

/// On by the golden angle each time, so that few charts differ well.
fn golden_hue(index: u32) -> f32 {
    (137.507_76 * f64::from(index) % 360.0) as f32
}

/// For many patches: any regular step shows as stripes where rows are as long as its period.
fn random_hue(index: u32) -> f32 {
    (hash(index, 1) % 360) as f32
}
