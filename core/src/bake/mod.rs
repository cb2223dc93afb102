//! The whole pipeline: start reading at [`bake`].

mod assemble;
mod check;
mod emitters;
mod error;
mod estimate;
mod field;
mod memory;
mod pieces;
mod rays;
mod report;
mod settings;
mod summary;

pub use error::*;
pub use report::*;
pub use settings::*;

use alloc::vec;
use alloc::vec::Vec;

use glam::{Vec3, Vec3A};

use crate::geometry::{Logged, NoLog, Occluders, RayLog, hash, tree};
use crate::light::Lamps;
use crate::lightmap::{
    Direct, DirectError, DirectTexel, Gather, Layout, LightmapImage, LightmapUv, Nodes, Patches, Placement, SeamTexel,
    Seams, Texels, check as check_texels, filter, layout, seam_texels,
};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress, Stage};
use crate::scene::{Scene, World};
use crate::transport::{LampLight, Lighting, Solution, Surfaces, Tracer, Transport};
use assemble::{Assembly, Repairs};
use emitters::Lamp;
use estimate::Estimate;
use field::Field;
use pieces::Pieces;
use rays::RayBudget;
use summary::Done;

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
/// # Errors
///
/// See [`BakeError`]; the text of each says what to do.
pub fn bake(scene: &Scene, settings: &BakeSettings, progress: &Progress) -> Result<Bake, BakeError> {
    bake_logged(scene, settings, progress, &NoLog)
}

