//! Circles, conics, curves through points, and what is measured along curves.
#![cfg(feature = "alloc")]

#[path = "common/splines.rs"]
#[expect(dead_code, reason = "knots are for other tests")]
mod splines;

use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};
use std::time::{Duration, Instant};

use glam::{DVec2, DVec3, Vec2, Vec3};
use radiosity::math::Real;
use radiosity::spline::*;
use splines::Random;

const CIRCLE: Circle<DVec2> = Circle { center: DVec2::ZERO, x: DVec2::X, y: DVec2::Y };

fn parameters(count: usize) -> impl Iterator<Item = f64> {
    (0..=count).map(move |i| i as f64 / count as f64)
}

/// All forms of the circle are round to 4 units in the last place, in both precisions.
#[test]
fn circles_are_round_to_rounding() {
    round::<DVec2>();
    round::<Vec2>();
}

fn round<V: ControlPoint<Point = V>>()
where
    V::Scalar: std::iter::Sum,
{
    let number = V::Scalar::from_f64;
    let axis = |axis| V::from_fn(|i| number(if i == axis { 1.0 } else { 0.0 }));
    let circle = Circle { center: V::default(), x: axis(0), y: axis(1) };
    let knots = CIRCLE_KNOTS.map(number);
    let points = circle.nurbs();
    let nurbs = Nurbs::new(KnotVector::new(&knots, 2).unwrap(), &points).unwrap();
    let third = circle.arc(number(0.3), number(0.3 + TAU / 3.0));
    let third = RationalBezier::new(&third).unwrap();
    let limit = V::Scalar::EPSILON * number(4.0);
    for t in parameters(1000) {
        let forms = [
            circle.explicit(number(2.0 * t - 1.0)),
            circle.parametric(number(TAU * t)),
            circle.rational(number(2.0 * t - 1.0)),
            nurbs.point(number(t)),
            third.point(number(t)),
        ];
        for (form, point) in forms.into_iter().enumerate() {
            let error = (point.length() - V::Scalar::ONE).abs();
            assert!(error <= limit, "form {form} at {t}: off by {error:?}");
            assert!(circle.implicit(point).abs() <= limit + limit);
        }
    }
}

/// `t = tan(alpha / 2)` names the point at `alpha`.
#[test]
fn forms_of_the_circle_name_the_same_points() {
    for alpha in parameters(50).map(|t| (t - 0.5) * 6.0) {
        let point = CIRCLE.parametric(alpha);
        assert!((CIRCLE.rational((alpha / 2.0).tan()) - point).length() < 1e-14);
        assert!((CIRCLE.explicit(point.x) - DVec2::new(point.x, point.y.abs())).length() < 1e-7);
        assert!((CIRCLE.at(alpha).curvature() - 1.0).abs() < 1e-14);
    }
    assert!(CIRCLE.implicit(DVec2::splat(0.5)) < 0.0 && CIRCLE.implicit(DVec2::ONE) > 0.0);
    let points = CIRCLE.nurbs();
    let nurbs = Nurbs::new(KnotVector::new(&CIRCLE_KNOTS, 2).unwrap(), &points).unwrap();
    for quarter in 0..=8 {
        let t = f64::from(quarter) / 8.0;
        assert!((nurbs.point(t) - CIRCLE.parametric(TAU * t)).length() < 1e-15);
    }
}

#[test]
fn arcs_in_a_row_are_an_arc() {
    let circle =
        Circle { center: DVec3::new(1.0, 2.0, 3.0), x: DVec3::new(2.0, 0.0, 0.0), y: DVec3::new(0.0, 0.0, 2.0) };
    let mut points = [Homogeneous::default(); 7];
    circle.arcs([0.5, 5.5], &mut points).unwrap();
    let mut knots = [0.0; 10];
    bezier_knots(&[0.0, 1.0, 2.0, 3.0], 2, &mut knots).unwrap();
    let arc = Nurbs::new(KnotVector::new(&knots, 2).unwrap(), &points).unwrap();
    assert!((arc.point(0.0) - circle.parametric(0.5)).length() < 1e-14);
    assert!((arc.point(3.0) - circle.parametric(5.5)).length() < 1e-14);
    for t in parameters(60) {
        assert!(((arc.point(3.0 * t) - circle.center).length() - 2.0).abs() < 1e-14);
    }
    assert!((arc_length(&arc, [0.0, 3.0], 1e-12) - 10.0).abs() < 1e-11);
    assert!(circle.arcs([0.0, 1.0], &mut [Homogeneous::default(); 4]).is_err());
}

