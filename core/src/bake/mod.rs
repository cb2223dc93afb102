//! The whole pipeline: start reading at [`bake`].

mod assemble;
mod bounce;
mod check;
mod emitters;
mod error;
mod field;
mod memory;
mod rays;
mod report;
mod settings;
mod summary;

pub use error::*;
pub use report::*;
pub use settings::*;

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3;

use crate::geometry::{Occluders, hash, tree};
use crate::light::DirectLight;
use crate::lightmap::{
    Direct, Gather, LightmapImage, LightmapUv, Patches, Placement, Smooth, Texels, check as check_texels, filter,
    layout,
};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress, Stage};
use crate::scene::{Scene, World};
use crate::transport::Tracer;
use bounce::Stage as PatchStage;
use field::{Field, Incident};
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
    check::check(scene, settings)?;
    let budget = RayBudget::from(settings.quality);
    let mut log = Log::new(progress);

    log.enter(Stage::Unwrap);
    let workers = Workers::new(settings.threads);
    let layout = workers.run(|| layout(scene, &settings.layout, progress))?;
    if layout.placements.iter().all(Option::is_none) {
        return Err(BakeError::NothingToBake);
    }
    let needed = memory::check(scene, &layout, budget.row, budget.patches, settings.memory_bytes)?;

    log.enter(Stage::Geometry);
    let world = World::new(scene);
    let blockers = world.corners[..world.blockers].to_vec();
    let tracer = Tracer::new(&world, workers.run_apart(progress, || tree(blockers))?);
    let mut texels = Texels::new(&world, &layout, progress)?;
    let baker = Baker { tracer: &tracer, workers: &workers, progress, budget, seed: seed(settings.seed) };
    let is_valid = check_texels(&mut texels, &tracer, &workers, baker.seed(1), progress)?;

    log.enter_after(Stage::Direct, &tracer);
    let (lights, is_light) = emitters::lights(&world);
    let direct = baker.direct(&texels, &is_valid, &lights)?;

    log.enter_after(Stage::Transport, &tracer);
    let patches = Patches::new(&world, &texels, &is_valid, layout.texels_per_meter, budget.patches);
    let stage = baker.stage(&texels, &patches);
    let rows = stage.rows(budget.row)?;

    log.enter_after(Stage::Solve, &tracer);
    let mut bounce = stage.bounce(&direct, &lights, &is_light)?;
    bounce.solve(&rows, scene.sky, progress)?;

    log.enter_after(Stage::Gather, &tracer);
    let incident = Incident::new(&direct, &texels, &patches, &bounce, &workers, progress)?;
    let spread = budget.spread();
    let (world, texels, patches, bounce) = (&world, &texels, &patches, &bounce);
    let field = Field { world, texels, patches, bounce, is_light: &is_light, spread, incident };
    let (indirect, nodes) = baker.indirect(&is_valid, &direct, &field)?;

    log.enter_after(Stage::Finish, &tracer);
    let images = assemble::images(texels, &is_valid, patches, &direct, &indirect, &workers, progress)?;

    let done = Done { field: &field, is_valid: &is_valid, rows: &rows, direct: &direct, indirect: &indirect };
    let report = Report {
        nodes,
        images: images.len(),
        texels: images.iter().map(|image| image.texels.len()).sum(),
        threads: workers.threads(),
        seed: settings.seed,
        estimated_memory_bytes: needed,
        stages: log.finish(&tracer),
        ..done.report(&layout)
    };
    Ok(Bake { images, uvs: layout.uvs, placements: layout.placements, report })
}

/// The steps that send rays.
struct Baker<'a, O> {
    tracer: &'a Tracer<'a, O>,
    workers: &'a Workers,
    progress: &'a Progress,
    budget: RayBudget,
    seed: u32,
}

impl<O: Occluders> Baker<'_, O> {
    /// Seeds for independent purposes.
    fn seed(&self, purpose: u32) -> u32 {
        hash(self.seed, purpose)
    }

    /// Direct irradiance / pi for each texel.
    fn direct(&self, texels: &Texels, is_valid: &[bool], lights: &[DirectLight]) -> Result<Vec<Vec3>, Cancelled> {
        let mut irradiance = vec![Vec3::ZERO; texels.list.len()];
        for (index, light) in lights.iter().enumerate() {
            self.progress.enter_part(index, lights.len());
            let seed = hash(self.seed(2), index as u32);
            let direct = Direct { texels, is_valid, tracer: self.tracer, rays: self.budget.shadow, seed };
            direct.add(light, &mut irradiance, self.workers, self.progress)?;
        }
        Ok(irradiance)
    }

    fn stage<'a>(&'a self, texels: &'a Texels, patches: &'a Patches) -> PatchStage<'a, O> {
        let Self { tracer, workers, progress, .. } = *self;
        PatchStage { tracer, texels, patches, workers, progress, seed: self.seed(3) }
    }

    /// Indirect light for each texel, and the number of nodes at which it was gathered.
    fn indirect(&self, is_valid: &[bool], direct: &[Vec3], field: &Field) -> Result<(Vec<Smooth>, usize), Cancelled> {
        let gather = Gather {
            texels: field.texels,
            is_valid,
            tracer: self.tracer,
            radiance: |hit: &_| field.radiance(hit),
            sky: field.world.scene.sky,
            settings: self.budget.gather,
            seed: self.seed(4),
        };
        let mut gathered = gather.run(self.workers, self.progress)?;
        let lights: Vec<f32> = direct
            .iter()
            .zip(&gathered)
            .map(|(direct, node)| (*direct + node.irradiance).element_sum() / 3.0)
            .collect();
        let mean = lights.iter().sum::<f32>() / lights.len().max(1) as f32;
        gather.refine(&mut gathered, |texel| lights[texel] + 0.1 * mean, self.workers, self.progress)?;
        let nodes = gathered.iter().filter(|node| node.width > 0).count();
        Ok((filter(&gathered, field.texels, is_valid, self.workers, self.progress)?, nodes))
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

fn seed(seed: u64) -> u32 {
    hash(seed as u32, (seed >> 32) as u32)
}