/// Bakes as [`bake`] does and hands every ray to `ray_log`: to trace the same rays elsewhere.
///
/// # Errors
///
/// Those of [`bake`].
pub fn bake_logged(
    scene: &Scene,
    settings: &BakeSettings,
    progress: &Progress,
    ray_log: &impl RayLog,
) -> Result<Bake, BakeError> {
    check::check(scene, settings)?;
    let budget = RayBudget::new(settings);
    let mut log = Log::new(progress);

    log.enter(Stage::Unwrap);
    let workers = Workers::new(settings.threads);
    let layout = laid_out(scene, settings, &workers, progress)?;
    let needed = memory::check(scene, &layout, &budget, settings)?;

    log.enter(Stage::Geometry);
    let world = World::new(scene);
    let blockers = world.corners[..world.blockers].to_vec();
    let occluders = workers.run_apart(progress, || tree(blockers))?;
    let tracer = Tracer::new(&world, Logged { occluders, log: ray_log });
    let mut texels = Texels::new(&world, &layout, progress)?;
    let seeds = Seeds(settings.seed);
    let is_valid = check_texels(&mut texels, &tracer, &workers, seeds.of(1), progress)?;
    let patches = Patches::new(&world, &texels, &is_valid, layout.texels_per_meter, budget.patches);
    let (lamps, is_light) = emitters::lamps(&world);
    let (texels, is_valid, patches, tracer, workers) = (&texels, &is_valid[..], &patches, &tracer, &workers);
    let pieces = Pieces { tracer, texels, patches, workers, progress, seed: seeds.of(3) };
    let surfaces = pieces.surfaces(&is_light)?;
    let baker = Baker { pieces: &pieces, surfaces: &surfaces, is_valid, budget, keep: settings.keep, seeds };

    log.enter_after(Stage::Direct, tracer);
    let lighting = Lighting::from(scene);
    let DirectLights { sums: direct, errors: direct_errors, kept } = baker.direct(&lamps, &lighting)?;

    log.enter_after(Stage::Transport, tracer);
    let rows = pieces.rows(budget.row, &surfaces)?;

    log.enter_after(Stage::Solve, tracer);
    let solution = Solution::new(&surfaces, &rows, &lighting, &direct, Vec::new(), workers, progress)?;

    log.enter_after(Stage::Gather, tracer);
    let radiance = surfaces.radiance(&lighting, &direct, &solution, workers, progress)?;
    let nodes = baker.gather(&direct, &radiance)?;
    let indirect = filter(&nodes.gathered, texels, is_valid, workers, progress)?;

    log.enter_after(Stage::Finish, tracer);
    let estimate = Estimate::new(texels, is_valid, (&direct, &direct_errors), &indirect);
    let assembly = Assembly { texels, is_valid, patches, workers, progress };
    let (mut images, fills) = assembly.images(&direct, &indirect, &estimate.errors)?;
    let seams = Seams::new(texels, is_valid, &estimate.errors, tracer, workers, progress)?;
    let seam_report = seams.solve(&mut images, workers, progress)?;
    let seam_texels = seam_texels(&seams, &images);
    let done = Done { world: &world, texels, is_valid, surfaces: &surfaces, solution: &solution, rows: &rows };
    let mut done = done.report(&layout, &lighting, &estimate, &nodes, &indirect);
    done.warnings.extend(estimate.warning(settings.target_error, layout.texels_per_meter));
    let transport = match settings.keep {
        Keep::Lightmaps => None,
        Keep::Transport => Some(assembly.transport(surfaces, kept, rows, nodes, Repairs { fills, seams }, scene)?),
    };
    let report = Report {
        images: images.len(),
        texels: images.iter().map(|image| image.texels.len()).sum(),
        threads: workers.threads(),
        seed: settings.seed,
        estimated_memory_bytes: needed,
        transport_bytes: transport.as_ref().map_or(0, |transport| transport.bytes().total() as u64),
        seams: seam_report,
        stages: log.finish(tracer),
        ..done
    };
    Ok(Bake { images, uvs: layout.uvs, placements: layout.placements, seams: seam_texels, transport, report })
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
        match self.keep {
            Keep::Lightmaps => {
                let strong = lamps.iter().map(|lamp| (&lamp.light, lighting.strength(lamp.origin)));
                lights.add(&self.light(&Lamps::new(strong.collect()), 0)?, Vec3::ONE);
            }
            Keep::Transport => {
                for (index, lamp) in lamps.iter().enumerate() {
                    let light = self.light(&Lamps::new(vec![(&lamp.light, Vec3::ONE)]), index)?;
                    lights.add(&light, lighting.strength(lamp.origin));
                    let light: Vec<Vec3> = light.iter().map(|light| light.irradiance).collect();
                    lights.kept.extend(LampLight::new(lamp.origin, &light));
                }
            }
        }
        Ok(lights)
    }

    /// Light of each receiver from all of these lamps, of which the first has this index.
    fn light(&self, lamps: &Lamps, first: usize) -> Result<Vec<DirectTexel>, Cancelled> {
        let Pieces { tracer, texels, workers, progress, .. } = *self.pieces;
        let seed = hash(self.seeds.of(2), first as u32);
        let direct = Direct { texels, is_valid: self.is_valid, tracer, rays: self.budget.shadow, seed };
        let mut light = direct.light(lamps, workers, progress)?;
        let bare = &self.surfaces.bare;
        let on = |&patch: &u32| DirectTexel { irradiance: self.pieces.direct_on(patch, lamps), ..Default::default() };
        light.extend(workers.map(bare.len(), 64, progress, |range| bare[range].iter().map(on).collect())?);
        Ok(light)
    }

    /// What the nodes gather of the radiance of all columns.
    fn gather(&self, direct: &[Vec3A], radiance: &[Vec3A]) -> Result<Nodes, Cancelled> {
        let Pieces { tracer, texels, patches, workers, progress, .. } = *self.pieces;
        let spread = self.budget.spread();
        let field = Field { tracer, texels, patches, surfaces: self.surfaces, spread };
        let gather = Gather {
            texels,
            is_valid: self.is_valid,
            tracer,
            column: |hit: Option<&_>| field.column(hit),
            radiance,
            keep: self.keep,
            settings: self.budget.gather,
            seed: self.seeds.of(4),
        };
        let direct: Vec<f32> = direct.iter().map(|direct| direct.element_sum() / 3.0).collect();
        gather.run(&direct, workers, progress)
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
    fn of(self, purpose: u32) -> u32 {
        hash(hash(self.0 as u32, (self.0 >> 32) as u32), purpose)
    }
}

/// The stages as they pass.
struct Log<'a> {
    progress: &'a Progress,
    stages: Vec<StageReport>,
    start: f64,
}

impl<'a> Log<'a> {
    fn new(progress: &'a Progress) -> Self {
        Self { progress, stages: Vec::new(), start: progress.seconds() }
    }

    fn enter(&mut self, stage: Stage) {
        self.close(0);
        self.progress.enter(stage);
        self.stages.push(StageReport { name: stage.name(), ..StageReport::default() });
    }

    fn enter_after<O: Occluders>(&mut self, stage: Stage, tracer: &Tracer<O>) {
        self.close(tracer.take_count());
        self.progress.enter(stage);
        self.stages.push(StageReport { name: stage.name(), ..StageReport::default() });
    }

    fn close(&mut self, rays: u64) {
        let now = self.progress.seconds();
        if let Some(last) = self.stages.last_mut() {
            (last.seconds, last.rays) = (now - self.start, rays);
        }
        self.start = now;
    }

    fn finish<O: Occluders>(mut self, tracer: &Tracer<O>) -> Vec<StageReport> {
        self.close(tracer.take_count());
        self.stages
    }
}
