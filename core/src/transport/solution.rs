//! The radiosity equation of a bake, for one lighting.

use alloc::vec;
use alloc::vec::Vec;
use core::iter::repeat_n;
use core::ops::Range;

use glam::Vec3A;

use super::{Lighting, Rows, Surfaces};
use crate::parallel::Workers;
use crate::progress::{Cancelled, Progress};
use crate::solve::{Chebyshev, Decay, FormFactors, Solver, System};
use crate::spectrum::Spectrum;

/// The solution is this close, as a share of the brightest light that any patch reflects. The noise of the rows is tens
/// of times that...
const TOLERANCE: f32 = 1e-4;
/// ...which reflectances up to 0.98 reach before, unless rounding hides it: next to a radiance a thousand times as large.
const MOST_SWEEPS: usize = 300;

/// What patches do with light and what they get straight from the lamps. Lists have an entry for each patch, then those of
/// the sky and one for the black.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PatchLight {
    /// Direct irradiance / pi.
    pub direct: Vec<Vec3A>,
    /// The share of the light that is reflected.
    pub reflectance: Vec<Vec3A>,
    /// Emitted radiance in cd/m2.
    pub emission: Vec<Vec3A>,
    /// The share of the light that meets a patch and stays; none of the sky and the black.
    pub presence: Vec<f32>,
}

impl PatchLight {
    /// From the direct light of the receivers.
    pub fn new(surfaces: &Surfaces, lighting: &Lighting, direct: &[Vec3A]) -> Self {
        Self {
            direct: surfaces.direct_of_patches(direct),
            reflectance: surfaces.reflectances(lighting),
            emission: surfaces.emissions(lighting),
            presence: surfaces.presence.iter().copied().chain(repeat_n(0.0, surfaces.outside())).collect(),
        }
    }

    /// Takes over what another one says of a range of patches.
    pub fn take_in(&mut self, other: &Self, patches: Range<usize>) {
        for (own, of_other) in [
            (&mut self.direct, &other.direct),
            (&mut self.reflectance, &other.reflectance),
            (&mut self.emission, &other.emission),
        ] {
            own[patches.clone()].copy_from_slice(&of_other[patches.clone()]);
        }
        self.presence[patches.clone()].copy_from_slice(&other.presence[patches]);
    }
}

/// The light of all bounces. Lists have an entry for each patch, then those of the sky and one for the black; radiances
/// are in cd/m2, irradiance is divided by pi.
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
    /// The share of the light that meets the patch and stays.
    pub presence: Vec<f32>,
    /// Bounces that were needed.
    pub sweeps: usize,
}

