//! Pictures of how good a bake is: density, error, invalid texels, seams.

use alloc::vec;
use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use super::Camera;
use super::legend::{draw_scale, heat};
use super::view::{View, lightmap_corners, lightmap_place};
use crate::bake::Bake;
use crate::geometry::{Hit, normal_and_area};
use crate::lightmap::{LightmapImage, TexelState};
use crate::math;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::scene::{Scene, World};

/// Rays for each pixel, in each direction.
const SAMPLES: u32 = 2;
/// Errors and steps from here on have the last color.
const LARGEST: f32 = 0.1;
/// Densities this many times below and above that of the bake have the first and the last color.
const SPREAD: f32 = 4.0;

/// Where nothing is, and what has no lightmap.
const NOTHING: [u8; 3] = [24, 24, 28];
const NO_LIGHTMAP: [u8; 3] = [64, 64, 72];
/// Texels of which a view has nothing to say.
const PLAIN: [u8; 3] = [90, 90, 90];
const INVALID: [u8; 3] = [230, 30, 30];
const GUTTER: [u8; 3] = [40, 70, 220];
/// The two grays of neighboring texels.
const GRAYS: [[u8; 3]; 2] = [[190, 190, 190], [110, 110, 110]];
/// The same where another color is to be seen through them.
const WHITES: [[u8; 3]; 2] = [[255; 3], [185; 3]];

/// What a picture in false colors shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FalseColor {
    /// Texels per meter against those of the bake, from a quarter to four times as many, and each texel.
    Density,
    /// The estimated error of each texel, up to 10 %.
    Error,
    /// Each texel: gray were computed, red lie inside geometry and were filled in, blue are gutters. A pixel in which a
    /// ray meets a red one is red.
    Invalid,
    /// The step of light across each seam, up to 10 %, at the texels that it touches.
    Seams,
    /// The true error of each texel, up to 10 %, as far as [`true_errors`](super::true_errors) found it.
    Truth,
}

impl FalseColor {
    /// All that a bake tells by itself.
    pub const ALL: [Self; 4] = [Self::Density, Self::Error, Self::Invalid, Self::Seams];

    /// A word for it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Density => "density",
            Self::Error => "error",
            Self::Invalid => "invalid",
            Self::Seams => "seams",
            Self::Truth => "truth",
        }
    }

    /// A color in sRGB for each texel of an image of a bake; density multiplies it by that of [`density_color`].
    pub fn texel_colors(self, bake: &Bake, image: usize) -> Vec<[u8; 3]> {
        let lightmap = &bake.images[image];
        let texels = 0..lightmap.texels.len();
        match self {
            Self::Density => texels.map(|at| checker(lightmap, at, WHITES)).collect(),
            Self::Error => texels.map(|at| of_error(lightmap, at)).collect(),
            Self::Invalid => texels.map(|at| of_state(lightmap, at)).collect(),
            Self::Seams => {
                let mut colors = vec![PLAIN; lightmap.texels.len()];
                for seam in bake.seams.iter().filter(|seam| seam.image as usize == image) {
                    colors[seam.texel as usize] = heat(seam.step / LARGEST);
                }
                colors
            }
            Self::Truth => {
                let errors = bake.true_errors.get(image).map_or(&[][..], Vec::as_slice);
                texels.map(|at| errors.get(at).map_or(PLAIN, |error| of_truth(*error))).collect()
            }
        }
    }
}

/// The color in sRGB of a density in texels per meter, in a bake of `usual` ones: blue are few, green as usual, red many.
pub fn density_color(density: f32, usual: f32) -> [u8; 3] {
    let octaves = math::log2((density / usual).max(f32::MIN_POSITIVE)) / math::log2(SPREAD);
    heat(0.5 + 0.5 * octaves)
}

/// Texels per meter on a triangle of a world, if its surface has a lightmap: the root of its area in texels over that in
/// square meters.
pub fn texel_density(world: &World, bake: &Bake, triangle: u32) -> Option<f32> {
    let (placement, [a, b, c]) = lightmap_corners(world, bake, triangle)?;
    let image = bake.images.get(placement.image)?;
    let (_, area) = normal_and_area(&world.corners[triangle as usize])?;
    let texels = 0.5 * (b - a).perp_dot(c - a).abs() * image.width as f32 * image.height as f32;
    Some(math::sqrt(texels / area))
}

