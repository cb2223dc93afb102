//! The whole pipeline: start reading at [`bake`].

mod assemble;
mod check;
mod coarse;
mod course;
mod emitters;
mod error;
mod estimate;
mod field;
mod memory;
mod parts;
mod pieces;
mod rays;
mod report;
mod settings;
mod summary;

pub use error::*;
pub use memory::KEPT_TEXELS;
pub use report::*;
pub use settings::*;

use alloc::vec;
use alloc::vec::Vec;
use core::mem;

use glam::{Vec3, Vec3A};

use crate::geometry::{Logged, Occluders, RayLog, hash, tree};
use crate::light::Lamps;
use crate::lightmap::{
    Blocks, Direct, DirectError, DirectTexel, Gather, Layout, LightmapImage, LightmapUv, Nodes, Placement, Reflectors,
    SeamTexel, UvOrigin, layout,
};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress, Stage};
use crate::scene::{Scene, World};
use crate::transport::{LampLight, Lighting, Solution, Surfaces, Tracer, Transport};
use course::Course;
use emitters::Lamp;
use field::Field;
use memory::{Finished, MemoryPlan};
use parts::Parts;
use pieces::Pieces;
use rays::RayBudget;

/// A finished bake.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bake {
    /// The lightmaps.
    pub images: Vec<LightmapImage>,
    /// For each mesh of the scene its lightmap coordinates, if a surface with a lightmap uses it.
    pub uvs: Vec<Option<LightmapUv>>,
    /// For each surface of the scene where its lightmap lies, if it has one.
    pub placements: Vec<Option<Placement>>,
    /// The texels at which seams are seen.
    pub seams: Vec<SeamTexel>,
    /// For each lightmap the true error of each texel, relative as [`LightmapImage::errors`] are, not a number where nobody
    /// looked; without any list until [`true_errors`](crate::render::true_errors) found them.
    pub true_errors: Vec<Vec<f32>>,
    /// How light travels, if [`BakeSettings::keep`] asks for it.
    pub transport: Option<Transport>,
    /// What was done and how good it is.
    pub report: Report,
}

/// Bakes the lightmaps of a scene.
///
/// Charts are laid out; light that comes straight from the sources is found for each texel; cells of texels become
/// patches, and rays count the form factors between them; the radiosity equation gives the light of all bounces; each
/// texel gathers it once.
///
/// All that surfaces reflect is reflected diffusely, but for mirrors, see [`Material::mirror_at`]. Light goes on from them,
/// and straight through glass and what is blended, colored: see [`Arrival`] for what that leaves out.
///
/// [`Material::mirror_at`]: crate::material::Material::mirror_at
/// [`Arrival`]: crate::transport::Arrival
///
/// Where the texels of all images do not fit into the memory together, the bake goes part by part, a few images at a
/// time. What lies in another part is seen by its patches then, as if it were far away.
///
/// # Errors
///
/// See [`BakeError`]; the text of each says what to do.
pub fn bake(scene: &Scene, settings: &BakeSettings, progress: &Progress) -> Result<Bake, BakeError> {
    let mut images = Vec::new();
    let mut collect = |index: usize, image: LightmapImage| {
        images.push((index, image));
        Ok(())
    };
    let bake = run(scene, settings, Finished::Collected, progress, None, &mut collect)?;
    images.sort_by_key(|&(index, _)| index);
    Ok(Bake { images: images.into_iter().map(|(_, image)| image).collect(), ..bake })
}

/// Bakes as [`bake`] does, but hands over each lightmap with its index as soon as it is finished, so that all of them
/// need not fit into the memory together; and hands every ray to `ray_log`, if there is one, to trace the same rays
/// elsewhere. Where there are no threads, that is also where a bake can rest: on a page, `examples/web` puts it to sleep
/// there between two slices.
///
/// Images come in any order; [`Bake::images`] stays empty. The estimate of the memory leaves room for one image and a
/// copy of it in another form, and for [`KEPT_TEXELS`] of those before.
///
/// # Errors
///
/// See [`BakeError`]; where `take` fails the bake is cancelled.
pub fn bake_into(
    scene: &Scene,
    settings: &BakeSettings,
    progress: &Progress,
    ray_log: Option<&dyn RayLog>,
    take: &mut dyn FnMut(usize, LightmapImage) -> Result<(), Cancelled>,
) -> Result<Bake, BakeError> {
    run(scene, settings, Finished::HandedOver, progress, ray_log, take)
}

