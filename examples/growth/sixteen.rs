//! Sixteen images in less memory than their texels need together.

use std::error::Error;
use std::time::Instant;

use radiosity::bake::{BakeSettings, Quality, bake_into};
use radiosity::light::LightSource;
use radiosity::lightmap::{LayoutSettings, LightmapImage, Resolution};
use radiosity::progress::Progress;

use super::memory;
use super::rooms::rooms;

/// The memory that images of this side may use: 8 GiB for those of 4096 x 4096 texels.
const LARGEST: u64 = 4096;
const MEMORY: u64 = 8 << 30;
/// What smaller ones may use beside their share: it does not shrink with them.
const FIXED: u64 = 144 << 20;
/// Rooms along each direction, each with a lamp.
const ROOMS: usize = 4;
/// How far the lamps shine, in meters: into their rooms and the next, as in games.
const RANGE: f32 = 3.0;
/// What a room with its two blocks takes of the images, in square meters.
const ROOM: f32 = 34.0;

/// Bakes about sixteen images of this side and hands each over as soon as it is finished.
pub fn bake_sixteen(side: u32) -> Result<(), Box<dyn Error>> {
    let mut scene = rooms(ROOMS, 2, ROOMS.pow(3));
    for light in &mut scene.lights {
        if let LightSource::Point(lamp) = &mut light.source {
            (lamp.range, lamp.radius) = (RANGE, 0.0);
        }
    }
    let texels_per_meter = 4.0 * side as f32 / (ROOM * ROOMS.pow(3) as f32).sqrt();
    let resolution = Resolution::TexelsPerMeter(texels_per_meter);
    let settings = BakeSettings {
        layout: LayoutSettings { resolution, max_image_size: side, ..Default::default() },
        quality: Quality::Draft,
        memory_bytes: FIXED + (MEMORY - FIXED) / (LARGEST * LARGEST / u64::from(side) / u64::from(side)),
        ..Default::default()
    };
    let (before, start) = (memory::start(), Instant::now());
    let mut take = |index: usize, image: LightmapImage| {
        let light: f64 = image.texels.iter().map(|texel| f64::from(texel.element_sum())).sum();
        let (seconds, mean) = (start.elapsed().as_secs_f64(), light / (3 * image.texels.len()) as f64);
        println!("{seconds:>7.0} s: image {index}, {} x {}, mean {mean:.2} cd/m2", image.width, image.height);
        Ok(())
    };
    let report = bake_into(&scene, &settings, &Progress::default(), None, &mut take)?.report;
    let peak = memory::peak().saturating_sub(before);
    for stage in &report.stages {
        println!("{:>10} {:>8.1} s {:>8.1} Mrays", stage.name, stage.seconds, stage.rays as f64 * 1e-6);
    }
    println!(
        "{} images, {} texels ({} valid), {} patches, {} triangles, {} lamps, in {} parts: {} MiB allowed, {} estimated, {} used",
        report.images,
        report.texels,
        report.valid_texels,
        report.patches,
        report.triangles,
        scene.lights.len(),
        report.parts,
        settings.memory_bytes >> 20,
        report.estimated_memory_bytes >> 20,
        peak >> 20,
    );
    report.warnings.iter().for_each(|warning| println!("{warning}"));
    Ok(())
}
