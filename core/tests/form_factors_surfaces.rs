//! Form factors between surfaces against known values, by every method that applies, in double and in single precision.

#[path = "reference/surfaces.rs"]
mod surfaces;

use glam::{DVec3, Vec3};
use radiosity::form_factor::*;
use radiosity::math::{Real, Vector};
use surfaces::{SURFACE_CASES, Surfaces};

/// The closed form.
fn closed<R: Real>(surfaces: &Surfaces) -> R {
    let number = R::from_f64;
    let bounds = |[x, y]: [[f64; 2]; 2]| Bounds { x: x.map(number), y: y.map(number) };
    match *surfaces {
        Surfaces::ParallelRectangles { width, height, distance } => {
            parallel_rectangles(number(width), number(height), number(distance))
        }
        Surfaces::ParallelOffset { a, b, distance } => {
            parallel_rectangles_offset(bounds(a), bounds(b), number(distance))
        }
        Surfaces::PerpendicularRectangles { length, width, height } => {
            perpendicular_rectangles(number(length), number(width), number(height))
        }
        Surfaces::PerpendicularOffset { a, b } => perpendicular_rectangles_offset(bounds(a), bounds(b)),
        Surfaces::TiltedSquares { degrees } => tilted_rectangles(R::ONE, R::ONE, R::ONE, number(degrees.to_radians())),
        Surfaces::CoaxialDiscs { from, to, distance } => coaxial_discs(number(from), number(to), number(distance)),
        Surfaces::SphereToDisc { radius, distance } => sphere_to_disc(number(radius), number(distance)),
        Surfaces::SphereToRectangle { width, height, distance } => {
            sphere_to_rectangle(number(width), number(height), number(distance))
        }
        Surfaces::SphereToCubeFace => number(4.0) * sphere_to_rectangle(number(0.5), number(0.5), number(0.5)),
        Surfaces::CubeFaceToSphere { radius } => {
            let back = number(4.0) * sphere_to_rectangle(number(0.5), number(0.5), number(0.5));
            back * number(4.0 * std::f64::consts::PI * radius * radius)
        }
        Surfaces::OuterSphereToInner { inner, outer } => outer_sphere_to_inner(number(inner), number(outer)),
        Surfaces::TwoSpheres { from, to, distance } => sphere_to_sphere(number(from), number(to), number(distance)),
        Surfaces::CoaxialCylinders { inner, outer, height } => {
            inner_cylinder_to_outer(number(inner), number(outer), number(height))
        }
        Surfaces::CylinderSideToItself { radius, height } => cylinder_side_to_itself(number(radius), number(height)),
        Surfaces::CylinderBaseToSide { radius, height } => cylinder_base_to_side(number(radius), number(height)),
        Surfaces::Hemisphere => inside_sphere(number(2.0) * R::PI, R::ONE),
        Surfaces::ParallelStrips { width, distance } => parallel_strips(number(width), number(distance)),
        Surfaces::StripsAtAnAngle { degrees } => strips_at_an_angle(R::ONE, R::ONE, number(degrees.to_radians())),
        Surfaces::TriangularDuct { from, to, third } => {
            let cos = (from * from + to * to - third * third) / (2.0 * from * to);
            strips_at_an_angle(number(from), number(to), number(cos.acos()))
        }
        Surfaces::BoxRow { width, height, depth } => {
            let two = number(2.0);
            let (width, height, depth) = (number(width), number(height), number(depth));
            parallel_rectangles(width, height, depth)
                + two * perpendicular_rectangles(width, height, depth)
                + two * perpendicular_rectangles(height, width, depth)
        }
        Surfaces::Tetrahedron => R::ONE / number(3.0),
    }
}

type Corners = Vec<DVec3>;

fn rectangle(corner: [f64; 3], u: [f64; 3], v: [f64; 3]) -> Corners {
    let [corner, u, v] = [corner, u, v].map(DVec3::from_array);
    vec![corner, corner + u, corner + u + v, corner + v]
}

/// The sender and all receivers, where they are polygons.
fn polygons(surfaces: &Surfaces) -> Option<(Corners, Vec<Corners>)> {
    let floor = |[x, y]: [[f64; 2]; 2]| rectangle([x[0], y[0], 0.0], [x[1] - x[0], 0.0, 0.0], [0.0, y[1] - y[0], 0.0]);
    let roof =
        |[x, y]: [[f64; 2]; 2], z: f64| rectangle([x[0], y[0], z], [0.0, y[1] - y[0], 0.0], [x[1] - x[0], 0.0, 0.0]);
    let wall = |[z, y]: [[f64; 2]; 2]| rectangle([0.0, y[0], z[0]], [0.0, y[1] - y[0], 0.0], [0.0, 0.0, z[1] - z[0]]);
    Some(match *surfaces {
        Surfaces::ParallelRectangles { width, height, distance } => {
            let bounds = [[0.0, width], [0.0, height]];
            (floor(bounds), vec![roof(bounds, distance)])
        }
        Surfaces::ParallelOffset { a, b, distance } => (floor(a), vec![roof(b, distance)]),
        Surfaces::PerpendicularRectangles { length, width, height } => {
            (floor([[0.0, width], [0.0, length]]), vec![wall([[0.0, height], [0.0, length]])])
        }
        Surfaces::PerpendicularOffset { a, b } => (floor(a), vec![wall(b)]),
        Surfaces::TiltedSquares { degrees } => {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let square = [[0.0, 1.0], [0.0, 1.0]];
            (floor(square), vec![rectangle([0.0; 3], [0.0, 1.0, 0.0], [cos, 0.0, sin])])
        }
        Surfaces::BoxRow { width: w, height: h, depth: d } => {
            let walls = vec![
                roof([[0.0, w], [0.0, h]], d),
                rectangle([0.0; 3], [0.0, h, 0.0], [0.0, 0.0, d]),
                rectangle([w, 0.0, 0.0], [0.0, 0.0, d], [0.0, h, 0.0]),
                rectangle([0.0; 3], [0.0, 0.0, d], [w, 0.0, 0.0]),
                rectangle([0.0, h, 0.0], [w, 0.0, 0.0], [0.0, 0.0, d]),
            ];
            (floor([[0.0, w], [0.0, h]]), walls)
        }
        Surfaces::Tetrahedron => {
            let [a, b, c, d] =
                [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(DVec3::from_array);
            (vec![a, c, b], vec![vec![a, b, d]])
        }
        _ => return None,
    })
}

fn single(corners: &Corners) -> Vec<Vec3> {
    corners.iter().map(|corner| corner.as_vec3()).collect()
}

#[test]
fn known_values_of_closed_forms() {
    for case in SURFACE_CASES {
        let factor: f64 = closed(&case.surfaces);
        assert!((factor - case.factor).abs() < 1e-9, "{}: {factor}, not {}", case.name, case.factor);
        let factor: f32 = closed(&case.surfaces);
        assert!((f64::from(factor) - case.factor).abs() < 1e-5, "{}: {factor}, not {}", case.name, case.factor);
    }
    assert_eq!(SURFACE_CASES.len(), 50);
}

#[test]
fn known_values_of_contour_integrals() {
    for case in SURFACE_CASES {
        let Some((a, others)) = polygons(&case.surfaces) else { continue };
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
        let Some((a, others)) = polygons(&case.surfaces) else { continue };
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
