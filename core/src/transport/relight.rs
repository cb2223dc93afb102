//! Lightmaps for other lamps and colors, without a ray.

use alloc::vec;
use alloc::vec::Vec;
use core::fmt;

use glam::{Vec3, Vec3A};

use super::{Contacts, Lighting, LightingError, SeamSolver, Solution, StoredImage, Transport};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};

/// Makes lightmaps for one lighting after the other. Each solution is the start of the next.
pub struct Relighter<'a> {
    transport: &'a Transport,
    workers: Workers,
    solution: Solution,
    /// Made when it is first needed.
    solver: Option<SeamSolver<'a>>,
}

/// Lightmaps for a lighting.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Relit {
    /// For each image of the bake its texels, row by row: irradiance / pi in cd/m2 per linear RGB channel.
    pub images: Vec<Vec<Vec3>>,
    /// How long it took.
    pub report: RelightReport,
}

/// How long it took to relight, by the clock of the progress.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RelightReport {
    /// Seconds for the direct light.
    pub direct: f64,
    /// Seconds for the light of all bounces on patches.
    pub solve: f64,
    /// Seconds for what leaves all pieces of surface.
    pub radiance: f64,
    /// Seconds for what the nodes gather of it.
    pub gather: f64,
    /// Seconds for what of this reaches the texels, and for the images.
    pub finish: f64,
    /// Seconds for making seams agree; the first time, for finding out how.
    pub seams: f64,
    /// Bounces that were needed from the start.
    pub sweeps: usize,
}

impl RelightReport {
    /// All seconds.
    pub fn seconds(&self) -> f64 {
        self.direct + self.solve + self.radiance + self.gather + self.finish + self.seams
    }
}

/// Why there is no other light.
#[derive(Clone, Debug, PartialEq)]
pub enum RelightError {
    /// The lighting does not belong to the transport.
    Lighting(LightingError),
    /// `Progress::cancel` was called.
    Cancelled,
}

impl fmt::Display for RelightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lighting(error) => error.fmt(f),
            Self::Cancelled => Cancelled.fmt(f),
        }
    }
}

impl core::error::Error for RelightError {}

impl From<LightingError> for RelightError {
    fn from(error: LightingError) -> Self {
        Self::Lighting(error)
    }
}

impl From<Cancelled> for RelightError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl<'a> Relighter<'a> {
    /// `threads` work on it; 0: one for each core. The result does not depend on it.
    pub fn new(transport: &'a Transport, threads: usize) -> Self {
        Self { transport, workers: Workers::new(threads), solution: Solution::default(), solver: None }
    }

