//! Form factors between surfaces against known values, by every method that applies, in double and in single precision.

#[path = "reference/methods.rs"]
#[expect(dead_code, reason = "points have another test")]
mod methods;
#[path = "reference/points.rs"]
#[expect(dead_code, reason = "points have another test")]
mod points;
#[path = "reference/small_patch.rs"]
mod small_patch;
#[path = "reference/surfaces.rs"]
mod surfaces;

use glam::{DVec3, Vec3};
use methods::{Corners, closed_form, duct_angle, strip_polygons, surface_polygons};
use radiosity::form_factor::*;
use radiosity::math::{Real, Vector};
use small_patch::small_patch;
use surfaces::{SURFACE_CASES, SurfaceCase, Surfaces};

/// Half the length of strips without end: what is missing counts with the cube of the distance over it, 1e-12.
const FAR: f64 = 1e4;

/// All cases whose surfaces are polygons, with the sender and the receivers; strips are long rectangles.
fn polygon_cases(far: f64) -> impl Iterator<Item = (&'static SurfaceCase, Corners, Vec<Corners>)> {
    SURFACE_CASES.iter().filter_map(move |case| {
        let (a, others) = surface_polygons(&case.surfaces).or_else(|| strip_polygons(&case.surfaces, far))?;
        Some((case, a, others))
    })
}

fn single(corners: &Corners) -> Vec<Vec3> {
    corners.iter().map(|corner| corner.as_vec3()).collect()
}

#[test]
fn known_values_of_closed_forms() {
    let mut count = 0;
    for case in SURFACE_CASES {
        let Some(factor) = closed_form::<f64>(&case.surfaces) else { continue };
        assert!((factor - case.factor).abs() < 1e-9, "{}: {factor}, not {}", case.name, case.factor);
        let factor = closed_form::<f32>(&case.surfaces).map_or(f64::NAN, f64::from);
        assert!((factor - case.factor).abs() < 1e-5, "{}: {factor}, not {}", case.name, case.factor);
        count += 1;
    }
    assert_eq!((SURFACE_CASES.len(), count), (50, 49), "all but the tetrahedron, which has its symmetry");
}

#[test]
fn known_values_of_contour_integrals() {
    for (case, a, others) in polygon_cases(FAR) {
        let factor: f64 = others.iter().map(|b| polygon_to_polygon(&a, b)).sum();
        assert!((factor - case.factor).abs() < 1e-9, "{}: {factor}, not {}", case.name, case.factor);
        let factor: f32 = others.iter().map(|b| polygon_to_polygon(&single(&a), &single(b))).sum();
        assert!((f64::from(factor) - case.factor).abs() < 1e-5, "{}: {factor}, not {}", case.name, case.factor);
    }
    assert_eq!(polygon_cases(FAR).count(), 35);
}

/// Each receiver may be wrong by the error it states, which is at most the accuracy asked for; polygons that stand for
/// longer ones lose a little.
fn check_double_integral<V: Vector>(
    name: &str,
    [expected, lost]: [f64; 2],
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
    assert!((value - expected).abs() <= error + lost, "{name}: {value} +- {error}, not {expected}");
}

#[test]
fn known_values_of_double_integrals() {
    for (case, a, others) in polygon_cases(FAR) {
        let expected = [case.factor, 1e-12];
        let singles = (single(&a), others.iter().map(single).collect());
        check_double_integral(case.name, expected, (a.clone(), others.clone()), 1e-9, double_integral);
        check_double_integral(case.name, expected, (a, others), 1e-4, double_integral);
        check_double_integral(case.name, expected, singles, 1e-5, double_integral);
    }
}

/// Of long strips that share an edge points see too little. Strips end at five times their width here, beyond which lies
/// less than 0.002 of what they send.
#[test]
fn known_values_of_double_integrals_of_points() {
    let is_duct = |surfaces: &Surfaces| matches!(surfaces, Surfaces::TriangularDuct { .. });
    let ducts = polygon_cases(20.0).filter(|(case, ..)| is_duct(&case.surfaces));
    let others = polygon_cases(5.0).filter(|(case, ..)| !is_duct(&case.surfaces));
    for (case, a, others) in others.chain(ducts) {
        let lost = if surface_polygons(&case.surfaces).is_some() { 1e-12 } else { 2e-3 };
        check_double_integral(case.name, [case.factor, lost], (a, others), 1e-2, double_integral_of_points);
    }
}

/// The two strips of a case, seen along them.
fn planar_strips<R: Real>(surfaces: &Surfaces) -> Option<[[Planar<R>; 2]; 2]> {
    let leaning = |a: f64, b: f64, angle: f64| [a, b * angle.cos(), b * angle.sin(), 0.0, 0.0];
    let [width, x, y, end, height] = match *surfaces {
        Surfaces::ParallelStrips { width, distance } => [width, width, distance, 0.0, distance],
        Surfaces::StripsAtAnAngle { degrees } => leaning(1.0, 1.0, degrees.to_radians()),
        Surfaces::TriangularDuct { from, to, third } => leaning(from, to, duct_angle(from, to, third)),
        _ => return None,
    };
    Some([[[0.0, 0.0], [width, 0.0]], [[x, y], [end, height]]].map(|strip| strip.map(|end| end.map(R::from_f64))))
}

#[test]
fn known_values_of_crossed_strings() {
    let mut count = 0;
    for case in SURFACE_CASES {
        let Some([a, b]) = planar_strips::<f64>(&case.surfaces) else { continue };
        let factor = strip_to_strip(a, b);
        assert!((factor - case.factor).abs() < 1e-12, "{}: {factor}, not {}", case.name, case.factor);
        let factor = planar_strips::<f32>(&case.surfaces).map_or(f64::NAN, |[a, b]| strip_to_strip(a, b).into());
        assert!((factor - case.factor).abs() < 1e-6, "{}: {factor}, not {}", case.name, case.factor);
        count += 1;
    }
    assert_eq!(count, 7);
}

/// Within its bound everywhere. Where sizes are small against distances their ratio squared says how good it is.
#[test]
fn known_values_of_the_point_formula() {
    let mut far = Vec::new();
    for case in SURFACE_CASES {
        let Some((a, others)) = surface_polygons(&case.surfaces) else { continue };
        let p = small_patch(&a);
        let (mut factor, mut bound, mut size) = (0.0, 0.0, 0.0_f64);
        for q in others.iter().map(|b| small_patch(b)) {
            factor += point_to_point(p.center, p.normal, q.center, q.normal, q.area);
            bound += point_to_point_error(&p, &q);
            size = size.max((p.radius + q.radius) / p.center.distance(q.center));
        }
        let error = (factor - case.factor).abs();
        assert!(error <= bound, "{}: {factor} +- {bound}, not {}", case.name, case.factor);
        if size < 0.3 {
            assert!(error < 0.5 * size * size * case.factor, "{}: {factor}, not {}", case.name, case.factor);
            far.push(case.name);
        }
    }
    assert_eq!(far, ["parallel squares at 5", "parallel squares at 10"]);
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