impl Solution {
    /// Solves `b = e + rho (D + F b)` from any `start`, with `rows` of form factors and the direct light of the receivers.
    ///
    /// The sky is of patches that emit and see nothing; the black one is black.
    pub fn new(
        surfaces: &Surfaces,
        rows: &Rows,
        lighting: &Lighting,
        direct: &[Vec3A],
        start: Vec<Vec3A>,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<Self, Cancelled> {
        Self::of_patches(PatchLight::new(surfaces, lighting, direct), rows, start, workers, progress)
    }

    /// The same from what the patches themselves do and get.
    pub fn of_patches(
        PatchLight { direct, reflectance, emission, presence }: PatchLight,
        rows: &Rows,
        start: Vec<Vec3A>,
        workers: &Workers,
        progress: &Progress,
    ) -> Result<Self, Cancelled> {
        let light = emission.iter().zip(&reflectance).zip(&direct);
        let exitance: Vec<Vec3A> = light.map(|((emission, rho), direct)| emission + rho * direct).collect();
        let rho = reflectance.iter().copied().fold(Vec3A::ZERO, Vec3A::max);
        // Rows sum to one, the sky and the black included.
        let decay = Decay { per_bounce: rho, amplification: Vec3A::ONE / (Vec3A::ONE - rho) };
        let form_factors = &Threaded { rows, workers, progress };
        let system = System { exitance: &exitance, reflectance: &reflectance, form_factors, decay };
        let (mut radiance, mut scratch) = (start, vec![Vec3A::ZERO; 2 * direct.len()]);
        radiance.resize(direct.len(), Vec3A::ZERO);
        let (mut solver, mut sweeps, mut is_done) = (Chebyshev::new(&system, &mut scratch), 0, false);
        while sweeps < MOST_SWEEPS && !is_done {
            is_done = is_close(solver.step(&system, &mut radiance).error, &radiance, &emission);
            progress.check()?;
            sweeps += 1;
        }
        let mut received = scratch;
        received.truncate(direct.len());
        form_factors.receive_all(&radiance, &mut received);
        progress.check()?;
        Ok(Self { radiance, received, direct, reflectance, emission, presence, sweeps })
    }

    /// (Emitted - absorbed - escaped) / emitted power, by what the rows say. Form factors from rays obey reciprocity
    /// only as far as their noise allows; what they miss shows here. So does light of lamps that several mirrors, or curved
    /// ones, would bring. What mirrors and glass absorb on the way counts as absorbed.
    pub fn energy_balance(&self, areas: impl ExactSizeIterator<Item = f32>, rows: &Rows) -> f32 {
        let (mut emitted, mut absorbed) = (0.0_f64, 0.0_f64);
        let outside = areas.len() as u32..self.radiance.len() as u32;
        let mut sky = self.radiance.clone();
        sky[..areas.len()].fill(Vec3A::ZERO);
        for (i, area) in areas.enumerate() {
            let from_outside = self.direct[i] + self.emission[i] + rows.mean(i, &sky);
            let kept = (self.direct[i] + self.received[i]) * (Vec3A::ONE - self.reflectance[i]);
            let area = area * self.presence[i];
            let escaped = self.radiance[i] * (rows.share::<Vec3A>(i, outside.clone()) + rows.absorbed::<Vec3A>(i));
            emitted += f64::from(area) * f64::from(from_outside.element_sum());
            absorbed += f64::from(area) * f64::from((kept + escaped).element_sum());
        }
        if emitted > 0.0 { ((emitted - absorbed) / emitted) as f32 } else { 0.0 }
    }
}

/// Whether an error is small in each band against the brightest light that is reflected: what shines itself, as the sky
/// does, may be a thousand times brighter than a room, and would hide an error of the room's whole light.
fn is_close(error: Vec3A, radiance: &[Vec3A], emission: &[Vec3A]) -> bool {
    let reflected = radiance.iter().zip(emission).map(|(radiance, emission)| radiance - emission);
    error.cmple(TOLERANCE * reflected.fold(Vec3A::ZERO, Vec3A::max)).all()
}

/// Rows shared among workers.
struct Threaded<'a> {
    rows: &'a Rows,
    workers: &'a Workers,
    progress: &'a Progress,
}

impl FormFactors for Threaded<'_> {
    type Scalar = f32;

    fn row(&self, i: usize, entry: impl FnMut(usize, f32)) {
        self.rows.row(i, entry);
    }

    /// Where it is cancelled, nothing changes.
    fn receive_all<S: Spectrum<Scalar = f32>>(&self, radiosity: &[S], received: &mut [S]) {
        let task = |range: Range<usize>| range.map(|i| self.rows.mean(i, radiosity)).collect();
        if let Ok(sums) = self.workers.map(self.rows.len(), 1024, self.progress, task) {
            received.copy_from_slice(&sums);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A room that reflects 1 under a sky of 100 000: an error of 0.01 is a hundredth of its light.
    #[test]
    fn a_bright_sky_hides_no_error() {
        let [radiance, emission] = [[1.0, 1e5], [0.0, 1e5]].map(|patches| patches.map(Vec3A::splat));
        assert!(!is_close(Vec3A::splat(0.01), &radiance, &emission));
        assert!(is_close(Vec3A::splat(0.9 * TOLERANCE), &radiance, &emission));
        assert!(!is_close(Vec3A::new(0.0, 0.0, 0.01), &radiance, &emission));
    }
}
