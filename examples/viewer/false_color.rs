//! Pictures of how a lightmap is cut and how good it is, one pixel for each texel.

use bevy::asset::RenderAssetUsages;
use bevy::image::{ImageFilterMode, ImageSampler, ImageSamplerDescriptor};
use bevy::prelude::*;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};
use radiosity::bake::Bake;
use radiosity::geometry::{hash, normal_and_area};
use radiosity::lightmap::NONE;
use radiosity::render::{density_color, texel_density};
use radiosity::scene::{Scene, World};

use crate::views::View;

const NOTHING: [u8; 3] = [0; 3];

/// What a view shows of a lightmap of a bake, if it is about more than its light.
pub fn image(view: View, bake: &Bake, index: usize) -> Option<Image> {
    let lightmap = &bake.images[index];
    let of_indices = |indices: &[u32], hue: fn(u32) -> f32| indices.iter().map(|&index| of_index(index, hue)).collect();
    let colors: Vec<[u8; 3]> = match view {
        View::Charts => of_indices(&lightmap.charts, golden_hue),
        View::Patches => of_indices(&lightmap.patches, random_hue),
        View::Quality(shown) => shown.texel_colors(bake, index),
        View::Lit | View::Lightmap | View::Albedo => return None,
    };
    let pixels = colors.into_iter().flat_map(|[red, green, blue]| [red, green, blue, 255]).collect();
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

/// For each surface of a bake the color of its density, if it has a lightmap.
pub fn densities(scene: &Scene, bake: &Bake) -> Vec<Option<Color>> {
    let world = World::new(scene);
    let mut sums = vec![(0.0, 0.0); scene.surfaces.len()];
    for (triangle, source) in (0..).zip(&world.sources) {
        let area = normal_and_area(&world.corners[triangle as usize]).map_or(0.0, |(_, area)| area);
        if let Some(density) = texel_density(&world, bake, triangle) {
            let (texels, whole) = &mut sums[source.surface as usize];
            *texels += density * density * area;
            *whole += area;
        }
    }
    let color = |(texels, area): (f32, f32)| {
        let [red, green, blue] = density_color((texels / area).sqrt(), bake.report.texels_per_meter);
        (area > 0.0).then_some(Color::srgb_u8(red, green, blue))
    };
    sums.into_iter().map(color).collect()
}

fn of_index(index: u32, hue: fn(u32) -> f32) -> [u8; 3] {
    if index == NONE {
        return NOTHING;
    }
    let lightness = 0.4 + 0.4 * (hash(index, 0) % 256) as f32 / 256.0;
    Color::hsl(hue(index), 0.65, lightness).to_srgba().to_u8_array_no_alpha()
}

/// On by the golden angle each time, so that few charts differ well.
fn golden_hue(index: u32) -> f32 {
    (137.507_76 * f64::from(index) % 360.0) as f32
}

/// For many patches: any regular step shows as stripes where rows are as long as its period.
fn random_hue(index: u32) -> f32 {
    (hash(index, 1) % 360) as f32
}