/// A conic with sharpness 1/2 is a parabola, below it an ellipse, above it a hyperbola.
#[test]
fn conics_are_what_their_weights_say() {
    let corner = [DVec2::X, DVec2::ONE, DVec2::Y];
    for (sharpness, kind) in [(0.3, Conic::Ellipse), (0.5, Conic::Parabola), (0.7, Conic::Hyperbola)] {
        let points = conic(corner, sharpness);
        assert_eq!(Conic::of(points.map(|point| point.weight)), kind);
        let middle = RationalBezier::new(&points).unwrap().point(0.5);
        assert!((middle - DVec2::splat(0.5 + 0.5 * sharpness)).length() < 1e-15);
    }
    // The arc of a quarter turn is such an ellipse.
    let points = conic(corner, FRAC_1_SQRT_2 / (1.0 + FRAC_1_SQRT_2));
    let arc = RationalBezier::new(&points).unwrap();
    assert!(parameters(20).all(|t| (arc.point(t).length() - 1.0).abs() < 1e-15));
    let parabola = conic([DVec2::new(-1.0, 1.0), DVec2::new(0.0, -1.0), DVec2::ONE], 0.5);
    let parabola = RationalBezier::new(&parabola).unwrap();
    assert!(parameters(20).map(|t| parabola.point(t)).all(|p| (p.y - p.x * p.x).abs() < 1e-15));
}

/// Exact both ways: powers, Bezier, Hermite, B-spline.
#[test]
fn cubics_are_converted_there_and_back() {
    let mut random = Random(21);
    for _ in 0..50 {
        let points: [DVec3; 4] = std::array::from_fn(|_| random.point());
        let cubic = Cubic::from_bezier(points);
        let [ends, tangents] = cubic.to_hermite();
        assert_eq!(ends[0], points[0]);
        let close = |a: [DVec3; 4], b: [DVec3; 4]| a.iter().zip(b).all(|(a, b)| (*a - b).length() < 1e-14);
        assert!(close(cubic.to_bezier(), points));
        assert!(close(Cubic::from_hermite(ends, tangents).to_bezier(), points));
        assert!(close(Cubic::from_bspline(points).to_bspline(), points));
        assert!((tangents[0] - 3.0 * (points[1] - points[0])).length() < 1e-14);
        let uniform = [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0, 4.0];
        let spline = BSpline::new(KnotVector::new(&uniform, 3).unwrap(), &points).unwrap();
        let mut pieces = [DVec3::ZERO; 4];
        spline.bezier(3, &mut pieces).unwrap();
        assert!(close(Cubic::from_bspline(points).to_bezier(), pieces));
        for t in parameters(10) {
            let [a, b] = [Cubic::from_bspline(points).at(t), spline.at(t)];
            assert!((a.point - b.point).length() + (a.first - b.first).length() < 1e-14);
            assert!((a.second - b.second).length() < 1e-13);
            assert!((cubic.point(t) - Bezier::new(&points).unwrap().point(t)).length() < 1e-14);
        }
    }
}

