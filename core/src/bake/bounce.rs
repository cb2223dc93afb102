//! Patches with their materials and the light that reaches them: the radiosity equation of a bake.

use alloc::vec;
use alloc::vec::Vec;
use core::f32::consts::PI;

use glam::Vec3;

use crate::geometry::{Hit, Occluders, Sobol, cosine_direction, hash};
use crate::light::DirectLight;
use crate::lightmap::{Patch, Patches, Site, Texels};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::scene::World;
use crate::solve::{Chebyshev, FormFactors, Solver, System};
use crate::transport::{End, RowCounts, Rows, Tracer};

/// Surfaces that reflect more are taken to reflect this much: nothing real reflects all.
pub(super) const LARGEST_REFLECTANCE: f32 = 0.98;
/// The solution is this close, as a share of the brightest patch...
const TOLERANCE: f32 = 1e-5;
/// ...which reflectances up to 0.98 reach long before.
const MOST_SWEEPS: usize = 1000;
/// Points of a patch from which direct light is looked for where it has no texels to average.
const DIRECT_POINTS: u32 = 16;

/// What each patch is and gets. Radiances in cd/m2; irradiance is divided by pi.
#[derive(Clone, Debug, Default)]
pub(super) struct Bounce {
    pub reflectance: Vec<Vec3>,
    /// Emitted radiance, of emitters that are no lights of their own.
    pub emission: Vec<Vec3>,
    /// Direct irradiance / pi.
    pub direct: Vec<Vec3>,
    /// Irradiance / pi from other patches and the sky.
    pub indirect: Vec<Vec3>,
    /// Radiance that leaves the patch.
    pub radiance: Vec<Vec3>,
    /// Patches whose reflectance was lowered.
    pub lowered: usize,
}

/// What the materials of patches are averaged from.
pub(super) struct Stage<'a, O> {
    pub tracer: &'a Tracer<'a, O>,
    pub texels: &'a Texels,
    pub patches: &'a Patches,
    pub workers: &'a Workers,
    pub progress: &'a Progress,
    pub seed: u32,
}

