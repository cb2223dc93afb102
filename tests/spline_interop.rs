//! Bevy's cubic curves become those of the core and come back, to the last bit.

use bevy::math::cubic_splines::{
    CubicBSpline, CubicBezier, CubicCardinalSpline, CubicCurve, CubicGenerator, CubicHermite, CubicNurbs,
    RationalGenerator,
};
use bevy::prelude::*;
use bevy_radiosity::convert::cubics::*;
use bevy_radiosity::prelude::SplineCurve;
use radiosity::spline::{Cubic, Hermite, OwnedBSpline, uniform_knots};

fn points(count: usize) -> Vec<Vec3> {
    let coordinate = |i: usize, k: usize| ((i * 7 + k * 13) % 17) as f32 * 0.37 - 2.1 + 0.01 * (i * k) as f32;
    (0..count).map(|i| Vec3::from_array([1, 2, 3].map(|k| coordinate(i, k)))).collect()
}

/// Both curves agree at all parameters, up to the rounding of a few sums of numbers up to about 10.
fn assert_same(name: &str, domain: f32, bevy: impl Fn(f32) -> Vec3, core: impl Fn(f32) -> Vec3) {
    for k in 0..=200 {
        let t = domain * k as f32 / 200.0;
        let (a, b) = (bevy(t), core(t));
        assert!(a.distance(b) < 2e-5, "{name} at {t}: {a} {b}");
    }
}

#[test]
fn pieces_are_copied() {
    let curve = CubicBSpline::new(points(9)).to_curve().unwrap();
    let pieces = from_curve(&curve);
    assert_eq!(to_curve(&pieces).unwrap(), curve);
    assert_eq!(pieces.len(), 6);
    for (piece, segment) in pieces.iter().zip(curve.segments()) {
        assert_eq!(from_segment(&to_segment(piece)), *piece);
        assert_same("a piece", 1.0, |t| segment.position(t), |t| piece.point(t));
        assert_same("its speed", 1.0, |t| segment.velocity(t), |t| piece.at(t).first);
        assert_same("its acceleration", 1.0, |t| segment.acceleration(t), |t| piece.at(t).second);
    }
    assert!(to_curve::<Vec3>(&[]).is_none());
    let flat = Cubic([1.0_f32, -2.0, 0.5, 3.0]);
    assert_eq!(from_segment(&to_segment(&flat)), flat);
}

#[test]
fn rational_pieces_are_copied() {
    let nurbs = CubicNurbs::new(
        points(6),
        Some([1.0, 0.7, 2.0, 0.3, 1.1, 1.0]),
        Some([0., 0., 0., 0., 0.4, 1.5, 2., 2., 2., 2.]),
    )
    .unwrap();
    let curve = nurbs.to_curve().unwrap();
    let pieces = from_rational_curve(&curve);
    assert_eq!(to_rational_curve(&pieces).unwrap(), curve);
    for ((piece, _), segment) in pieces.iter().zip(curve.segments()) {
        assert_same("a rational piece", 1.0, |t| segment.position(t), |t| piece.point(t));
    }
    let core = from_nurbs(&nurbs).unwrap();
    let back = to_nurbs(&core).unwrap();
    assert_eq!((&back.control_points, &back.weights), (&nurbs.control_points, &nurbs.weights));
    assert_eq!(back.knots, nurbs.knots);
    assert_eq!(from_nurbs(&back).unwrap(), core);
    let component = SplineCurve::from(&nurbs).nurbs().unwrap();
    let length = curve.length();
    assert_same("NURBS", length, |t| curve.position(t), |t| core.curve().point(t));
    assert_same("a component", length, |t| curve.position(t), |t| component.curve().point(t));
}

#[test]
fn bezier_curves() {
    let bevy = CubicBezier::new(points(12).as_chunks::<4>().0.to_vec());
    let core = from_bezier(&bevy).unwrap();
    assert_eq!(to_bezier(&core).unwrap().control_points, bevy.control_points);
    let curve = bevy.to_curve().unwrap();
    assert_same("Bezier", 0.999, |t| curve.position(t), |t| core[0].curve().point(t));
    // They do not meet, and so does not the component.
    let component = SplineCurve::from(&curve);
    assert_eq!(component.points.len(), 12);
    let nurbs = component.nurbs().unwrap();
    assert_same("torn Bezier", 2.999, |t| curve.position(t), |t| nurbs.curve().point(t));
}

#[test]
fn hermite_and_cardinal_splines() {
    let (places, tangents) = (points(7), points(14).split_off(7));
    let bevy = to_hermite(&places, &tangents);
    assert_eq!(from_hermite(&bevy), (places.clone(), tangents.clone()));
    let times: Vec<f32> = (0..7).map(|i| i as f32).collect();
    let agrees = |name: &str, curve: CubicCurve<Vec3>, tangents: &[Vec3]| {
        let core = Hermite::new(&times, &places, tangents).unwrap();
        assert_same(name, 6.0, |t| curve.position(t), |t| core.point(t));
    };
    agrees("Hermite", CubicHermite::to_curve(&bevy).unwrap(), &tangents);

    for tension in [0.5, 0.2, 1.0] {
        let bevy = CubicCardinalSpline::new(tension, places.clone());
        let (same, tangents) = from_cardinal(&bevy).unwrap();
        let back = to_cardinal(&same, 1.0 - 2.0 * tension);
        assert_eq!(back.control_points, bevy.control_points);
        assert!((back.tension - tension).abs() <= f32::EPSILON);
        agrees("cardinal", bevy.to_curve().unwrap(), &tangents);
    }
}

#[test]
fn b_splines() {
    let bevy = CubicBSpline::new(points(9));
    let core = from_b_spline(&bevy).unwrap();
    assert_eq!(to_b_spline(&core).unwrap().control_points, bevy.control_points);
    let curve = bevy.to_curve().unwrap();
    assert_same("B-spline", 6.0, |t| curve.position(t), |t| core.curve().point(t));
    let component = SplineCurve::from(&curve);
    assert_eq!(component.points.len(), 19, "pieces that meet share a point");
    let nurbs = component.nurbs().unwrap();
    assert_same("a component", 6.0, |t| curve.position(t), |t| nurbs.curve().point(t));
    assert!(to_b_spline(&core.inserted(2.5).unwrap()).is_none());
    // Distances of many knots differ by more than their share of rounding.
    for count in [200, 1000, 5000] {
        let mut knots = vec![0.0; count + 4];
        uniform_knots(&mut knots, 3);
        let many = OwnedBSpline::new(knots.clone(), 3, points(count)).unwrap();
        assert_eq!(to_b_spline(&many).unwrap().control_points, points(count));
        knots[count / 2] += 0.01 * (knots[1] - knots[0]);
        assert!(to_b_spline(&OwnedBSpline::new(knots, 3, points(count)).unwrap()).is_none());
    }
    assert!(from_b_spline(&CubicBSpline::new(points(3))).is_err());
}
