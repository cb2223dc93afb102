//! Form factors from a point against known values, by every method that applies, in double and in single precision.

#[path = "reference/points.rs"]
mod points;

use glam::{DVec3, Vec3};
use points::{POINT_CASES, Point, PointCase, Target};
use radiosity::form_factor::*;
use radiosity::math::{Real, Vector};

/// All ways to one number, in one precision.
fn factors<V: Vector>(case: &PointCase) -> Vec<V::Scalar> {
    let number = V::Scalar::from_f64;
    let at = |point: Point| V::from_array(point.map(number));
    let (origin, normal) = (V::default(), at(case.normal));
    let polygon = |corners: &[Point]| {
        let corners: Vec<V> = corners.iter().map(|&corner| at(corner)).collect();
        point_to_polygon(origin, normal, &corners)
    };
    match case.target {
        Target::Polygon(corners) => vec![polygon(corners)],
        Target::ParallelRectangle { width: w, height: h, distance: d } => vec![
            point_to_parallel_rectangle(number(w), number(h), number(d)),
            polygon(&[[0.0, 0.0, d], [0.0, h, d], [w, h, d], [w, 0.0, d]]),
        ],
        Target::PerpendicularRectangle { width: w, height: h, distance: d } => vec![
            point_to_perpendicular_rectangle(number(w), number(h), number(d)),
            polygon(&[[d, 0.0, 0.0], [d, 0.0, h], [d, w, h], [d, w, 0.0]]),
        ],
        Target::Disc { center, radius } => discs::<V>(normal, center, radius),
        Target::Sphere { distance, degrees } => {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let center = at([distance * sin, 0.0, distance * cos]);
            vec![point_to_sphere(origin, normal, center, V::Scalar::ONE)]
        }
        Target::Sky { degrees } => {
            let (sin, cos) = degrees.to_radians().sin_cos();
            vec![point_to_sky(at([sin, 0.0, cos]), normal)]
        }
        Target::Strip { from, to } => strips::<V>(from, to),
        Target::SquareLessShadow => {
            let square =
                |half: f64| polygon(&[[-half, -half, 1.0], [-half, half, 1.0], [half, half, 1.0], [half, -half, 1.0]]);
            vec![square(0.5) - square(0.25)]
        }
        Target::DiscLessShadow => {
            let axis = |radius: f64| discs::<V>(normal, [0.0, 0.0, 2.0], radius);
            axis(1.0).into_iter().zip(axis(0.6)).map(|(whole, shadow)| whole - shadow).collect()
        }
    }
}

/// The general form and the one for the position of the disc.
fn discs<V: Vector>(normal: V, center: Point, radius: f64) -> Vec<V::Scalar> {
    let number = V::Scalar::from_f64;
    let down = V::from_array([0.0, 0.0, -1.0].map(number));
    let disc = Disc { center: V::from_array(center.map(number)), normal: down, radius: number(radius) };
    let (offset, distance) = (number(center[0]), number(center[2]));
    let special = if normal.dot(down) == V::Scalar::ZERO {
        point_to_perpendicular_disc(number(radius), distance, offset)
    } else {
        point_to_parallel_disc(number(radius), distance, offset)
    };
    vec![point_to_disc(V::default(), normal, &disc), special]
}

/// Crossed strings, and Lambert's form for a strip whose ends are too far to matter.
fn strips<V: Vector>(from: f64, to: f64) -> Vec<V::Scalar> {
    const FAR: f64 = 1e5;
    let number = V::Scalar::from_f64;
    let ends = [[to, 2.0], [from, 2.0]].map(|end| end.map(number));
    let origin = [V::Scalar::ZERO; 2];
    let corners = [[from, -FAR, 2.0], [from, FAR, 2.0], [to, FAR, 2.0], [to, -FAR, 2.0]];
    let polygon = corners.map(|corner| V::from_array(corner.map(number)));
    let up = V::from_array([0.0, 0.0, 1.0].map(number));
    vec![point_to_strip(origin, [V::Scalar::ZERO, V::Scalar::ONE], ends), point_to_polygon(V::default(), up, &polygon)]
}

#[test]
fn known_values() {
    for case in POINT_CASES {
        for (way, factor) in factors::<DVec3>(case).into_iter().enumerate() {
            assert!((factor - case.factor).abs() < 1e-9, "{}, way {way}: {factor}, not {}", case.name, case.factor);
        }
        for (way, factor) in factors::<Vec3>(case).into_iter().enumerate() {
            let error = (f64::from(factor) - case.factor).abs();
            assert!(error < 1e-5, "{}, way {way}: {factor}, not {}", case.name, case.factor);
        }
    }
    assert_eq!(POINT_CASES.len(), 28);
}
