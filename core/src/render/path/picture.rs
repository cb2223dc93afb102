//! A picture that gets better the longer it is looked at.

use alloc::vec;
use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use super::{Estimate, Optics, PATHS, PathTracer};
use crate::geometry::{Sobol, hash, tree};
use crate::material::linear_to_srgb;
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress, Stage};
use crate::render::{Camera, exposure, khronos_pbr_neutral};
use crate::scatter::Colored;
use crate::scene::{Scene, World};

/// What a camera sees, pixel by pixel, each with its standard error.
#[derive(Clone, Debug, PartialEq)]
pub struct PathPicture<S> {
    /// Width and height.
    pub size: [u32; 2],
    /// Radiance in cd/m2, row by row from the top; all have the same number of values of [`PATHS`] paths each.
    pub pixels: Vec<Estimate<S>>,
    /// Of all random decisions.
    pub seed: u32,
}

/// How a picture is made by paths of light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathSettings {
    /// For each pixel at least so many.
    pub paths: u32,
    /// Whether rough metal and varnish reflect, which no lightmap shows.
    pub gloss: bool,
    /// Of all random decisions.
    pub seed: u32,
    /// 0 for one on each core; the result does not depend on it.
    pub threads: usize,
}

/// A scene as its bake takes it, or with gloss, seen by a camera. What blocks no light is not seen.
///
/// # Errors
///
/// Where the progress was told to cancel.
pub fn path_traced(
    scene: &Scene,
    camera: &Camera,
    size: [u32; 2],
    settings: &PathSettings,
    progress: &Progress,
) -> Result<PathPicture<Vec3>, Cancelled> {
    progress.enter(Stage::Paths);
    let world = World::new(scene);
    let occluders = tree(world.corners[..world.blockers].to_vec());
    let of_kind = if settings.gloss { PathTracer::glossy } else { PathTracer::diffuse };
    let tracer = of_kind(&world, occluders);
    let (workers, mut picture) = (Workers::new(settings.threads), PathPicture::new(size, settings.seed));
    let steps = settings.paths.div_ceil(PATHS);
    for step in 0..steps {
        progress.enter_group(step as usize, steps as usize);
        picture.step(&tracer, camera, &workers, progress)?;
    }
    Ok(picture)
}

impl PathPicture<Vec3> {
    /// The pixels in sRGB at an exposure, tone mapped by [`khronos_pbr_neutral`].
    pub fn rgb(&self, ev100: f32) -> Vec<[u8; 3]> {
        let exposure = exposure(ev100);
        let shown = |pixel: &Estimate<Vec3>| khronos_pbr_neutral(pixel.mean * exposure).to_array().map(linear_to_srgb);
        self.pixels.iter().map(shown).collect()
    }
}

impl<S: Colored> PathPicture<S> {
    /// A black picture of this width and height.
    pub fn new([width, height]: [u32; 2], seed: u32) -> Self {
        Self { size: [width, height], pixels: vec![Estimate::default(); width as usize * height as usize], seed }
    }

    /// Adds [`PATHS`] paths to each pixel. The result does not depend on the number of threads.
    ///
    /// # Errors
    ///
    /// Where the progress was told to cancel; the picture is as it was.
    pub fn step<O: Optics<S>>(
        &mut self,
        tracer: &PathTracer<S, O>,
        camera: &Camera,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<(), Cancelled> {
        let Self { size: [width, height], seed, .. } = *self;
        let size = Vec2::new(width as f32, height as f32);
        let step = hash(seed, self.pixels.first().map_or(0, |pixel| pixel.count));
        let pixel = |index: usize| {
            let corner = Vec2::new((index % width as usize) as f32, (index / width as usize) as f32);
            let seed = hash(step, index as u32);
            let within = Sobol::new(hash(seed, 2));
            tracer.mean(seed, |numbers, path| {
                let ray = camera.ray((corner + within.square(path)) / size, size.x / size.y);
                tracer.seen(ray, numbers)
            })
        };
        let values = workers.map(self.pixels.len(), PATHS as usize, progress, |range| range.map(pixel).collect())?;
        self.pixels.iter_mut().zip(values).for_each(|(pixel, value)| pixel.add(value));
        Ok(())
    }
}
