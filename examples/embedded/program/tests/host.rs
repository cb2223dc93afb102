//! On the host: the checksums, and the radiosities beside those from exact form factors of the same patches.

use glam::{DVec3, Vec3};
use program::r#box::{SCREENS, SURFACES, screens, surfaces};
use program::radiosity::Patches;
use program::size::{FINENESS, PAIRS, PATCHES};
use program::{Board, expected, run};
use radiosity::form_factor::{Exchanges, polygon_to_polygon_among};
use radiosity::solve::{Dense, FormFactors, Reciprocal, Stop, System, gauss_seidel};

struct Silent;

impl Board for Silent {
    fn instructions(&mut self) -> u64 {
        0
    }
    fn write(&mut self, _: &str) {}
}

#[test]
fn checksums_are_those_that_targets_compare_with() {
    assert_eq!(run(&mut Silent), expected::CHECKSUMS);
}

/// All patches have room, and the arrays are no larger than that.
#[test]
fn every_patch_has_room() {
    let surfaces = surfaces(&FINENESS);
    assert_eq!(surfaces.len(), SURFACES);
    assert_eq!(surfaces.iter().map(|surface| surface.facets().count()).sum::<usize>(), PATCHES);
}

fn solved<F: FormFactors<Scalar = f32>>(patches: &Patches, rows: &F) -> Vec<Vec3> {
    let mut radiosity = patches.exitance.to_vec();
    let stop = Stop { tolerance: 1e-6, most_steps: 100 };
    gauss_seidel(&System::new(&patches.exitance, &patches.reflectance, rows), &mut radiosity, &stop);
    radiosity
}

/// The exact form factors, to 1e-5, are those of the critical lines in `f64`. Errors are shares of the radiosity and a
/// tenth of the mean, because patches under the blocks are all but black.
#[test]
fn radiosities_are_within_two_percent() {
    let surfaces = surfaces(&FINENESS);
    let patches = Patches::new(&surfaces);
    let screens = screens(&surfaces);
    let double = |corners: &[Vec3; 4]| corners.map(|corner| corner.as_dvec3());
    let blockers: Vec<[DVec3; 4]> = surfaces[SURFACES - SCREENS..].iter().map(|face| double(&face.corners)).collect();
    // A face hides nothing from its own patches, from which rounding would move it away.
    let faces: Vec<usize> =
        surfaces.iter().enumerate().flat_map(|(k, surface)| surface.facets().map(move |_| k)).collect();
    let between = |i: usize, j: usize| {
        let others = blockers.iter().zip(SURFACES - SCREENS..).filter(|&(_, k)| k != faces[i] && k != faces[j]);
        others.map(|(corners, _)| corners.as_slice()).collect::<Vec<_>>()
    };
    let largest = patches.facets.iter().map(|facet| facet.area).fold(0.0, f32::max);
    let mut exchanges = [12, 16].map(|bits| (Exchanges::new(largest, [0; PAIRS]), largest / ((1 << bits) - 1) as f32));
    let mut exact = vec![0.0_f32; PATCHES * PATCHES];
    let (mut worst, mut sum) = (0.0_f32, 0.0);
    for (i, a) in patches.facets.iter().enumerate() {
        for (j, b) in patches.facets[..i].iter().enumerate() {
            let true_factor =
                polygon_to_polygon_among(&double(a.corners()), &double(b.corners()), &between(i, j), 1e-5).value as f32;
            let factor = patches.factor([i, j], &screens);
            for (exchanges, step) in &mut exchanges {
                exchanges.set([i, j], (factor * a.area / *step).round() * *step).unwrap();
            }
            (exact[i * PATCHES + j], exact[j * PATCHES + i]) = (true_factor, true_factor * a.area / b.area);
            (worst, sum) = (worst.max((factor - true_factor).abs()), sum + (factor - true_factor).abs());
        }
    }
    println!("form factors: worst error {worst:.1e}, mean {:.1e}", sum / PAIRS as f32);
    let inverse_areas: Vec<f32> = patches.facets.iter().map(|facet| 1.0 / facet.area).collect();
    let large = solved(&patches, &Dense { count: PATCHES, factors: &exact });
    let mean = large.iter().map(|radiosity| radiosity.max_element()).sum::<f32>() / PATCHES as f32;
    let error =
        |(small, large): (&Vec3, &Vec3)| (*small - *large).abs().max_element() / (large.max_element() + 0.1 * mean);
    let worst = exchanges.map(|(exchanges, _)| {
        let small = solved(&patches, &Reciprocal { exchanges: &exchanges, inverse_areas: &inverse_areas });
        let errors: Vec<f32> = small.iter().zip(&large).map(error).collect();
        (errors.iter().copied().fold(0.0, f32::max), errors.iter().sum::<f32>() / PATCHES as f32)
    });
    for ((worst, mean), bits) in worst.iter().zip([12, 16]) {
        println!("radiosities in {bits} bits: worst error {:.2} %, mean {:.2} %", 100.0 * worst, 100.0 * mean);
    }
    assert!(worst[1].0 < 0.02, "{worst:?}");
}
