//! A room that is solved while it is looked at: the patch with the most light to give shoots first.
//!
//! Progressive refinement, Cohen et al. 1988. A shot needs one row of form factors; all rows are kept, so that another
//! lamp needs no ray.

use alloc::vec;
use alloc::vec::Vec;

use glam::Vec3;
use program::r#box::{Fineness, screens, surfaces};
use radiosity::composite::RasterError;
use radiosity::form_factor::{Exchanges, Facet, Screen, SightRays, facet_to_facet, pairs};
use radiosity::solve::{Decay, GaussSeidelSweep, Reciprocal, System};

use crate::view::{color, see};

const FINENESS: Fineness =
    Fineness { wall: [14, 14], ceiling: [8, 4], lamp: [2, 2], sides: [[5, 5], [5, 10]], top: [5, 5] };
/// Rays between patches that do not see all of each other.
const RAYS: u32 = 64;
/// The same where one of them is a lamp.
const RAYS_OF_A_LAMP: u32 = 1024;
/// In place of a patch where a pixel shows none.
const NOTHING: u32 = u32::MAX;
const TOLERANCE: f32 = 1e-4;

/// What is going on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// The row of this patch is being filled; the next entry.
    Row(usize, usize),
    /// All rows are there; sweeps make the solution exact.
    Sweeps,
    /// Nothing is left to do.
    Done,
}

/// Patches, what is known of their exchanges, and a picture of them.
pub struct Room {
    facets: Vec<Facet>,
    reflectance: Vec<Vec3>,
    exitance: Vec<Vec3>,
    inverse_areas: Vec<f32>,
    screens: Vec<Screen>,
    exchanges: Exchanges<Vec<u16>>,
    has_row: Vec<bool>,
    radiosity: Vec<Vec3>,
    unshot: Vec<Vec3>,
    stage: Stage,
    sweep: GaussSeidelSweep<Vec3>,
    /// How light dies out, known from the first sweep on; it asks for all rows.
    decay: Option<Decay<Vec3>>,
    lamp: Vec3,
    /// For each pixel the patch that it shows.
    seen: Vec<u32>,
    pixels: Vec<u8>,
}

impl Room {
    /// The Cornell box, in a square picture with `side` pixels a side.
    ///
    /// # Errors
    ///
    /// Where the side is above 32768.
    pub fn new(side: u32) -> Result<Self, RasterError> {
        let surfaces = surfaces(&FINENESS);
        let all = || surfaces.iter().flat_map(|surface| surface.facets().map(move |facet| (surface, facet)));
        let facets: Vec<Facet> = all().map(|(_, facet)| facet).collect();
        let exitance: Vec<Vec3> = all().map(|(surface, _)| surface.exitance).collect();
        let largest = facets.iter().map(|facet| facet.area).fold(0.0, f32::max);
        let mut room = Self {
            reflectance: all().map(|(surface, _)| surface.reflectance).collect(),
            inverse_areas: facets.iter().map(|facet| 1.0 / facet.area).collect(),
            screens: screens(&surfaces).to_vec(),
            exchanges: Exchanges::new(largest, vec![0; pairs(facets.len())]),
            has_row: vec![false; facets.len()],
            radiosity: exitance.clone(),
            unshot: exitance.clone(),
            stage: Stage::Done,
            sweep: GaussSeidelSweep::default(),
            decay: None,
            lamp: Vec3::ONE,
            seen: shown(&facets, side)?,
            pixels: vec![255; 4 * (side * side) as usize],
            facets,
            exitance,
        };
        room.choose();
        Ok(room)
    }

    /// Goes on by about so many pairs of patches; whether there is more to do.
    pub fn step(&mut self, most: usize) -> bool {
        match self.stage {
            Stage::Row(shooter, next) => self.fill(shooter, next, most),
            Stage::Sweeps => self.gather(most),
            Stage::Done => {}
        }
        self.stage != Stage::Done
    }

    /// Patches that have shot.
    pub fn rows(&self) -> usize {
        self.has_row.iter().filter(|&&has_row| has_row).count()
    }

    /// How many patches there are.
    pub fn patches(&self) -> usize {
        self.facets.len()
    }