impl<O: Occluders> Stage<'_, O> {
    fn world(&self) -> &World<'_> {
        self.tracer.world
    }

    /// Rows of form factors: `rays` from each patch.
    pub fn rows(&self, rays: u32) -> Result<Rows, Cancelled> {
        let rows = self.workers.map(self.patches.list.len(), 32, self.progress, |range| {
            range.map(|patch| self.row(patch, rays)).collect()
        })?;
        Ok(rows.into_iter().collect())
    }

    fn row(&self, index: usize, rays: u32) -> RowCounts {
        let patch = &self.patches.list[index];
        let seed = hash(self.seed, index as u32);
        let sequence = Sobol::new(seed);
        let mut ends: Vec<End> = (0..rays)
            .map(|k| {
                let (triangle, point, normal) = self.patches.point(self.world(), self.texels, patch, &sequence, k);
                let direction = cosine_direction(sequence.square(k), normal);
                let ray = self.tracer.leave(triangle, point, normal, direction, f32::INFINITY);
                match self.tracer.nearest(&ray, hash(seed, k)) {
                    None => End::Sky,
                    Some(hit) => match self.patches.at(self.world(), self.texels, &hit) {
                        Some(patch) => End::Patch(patch),
                        None => End::Black,
                    },
                }
            })
            .collect();
        self.tracer.count(rays as usize);
        RowCounts::new(&mut ends)
    }

    /// Averages materials and direct light over all patches. `direct` has irradiance / pi for each texel.
    pub fn bounce(&self, direct: &[Vec3], lights: &[DirectLight], is_light: &[bool]) -> Result<Bounce, Cancelled> {
        let found = self.workers.map(self.patches.list.len(), 64, self.progress, |range| {
            range.map(|index| self.average(index, direct, lights, is_light)).collect()
        })?;
        let mut bounce = Bounce { indirect: vec![Vec3::ZERO; found.len()], ..Bounce::default() };
        for [reflectance, emission, direct] in found {
            bounce.lowered += usize::from(reflectance.max_element() > LARGEST_REFLECTANCE);
            bounce.reflectance.push(reflectance.min(Vec3::splat(LARGEST_REFLECTANCE)));
            bounce.emission.push(emission);
            bounce.direct.push(direct);
        }
        Ok(bounce)
    }

    /// Mean reflectance, emitted radiance and direct irradiance / pi of a patch.
    fn average(&self, index: usize, direct: &[Vec3], lights: &[DirectLight], is_light: &[bool]) -> [Vec3; 3] {
        let patch = &self.patches.list[index];
        let mut sums = [Vec3::ZERO; 3];
        let mut has_texels = false;
        for (site, area) in self.patches.sites(patch) {
            let hit = self.hit(site);
            sums[0] += self.world().reflectance(&hit) * area;
            let surface = self.world().sources[hit.triangle as usize].surface;
            if !is_light[surface as usize] {
                sums[1] += self.world().emission(&hit) * area;
            }
            if let (Site::Texel(texel), true) = (site, patch.side > 0.0) {
                has_texels = true;
                sums[2] += direct[texel as usize] * area;
            }
        }
        let mut means = sums.map(|sum| sum / patch.area);
        if !has_texels {
            means[2] = self.direct_on(patch, index, lights);
        }
        means
    }

    /// Direct irradiance / pi on a patch without texels on its side, from a few points of it.
    fn direct_on(&self, patch: &Patch, index: usize, lights: &[DirectLight]) -> Vec3 {
        let sequence = Sobol::new(hash(self.seed ^ 0x00d1_9ec7, index as u32));
        let mut sum = Vec3::ZERO;
        for k in 0..DIRECT_POINTS {
            let (triangle, point, normal) = self.patches.point(self.world(), self.texels, patch, &sequence, k);
            for light in lights {
                let irradiance = light.irradiance(point, normal);
                if irradiance == Vec3::ZERO {
                    continue;
                }
                let shadow = light.shadow_ray(sequence.square(k), point, normal);
                if shadow.weight > 0.0 {
                    let end = if shadow.end == 1.0 { 1.0 - 1e-4 } else { shadow.end };
                    let ray = self.tracer.leave(triangle, point, normal, shadow.direction, end);
                    sum += irradiance * self.tracer.visibility(&ray);
                    self.tracer.count(1);
                }
            }
        }
        sum / (DIRECT_POINTS as f32 * PI)
    }

    fn hit(&self, site: Site) -> Hit {
        match site {
            Site::Texel(texel) => self.texels.hit(texel),
            Site::Triangle(triangle) => {
                Hit { triangle, distance: 0.0, barycentric: glam::Vec2::splat(1.0 / 3.0), front: true }
            }
        }
    }
}

impl Bounce {
    /// Solves `b = e + rho (D + sky + F b)` for all bounces.
    pub fn solve(&mut self, rows: &Rows, sky: Vec3, progress: &Progress) -> Result<(), Cancelled> {
        let count = self.reflectance.len();
        let exitance: Vec<Vec3> =
            (0..count).map(|i| self.emission[i] + self.reflectance[i] * (self.direct[i] + sky * rows.sky(i))).collect();
        self.radiance = exitance.clone();
        let system = System::new(&exitance, &self.reflectance, rows);
        let mut scratch = vec![Vec3::ZERO; 2 * count];
        let mut solver = Chebyshev::new(&system, &mut scratch);
        for _ in 0..MOST_SWEEPS {
            progress.check()?;
            if solver.step(&system, &mut self.radiance).is_within(TOLERANCE) {
                break;
            }
        }
        self.indirect = (0..count).map(|i| sky * rows.sky(i) + rows.receive(i, &self.radiance)).collect();
        Ok(())
    }

    /// (Emitted - absorbed - escaped) / emitted power, by what the rows say. Form factors from rays obey reciprocity
    /// only as far as their noise allows; what they miss shows here.
    pub fn energy_balance(&self, patches: &Patches, rows: &Rows, sky: Vec3) -> f32 {
        let (mut emitted, mut absorbed) = (0.0_f64, 0.0_f64);
        for (i, patch) in patches.list.iter().enumerate() {
            let area = f64::from(patch.area);
            let incident = self.direct[i] + self.indirect[i];
            let from_outside = self.direct[i] + self.emission[i] + sky * rows.sky(i);
            let escaped = self.radiance[i] * (rows.sky(i) + rows.black(i));
            emitted += area * f64::from(from_outside.element_sum());
            absorbed += area * f64::from((incident * (Vec3::ONE - self.reflectance[i]) + escaped).element_sum());
        }
        if emitted > 0.0 { ((emitted - absorbed) / emitted) as f32 } else { 0.0 }
    }
}
