//! Skies: panoramas and cubes to the sky of a scene.

use bevy::color::ColorToComponents;
use bevy::image::Image;
use bevy::math::{Vec2, Vec3};
use radiosity::light::{Light, LightSource, SkyImage};
use radiosity::scene::Scene;

/// Puts a scene under a sky, its suns as lights of this name after all others.
pub(crate) fn put_sky(scene: &mut Scene, mut sky: SkyImage, scale: Vec3, name: &str) {
    scene.lights.extend(sky.take_suns().into_iter().map(|mut sun| {
        sun.illuminance *= scale;
        Light { name: name.to_owned(), source: LightSource::Directional(sun) }
    }));
    (scene.sky, scene.sky_image) = (scale, Some(sky));
}

/// A panorama, or a cube in six layers, as Bevy's skyboxes are.
///
/// # Errors
///
/// Says why the picture cannot be read and what to do, as the end of a sentence about it.
pub(crate) fn sky(image: &Image) -> Result<SkyImage, String> {
    if image.data.is_none() {
        return Err("lives on the GPU only; load it with `RenderAssetUsages::MAIN_WORLD`".into());
    }
    let size = image.texture_descriptor.size;
    let format = image.texture_descriptor.format;
    let unreadable =
        || format!("has the format {format:?}, which cannot be read on the CPU; give it the panorama as .hdr or .exr");
    let color = |x: u32, y: u32, layer: u32| {
        let color =
            if size.depth_or_array_layers > 1 { image.get_color_at_3d(x, y, layer) } else { image.get_color_at(x, y) };
        color.map_or(Vec3::NAN, |color| Vec3::from(color.to_linear().to_f32_array_no_alpha()))
    };
    if !color(0, 0, 0).is_finite() {
        return Err(unreadable());
    }
    let sky = match size.depth_or_array_layers {
        1 => {
            let places = (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y)));
            SkyImage::new(size.width, size.height, places.map(|(x, y)| color(x, y, 0)).collect())
        }
        6 => SkyImage::from_fn(4 * size.width, 2 * size.width, |direction| {
            let (face, place) = on_cube(direction);
            let [x, y] =
                (place * size.width as f32).as_uvec2().min(bevy::math::UVec2::splat(size.width - 1)).to_array();
            color(x, y, face)
        }),
        layers => return Err(format!("has {layers} layers; a cube has 6, a panorama 1")),
    };
    sky.map_err(|error| format!("is no sky: {error}"))
}

/// The face of a cube that lies in a direction, and where on it, in `[0, 1]` from the upper left. Cubes are left-handed, so
/// that Bevy looks them up with z turned around.
fn on_cube(direction: Vec3) -> (u32, Vec2) {
    let Vec3 { x, y, z } = direction * Vec3::new(1.0, 1.0, -1.0);
    let size = Vec3::new(x, y, z).abs();
    let (face, across, down, along) = match size.max_element() {
        along if along == size.x => {
            if x > 0.0 {
                (0, -z, -y, along)
            } else {
                (1, z, -y, along)
            }
        }
        along if along == size.y => {
            if y > 0.0 {
                (2, x, z, along)
            } else {
                (3, x, -z, along)
            }
        }
        along => {
            if z > 0.0 {
                (4, x, -y, along)
            } else {
                (5, -x, -y, along)
            }
        }
    };
    (face, (Vec2::new(across, down) / along + 1.0) * 0.5)
}

#[cfg(test)]
mod tests {
    use bevy::asset::RenderAssetUsages;
    use bevy::math::Vec3;
    use wgpu_types::{Extent3d, TextureDimension, TextureFormat};

    use super::*;

    fn float_image(width: u32, height: u32, layers: u32, texel: impl Fn(u32) -> [f32; 4]) -> Image {
        let size = Extent3d { width, height, depth_or_array_layers: layers };
        let texels: Vec<f32> = (0..width * height * layers).flat_map(texel).collect();
        let data = texels.iter().flat_map(|number| number.to_le_bytes()).collect();
        Image::new(size, TextureDimension::D2, data, TextureFormat::Rgba32Float, RenderAssetUsages::MAIN_WORLD)
    }

    /// Faces lie where Bevy draws them: the first to the right, the third above, the fifth behind -Z as one looks along it.
    #[test]
    fn cubes_lie_as_they_are_drawn() {
        let cube = float_image(4, 4, 6, |index| [(index / 16) as f32 + 1.0, 0.0, 0.0, 1.0]);
        let sky = sky(&cube).unwrap();
        let axes = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::NEG_Z, Vec3::Z];
        for (face, axis) in axes.into_iter().enumerate() {
            assert_eq!(sky.radiance(axis + Vec3::splat(0.01)).x, face as f32 + 1.0, "{axis}");
        }
        // Looking along -Z, right is right and up is up.
        let marked = float_image(4, 4, 6, |index| [if index == 64 + 3 { 9.0 } else { 1.0 }, 0.0, 0.0, 1.0]);
        assert_eq!(super::sky(&marked).unwrap().radiance(Vec3::new(0.9, 0.9, -1.0)).x, 9.0);
    }

    #[test]
    fn what_is_no_sky_is_told() {
        let panorama = float_image(4, 2, 1, |_| [1.0, 2.0, 3.0, 1.0]);
        assert_eq!(sky(&panorama).unwrap().radiance(Vec3::X), Vec3::new(1.0, 2.0, 3.0));
        assert!(sky(&float_image(4, 4, 2, |_| [1.0; 4])).unwrap_err().contains("layers"));
        assert!(sky(&float_image(4, 2, 1, |index| [1.0 - index as f32; 4])).unwrap_err().contains("negative"));
        let on_gpu = Image { data: None, ..panorama };
        assert!(sky(&on_gpu).unwrap_err().contains("MAIN_WORLD"));
    }
}