/// How good a bake is, as `camera` sees it: pixels in sRGB, row by row from the top. Surfaces are shaded a little, so that
/// shapes are told apart; a scale at the lower edge tells what colors mean.
///
/// # Errors
///
/// Where the progress was told to cancel.
pub fn false_color(
    scene: &Scene,
    bake: &Bake,
    camera: &Camera,
    [width, height]: [u32; 2],
    shown: FalseColor,
    progress: &Progress,
) -> Result<Vec<[u8; 3]>, Cancelled> {
    let colors = (0..bake.images.len()).map(|image| shown.texel_colors(bake, image)).collect();
    let size = Vec2::new(width as f32, height as f32);
    let picture = Picture { view: View::new(scene), bake, shown, colors, camera, size };
    let row = |y: usize| (0..width).map(move |x| (x, y as u32));
    let rows = Workers::new(bake.report.threads).map(height as usize, 1, progress, |rows| {
        rows.map(|y| row(y).map(|(x, y)| picture.pixel(x, y)).collect::<Vec<_>>()).collect()
    })?;
    let mut rgb = rows.concat();
    let usual = bake.report.texels_per_meter;
    match shown {
        FalseColor::Density => draw_scale(&mut rgb, width as usize, [usual / SPREAD, usual * SPREAD], "/M"),
        FalseColor::Error | FalseColor::Seams | FalseColor::Truth => {
            draw_scale(&mut rgb, width as usize, [0.0, 100.0 * LARGEST], "%")
        }
        FalseColor::Invalid => {}
    }
    Ok(rgb)
}

/// Everything that a pixel depends on.
struct Picture<'a> {
    view: View<'a>,
    bake: &'a Bake,
    shown: FalseColor,
    /// Of the texels of each image.
    colors: Vec<Vec<[u8; 3]>>,
    camera: &'a Camera,
    size: Vec2,
}

/// What one ray of a pixel finds.
struct Sample {
    color: Vec3,
    /// Whether it must not be lost among the others.
    stands_out: bool,
}

impl Picture<'_> {
    /// The mean over a grid of rays; over those that meet invalid texels, where these are shown and some do, so that
    /// single ones are not lost.
    fn pixel(&self, x: u32, y: u32) -> [u8; 3] {
        let samples: [Sample; (SAMPLES * SAMPLES) as usize] = core::array::from_fn(|sample| {
            let within = Vec2::new((sample as u32 % SAMPLES) as f32, (sample as u32 / SAMPLES) as f32) + 0.5;
            self.sample((Vec2::new(x as f32, y as f32) + within / SAMPLES as f32) / self.size)
        });
        let any_stands_out = samples.iter().any(|sample| sample.stands_out);
        let counting = || samples.iter().filter(|sample| sample.stands_out == any_stands_out);
        let mean = counting().map(|sample| sample.color).sum::<Vec3>() / counting().count() as f32;
        mean.to_array().map(|channel| (channel + 0.5) as u8)
    }

    fn sample(&self, at: Vec2) -> Sample {
        let ray = self.camera.ray(at, self.size.x / self.size.y);
        let Some(hit) = self.view.nearest(&ray, None) else {
            return Sample { color: channels(NOTHING), stands_out: false };
        };
        let color = self.color(&hit);
        let stands_out = self.shown == FalseColor::Invalid && color == channels(INVALID);
        Sample { color: self.shade(&hit, ray.direction.normalize_or_zero()) * color, stands_out }
    }

    /// Between 0.6 at grazing and 1 at right angles.
    fn shade(&self, hit: &Hit, direction: Vec3) -> f32 {
        0.6 + 0.4 * self.view.normals[hit.triangle as usize].dot(direction).abs()
    }

    fn color(&self, hit: &Hit) -> Vec3 {
        let Some((image, uv)) = lightmap_place(&self.view, self.bake, hit) else { return channels(NO_LIGHTMAP) };
        let (Some(lightmap), Some(colors)) = (self.bake.images.get(image), self.colors.get(image)) else {
            return channels(NO_LIGHTMAP);
        };
        let at = |share: f32, count: u32| ((share * count as f32) as usize).min(count as usize - 1);
        let texel = at(uv.y, lightmap.height) * lightmap.width as usize + at(uv.x, lightmap.width);
        let color = channels(colors[texel]);
        match (self.shown, texel_density(&self.view, self.bake, hit.triangle)) {
            (FalseColor::Density, Some(density)) => {
                color * channels(density_color(density, self.bake.report.texels_per_meter)) / 255.0
            }
            _ => color,
        }
    }
}

fn channels(color: [u8; 3]) -> Vec3 {
    Vec3::from(color.map(f32::from))
}

/// One of two colors, so that each texel differs from its neighbors.
fn checker(lightmap: &LightmapImage, at: usize, colors: [[u8; 3]; 2]) -> [u8; 3] {
    let (column, row) = (at % lightmap.width as usize, at / lightmap.width as usize);
    colors[(column + row) % 2]
}

fn of_error(lightmap: &LightmapImage, at: usize) -> [u8; 3] {
    match lightmap.states[at] {
        TexelState::Valid => heat(lightmap.errors[at] / LARGEST),
        TexelState::Invalid | TexelState::Gutter | TexelState::Empty => PLAIN,
    }
}