/// A C2 curve through points of a cubic is the cubic, if its ends know of it; tangents and curvatures agree everywhere.
#[test]
fn c2_curves_reproduce_cubics_and_are_smooth() {
    let times = [0.0, 0.7, 1.0, 2.2, 3.0, 3.1];
    let cubic = |t: f64| DVec2::new(1.0 + t - t * t * t, 2.0 * t * t + 0.1 * t * t * t);
    let slope = |t: f64| DVec2::new(1.0 - 3.0 * t * t, 4.0 * t + 0.3 * t * t);
    let points = times.map(cubic);
    let (mut tangents, mut scratch) = ([DVec2::ZERO; 6], [0.0; 12]);
    for ends in [EndCondition::NotAKnot, EndCondition::Clamped([slope(0.0), slope(3.1)])] {
        c2_tangents(&times, &points, ends, &mut scratch, &mut tangents).unwrap();
        for (tangent, t) in tangents.iter().zip(times) {
            assert!((*tangent - slope(t)).length() < 1e-12, "{tangent} {}", slope(t));
        }
    }
    let mut random = Random(22);
    let mut points: Vec<DVec2> = (0..6).map(|_| random.point().truncate()).collect();
    for ends in [EndCondition::Natural, EndCondition::Periodic] {
        points[5] = if ends == EndCondition::Periodic { points[0] } else { points[5] };
        c2_tangents(&times, &points, ends, &mut scratch, &mut tangents).unwrap();
        let curve = Hermite::new(&times, &points, &tangents).unwrap();
        let bend = |piece: usize, at: f64| {
            let duration = times[piece + 1] - times[piece];
            curve.piece(piece).at(at).second / (duration * duration)
        };
        assert!((1..5).all(|i| (bend(i - 1, 1.0) - bend(i, 0.0)).length() < 1e-11));
        let (start, end) = (bend(0, 0.0), bend(4, 1.0));
        if ends == EndCondition::Natural {
            assert!(start.length() + end.length() < 1e-11);
        } else {
            assert!((start - end).length() < 1e-11 && tangents[0] == tangents[5]);
        }
    }
    let two = EndCondition::Clamped([DVec2::X, DVec2::Y]);
    c2_tangents(&[0.0, 1.0], &[DVec2::ZERO, DVec2::ONE], two, &mut [0.0; 4], &mut tangents[..2]).unwrap();
    assert_eq!(tangents[..2], [DVec2::X, DVec2::Y]);
}

