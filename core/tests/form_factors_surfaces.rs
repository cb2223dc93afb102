//! Form factors between surfaces against known values, by every method that applies, in double and in single precision.

#[path = "reference/methods.rs"]
#[expect(dead_code, reason = "points and strips have other tests")]
mod methods;
#[path = "reference/points.rs"]
#[expect(dead_code, reason = "points have another test")]
mod points;
#[path = "reference/surfaces.rs"]
mod surfaces;

use glam::{DVec3, Vec3};
use methods::{Corners, closed_form, surface_polygons};
use radiosity::form_factor::*;
use radiosity::math::{Real, Vector};
use surfaces::{SURFACE_CASES, Surfaces};

fn single(corners: &Corners) -> Vec<Vec3> {
    corners.iter().map(|corner| corner.as_vec3()).collect()
}

#[test]
fn known_values_of_closed_forms() {
    for case in SURFACE_CASES {
        let factor: f64 = closed_form(&case.surfaces);
        assert!((factor - case.factor).abs() < 1e-9, "{}: {factor}, not {}", case.name, case.factor);
        let factor: f32 = closed_form(&case.surfaces);
        assert!((f64::from(factor) - case.factor).abs() < 1e-5, "{}: {factor}, not {}", case.name, case.factor);
    }
    assert_eq!(SURFACE_CASES.len(), 50);
}

#[test]
fn known_values_of_contour_integrals() {
    for case in SURFACE_CASES {
        let Some((a, others)) = surface_polygons(&case.surfaces) else { continue };
        let factor: f64 = others.iter().map(|b| polygon_to_polygon(&a, b)).sum();
        assert!((factor - case.factor).abs() < 1e-9, "{}: {factor}, not {}", case.name, case.factor);
        let factor: f32 = others.iter().map(|b| polygon_to_polygon(&single(&a), &single(b))).sum();
        assert!((f64::from(factor) - case.factor).abs() < 1e-5, "{}: {factor}, not {}", case.name, case.factor);
    }
}

/// Each receiver may be wrong by the error it states, which is at most the accuracy asked for.
fn check_double_integral<V: Vector>(
    name: &str,
    expected: f64,
    (a, others): (Vec<V>, Vec<Vec<V>>),
    accuracy: f64,
    method: impl Fn(&[V], &[V], V::Scalar) -> Estimate<V::Scalar>,
) {
    let (mut value, mut error) = (0.0, 0.0);
    for b in &others {
        let found = method(&a, b, V::Scalar::from_f64(accuracy));
        assert!(found.error.to_f64() <= accuracy * 1.001, "{name}: {found:?}");
        value += found.value.to_f64();
        error += found.error.to_f64();
    }
    assert!((value - expected).abs() <= error + 1e-12, "{name}: {value} +- {error}, not {expected}");
}

#[test]
fn known_values_of_double_integrals() {
    for case in SURFACE_CASES {
        let Some((a, others)) = surface_polygons(&case.surfaces) else { continue };
        let singles = (single(&a), others.iter().map(single).collect());
        check_double_integral(case.name, case.factor, (a.clone(), others.clone()), 1e-9, double_integral);
        check_double_integral(case.name, case.factor, (a.clone(), others.clone()), 1e-4, double_integral);
        check_double_integral(case.name, case.factor, singles, 1e-5, double_integral);
        check_double_integral(case.name, case.factor, (a, others), 1e-2, double_integral_of_points);
    }
}

/// Strips without end are very long rectangles.
#[test]
fn strips_are_long_rectangles() {
    for case in SURFACE_CASES {
        let (degrees, distance) = match case.surfaces {
            Surfaces::ParallelStrips { distance, .. } => (0.0_f64, distance),
            Surfaces::StripsAtAnAngle { degrees } => (degrees, 0.0),
            _ => continue,
        };
        let factor: f64 = if degrees > 0.0 {
            tilted_rectangles(1e4, 1.0, 1.0, degrees.to_radians())
        } else {
            parallel_rectangles(1.0, 1e4, distance)
        };
        assert!((factor - case.factor).abs() < 1e-4, "{}: {factor}, not {}", case.name, case.factor);
    }
}

/// What the face of a cube sees of a sphere in it, from the closed form for a point: the mean over the face.
#[test]
fn a_sphere_from_all_points_of_a_face() {
    let sphere = |p: DVec3| point_to_sphere(p, DVec3::Z, DVec3::new(0.5, 0.5, 0.5), 0.25);
    let count = 64;
    let place = |i: usize| (i as f64 + 0.5) / count as f64;
    let points = (0..count * count).map(|k| DVec3::new(place(k / count), place(k % count), 0.0));
    let mean = points.map(sphere).sum::<f64>() / (count * count) as f64;
    assert!((mean - 0.1308996938996).abs() < 1e-4, "{mean}");
}