fn run(
    scene: &Scene,
    settings: &BakeSettings,
    finished: Finished,
    progress: &Progress,
    ray_log: Option<&dyn RayLog>,
    take: &mut dyn FnMut(usize, LightmapImage) -> Result<(), Cancelled>,
) -> Result<Bake, BakeError> {
    check::check(scene, settings)?;
    let (budget, mut log) = (RayBudget::new(settings), Log::new(progress));

    log.enter(Stage::Unwrap);
    let workers = &Workers::new(settings.threads);
    let layout = laid_out(scene, settings, workers, progress)?;
    let plan = MemoryPlan::new(scene, &layout, &budget, settings, finished)?;

    log.enter(Stage::Geometry);
    let world = World::new(scene);
    let blockers = world.corners[..world.blockers].to_vec();
    let occluders = workers.run_apart(progress, || tree(blockers))?;
    let tracer = &Tracer::new(&world, Logged { occluders, log: ray_log });
    let (row_seeds, cell) = ([1, 3].map(|number| Seeds(settings.seed).of(number)), plan.cell as usize);
    let mut parts = Parts::new((plan.parts, plan.cell), tracer, &layout, budget.patches, row_seeds, workers, progress)?;
    let (lamps, is_light) = emitters::lamps(&world);
    let lighting = &Lighting::from(scene);
    let course = Course { lamps: &lamps, is_light: &is_light, lighting, settings, budget, room: plan.room };

    log.enter_after(Stage::Direct, tracer);
    let (light, lit) = course.direct(&mut parts)?;

    log.enter_after(Stage::Transport, tracer);
    let rows = course.rows(&mut parts)?;

    log.enter_after(Stage::Solve, tracer);
    let solution = Solution::of_patches(light, &rows, Vec::new(), workers, progress)?;

    log.enter_after(Stage::Gather, tracer);
    let (mut tally, transport) = course.gather(&mut parts, lit, rows, &solution, &mut log, take)?;
    let report = Report {
        triangles: world.blockers,
        surfaces: layout.placements.iter().flatten().count(),
        unwrapped: layout.uvs.iter().flatten().filter(|uv| uv.origin == UvOrigin::Unwrapped).count(),
        texels: layout.images.iter().map(|[width, height]| (width * height) as usize).sum(),
        patches: parts.patches.list.len(),
        images: layout.images.len(),
        parts: parts.len(),
        texels_per_meter: layout.texels_per_meter,
        threads: workers.threads(),
        seed: settings.seed,
        estimated_memory_bytes: plan.needed + memory::COPIES_OF_ROWS * tally.row_bytes as u64,
        transport_bytes: transport.as_ref().map_or(0, |transport| transport.bytes().total() as u64),
        warnings: summary::warnings(&world, &layout, &tally, [parts.patches.list.len(), parts.len(), cell], settings),
        seams: tally.seams,
        stages: log.finish(tracer),
        ..tally.report()
    };
    let (Layout { uvs, placements, .. }, seams) = (layout, mem::take(&mut tally.seam_texels));
    Ok(Bake { uvs, placements, seams, transport, report, ..Bake::default() })
}

fn laid_out(
    scene: &Scene,
    settings: &BakeSettings,
    workers: &Workers,
    progress: &Progress,
) -> Result<Layout, BakeError> {
    let layout = workers.run(|| layout(scene, &settings.layout, progress))?;
    if layout.placements.iter().all(Option::is_none) { Err(BakeError::NothingToBake) } else { Ok(layout) }
}

/// The steps that find the light of texels.
struct Baker<'a, O> {
    pieces: &'a Pieces<'a, O>,
    surfaces: &'a Surfaces,
    is_valid: &'a [bool],
    budget: RayBudget,
    keep: Keep,
    seeds: Seeds,
}