#[test]
fn tangent_rules_agree_where_they_must() {
    let mut random = Random(23);
    let points = random.points(7);
    let (mut cardinal, mut rom, mut kochanek) = ([DVec3::ZERO; 7], [DVec3::ZERO; 7], [[DVec3::ZERO; 7]; 2]);
    let mut times = [0.0; 7];
    chord_times(&points, 0.0, &mut times).unwrap();
    assert_eq!(times, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    cardinal_tangents(&points, 0.0, &mut cardinal).unwrap();
    catmull_rom_tangents(&times, &points, &mut rom).unwrap();
    let [arriving, leaving] = &mut kochanek;
    kochanek_bartels_tangents(&points, &[KochanekBartels::default(); 7], [arriving, leaving]).unwrap();
    for i in 1..6 {
        assert!(
            (cardinal[i] - rom[i]).length() < 1e-14
                && (cardinal[i] - (points[i + 1] - points[i - 1]) / 2.0).length() < 1e-15
        );
        assert!((cardinal[i] - kochanek[0][i]).length() + (cardinal[i] - kochanek[1][i]).length() < 1e-14);
    }
    // Discontinuous tangents make corners, tension 1 stops.
    let corner = KochanekBartels { continuity: 0.5, ..Default::default() };
    let [arriving, leaving] = &mut kochanek;
    kochanek_bartels_tangents(&points, &[corner; 7], [arriving, leaving]).unwrap();
    assert!((kochanek[0][3] - kochanek[1][3]).length() > 1e-3);
    let curve = Hermite::with_corners(&times, &points, [&kochanek[0], &kochanek[1]]).unwrap();
    assert!((0..7).all(|i| (curve.point(i as f64) - points[i]).length() < 1e-14));
    cardinal_tangents(&points, 1.0, &mut cardinal).unwrap();
    assert!(cardinal.iter().all(|tangent| *tangent == DVec3::ZERO));
}

/// The centripetal Catmull-Rom spline is the pyramid of Barry and Goldman.
#[test]
fn centripetal_catmull_rom() {
    let points = [DVec2::ZERO, DVec2::new(1.0, 2.0), DVec2::new(1.2, 2.0), DVec2::new(4.0, 0.0)];
    let (mut times, mut tangents) = ([0.0; 4], [DVec2::ZERO; 4]);
    chord_times(&points, 0.5, &mut times).unwrap();
    assert!((times[2] - times[1] - 0.2_f64.sqrt()).abs() < 1e-14);
    catmull_rom_tangents(&times, &points, &mut tangents).unwrap();
    let curve = Hermite::new(&times, &points, &tangents).unwrap();
    for share in parameters(20) {
        let t = times[1] + (times[2] - times[1]) * share;
        let mix = |a: DVec2, b: DVec2, from: usize, to: usize| a.lerp(b, (t - times[from]) / (times[to] - times[from]));
        let first: [DVec2; 3] = std::array::from_fn(|i| mix(points[i], points[i + 1], i, i + 1));
        let second: [DVec2; 2] = std::array::from_fn(|i| mix(first[i], first[i + 1], i, i + 2));
        assert!((curve.point(t) - mix(second[0], second[1], 1, 2)).length() < 1e-14);
    }
    chord_times(&[DVec2::ONE; 3], 0.5, &mut times[..3]).unwrap();
    assert!(times[0] < times[1] && times[1] < times[2]);
}

#[test]
fn curves_through_points_and_near_to_them() {
    let mut random = Random(24);
    for degree in 1..=7 {
        let points = random.points(degree + 8);
        let through = OwnedBSpline::through(&points, degree).unwrap();
        let mut times = vec![0.0; points.len()];
        chord_times(&points, 1.0, &mut times).unwrap();
        for (t, point) in times.iter().zip(&points) {
            assert!((through.curve().point(*t) - *point).length() < 1e-9, "degree {degree}");
        }
        // Many points of a spline give the spline back.
        let knots = through.curve().knots();
        let [start, end] = knots.domain();
        let many: Vec<f64> = parameters(300).map(|t| start + (end - start) * t).collect();
        let samples: Vec<DVec3> = many.iter().map(|&t| through.curve().point(t)).collect();
        let (near, distance) = OwnedBSpline::near(knots.knots().to_vec(), degree, &many, &samples).unwrap();
        assert!(distance < 1e-13, "degree {degree}: {distance:e}");
        let apart = near.curve().points().iter().zip(through.curve().points()).map(|(a, b)| (*a - *b).length());
        assert!(apart.fold(0.0, f64::max) < 1e-9, "degree {degree}");
    }
    let knots = vec![0.0, 0.0, 0.5, 1.0, 1.0];
    let few = OwnedBSpline::near(knots, 1, &[0.0, 0.1, 0.2], &[DVec3::ONE; 3]).unwrap_err();
    assert_eq!(few, SplineError::Singular { index: 2 });
}

/// Points at what is no parameter of the curve are refused, the rounding of one is not.
#[test]
fn parameters_of_points_lie_in_the_domain() {
    let knots = [1.0, 1.0, 2.0, 3.0, 3.0];
    let vector = KnotVector::new(&knots, 1).unwrap();
    let (points, mut scratch, mut found) = ([0.0, 5.0, 2.0], [0.0; 9], [0.0; 3]);
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.9, 3.1] {
        let parameters = [1.0, wrong, 3.0];
        let interpolated = interpolate(vector, &parameters, &points, &mut scratch, &mut found);
        let fitted = fit(vector, &parameters, &points, &mut scratch, &mut found);
        for error in [interpolated.unwrap_err(), fitted.unwrap_err()] {
            let SplineError::Parameter { parameter, domain: [1.0, 3.0] } = error else { panic!("{error}") };
            assert_eq!(parameter.to_bits(), wrong.to_bits());
        }
    }
    let rounded = [1.0 - f64::EPSILON, 2.0, 3.0 + 2.0 * f64::EPSILON];
    interpolate(vector, &rounded, &points, &mut scratch, &mut found).unwrap();
    assert_eq!(found, points);
    assert!(fit(vector, &rounded, &points, &mut scratch, &mut found).unwrap() < 1e-15);
}

/// A degree is refused before anything is counted with it.
#[test]
fn degrees_beyond_all_bounds() {
    let points = vec![DVec3::X, DVec3::Y, DVec3::Z];
    for degree in [MAX_DEGREE + 1, usize::MAX / 4, usize::MAX] {
        let error = SplineError::Degree { degree };
        assert_eq!(KnotVector::new(&[0.0, 1.0], degree), Err(error));
        assert_eq!(averaged_knots(&[0.0, 1.0], degree, &mut [0.0; 4]), Err(error));
        assert_eq!(OwnedBSpline::from_beziers(&[0.0, 1.0], degree, points.clone()), Err(error));
        assert_eq!(OwnedBSpline::through(&points, degree), Err(error));
        assert_eq!(OwnedSurface::through(&points, 3, [degree, 1]), Err(error));
        let curve = BSpline::new(KnotVector::bezier(2).unwrap(), &points).unwrap();
        assert_eq!(loft(&[curve, curve], degree), Err(error));
        clamped_knots(&mut [0.0; 4], degree);
        uniform_knots(&mut [0.0; 4], degree);
    }
}