fn of_truth(error: f32) -> [u8; 3] {
    if error.is_nan() { PLAIN } else { heat(error / LARGEST) }
}

fn of_state(lightmap: &LightmapImage, at: usize) -> [u8; 3] {
    match lightmap.states[at] {
        TexelState::Valid => checker(lightmap, at, GRAYS),
        TexelState::Invalid => INVALID,
        TexelState::Gutter => GUTTER,
        TexelState::Empty => [0; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bake::{BakeSettings, Quality, bake};
    use crate::lightmap::{LayoutSettings, Resolution};
    use crate::scene::{cornell_box, cornell_camera};

    fn baked(density: f32) -> (Scene, Bake) {
        let scene = cornell_box();
        let layout = LayoutSettings { resolution: Resolution::TexelsPerMeter(density), ..Default::default() };
        let settings = BakeSettings { layout, quality: Quality::Draft, ..Default::default() };
        let bake = bake(&scene, &settings, &Progress::default()).unwrap();
        (scene, bake)
    }

    /// A wall has the density that was asked for, to what a whole number of texels allows.
    #[test]
    fn density_is_the_one_of_the_bake() {
        let (scene, bake) = baked(32.0);
        let world = World::new(&scene);
        for triangle in 0..world.corners.len() as u32 {
            let density = texel_density(&world, &bake, triangle).unwrap();
            assert!((density / 32.0 - 1.0).abs() < 0.2, "triangle {triangle}: {density}");
        }
    }

    /// Of each view the middle of the back wall shows what the texel there holds.
    #[test]
    fn pictures_show_what_texels_hold() {
        let (scene, mut bake) = baked(16.0);
        bake.seams.clear();
        for image in &mut bake.images {
            image.errors.fill(LARGEST);
            image.states.fill(TexelState::Invalid);
        }
        let (transform, fov_y) = cornell_camera();
        let camera = Camera::perspective(transform, fov_y);
        let middle = |bake: &Bake, shown| {
            let rgb = false_color(&scene, bake, &camera, [32, 32], shown, &Progress::default()).unwrap();
            assert_eq!(rgb.len(), 32 * 32);
            rgb[12 * 32 + 16]
        };
        let near = |a: [u8; 3], b: [u8; 3]| a.iter().zip(b).all(|(a, b)| a.abs_diff(b) < 12);
        assert!(near(middle(&bake, FalseColor::Invalid), INVALID));
        assert!(near(middle(&bake, FalseColor::Seams), PLAIN));
        bake.images.iter_mut().for_each(|image| image.states.fill(TexelState::Valid));
        assert!(near(middle(&bake, FalseColor::Error), heat(1.0)));
        assert!(near(middle(&bake, FalseColor::Truth), PLAIN));
        bake.true_errors = bake.images.iter().map(|image| vec![0.5 * LARGEST; image.texels.len()]).collect();
        assert!(near(middle(&bake, FalseColor::Truth), heat(0.5)));
        let texels = bake.images[0].texels.len() as u32;
        bake.seams = (0..texels).map(|texel| crate::lightmap::SeamTexel { image: 0, texel, step: 0.0 }).collect();
        assert!(near(middle(&bake, FalseColor::Seams), heat(0.0)));
    }

    /// A wall of which every eighth texel is invalid, with two texels for a pixel in each direction: none is lost.
    #[test]
    fn single_invalid_texels_are_seen() {
        let (scene, mut bake) = baked(128.0);
        for image in &mut bake.images {
            let width = image.width as usize;
            let is_invalid = |at: usize| at % width % 8 == 3 && at / width % 8 == 5;
            image.states = (0..image.texels.len())
                .map(|at| if is_invalid(at) { TexelState::Invalid } else { TexelState::Valid })
                .collect();
        }
        let (transform, fov_y) = cornell_camera();
        let camera = Camera::perspective(transform, fov_y);
        let progress = Progress::default();
        let rgb = false_color(&scene, &bake, &camera, [48, 48], FalseColor::Invalid, &progress).unwrap();
        let count = rgb.iter().filter(|[red, green, _]| *red / 3 > *green).count();
        assert!(count > 20, "{count}");
        assert!(rgb.iter().all(|[red, green, _]| red.abs_diff(*green) < 6 || *red / 3 > *green), "they were mixed");
    }

    /// The most common density is green, four times less is blue, four times more is red.
    #[test]
    fn densities_have_colors() {
        assert_eq!(density_color(8.0, 8.0), heat(0.5));
        assert_eq!(density_color(2.0, 8.0), heat(0.0));
        assert_eq!(density_color(32.0, 8.0), heat(1.0));
        assert_eq!(density_color(0.0, 8.0), heat(0.0));
    }
}
