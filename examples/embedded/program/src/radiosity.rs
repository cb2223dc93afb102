//! The Cornell box: form factors of all pairs, and Gauss-Seidel in RGB, in steps of bounded work.

use glam::Vec3;
use heapless::Vec;
use radiosity::form_factor::{Exchanges, Facet, Screen, SightRays, facet_to_facet, pairs};
use radiosity::solve::{GaussSeidelSweep, Reciprocal, System};

use crate::Board;
use crate::r#box::{Surface, screens, surfaces};
use crate::checksum::Checksum;
use crate::report::Report;
use crate::size::{FINENESS, PAIRS, PATCHES};

/// Rays between two patches that do not see all of each other.
const RAYS: u32 = 128;
/// The same where one of them is a lamp: an error in its light is an error of all light.
const RAYS_OF_A_LAMP: u32 = 4096;
/// The largest error at the end, as a share of the brightest patch.
const TOLERANCE: f32 = 1e-4;
/// Patches of one step of the solver.
const STEP: usize = 8;
const MOST_SWEEPS: u32 = 100;

/// What is known of the patches, one entry each.
pub struct Patches {
    /// Where they are.
    pub facets: Vec<Facet, PATCHES>,
    /// Of each band.
    pub reflectance: Vec<Vec3, PATCHES>,
    /// Emitted radiance in cd/m2.
    pub exitance: Vec<Vec3, PATCHES>,
}

impl Patches {
    /// All pieces of the surfaces. What has no room is left out.
    pub fn new(surfaces: &[Surface]) -> Self {
        let mut patches = Self { facets: Vec::new(), reflectance: Vec::new(), exitance: Vec::new() };
        for surface in surfaces {
            for facet in surface.facets() {
                let _ = patches.facets.push(facet);
                let _ = patches.reflectance.push(surface.reflectance);
                let _ = patches.exitance.push(surface.exitance);
            }
        }
        patches
    }

    /// The form factor of a pair; each pair has rays of its own. 0 where there is no such pair.
    pub fn factor(&self, [i, j]: [usize; 2], screens: &[Screen]) -> f32 {
        let (Some(a), Some(b)) = (self.facets.get(i), self.facets.get(j)) else { return 0.0 };
        let glows = |patch: usize| self.exitance.get(patch).is_some_and(|&exitance| exitance != Vec3::ZERO);
        let most = if glows(i) || glows(j) { RAYS_OF_A_LAMP } else { RAYS };
        facet_to_facet(a, b, screens, SightRays { most, sequence: (pairs(i) + j) as u32 })
    }
}

/// The checksums of form factors and radiosities.
#[inline(never)]
pub fn solve(report: &mut Report<impl Board>) -> [Checksum; 2] {
    let surfaces = surfaces(&FINENESS);
    let patches = Patches::new(&surfaces);
    let largest = patches.facets.iter().map(|facet| facet.area).fold(0.0, f32::max);
    let mut exchanges = Exchanges::new(largest, [0; PAIRS]);
    report.count("patches", patches.facets.len() as u32);
    let mut form_factors = Checksum::default();
    let screens = screens(&surfaces);
    let spent = report.measure(|| fill(&patches, &screens, &mut exchanges, &mut form_factors));
    report.count("instructions for all form factors", spent);
    report.checksum("form factors", form_factors);

    let mut inverse_areas = Vec::<f32, PATCHES>::new();
    for facet in &patches.facets {
        let _ = inverse_areas.push(1.0 / facet.area);
    }
    let rows = Reciprocal { exchanges: &exchanges, inverse_areas: &inverse_areas };
    let mut radiosity = patches.exitance.clone();
    let mut sweeps = 0;
    let system = System::new(&patches.exitance, &patches.reflectance, &rows);
    let spent = report.measure(|| sweeps = iterate(&system, &mut radiosity));
    report.count("sweeps to 1e-4", sweeps);
    report.count("instructions per sweep", spent / sweeps.max(1));
    for (name, patch) in [("floor", MIDDLE), ("red wall", 3 * PATCHES_OF_A_WALL + MIDDLE)] {
        let [red, green, blue] = radiosity.get(patch).copied().unwrap_or_default().to_array();
        report.numbers(name, "cd/m2 in the middle, in red, green and blue", [red, green, blue]);
    }
    let mut radiosities = Checksum::default();
    radiosity.iter().for_each(|radiosity| radiosities.add_all(radiosity.to_array()));
    report.checksum("radiosities", radiosities);
    [form_factors, radiosities]
}

const PATCHES_OF_A_WALL: usize = FINENESS.wall[0] as usize * FINENESS.wall[1] as usize;
/// The patch in the middle of a wall.
const MIDDLE: usize = (FINENESS.wall[1] / 2) as usize * FINENESS.wall[0] as usize + (FINENESS.wall[0] / 2) as usize;

/// The form factors of all pairs. Each pair is a step; nothing else has to be remembered between them.
fn fill(patches: &Patches, screens: &[Screen], exchanges: &mut Exchanges<[u16; PAIRS]>, checksum: &mut Checksum) {
    for (i, a) in patches.facets.iter().enumerate() {
        for j in 0..i {
            let exchange = patches.factor([i, j], screens) * a.area;
            checksum.add(exchange);
            // There is room for all pairs, and none exchanges more than the largest area; a sum that lacks one differs.
            if exchanges.set([i, j], exchange).is_err() {
                checksum.add(f32::NAN);
            }
        }
    }
}

/// Steps of a few patches each, between which firmware has time for other things; gives the number of sweeps.
fn iterate(system: &System<Vec3, Reciprocal<[u16; PAIRS]>>, radiosity: &mut [Vec3]) -> u32 {
    let (mut sweep, mut sweeps) = (GaussSeidelSweep::default(), 0);
    while sweeps < MOST_SWEEPS {
        if let Some(accuracy) = sweep.step(system, radiosity, STEP) {
            sweeps += 1;
            if accuracy.is_within(TOLERANCE) {
                break;
            }
        }
    }
    sweeps
}