impl<O: Occluders> Baker<'_, O> {
    /// Direct light of each receiver, how far it may be off for each texel, and what is kept of each lamp.
    ///
    /// What is kept is linear in the lamps by its nature, and so is the time that it takes.
    fn direct(&self, lamps: &[Lamp], lighting: &Lighting) -> Result<DirectLights, Cancelled> {
        let mut lights = DirectLights::new(self.surfaces.receivers(), self.is_valid.len());
        let blocks = &Blocks::new(self.pieces.texels);
        match self.keep {
            Keep::Lightmaps => {
                let strong = lamps.iter().map(|lamp| (&lamp.light, lighting.strength(lamp.origin)));
                let mirrors = lamps.iter().map(|lamp| lamp.mirror.as_ref()).collect();
                lights.add(&self.light(&Lamps::new(strong.collect()).seen_in(mirrors), 0, blocks)?, Vec3::ONE);
            }
            Keep::Transport => {
                for (index, lamp) in lamps.iter().enumerate() {
                    let lamps = Lamps::new(vec![(&lamp.light, Vec3::ONE)]).seen_in(vec![lamp.mirror.as_ref()]);
                    let light = self.light(&lamps, index, blocks)?;
                    lights.add(&light, lighting.strength(lamp.origin));
                    let light: Vec<Vec3> = light.iter().map(|light| light.irradiance).collect();
                    lights.kept.extend(LampLight::new(lamp.origin, &light));
                }
            }
        }
        Ok(lights)
    }

    /// Light of each receiver from all of these lamps, of which the first has this index.
    fn light(&self, lamps: &Lamps, first: usize, blocks: &Blocks) -> Result<Vec<DirectTexel>, Cancelled> {
        let Pieces { tracer, texels, workers, progress, .. } = *self.pieces;
        let seed = hash(self.seeds.of(2), first as u32);
        let direct = Direct { texels, blocks, is_valid: self.is_valid, tracer, rays: self.budget.shadow, seed };
        let mut light = direct.light(lamps, workers, progress)?;
        let bare = &self.surfaces.bare;
        let on = |&patch: &u32| DirectTexel { irradiance: self.pieces.direct_on(patch, lamps), ..Default::default() };
        light.extend(workers.map(bare.len(), 64, progress, |range| bare[range].iter().map(on).collect())?);
        Ok(light)
    }

    /// What the nodes gather of the radiance of all columns, where so much of the error is `known` and rows may take so many
    /// bytes.
    fn gather(
        &self,
        direct: &[Vec3A],
        radiance: &mut [Vec3A],
        (known, room): (f32, usize),
    ) -> Result<Nodes, Cancelled> {
        let Pieces { tracer, texels, workers, progress, .. } = *self.pieces;
        let reflectors = match self.keep {
            Keep::Lightmaps => Reflectors::new(radiance, texels, self.surfaces, tracer.world),
            // What is bright depends on the light of the bake.
            Keep::Transport => Reflectors::default(),
        };
        reflectors.take_from(radiance, self.surfaces);
        let field = Field::new(self.pieces, self.surfaces, self.budget.spread());
        let gather = Gather {
            texels,
            is_valid: self.is_valid,
            tracer,
            look: |direction, hit: Option<&_>| field.look(direction, hit),
            radiance,
            black: self.surfaces.black(),
            reflectors: &reflectors,
            touches: &|texel, distance| self.pieces.touches(texel, distance),
            keep: self.keep,
            room,
            settings: self.budget.gather_beside(known),
            seed: self.seeds.of(4),
        };
        let direct: Vec<f32> = direct.iter().map(|direct| direct.element_sum() / 3.0).collect();
        let nodes = gather.run(&direct, workers, progress)?;
        reflectors.give_back_to(radiance, self.surfaces);
        Ok(nodes)
    }
}

/// What comes straight from the lamps.
struct DirectLights {
    /// Irradiance / pi for each receiver.
    sums: Vec<Vec3A>,
    /// How far that may be off, for each texel.
    errors: Vec<DirectError>,
    kept: Vec<LampLight>,
}

impl DirectLights {
    fn new(receivers: usize, texels: usize) -> Self {
        Self { sums: vec![Vec3A::ZERO; receivers], errors: vec![DirectError::default(); texels], kept: Vec::new() }
    }

    fn add(&mut self, lights: &[DirectTexel], strength: Vec3) {
        for (index, light) in lights.iter().enumerate() {
            let light = light.times(strength);
            self.sums[index] += Vec3A::from(light.irradiance);
            self.errors.get_mut(index).into_iter().for_each(|error| *error += light.error);
        }
    }
}

/// Seeds for independent purposes.
#[derive(Clone, Copy)]
struct Seeds(u64);

impl Seeds {
    /// Those of a part; the first has the seeds of the bake.
    fn of_part(self, number: usize) -> Self {
        Self(self.0.wrapping_add((number as u64) << 32))
    }

    fn of(self, purpose: u32) -> u32 {
        hash(hash(self.0 as u32, (self.0 >> 32) as u32), purpose)
    }
}

/// The stages as they pass; some pass several times.
struct Log<'a> {
    progress: &'a Progress,
    stages: Vec<StageReport>,
    start: f64,
    now: usize,
}

impl<'a> Log<'a> {
    fn new(progress: &'a Progress) -> Self {
        Self { progress, stages: Vec::new(), start: progress.seconds(), now: 0 }
    }

    fn enter(&mut self, stage: Stage) {
        self.close(0);
        self.progress.enter(stage);
        self.open(stage);
    }

    fn enter_after<O: Occluders>(&mut self, stage: Stage, tracer: &Tracer<O>) {
        self.close(tracer.take_count());
        self.progress.enter(stage);
        self.open(stage);
    }

    /// Counts for another stage from now on, while who watches sees the one that was entered.
    fn turn_to<O: Occluders>(&mut self, stage: Stage, tracer: &Tracer<O>) {
        self.close(tracer.take_count());
        self.open(stage);
    }

    fn open(&mut self, stage: Stage) {
        let name = stage.name();
        let known = self.stages.iter().position(|report| report.name == name);
        self.now = known.unwrap_or_else(|| {
            self.stages.push(StageReport { name, ..StageReport::default() });
            self.stages.len() - 1
        });
    }

    fn close(&mut self, rays: u64) {
        let now = self.progress.seconds();
        if let Some(report) = self.stages.get_mut(self.now) {
            report.seconds += now - self.start;
            report.rays += rays;
        }
        self.start = now;
    }

    fn finish<O: Occluders>(mut self, tracer: &Tracer<O>) -> Vec<StageReport> {
        self.close(tracer.take_count());
        self.stages
    }
}