    /// The transport that it works on.
    pub fn transport(&self) -> &'a Transport {
        self.transport
    }

    /// Forgets the last solution, so that the next starts in the dark.
    pub fn forget(&mut self) {
        self.solution = Solution::default();
    }

    /// (Emitted - absorbed - escaped) / emitted power of the last lighting: 0 when no light is lost or made.
    pub fn energy_balance(&self) -> f32 {
        self.solution.energy_balance(self.transport.surfaces.areas.iter().copied(), &self.transport.patches)
    }

    /// The lightmaps for a lighting.
    ///
    /// # Errors
    ///
    /// The lighting belongs to another scene, or the progress was told to cancel.
    pub fn relight(&mut self, lighting: &Lighting, progress: &Progress) -> Result<Relit, RelightError> {
        let Self { transport, workers, .. } = &*self;
        let of_bake = &transport.lighting;
        lighting.check(of_bake.lamps.len(), of_bake.materials.len())?;
        let mut clock = Clock { progress, last: progress.seconds() };
        let mut report = RelightReport::default();

        let direct = transport.direct(lighting, workers, progress)?;
        report.direct = clock.lap();

        let start = self.solution.radiance.clone();
        let (surfaces, rows) = (&transport.surfaces, &transport.patches);
        let solution = Solution::new(surfaces, rows, lighting, &direct, start, workers, progress)?;
        report.sweeps = solution.sweeps;
        report.solve = clock.lap();

        let mut radiance = surfaces.radiance(lighting, &direct, &solution, workers, progress)?;
        report.radiance = clock.lap();

        let mut nodes = transport.gather(&radiance, workers, progress)?;
        let contacts = Contacts { surfaces, list: &transport.contacts, rows: &transport.nodes };
        let mut touched: Vec<Vec3A> = contacts.list.iter().map(|contact| nodes[contact.node as usize]).collect();
        contacts.exchange(lighting, &solution.received, &mut radiance, &mut touched, workers, progress)?;
        contacts.list.iter().zip(&touched).for_each(|(contact, &light)| nodes[contact.node as usize] = light);
        report.gather = clock.lap();

        let mut images = transport.images(&direct, &nodes, workers, progress)?;
        report.finish = clock.lap();
        self.solution = solution;
        self.mend(&mut images, progress)?;
        report.seams = clock.lap();
        Ok(Relit { images, report })
    }

    /// Makes both sides of seams agree.
    fn mend(&mut self, images: &mut [Vec<Vec3>], progress: &Progress) -> Result<(), Cancelled> {
        let Self { transport, workers, solver, .. } = self;
        let seams = &transport.seams;
        let solver = match solver {
            Some(solver) => solver,
            None => solver.insert(SeamSolver::new(seams, workers, progress)?),
        };
        let mut light = seams.gather(images.iter().map(|image| &image[..]));
        solver.solve(&mut light, workers, progress)?;
        seams.scatter(&light, images.iter_mut().map(|image| &mut image[..]));
        Ok(())
    }
}

impl Transport {
    /// Direct irradiance / pi of all texels, then of bare patches.
    pub fn direct(&self, lighting: &Lighting, workers: &Workers, progress: &Progress) -> Result<Vec<Vec3A>, Cancelled> {
        workers.map(self.surfaces.receivers(), 4096, progress, |range| {
            let mut sums = vec![Vec3A::ZERO; range.len()];
            self.lamps.iter().for_each(|lamp| lamp.add(lighting, &range, &mut sums));
            sums
        })
    }

    /// What each node gathers of the radiance of the pieces of surface: irradiance / pi.
    pub fn gather(&self, radiance: &[Vec3A], workers: &Workers, progress: &Progress) -> Result<Vec<Vec3A>, Cancelled> {
        workers
            .map(self.nodes.len(), 1024, progress, |range| range.map(|node| self.nodes.mean(node, radiance)).collect())
    }

    /// The finished texels of all images.
    fn images(
        &self,
        direct: &[Vec3A],
        nodes: &[Vec3A],
        workers: &Workers,
        progress: &Progress,
    ) -> Result<Vec<Vec<Vec3>>, Cancelled> {
        let light = workers.map(self.texels.len(), 4096, progress, |range| {
            range.map(|texel| (direct[texel] + self.texels.mean(texel, nodes)).max(Vec3A::ZERO)).collect()
        })?;
        let firsts = self.images.iter().scan(0, |next, image| {
            *next += image.places.len();
            Some(*next - image.places.len())
        });
        let firsts: Vec<usize> = firsts.collect();
        workers.map(self.images.len(), 1, progress, |range| {
            range.map(|index| self.images[index].texels(&light[firsts[index]..])).collect()
        })
    }
}

impl StoredImage {
    /// All texels, from the light of those that have their own.
    fn texels(&self, light: &[Vec3A]) -> Vec<Vec3> {
        let mut texels = vec![Vec3::ZERO; self.width as usize * self.height as usize];
        for (&place, &light) in self.places.iter().zip(light).filter(|(place, _)| **place != Self::NOWHERE) {
            texels[place as usize] = light.into();
        }
        self.fills.apply(&mut texels);
        texels
    }
}

/// Tells how long things take.
struct Clock<'a> {
    progress: &'a Progress,
    last: f64,
}

impl Clock<'_> {
    fn lap(&mut self) -> f64 {
        let now = self.progress.seconds();
        now - core::mem::replace(&mut self.last, now)
    }
}
