//! The sky of a bake: one color, or a panorama in a file.

use std::fs;
use std::path::{Path, PathBuf};

use bevy::math::{Quat, Vec3};
use radiosity::light::SkyImage;
use radiosity::scene::Scene;

use super::args::Args;
use super::error::CliError;
use crate::convert;

/// What `--sky` says.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum SkyArg {
    /// Radiance in cd/m2.
    Color([f32; 3]),
    /// A panorama.
    File(PathBuf),
}

/// Three numbers or one are a color, everything else a file.
pub(super) fn parse(text: &str) -> Result<SkyArg, String> {
    let numbers: Option<Vec<f32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    let color = match numbers.as_deref() {
        Some([all]) => [*all; 3],
        Some([red, green, blue]) => [*red, *green, *blue],
        Some(_) => return Err("it must be one number, three with commas, or a file".into()),
        None => return Ok(SkyArg::File(text.into())),
    };
    let is_light = color.iter().all(|channel| channel.is_finite() && *channel >= 0.0);
    if is_light { Ok(SkyArg::Color(color)) } else { Err("it must not be below 0".into()) }
}

/// Puts the scene under the sky of the arguments, the suns of a panorama as lights.
pub(super) fn add(args: &Args, scene: &mut Scene) -> Result<(), CliError> {
    match &args.sky {
        None => {}
        Some(SkyArg::Color(color)) => scene.sky = Vec3::from(*color) * args.sky_scale,
        Some(SkyArg::File(path)) => {
            let turn = Quat::from_rotation_y(-args.sky_turn.to_radians());
            let name = format!("sun of {}", path.display());
            convert::put_sky(scene, read(path)?.turned(turn), Vec3::splat(args.sky_scale), &name);
        }
    }
    Ok(())
}

/// What the sky of the arguments is, for telling bakes apart.
pub(super) fn bytes(args: &Args) -> Vec<u8> {
    let mut bytes = format!("{:?} {} {}", args.sky, args.sky_scale, args.sky_turn).into_bytes();
    if let Some(SkyArg::File(path)) = &args.sky {
        // One that cannot be read is told about when it is baked.
        bytes.extend(fs::read(path).unwrap_or_default());
    }
    bytes
}

fn read(path: &Path) -> Result<SkyImage, CliError> {
    let failed = |what: String| CliError::new(format!("the sky {}: {what}", path.display()));
    let bytes = fs::read(path).map_err(|error| failed(format!("{error}; check the path")))?;
    let image = image::load_from_memory(&bytes)
        .map_err(|error| failed(format!("{error}; give it a panorama as .hdr or .exr")))?
        .into_rgb32f();
    let texels = image.pixels().map(|pixel| Vec3::from(pixel.0)).collect();
    SkyImage::new(image.width(), image.height(), texels).map_err(|error| failed(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sky_is_a_color_or_a_file() {
        assert_eq!(parse("2"), Ok(SkyArg::Color([2.0; 3])));
        assert_eq!(parse("1, 0.5,0"), Ok(SkyArg::Color([1.0, 0.5, 0.0])));
        assert_eq!(parse("noon.hdr"), Ok(SkyArg::File("noon.hdr".into())));
        assert!(parse("1,2").is_err() && parse("-1").is_err() && parse("1,inf,1").is_err());
    }

    /// A panorama of both formats reads as it was written; a picture of a cat is refused with its name.
    #[test]
    fn panoramas_are_read() {
        let folder = std::env::temp_dir().join(format!("radiosity-sky-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let color = |x: u32, y: u32| [0.5 * x as f32, 2.0 + y as f32, 8.0];
        let panorama = image::Rgb32FImage::from_fn(8, 4, |x, y| image::Rgb(color(x, y)));
        for name in ["sky.hdr", "sky.exr"] {
            panorama.save(folder.join(name)).unwrap();
            let sky = read(&folder.join(name)).unwrap();
            // The texel right of the middle, in the row above the horizon.
            let found = sky.radiance(Vec3::new(0.1, 0.1, -1.0));
            assert!((found / Vec3::from(color(4, 1)) - 1.0).abs().max_element() < 0.01, "{name}: {found}");
        }
        fs::write(folder.join("cat.hdr"), "meow").unwrap();
        let error = read(&folder.join("cat.hdr")).unwrap_err().to_string();
        assert!(error.contains("cat.hdr") && error.contains(".exr"), "{error}");
        fs::remove_dir_all(folder).unwrap();
    }
}
