//! `preview.png`: the baked scene seen from its camera.

use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use radiosity::bake::Bake;
use radiosity::progress::Progress;
use radiosity::render::{Camera, Preview, overview, preview};
use radiosity::scene::Scene;

use super::error::CliError;

const HEIGHT: u32 = 720;
/// How often the wish to stop is looked for.
const PATIENCE: Duration = Duration::from_millis(20);
/// Width over height where no camera says otherwise.
const ASPECT: f32 = 4.0 / 3.0;

/// A PNG of the scene and the EV100 that it was exposed with.
pub(super) fn encode(
    scene: &Scene,
    bake: &Bake,
    camera: Option<(Camera, f32)>,
    ev100: Option<f32>,
    interrupted: &AtomicBool,
) -> Result<(Vec<u8>, f32), CliError> {
    let (camera, aspect) = camera.unwrap_or_else(|| (overview(scene), ASPECT));
    let width = (HEIGHT as f32 * aspect.clamp(0.5, 2.5)) as u32;
    let picture = draw(scene, bake, &camera, width, ev100, interrupted)?;
    let failed = |error: png::EncodingError| CliError::new(format!("cannot encode preview.png: {error}"));
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, HEIGHT);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(picture.rgb.as_flattened()).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok((file, picture.ev100))
}

/// Draws on another thread, so that this one can stop it.
fn draw(
    scene: &Scene,
    bake: &Bake,
    camera: &Camera,
    width: u32,
    ev100: Option<f32>,
    interrupted: &AtomicBool,
) -> Result<Preview, CliError> {
    let progress = Progress::default();
    thread::scope(|scope| {
        let drawing = scope.spawn(|| preview(scene, bake, camera, [width, HEIGHT], ev100, &progress));
        while !drawing.is_finished() {
            if interrupted.load(Ordering::Relaxed) {
                progress.cancel();
            }
            thread::sleep(PATIENCE);
        }
        let drawn = drawing.join().map_err(|_| CliError::new("drawing preview.png failed; please report it"))?;
        drawn.map_err(|_| CliError::Cancelled)
    })
}
