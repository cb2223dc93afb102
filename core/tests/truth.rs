//! Bakes held against paths of light.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;

use common::*;
use radiosity::bake::Quality;
use radiosity::lightmap::{NONE, TexelState};
use radiosity::progress::Progress;
use radiosity::render::{true_errors, truth};
use radiosity::scene::{Scene, cornell_box};

/// A furnace is baked right; texels that are a tenth too bright are found out.
#[test]
fn errors_are_found() {
    let mut scene = Scene { materials: vec![grey(0.5, 1.0)], ..Default::default() };
    add_box(&mut scene, "furnace", [0.0; 3], [1.0; 3], 0, true);
    let mut bake = baked(&scene, &settings(16.0, Quality::Draft));
    let right = truth(&scene, &bake, 40, &Progress::default()).unwrap();
    assert!(right.points == 40 && right.rms < 0.01 && right.bias.abs() < 0.005, "{right:?}");
    assert!(right.standard_error < 0.01, "{right:?}");
    bake.images.iter_mut().flat_map(|image| &mut image.texels).for_each(|texel| *texel *= 1.1);
    let wrong = truth(&scene, &bake, 40, &Progress::default()).unwrap();
    // Relative to 2 + 0.2.
    assert!((wrong.rms - 0.2 / 2.2).abs() < 0.01 && (wrong.bias - 0.1).abs() < 0.01, "{wrong:?}");
    // All 40 are wrong by the same.
    assert!((wrong.rms_without_worst - wrong.rms).abs() < 0.01, "{wrong:?}");
}

/// Shadows, colors and a small lamp: half of the points are within 3 %, without bias; threads change nothing.
#[test]
fn the_cornell_box_is_nearly_true() {
    let scene = cornell_box();
    let mut bake = baked(&scene, &settings(128.0, Quality::Draft));
    let found = truth(&scene, &bake, 50, &Progress::default()).unwrap();
    assert!(found.p50 < 0.03 && found.bias.abs() < 0.02, "{found:?}");
    bake.report.threads = 1;
    assert_eq!(found, truth(&scene, &bake, 50, &Progress::default()).unwrap());
}

/// One chart is a fifth too bright: its texels have that error, all others none.
#[test]
fn errors_lie_where_they_are() {
    let mut scene = Scene { materials: vec![grey(0.5, 1.0)], ..Default::default() };
    add_box(&mut scene, "furnace", [0.0; 3], [1.0; 3], 0, true);
    let mut bake = baked(&scene, &settings(16.0, Quality::Draft));
    let spoilt = bake.images[0].charts.iter().copied().find(|chart| *chart != NONE).unwrap();
    let image = &mut bake.images[0];
    for (texel, chart) in image.texels.iter_mut().zip(&image.charts) {
        *texel *= if *chart == spoilt { 1.2 } else { 1.0 };
    }
    let errors = true_errors(&scene, &bake, 100, &Progress::default()).unwrap();
    let image = &bake.images[0];
    let mut counts = [0, 0];
    for ((error, chart), state) in errors[0].iter().zip(&image.charts).zip(&image.states) {
        if *state != TexelState::Valid {
            assert!(error.is_nan());
        } else if !error.is_nan() {
            counts[usize::from(*chart == spoilt)] += 1;
            let expected = if *chart == spoilt { 0.2 / 1.1 } else { 0.0 };
            assert!((error - expected).abs() < 0.03, "{error}, not {expected}");
        }
    }
    assert!(counts.iter().all(|count| *count > 100), "{counts:?}");
}
