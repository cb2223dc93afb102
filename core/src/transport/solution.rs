//! The radiosity equation of a bake, for one lighting.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3A;

use super::{Lighting, Rows, Surfaces};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};

/// The solution is this close, as a share of the brightest patch...
const TOLERANCE: f32 = 1e-5;
/// ...which reflectances up to 0.98 reach long before.
const MOST_SWEEPS: usize = 1000;

/// The light of all bounces. Lists have an entry for each patch, one for the sky and one for the black; radiances are
/// in cd/m2, irradiance is divided by pi.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solution {
    /// Radiance that leaves the patch.
    pub radiance: Vec<Vec3A>,
    /// Irradiance / pi from other patches and the sky.
    pub received: Vec<Vec3A>,
    /// Direct irradiance / pi.
    pub direct: Vec<Vec3A>,
    /// The share of the light that is reflected.
    pub reflectance: Vec<Vec3A>,
    /// Emitted radiance.
    pub emission: Vec<Vec3A>,
    /// Bounces that were needed.
    pub sweeps: usize,
}

impl Solution {
    /// Solves `b = e + rho (D + F b)` from any `start`, with `rows` of form factors and the direct light of the receivers.
    ///
    /// The sky is a patch that emits and sees nothing; the black one is black. Chebyshev's iteration, as in
    /// [`crate::solve::chebyshev`], with the rows of a sweep shared among workers: it needs no scalar products, and so
    /// gives the same bits for any number of them.
    pub fn new(
        surfaces: &Surfaces,
        rows: &Rows,
        lighting: &Lighting,
        direct: &[Vec3A],
        start: Vec<Vec3A>,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<Self, Cancelled> {
        let direct = surfaces.direct_of_patches(direct);
        let (reflectance, emission) = (surfaces.reflectances(lighting), surfaces.emissions(lighting));
        let received = vec![Vec3A::ZERO; direct.len()];
        let mut solution = Self { radiance: start, received, direct, reflectance, emission, sweeps: 0 };
        solution.radiance.resize(solution.direct.len(), Vec3A::ZERO);
        solution.sweep_until_done(rows, workers, progress)?;
        solution.received = receive(rows, &solution.radiance, workers, progress)?;
        Ok(solution)
    }

    fn sweep_until_done(&mut self, rows: &Rows, workers: &Workers, progress: &Progress) -> Result<(), Cancelled> {
        let rho = self.reflectance.iter().fold(0.0_f32, |rho, patch| rho.max(patch.max_element()));
        let (mut before, mut omega) = (self.radiance.clone(), 1.0);
        while self.sweeps < MOST_SWEEPS {
            let received = receive(rows, &self.radiance, workers, progress)?;
            let (mut residual, mut largest) = (0.0_f32, 0.0_f32);
            for (i, received) in received.into_iter().enumerate() {
                let jacobi = self.emission[i] + self.reflectance[i] * (self.direct[i] + received);
                residual = residual.max((jacobi - self.radiance[i]).abs().max_element());
                largest = largest.max(jacobi.max_element());
                let next = before[i] + (jacobi - before[i]) * omega;
                before[i] = core::mem::replace(&mut self.radiance[i], next);
            }
            self.sweeps += 1;
            if residual <= TOLERANCE * largest * (1.0 - rho) {
                break;
            }
            omega = 1.0 / (1.0 - rho * rho * omega / if self.sweeps == 1 { 2.0 } else { 4.0 });
        }
        Ok(())
    }

    /// (Emitted - absorbed - escaped) / emitted power, by what the rows say. Form factors from rays obey reciprocity
    /// only as far as their noise allows; what they miss shows here.
    pub fn energy_balance(&self, surfaces: &Surfaces, rows: &Rows) -> f32 {
        let (mut emitted, mut absorbed) = (0.0_f64, 0.0_f64);
        let Some(&sky) = self.radiance.get(surfaces.sky() as usize) else { return 0.0 };
        for (i, &area) in surfaces.areas.iter().enumerate() {
            let (to_sky, to_black) = (rows.share(i, surfaces.sky()), rows.share(i, surfaces.black()));
            let from_outside = self.direct[i] + self.emission[i] + sky * to_sky;
            let kept = (self.direct[i] + self.received[i]) * (Vec3A::ONE - self.reflectance[i]);
            let escaped = self.radiance[i] * (to_sky + to_black);
            emitted += f64::from(area) * f64::from(from_outside.element_sum());
            absorbed += f64::from(area) * f64::from((kept + escaped).element_sum());
        }
        if emitted > 0.0 { ((emitted - absorbed) / emitted) as f32 } else { 0.0 }
    }
}

/// What all patches receive from each other: one product with the rows.
fn receive(rows: &Rows, radiance: &[Vec3A], workers: &Workers, progress: &Progress) -> Result<Vec<Vec3A>, Cancelled> {
    workers.map(rows.len(), 1024, progress, |range| range.map(|i| rows.mean(i, radiance)).collect())
}