/// Control points that are all the same are measured at once, where halves of halves would take a second for each.
#[test]
fn a_curve_without_length_takes_no_time() {
    let start = Instant::now();
    for x in (0..20).map(f64::from) {
        for tolerance in [0.0, 1e-300, 1e-9] {
            assert_eq!(arc_length(&Cubic::from_bezier([DVec3::splat(x); 4]), [0.0, 1.0], tolerance), 0.0);
            assert_eq!(arc_length(&Bezier::new(&[DVec2::splat(x); 4]).unwrap(), [0.0, 1.0], tolerance), 0.0);
            assert_eq!(arc_length(&Bezier::new(&[DVec2::splat(x); 6]).unwrap(), [0.0, 1.0], tolerance), 0.0);
        }
    }
    assert!(start.elapsed() < Duration::from_secs(5));
}

/// A distance and its negative lead there and back.
#[test]
fn parameters_at_negative_distances() {
    assert!((parameter_at(&CIRCLE, PI, -1.0, 1e-12) - (PI - 1.0)).abs() < 1e-11);
    assert_eq!(parameter_at(&CIRCLE, 1.0, -1.5, 1e-12), 0.0);
    assert_eq!(parameter_at(&CIRCLE, 1.0, f64::NEG_INFINITY, 1e-12), 0.0);
    let mut random = Random(28);
    let owned = OwnedBSpline::through(&random.points(9), 3).unwrap();
    let curve = owned.curve();
    let [start, end] = curve.knots().domain();
    for _ in 0..40 {
        let [from, to] = [random.between(start, end), random.between(start, end)];
        let distance = arc_length(&curve, [from, to], 1e-12);
        assert!((parameter_at(&curve, from, distance, 1e-11) - to).abs() < 1e-8, "from {from} to {to}");
    }
}

/// Closed forms: the circle, a parabola, a line; and the inverse.
#[test]
fn arc_lengths() {
    let whole = arc_length(&CIRCLE, [0.0, TAU], 1e-12);
    assert!((whole - TAU).abs() < 1e-12);
    assert_eq!(arc_length(&CIRCLE, [TAU, 0.0], 1e-12), -whole);
    let parabola = [DVec2::new(-1.0, 1.0), DVec2::new(0.0, -1.0), DVec2::ONE];
    let parabola = Bezier::new(&parabola).unwrap();
    let exact = 5.0_f64.sqrt() + 0.5 * 2.0_f64.asinh();
    for tolerance in [1e-3, 1e-6, 1e-12] {
        let length = arc_length(&parabola, [0.0, 1.0], tolerance);
        assert!((length - exact).abs() < tolerance, "{tolerance}: {}", length - exact);
    }
    // A cusp in the middle: (x^2)^(3/2) = |x|^3; its speed is |t| sqrt(4 + 9 t^2).
    let cusp = [DVec2::new(1.0, -1.0), DVec2::new(-1.0 / 3.0, 1.0), DVec2::new(-1.0 / 3.0, -1.0), DVec2::new(1.0, 1.0)];
    let cusp = Bezier::new(&cusp).unwrap();
    let exact = 2.0 * (13.0_f64.powf(1.5) - 8.0) / 27.0;
    assert!((arc_length(&cusp, [0.0, 1.0], 1e-9) - exact).abs() < 1e-9);
    let points = [DVec2::ZERO, DVec2::new(1.0, 2.0), DVec2::new(3.0, 0.0)];
    let rounded = points.map(|point| point.as_vec2());
    let (single, double) = (Bezier::new(&rounded).unwrap(), Bezier::new(&points).unwrap());
    let [a, b] = [f64::from(arc_length(&single, [0.0, 1.0], 1e-6)), arc_length(&double, [0.0, 1.0], 1e-6)];
    assert!((a - b).abs() < 1e-5);
    let mut random = Random(27);
    for points in (0..300).map(|_| [random.point(), random.point(), random.point(), random.point()]) {
        let curve = Bezier::new(&points).unwrap();
        let exact = arc_length(&curve, [0.0, 1.0], 1e-14);
        for tolerance in [1e-3, 1e-6, 1e-9] {
            assert!((arc_length(&curve, [0.0, 1.0], tolerance) - exact).abs() < tolerance);
            assert!((arc_length(&Cubic::from_bezier(points), [0.0, 1.0], tolerance) - exact).abs() < tolerance);
        }
    }
    for share in parameters(10) {
        let t = parameter_at(&parabola, 0.0, whole * 0.2 * share, 1e-10);
        assert!((arc_length(&parabola, [0.0, t], 1e-12) - whole * 0.2 * share).abs() < 1e-9);
    }
    assert_eq!(parameter_at(&parabola, 0.0, 1e9, 1e-9), 1.0);
    let _ = arc_length(&parabola, [f64::NAN, 1.0], 1e-9);
    let _ = arc_length(&parabola, [0.0, f64::NAN], f64::NAN);
}

