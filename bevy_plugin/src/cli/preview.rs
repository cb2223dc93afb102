//! `preview.png`: the baked scene seen from its camera; and the pictures that tell how good the bake is.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use radiosity::bake::Bake;
use radiosity::progress::{Cancelled, Progress, Stage};
use radiosity::render::{
    Camera, FalseColor, PathSettings, Preview, Truth, difference, false_color, lightmapped, overview, path_traced,
    preview, true_errors, truth,
};
use radiosity::scene::Scene;

use super::error::CliError;
use super::progress::Display;

const HEIGHT: u32 = 720;
/// How often the wish to stop is looked for.
const PATIENCE: Duration = Duration::from_millis(20);
/// Width over height where no camera says otherwise.
const ASPECT: f32 = 4.0 / 3.0;
/// Pixels between two pictures.
const GAP: usize = 4;

/// What is drawn, and from where.
pub(super) struct Pictures<'a> {
    scene: &'a Scene,
    bake: &'a Bake,
    camera: Camera,
    width: u32,
    interrupted: &'a AtomicBool,
}

impl<'a> Pictures<'a> {
    /// Of a bake, from the camera of the scene if there is one. Drawing stops once `interrupted` is true.
    pub fn new(scene: &'a Scene, bake: &'a Bake, camera: Option<(Camera, f32)>, interrupted: &'a AtomicBool) -> Self {
        let (camera, aspect) = camera.unwrap_or_else(|| (overview(scene), ASPECT));
        let width = (HEIGHT as f32 * aspect.clamp(0.5, 2.5)) as u32;
        Self { scene, bake, camera, width, interrupted }
    }

    /// A PNG of the scene and the EV100 that it was exposed with.
    pub fn preview(&self, ev100: Option<f32>) -> Result<(Vec<u8>, f32), CliError> {
        let Self { scene, bake, camera, width, .. } = *self;
        let Preview { rgb, ev100 } =
            self.draw(|progress| preview(scene, bake, &camera, [width, HEIGHT], ev100, progress))?;
        Ok((png(&rgb, width)?, ev100))
    }

    /// A PNG of the bake in false colors.
    pub fn false_color(&self, shown: FalseColor) -> Result<Vec<u8>, CliError> {
        let Self { scene, bake, camera, width, .. } = *self;
        png(&self.draw(|progress| false_color(scene, bake, &camera, [width, HEIGHT], shown, progress))?, width)
    }

    /// The error of the bake at so many random points, by paths of light.
    pub fn truth(&self, points: u32) -> Result<Truth, CliError> {
        self.follow(|progress| truth(self.scene, self.bake, points as usize, progress))
    }

    /// The errors of about so many texels, for [`Bake::true_errors`].
    pub fn true_errors(&self, texels: u32) -> Result<Vec<Vec<f32>>, CliError> {
        self.follow(|progress| true_errors(self.scene, self.bake, texels as usize, progress))
    }

    /// Writes what paths of light show, the same beside the preview, and the difference of both.
    pub fn render(&self, file: &Path, (paths, gloss): (u32, bool), ev100: f32) -> Result<(), CliError> {
        let Self { scene, bake, camera, width, .. } = *self;
        let (size, threads, seed) = ([width, HEIGHT], bake.report.threads, bake.report.seed as u32);
        let settings = PathSettings { paths, gloss, seed, threads };
        let picture = self.follow(|progress| path_traced(scene, &camera, size, &settings, progress))?;
        let radiance = self.draw(|progress| lightmapped(scene, bake, &camera, size, progress))?;
        let Preview { rgb, .. } = self.draw(|progress| preview(scene, bake, &camera, size, Some(ev100), progress))?;
        let truth = picture.rgb(ev100);
        let both = beside(&rgb, &truth, width as usize);
        write(file, &png(&truth, width)?)?;
        write(&named(file, "beside"), &png(&both, 2 * width + GAP as u32)?)?;
        write(&named(file, "difference"), &png(&difference(&radiance, &picture), width)?)
    }

    /// Follows paths on another thread, and shows how far they are.
    fn follow<T: Send>(&self, work: impl FnOnce(&Progress) -> Result<T, Cancelled> + Send) -> Result<T, CliError> {
        let mut display = Display::new();
        let paths = |progress: &Progress| {
            progress.enter(Stage::Paths);
            work(progress)
        };
        let result = self.watch(paths, |progress| display.update(progress));
        display.finish();
        result
    }

    /// Draws on another thread, so that this one can stop it.
    fn draw<T: Send>(&self, draw: impl FnOnce(&Progress) -> Result<T, Cancelled> + Send) -> Result<T, CliError> {
        self.watch(draw, |_| {})
    }

    fn watch<T: Send>(
        &self,
        draw: impl FnOnce(&Progress) -> Result<T, Cancelled> + Send,
        mut look: impl FnMut(&Progress),
    ) -> Result<T, CliError> {
        let progress = Progress::default();
        thread::scope(|scope| {
            let drawing = scope.spawn(|| draw(&progress));
            while !drawing.is_finished() {
                if self.interrupted.load(Ordering::Relaxed) {
                    progress.cancel();
                }
                look(&progress);
                thread::sleep(PATIENCE);
            }
            let drawn = drawing.join().map_err(|_| CliError::new("drawing a picture failed; please report it"))?;
            drawn.map_err(|_| CliError::Cancelled)
        })
    }
}

fn png(rgb: &[[u8; 3]], width: u32) -> Result<Vec<u8>, CliError> {
    let failed = |error: png::EncodingError| CliError::new(format!("cannot encode a picture: {error}"));
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, rgb.len() as u32 / width);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(rgb.as_flattened()).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(file)
}

/// Two pictures of the same width, with a white gap between them.
fn beside(left: &[[u8; 3]], right: &[[u8; 3]], width: usize) -> Vec<[u8; 3]> {
    let rows = left.chunks(width).zip(right.chunks(width));
    rows.flat_map(|(left, right)| [left, &[[255; 3]; GAP], right].concat()).collect()
}

/// `FILE-WORD.png` of `FILE.png`.
fn named(file: &Path, word: &str) -> PathBuf {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    file.with_file_name(format!("{stem}-{word}.png"))
}

fn write(file: &Path, bytes: &[u8]) -> Result<(), CliError> {
    fs::write(file, bytes).map_err(|error| CliError::new(format!("{} cannot be written: {error}", file.display())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_baked_picture_stands_on_the_left() {
        let (left, right, white) = ([[1; 3]; 2], [[2; 3]; 2], [[255; 3]; GAP]);
        assert_eq!(
            beside(&left, &right, 1),
            [&left[..1], &white, &right[..1], &left[..1], &white, &right[..1]].concat()
        );
        assert_eq!(named(Path::new("a/b.png"), "beside"), Path::new("a/b-beside.png"));
    }
}
