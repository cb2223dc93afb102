//! `preview.png`: the baked scene seen from its camera; and the pictures that tell how good the bake is.

use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use radiosity::bake::Bake;
use radiosity::progress::{Cancelled, Progress};
use radiosity::render::{Camera, FalseColor, Preview, false_color, overview, preview};
use radiosity::scene::Scene;

use super::error::CliError;

const HEIGHT: u32 = 720;
/// How often the wish to stop is looked for.
const PATIENCE: Duration = Duration::from_millis(20);
/// Width over height where no camera says otherwise.
const ASPECT: f32 = 4.0 / 3.0;

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
        Ok((self.png(&rgb)?, ev100))
    }

    /// A PNG of the bake in false colors.
    pub fn false_color(&self, shown: FalseColor) -> Result<Vec<u8>, CliError> {
        let Self { scene, bake, camera, width, .. } = *self;
        self.png(&self.draw(|progress| false_color(scene, bake, &camera, [width, HEIGHT], shown, progress))?)
    }

    fn png(&self, rgb: &[[u8; 3]]) -> Result<Vec<u8>, CliError> {
        let failed = |error: png::EncodingError| CliError::new(format!("cannot encode a picture: {error}"));
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width, HEIGHT);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header().map_err(failed)?;
        writer.write_image_data(rgb.as_flattened()).map_err(failed)?;
        writer.finish().map_err(failed)?;
        Ok(file)
    }

    /// Draws on another thread, so that this one can stop it.
    fn draw<T: Send>(&self, draw: impl FnOnce(&Progress) -> Result<T, Cancelled> + Send) -> Result<T, CliError> {
        let progress = Progress::default();
        thread::scope(|scope| {
            let drawing = scope.spawn(|| draw(&progress));
            while !drawing.is_finished() {
                if self.interrupted.load(Ordering::Relaxed) {
                    progress.cancel();
                }
                thread::sleep(PATIENCE);
            }
            let drawn = drawing.join().map_err(|_| CliError::new("drawing a picture failed; please report it"))?;
            drawn.map_err(|_| CliError::Cancelled)
        })
    }
}