#[test]
fn travel_has_speed_one() {
    let mut random = Random(25);
    for degree in 2..=6 {
        let owned = OwnedBSpline::through(&random.points(9), degree).unwrap();
        let travel = Travel::<_, 32>::new(owned.curve(), 1e-9);
        let whole = arc_length(&owned.curve(), owned.curve().knots().domain(), 1e-10);
        assert!((travel.length() - whole).abs() < 1e-8);
        for share in parameters(40) {
            let distance = share * travel.length();
            let t = travel.parameter(distance);
            let start = owned.curve().knots().domain()[0];
            assert!((arc_length(&owned.curve(), [start, t], 1e-10) - distance).abs() < 1e-8);
            let jet = travel.at(distance);
            assert!((jet.first.length() - 1.0).abs() < 1e-12 && jet.first.dot(jet.second).abs() < 1e-9);
        }
        assert_eq!(travel.parameter(-1.0), owned.curve().knots().domain()[0]);
        assert_eq!(travel.parameter(1e9), owned.curve().knots().domain()[1]);
    }
    let around = Travel::<_, 8>::new(CIRCLE, 1e-12);
    assert!((around.at(PI).point + DVec2::X).length() < 1e-11);
    assert!((around.at(PI).second - DVec2::X).length() < 1e-11);
    assert!((Travel::<_, 2>::new(CIRCLE, 1e-12).length() - TAU).abs() < 1e-11);
}

/// Not farther than any of many samples, and at right angles to the curve or at an end.
#[test]
fn nearest_points() {
    let mut random = Random(26);
    for degree in 1..=9 {
        let points = random.points(degree + 1);
        let weighted: Vec<_> = points.iter().map(|&p| Homogeneous::new(p, random.between(0.4, 2.5))).collect();
        let (plain, rational) = (Bezier::new(&points).unwrap(), Bezier::new(&weighted).unwrap());
        let owned = OwnedBSpline::through(&random.points(degree + 5), degree).unwrap();
        for _ in 0..10 {
            let to = random.point() * 1.5;
            check_nearest(&plain, plain.nearest(to), to);
            check_nearest(&rational, rational.nearest(to), to);
            check_nearest(&owned.curve(), owned.curve().nearest(to), to);
        }
    }
    let points = CIRCLE.nurbs();
    let circle = Nurbs::new(KnotVector::new(&CIRCLE_KNOTS, 2).unwrap(), &points).unwrap();
    assert!((circle.nearest(DVec2::ZERO).distance - 1.0).abs() < 1e-14);
    assert!((circle.nearest(DVec2::new(3.0, -4.0)).point - DVec2::new(0.6, -0.8)).length() < 1e-8);
}