    /// The lamp in another color, as shares of its usual radiance in `(0, 1]`: all light is what it was, times the ratio,
    /// since bands do not mix and no other lamp shines. What has been exchanged stays known.
    pub fn relight(&mut self, lamp: Vec3) {
        let ratio = lamp / self.lamp;
        self.lamp = lamp;
        for light in [&mut self.exitance, &mut self.radiosity, &mut self.unshot] {
            light.iter_mut().for_each(|light| *light *= ratio);
        }
        if self.stage == Stage::Done {
            self.stage = Stage::Sweeps;
        }
    }

    /// The picture as it is now, four bytes a pixel.
    pub fn draw(&mut self) -> &[u8] {
        let colors: Vec<[u8; 3]> = self.radiosity.iter().copied().map(color).collect();
        for (pixel, &patch) in self.pixels.chunks_exact_mut(4).zip(&self.seen) {
            pixel[..3].copy_from_slice(&colors.get(patch as usize).copied().unwrap_or_default());
        }
        &self.pixels
    }

    /// The patch with the most power that has not shot yet; sweeps when there is none.
    fn choose(&mut self) {
        let power = |patch: usize| self.unshot[patch].element_sum() * self.facets[patch].area;
        let open = (0..self.facets.len()).filter(|&patch| !self.has_row[patch]);
        let brightest = open.max_by(|&a, &b| power(a).total_cmp(&power(b)));
        self.stage = brightest.map_or(Stage::Sweeps, |patch| Stage::Row(patch, 0));
    }

    /// A part of the row of the shooter; at its end it shoots.
    fn fill(&mut self, shooter: usize, next: usize, most: usize) {
        let end = (next + most).min(self.facets.len());
        for other in next..end {
            if other == shooter || self.has_row[other] {
                continue;
            }
            let (i, j) = (shooter.max(other), shooter.min(other));
            let glows = self.exitance[i] != Vec3::ZERO || self.exitance[j] != Vec3::ZERO;
            let most = if glows { RAYS_OF_A_LAMP } else { RAYS };
            let rays = SightRays { most, sequence: (pairs(i) + j) as u32 };
            let factor = facet_to_facet(&self.facets[i], &self.facets[j], &self.screens, rays);
            // An exchange above all areas cannot be; it would stay 0.
            let _ = self.exchanges.set([i, j], factor * self.facets[i].area);
        }
        self.stage = Stage::Row(shooter, end);
        if end == self.facets.len() {
            self.shoot(shooter);
            self.choose();
        }
    }

    /// `B_j += rho_j B_i A_i F_ij / A_j`
    fn shoot(&mut self, shooter: usize) {
        let light = core::mem::take(&mut self.unshot[shooter]);
        self.has_row[shooter] = true;
        for j in 0..self.facets.len() {
            let gained = self.reflectance[j] * light * (self.exchanges.get([shooter, j]) * self.inverse_areas[j]);
            self.radiosity[j] += gained;
            self.unshot[j] += gained;
        }
    }

    /// A few rows of a sweep of Gauss and Seidel.
    fn gather(&mut self, most: usize) {
        let rows = Reciprocal { exchanges: &self.exchanges, inverse_areas: &self.inverse_areas };
        let (exitance, reflectance) = (&self.exitance[..], &self.reflectance[..]);
        let decay = *self.decay.get_or_insert_with(|| System::new(exitance, reflectance, &rows).decay);
        let system = System { exitance, reflectance, form_factors: &rows, decay };
        let count = most.div_ceil(self.facets.len());
        if let Some(accuracy) = self.sweep.step(&system, &mut self.radiosity, count)
            && accuracy.is_within(TOLERANCE)
        {
            self.stage = Stage::Done;
        }
    }
}

/// For each pixel of a square picture the patch that it shows.
fn shown(facets: &[Facet], side: u32) -> Result<Vec<u32>, RasterError> {
    let mut shown = vec![NOTHING; side as usize * side as usize];
    let things = facets.iter().zip(0..).flat_map(|(facet, patch)| {
        let [a, b, c, d] = *facet.corners();
        [[a, b, c], [a, c, d]].map(|corners| (patch, corners))
    });
    see(side, things, |patch, fragment| shown[fragment.pixel] = patch)?;
    Ok(shown)
}