/// Cubics of all kinds: straight ones, loops, cusps, single points, seen from near, far and from themselves.
#[test]
fn nearest_points_of_cubics() {
    let mut random = Random(27);
    let x = DVec3::X;
    for case in 0..200 {
        let p = random.points(4);
        let points = match case % 8 {
            0 => [0.0, 1.0, 2.0, 3.0].map(|i| p[0] + x * i),
            1 => [0.0, 3.0, -2.0, 1.0].map(|i| p[0] + x * i),
            2 => [p[0]; 4],
            3 => [p[0], p[0], p[1], p[1]],
            4 => [p[0], p[1], p[1], p[0]],
            5 => [DVec3::ZERO, x + DVec3::Y, DVec3::Y, x],
            _ => [p[0], p[1], p[2], p[3]],
        };
        let curve = Bezier::new(&points).unwrap();
        for to in [random.point(), random.point() * 100.0, curve.point(random.unit()), points[0], points[3]] {
            check_nearest(&curve, curve.nearest(to), to);
        }
    }
    let curve = [DVec2::ZERO, DVec2::Y, DVec2::ONE, DVec2::X];
    assert_eq!(Bezier::new(&curve).unwrap().nearest(DVec2::new(0.5, 9.0)).parameter, 0.5);
    assert!(!Bezier::new(&curve).unwrap().nearest(DVec2::NAN).distance.is_finite());
}

fn check_nearest(curve: &impl Curve<Point = DVec3>, nearest: Nearest<DVec3>, to: DVec3) {
    let [start, end] = curve.domain();
    assert!((curve.point(nearest.parameter) - nearest.point).length() < 1e-12);
    assert!(((nearest.point - to).length() - nearest.distance).abs() < 1e-14 * (1.0 + nearest.distance));
    let sampled = parameters(2000).map(|t| (curve.point(start + (end - start) * t) - to).length());
    let best = sampled.fold(f64::MAX, f64::min);
    assert!(nearest.distance <= best * (1.0 + 1e-12) + 1e-14, "{} {best}", nearest.distance);
}

/// In a plane, frames do not turn; on a helix, the angle is the torsion times the length.
#[test]
fn frames_turn_no_more_than_they_must() {
    let t: Vec<f64> = parameters(200).map(|t| TAU * t).collect();
    let ring = Circle { center: DVec3::ZERO, x: DVec3::X, y: DVec3::Y };
    let mut frames = vec![Frame::default(); t.len()];
    rotation_minimizing_frames(&ring, DVec3::Z, &t, &mut frames);
    assert!(frames.iter().all(|frame| (frame.normal - DVec3::Z).length() < 1e-13));
    rotation_minimizing_frames(&Helix, DVec3::NEG_X, &t, &mut frames);
    for (frame, &t) in frames.iter().zip(&t) {
        assert!((frame.tangent.cross(frame.normal) - frame.binormal).length() < 1e-14);
        assert!(frame.tangent.dot(frame.normal).abs() < 1e-14 && (frame.normal.length() - 1.0).abs() < 1e-14);
        // Torsion b / (a^2 + b^2), speed sqrt(a^2 + b^2).
        let angle = -t * Helix::RISE / (1.0 + Helix::RISE * Helix::RISE).sqrt();
        let expected = Frame::frenet(&Helix.at(t)).turned(angle);
        assert!((frame.normal - expected.normal).length() < 1e-6, "{t}: {} {}", frame.normal, expected.normal);
    }
    // A closed space curve needs its frames turned back.
    let points = [DVec3::ZERO, DVec3::X, DVec3::ONE, DVec3::new(-1.0, 1.0, 2.0), DVec3::NEG_X, DVec3::ZERO];
    let knot = Bezier::new(&points).unwrap();
    rotation_minimizing_frames(&knot, DVec3::Y, &parameters(200).collect::<Vec<f64>>(), &mut frames);
    close_frames(&mut frames);
    assert!((frames[200].normal.dot(frames[0].normal.cross(frames[200].tangent))).abs() < 1e-12);
    let lost = Frame::new(Vec3::ZERO, Vec3::ZERO, Vec3::ZERO);
    assert!((lost.tangent.cross(lost.normal) - lost.binormal).length() < 1e-6 && lost.normal.length() > 0.99);
    assert!(lost.next(Vec3::ZERO, Vec3::ZERO).normal.is_finite());
}

struct Helix;

impl Helix {
    const RISE: f64 = 0.4;
}

impl Curve for Helix {
    type Point = DVec3;

    fn domain(&self) -> [f64; 2] {
        [0.0, TAU]
    }
    fn at(&self, t: f64) -> Jet<DVec3> {
        let (sin, cos) = t.sin_cos();
        Jet {
            point: DVec3::new(cos, sin, Self::RISE * t),
            first: DVec3::new(-sin, cos, Self::RISE),
            second: DVec3::new(-cos, -sin, 0.0),
        }
    }
}
