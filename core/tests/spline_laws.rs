//! Laws of Bezier and B-spline curves, on random ones of all degrees.
#![cfg(feature = "alloc")]

#[path = "common/splines.rs"]
mod splines;

use glam::{DMat3, DVec2, DVec3, Vec2, Vec3, Vec3A, Vec4};
use radiosity::math::VectorSpace;
use radiosity::spline::*;
use splines::Random;

const DEGREES: std::ops::RangeInclusive<usize> = 1..=MAX_DEGREE;

fn parameters(count: usize) -> impl Iterator<Item = f64> {
    (0..=count).map(move |i| i as f64 / count as f64)
}

fn random_curve(random: &mut Random, degree: usize) -> OwnedBSpline<DVec3> {
    let count = degree + random.count(1, 8);
    OwnedBSpline::new(random.knots(degree, count), degree, random.points(count)).unwrap()
}

/// Basis functions sum to 1, their derivatives to 0; on their span none is negative.
#[test]
fn basis_functions_are_a_partition_of_unity() {
    let mut random = Random(1);
    for degree in DEGREES {
        let owned = random_curve(&mut random, degree);
        let knots = owned.curve().knots();
        for t in parameters(50) {
            let mut rows = [[0.0; MAX_DEGREE + 1]; 4];
            knots.basis_derivatives(knots.span(t), t, &mut rows);
            assert_eq!(rows[0], knots.basis(knots.span(t), t));
            assert!(rows[0].iter().all(|&value| value >= 0.0));
            assert!((rows[0].iter().sum::<f64>() - 1.0).abs() < 1e-14);
            for row in &rows[1..] {
                let scale = row.iter().fold(1.0, |largest: f64, value| largest.max(value.abs()));
                assert!(row.iter().sum::<f64>().abs() < 1e-13 * scale);
            }
            let mut bernsteins = vec![0.0; degree + 1];
            bernstein(&mut bernsteins, t);
            assert!((bernsteins.iter().sum::<f64>() - 1.0).abs() < 1e-14);
        }
    }
}

/// Whatever the span, the basis functions are those of a piece: the one to which its knot belongs.
#[test]
fn every_span_stands_for_a_piece() {
    let all = [-1.0, 0.0, 0.5, 0.5, 2.0, 2.0, 3.0];
    let knots = KnotVector::new(&all, 1).unwrap();
    let (pieces, t) = ([1, 1, 3, 3, 3, 3, 3], 0.7);
    for span in (0..=7).chain([usize::MAX]) {
        let piece = *pieces.get(span).unwrap_or(&3);
        assert_eq!(knots.basis(span, t), knots.basis(piece, t), "span {span}");
        let mut rows = [[[0.0; MAX_DEGREE + 1]; 2]; 2];
        let [of_span, of_piece] = &mut rows;
        knots.basis_derivatives(span, t, of_span);
        knots.basis_derivatives(piece, t, of_piece);
        assert_eq!(rows[0], rows[1]);
        assert!(rows[0].iter().flatten().all(|value| value.is_finite()));
        let curve = BSpline::new(knots, &[1.0, 5.0, 2.0, 3.0, 4.0]).unwrap();
        assert_eq!(curve.blossom(span, &[t]), curve.blossom(piece, &[t]));
    }
}

/// Less knots may take more than the weights have: an error, no curve with weights below 0.
#[test]
fn weights_stay_positive_without_a_knot() {
    let weights = [1.0, 0.01, 0.01, 0.5];
    let points = |x: f64| weights.map(|weight| Homogeneous::new(DVec3::X * x, weight)).to_vec();
    let knots = vec![0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0];
    let curve = OwnedBSpline::new(knots.clone(), 2, points(1.0)).unwrap();
    let error = curve.removed(0.5).unwrap_err();
    assert!(matches!(error, SplineError::Weight { index: 1, weight } if weight < 0.0), "{error}");
    let line = vec![0.0, 0.0, 1.0, 1.0];
    let rows = [points(1.0), points(2.0)].concat();
    let surface = OwnedSurface::new([knots, line], [2, 1], rows).unwrap();
    for (surface, direction) in [(surface.clone(), Direction::U), (surface.transposed(), Direction::V)] {
        assert_eq!(surface.without_knot(direction, 0.5).unwrap_err(), error);
    }
}

/// A map of the control points is a map of the curve.
#[test]
fn curves_are_affinely_invariant() {
    let mut random = Random(2);
    for degree in DEGREES {
        let owned = random_curve(&mut random, degree);
        let columns = [random.point(), random.point(), random.point()];
        let (matrix, shift) = (DMat3::from_cols(columns[0], columns[1], columns[2]), random.point());
        let map = |point: DVec3| matrix * point + shift;
        let mapped: Vec<DVec3> = owned.curve().points().iter().map(|&point| map(point)).collect();
        let mapped = BSpline::new(owned.curve().knots(), &mapped).unwrap();
        let weighted: Vec<_> = owned.curve().points().iter().map(|&p| Homogeneous::new(p, 0.5 + p.x * p.x)).collect();
        let rational = Bezier::new(&weighted[..=degree]).unwrap();
        let moved: Vec<_> = weighted.iter().map(|p| Homogeneous::new(map(p.project()), p.weight)).collect();
        let moved = Bezier::new(&moved[..=degree]).unwrap();
        for t in parameters(20) {
            assert!((mapped.point(t) - map(owned.curve().point(t))).length() < 1e-13);
            assert!((moved.point(t) - map(rational.point(t))).length() < 1e-12);
        }
    }
}

/// No coordinate in any direction leaves the interval of the control points that act on a piece.
#[test]
fn curves_lie_in_the_hull_of_their_control_points() {
    let mut random = Random(3);
    for degree in DEGREES {
        let owned = random_curve(&mut random, degree);
        let curve = owned.curve();
        for t in parameters(100) {
            let span = curve.knots().span(t);
            let direction = random.point().normalize();
            let along = curve.points()[span - degree..=span].iter().map(|point| point.dot(direction));
            let (low, high) = along.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
            let x = curve.point(t).dot(direction);
            assert!(x > low - 1e-14 && x < high + 1e-14);
        }
    }
}

#[test]
fn bounds_hold_the_curve_and_touch_it() {
    let mut random = Random(4);
    for degree in DEGREES {
        let points = random.points(degree + 1);
        let weighted: Vec<_> = points.iter().map(|&p| Homogeneous::new(p, random.between(0.3, 3.0))).collect();
        let samples = |at: &dyn Fn(f64) -> DVec3| {
            let points: Vec<DVec3> = parameters(4000).map(at).collect();
            points.iter().fold([points[0]; 2], |[low, high], p| [low.min(*p), high.max(*p)])
        };
        let (plain, rational) = (Bezier::new(&points).unwrap(), Bezier::new(&weighted).unwrap());
        for (bounds, [low, high]) in
            [(plain.bounds(), samples(&|t| plain.point(t))), (rational.bounds(), samples(&|t| rational.point(t)))]
        {
            let (below, above) = (low - bounds[0], bounds[1] - high);
            assert!(below.min_element() > -1e-14 && above.min_element() > -1e-14);
            assert!(below.max_element() < 1e-4 && above.max_element() < 1e-4, "degree {degree}: {below} {above}");
        }
    }
}

/// Knots and degrees are ways to write the same curve.
#[test]
fn insertion_and_elevation_change_nothing() {
    let mut random = Random(5);
    for degree in 1..MAX_DEGREE {
        let owned = random_curve(&mut random, degree);
        let knot = random.between(0.0, 1.0);
        let inserted = owned.inserted(knot).unwrap();
        let twice = inserted.inserted(if degree > 1 { knot } else { 0.5 * knot }).unwrap();
        let elevated = owned.elevated().unwrap();
        assert_eq!(elevated.curve().degree(), degree + 1);
        for (other, limit) in [(&inserted, 1e-14), (&twice, 1e-14), (&elevated, 1e-13 * 2_f64.powi(degree as i32))] {
            let checked = KnotVector::new(other.curve().knots().knots(), other.curve().degree()).unwrap();
            assert_eq!(checked.domain(), [0.0, 1.0]);
            for t in parameters(40) {
                let error = (other.curve().point(t) - owned.curve().point(t)).length();
                assert!(error < limit, "degree {degree} at {t}: {error:e}");
            }
        }
    }
}

/// Boehm's rule is the Oslo algorithm for one knot.
#[test]
fn oslo_equals_boehm() {
    let mut random = Random(6);
    for degree in DEGREES {
        let owned = random_curve(&mut random, degree);
        let finer = owned.inserted(random.unit()).unwrap().inserted(random.unit()).unwrap();
        let mut points = vec![DVec3::ZERO; finer.curve().points().len()];
        owned.curve().refine(finer.curve().knots(), &mut points).unwrap();
        for (oslo, boehm) in points.iter().zip(finer.curve().points()) {
            assert!((*oslo - *boehm).length() < 1e-14, "degree {degree}: {oslo} {boehm}");
        }
        let back = finer.curve().refine(owned.curve().knots(), &mut vec![DVec3::ZERO; owned.curve().points().len()]);
        assert!(matches!(back, Err(SplineError::MissingKnot { .. })));
    }
}

/// What was inserted can be removed; what was not, tells how much the curve changes at most.
#[test]
fn removal_undoes_insertion() {
    let mut random = Random(7);
    for degree in 1..=8 {
        let owned = random_curve(&mut random, degree);
        let knot = random.between(0.1, 0.9);
        let finer = owned.inserted(knot).unwrap();
        let (back, distance) = finer.removed(knot).unwrap();
        assert!(distance < 1e-11, "degree {degree}: {distance:e}");
        for (a, b) in back.curve().points().iter().zip(owned.curve().points()) {
            assert!((*a - *b).length() < 1e-10);
        }
        let inner = owned.curve().knots().knots().iter().copied().find(|&knot| knot > 0.0 && knot < 1.0);
        if let Some(inner) = inner {
            let (other, distance) = owned.removed(inner).unwrap();
            let apart = |t| (other.curve().point(t) - owned.curve().point(t)).length();
            assert!(parameters(200).map(apart).fold(0.0, f64::max) <= distance * (1.0 + 1e-12));
            assert!(distance > 1e-6);
        }
    }
}

#[test]
fn bezier_pieces_are_the_curve_and_join_to_it_again() {
    let mut random = Random(8);
    for degree in DEGREES {
        let owned = random_curve(&mut random, degree);
        let pieces = owned.beziers();
        for ([start, end], piece) in &pieces {
            for share in parameters(10) {
                let t = start + (end - start) * share;
                let error = (piece.curve().point(share) - owned.curve().point(t)).length();
                // At its end a piece may meet a break of the curve.
                assert!(error < 1e-12 || share == 1.0, "degree {degree} at {t}: {error:e}");
            }
        }
        let meet = |a: &OwnedBezier<DVec3>, b: &OwnedBezier<DVec3>| {
            (*a.curve().points().last().unwrap() - b.curve().points()[0]).length() < 1e-12
        };
        if !pieces.windows(2).all(|pair| meet(&pair[0].1, &pair[1].1)) {
            continue;
        }
        let breaks: Vec<f64> = pieces.iter().map(|([start, _], _)| *start).chain([1.0]).collect();
        let mut points = vec![pieces[0].1.curve().points()[0]];
        pieces.iter().for_each(|(_, piece)| points.extend(&piece.curve().points()[1..]));
        let joined = OwnedBSpline::from_beziers(&breaks, degree, points).unwrap();
        for t in parameters(40) {
            assert!((joined.curve().point(t) - owned.curve().point(t)).length() < 1e-12);
        }
    }
}

#[test]
fn halves_and_segments_join() {
    let mut random = Random(9);
    for degree in DEGREES {
        let points = random.points(degree + 1);
        let curve = Bezier::new(&points).unwrap();
        let (mut before, mut after, mut part) = (points.clone(), points.clone(), points.clone());
        let (cut, from, to) = (random.unit(), random.unit(), random.unit());
        curve.split(cut, &mut before, &mut after).unwrap();
        curve.segment([from, to], &mut part).unwrap();
        assert_eq!(before[degree], after[0]);
        let [before, after, part] = [&before, &after, &part].map(|points| Bezier::new(points).unwrap());
        for t in parameters(20) {
            assert!((before.point(t) - curve.point(cut * t)).length() < 1e-13);
            assert!((after.point(t) - curve.point(cut + (1.0 - cut) * t)).length() < 1e-13);
            assert!((part.point(t) - curve.point(from + (to - from) * t)).length() < 1e-13);
        }
    }
}

#[test]
fn a_degree_more_can_be_taken_back() {
    let mut random = Random(10);
    for degree in 0..MAX_DEGREE {
        let points = random.points(degree + 1);
        let curve = Bezier::new(&points).unwrap();
        let mut elevated = vec![DVec3::ZERO; degree + 2];
        curve.elevate(&mut elevated).unwrap();
        let raised = Bezier::new(&elevated).unwrap();
        let mut reduced = points.clone();
        assert!(raised.reduce(&mut reduced).unwrap() < 1e-10);
        let mut highest = vec![DVec3::ZERO; MAX_DEGREE + 1];
        curve.elevate(&mut highest).unwrap();
        let highest = Bezier::new(&highest).unwrap();
        for t in parameters(20) {
            assert!((raised.point(t) - curve.point(t)).length() < 1e-14);
            assert!((highest.point(t) - curve.point(t)).length() < 1e-14);
        }
        assert!(points.iter().zip(&reduced).all(|(a, b)| (*a - *b).length() < 1e-10));
        if degree > 0 {
            let mut lower = vec![DVec3::ZERO; degree];
            let distance = curve.reduce(&mut lower).unwrap();
            let lower = Bezier::new(&lower).unwrap();
            let apart = parameters(100).map(|t| (lower.point(t) - curve.point(t)).length()).fold(0.0, f64::max);
            assert!(apart <= distance * (1.0 + 1e-12));
        }
    }
}

/// Derivatives of all orders are limits of differences and the values of exact hodographs.
#[test]
fn derivatives_of_any_order() {
    let mut random = Random(11);
    for degree in DEGREES {
        let points = random.points(degree + 1);
        let curve = Bezier::new(&points).unwrap();
        let mut hodographs = vec![points.clone()];
        for order in 0..degree {
            let mut next = vec![DVec3::ZERO; degree - order];
            Bezier::new(&hodographs[order]).unwrap().hodograph(&mut next).unwrap();
            hodographs.push(next);
        }
        for t in parameters(7) {
            let mut derivatives = [DVec3::ONE; MAX_DEGREE + 2];
            curve.derivatives(t, &mut derivatives);
            for (order, derivative) in derivatives.iter().enumerate() {
                let exact = hodographs.get(order).map_or(DVec3::ZERO, |points| Bezier::new(points).unwrap().point(t));
                let scale = hodographs.get(order).map_or(1.0, |p| p.iter().map(|p| p.length()).fold(1.0, f64::max));
                assert!((*derivative - exact).length() < 1e-12 * scale, "degree {degree}, order {order}");
            }
        }
    }
}

#[test]
fn derivatives_are_limits_of_differences() {
    let mut random = Random(12);
    for degree in 1..=9 {
        let owned = random_curve(&mut random, degree);
        let weighted: Vec<_> = owned.curve().points().iter().map(|&p| Homogeneous::new(p, 1.0 + p.y * p.y)).collect();
        let rational = BSpline::new(owned.curve().knots(), &weighted).unwrap();
        let knots = owned.curve().knots().knots();
        let h = 1e-5;
        for t in parameters(30).filter(|&t| t > h && t < 1.0 - h && knots.iter().all(|knot| (knot - t).abs() > h)) {
            check_jets(&owned.curve(), t, h);
            check_jets(&rational, t, h);
            let (mut derivatives, jet) = ([DVec3::ZERO; 3], rational.at(t));
            rational.derivatives(t, &mut derivatives);
            for (a, b) in [jet.point, jet.first, jet.second].into_iter().zip(derivatives) {
                assert!((a - b).length() <= 1e-11 * (1.0 + b.length()));
            }
        }
    }
}

fn check_jets(curve: &impl Curve<Point = DVec3>, t: f64, h: f64) {
    let [before, jet, after] = [t - h, t, t + h].map(|t| curve.at(t));
    let scale = 1.0 + jet.first.length() + jet.second.length();
    let first = (after.point - before.point) / (2.0 * h);
    let second = (after.first - before.first) / (2.0 * h);
    // The error is a sixth of h^2 times the next derivative but one.
    assert!((first - jet.first).length() < 1e-4 * scale * scale, "{} is not {}", jet.first, first);
    assert!((second - jet.second).length() < 1e-3 * scale * scale, "{} is not {}", jet.second, second);
    assert!((curve.point(t) - jet.point).length() < 1e-14);
    assert!((curve.speed(t) - jet.first.length()).abs() < 1e-12 * scale);
}

/// At a knot of multiplicity `m`, `p - m` derivatives are continuous, and the next one is not.
#[test]
fn pieces_join_as_smoothly_as_their_knots_say() {
    let mut random = Random(13);
    for (degree, multiplicity) in (1..=6).flat_map(|degree| (1..=degree).map(move |m| (degree, m))) {
        let inner = std::iter::repeat_n(0.5, multiplicity);
        let knots: Vec<f64> =
            std::iter::repeat_n(0.0, degree + 1).chain(inner).chain(std::iter::repeat_n(1.0, degree + 1)).collect();
        let points = random.points(knots.len() - degree - 1);
        let curve = BSpline::new(KnotVector::new(&knots, degree).unwrap(), &points).unwrap();
        let mut pieces = [vec![DVec3::ZERO; degree + 1], vec![DVec3::ZERO; degree + 1]];
        for (piece, span) in pieces.iter_mut().zip(curve.knots().spans()) {
            curve.bezier(span, piece).unwrap();
        }
        let mut derivatives = [[DVec3::ZERO; 7]; 2];
        Bezier::new(&pieces[0]).unwrap().derivatives(1.0, &mut derivatives[0]);
        Bezier::new(&pieces[1]).unwrap().derivatives(0.0, &mut derivatives[1]);
        let [before, after] = derivatives;
        for (order, (before, after)) in before.iter().zip(after).enumerate().take(degree + 1) {
            let step = (*before - after).length();
            let is_continuous = order <= degree - multiplicity;
            assert_eq!(step < 1e-10, is_continuous, "degree {degree}, knot {multiplicity} times, order {order}");
        }
    }
}

#[test]
fn closed_curves_go_round() {
    let mut random = Random(14);
    for degree in 1..=7 {
        let count = degree + random.count(0, 5);
        let points = random.points(count.max(2));
        let mut knots = vec![0.0; points.len() + 2 * degree + 1];
        uniform_knots(&mut knots, degree);
        let vector = KnotVector::new(&knots, degree).unwrap();
        let closed = BSpline::closed(vector, &points).unwrap();
        assert!(closed.is_closed());
        let repeated: Vec<DVec3> = (0..points.len() + degree).map(|i| points[i % points.len()]).collect();
        let open = BSpline::new(vector, &repeated).unwrap();
        for t in parameters(30) {
            assert!((closed.point(t) - open.point(t.min(1.0))).length() < 1e-13);
            assert!((closed.point(t) - closed.point(t + 3.0)).length() < 1e-12);
            assert!((closed.point(t) - closed.point(t - 2.0)).length() < 1e-12);
        }
        let owned = OwnedBSpline::new(knots.clone(), degree, points.clone()).unwrap();
        for t in parameters(30).filter(|&t| t < 1.0) {
            assert!((owned.inserted(0.4).unwrap().curve().point(t) - closed.point(t)).length() < 1e-12);
            assert!((owned.elevated().unwrap().curve().point(t) - closed.point(t)).length() < 1e-11);
        }
    }
}

/// One code for numbers and vectors: coordinates are curves of their own.
#[test]
fn coordinates_are_curves() {
    let points: [Vec4; 6] = core::array::from_fn(|i| Vec4::new(0.5, i as f32, (i * i) as f32, (i % 3) as f32));
    let t = 0.37;
    let whole = Bezier::new(&points).unwrap().at(t);
    let close = |a: f32, b: f32| (a - b).abs() < 1e-5 * (1.0 + b.abs());
    for axis in 0..4 {
        let numbers = points.map(|point| point.coordinate(axis));
        let jet = Bezier::new(&numbers).unwrap().at(t);
        assert!(close(jet.point, whole.point[axis]) && close(jet.first, whole.first[axis]));
    }
    let flat = Bezier::new(&points.map(|p| Vec2::new(p.x, p.y))).unwrap().point(t);
    let space = Bezier::new(&points.map(|p| p.truncate())).unwrap().point(t);
    let aligned = Bezier::new(&points.map(|p| Vec3A::from(p.truncate()))).unwrap().point(t);
    assert!(close(flat.y, whole.point.y) && close(space.z, whole.point.z) && close(aligned.z, whole.point.z));
    let precise = Bezier::new(&points.map(|p| p.as_dvec4())).unwrap().point(f64::from(t));
    assert!(close(precise.z as f32, whole.point.z));
    let steady: Jet<Vec3> = Bezier::new(&[Vec3::ONE; 5]).unwrap().at(0.2);
    assert!((steady.point - Vec3::ONE).length() < 1e-6 && steady.first == Vec3::ZERO);
}

#[test]
fn many_points_at_once_are_the_same_points() {
    let mut random = Random(15);
    for degree in DEGREES {
        let owned = random_curve(&mut random, degree);
        let mut t: Vec<f64> = parameters(60).collect();
        t.push(random.unit());
        let mut points = vec![DVec3::ZERO; t.len()];
        owned.curve().sample(&t, &mut points);
        assert!(t.iter().zip(points).all(|(&t, point)| point == owned.curve().point(t)));
    }
}

/// The implicit form vanishes on the curve, and has other signs on both sides of it.
#[test]
fn implicit_forms_vanish_on_the_curve() {
    let mut random = Random(16);
    for degree in 1..=6 {
        let points: Vec<DVec2> = random.points(degree + 1).iter().map(|p| p.truncate()).collect();
        let weighted: Vec<_> = points.iter().map(|&p| Homogeneous::new(p, 1.0 + p.x * p.x)).collect();
        let (plain, rational) = (Bezier::new(&points).unwrap(), Bezier::new(&weighted).unwrap());
        for t in [0.13, 0.5, 0.81] {
            check_implicit(plain.at(t), |p| plain.implicit(p));
            check_implicit(rational.at(t), |p| rational.implicit(p));
        }
    }
}

fn check_implicit(jet: Jet<DVec2>, implicit: impl Fn(DVec2) -> f64) {
    let across = jet.first.perp().normalize() * 1e-4;
    let [left, on, right] = [jet.point + across, jet.point, jet.point - across].map(implicit);
    assert!(left * right < 0.0 && on.abs() < 1e-3 * left.abs().min(right.abs()), "{left:e} {on:e} {right:e}");
}

#[test]
fn roots_of_bernstein_polynomials() {
    // (t - 0.25)(t - 0.5)^2 (t - 0.75), by its blossom.
    let roots = [0.25, 0.5, 0.5, 0.75];
    let coefficients: [f64; 5] = core::array::from_fn(|ones| blossom_of_product(&roots, ones));
    let found = bernstein_roots(&coefficients);
    assert_eq!(found.len(), 3);
    assert!(found.iter().zip([0.25, 0.5, 0.75]).all(|(a, b)| (a - b).abs() < 1e-7), "{found:?}");
    assert_eq!(bernstein_roots(&[0.0, 1.0]).as_slice(), [0.0]);
    assert_eq!(bernstein_roots(&[1.0, 0.0]).as_slice(), [1.0]);
    assert!(bernstein_roots(&[0.0_f32; 4]).is_empty() && bernstein_roots::<f64>(&[]).is_empty());
    assert!(bernstein_roots(&[f64::NAN, 1.0]).is_empty());
    // Chebyshev's polynomial of degree 9 has all of its roots inside.
    let binomial = |n: i32, k: i32| (1..=k).map(|i| f64::from(n - k + i) / f64::from(i)).product::<f64>();
    let height = |i: i32| f64::from(1 - 2 * (i % 2)) * binomial(18, 2 * i) / binomial(9, i);
    let curve: Vec<DVec2> = (0..=9).map(|i| DVec2::new(f64::from(i) / 9.0, height(i))).collect();
    let crossings = Bezier::new(&curve).unwrap().crossings(DVec2::ZERO, DVec2::Y);
    assert_eq!(crossings.len(), 9);
    for (k, t) in crossings.iter().enumerate() {
        let angle = (2 * k + 1) as f64 * std::f64::consts::PI / 18.0;
        assert!((t - 0.5 * (1.0 - angle.cos())).abs() < 1e-13, "{t}");
    }
    let turns = Bezier::new(&curve).unwrap().turning_points(1);
    assert!(turns.len() == 8 && turns.iter().all(|&t| Bezier::new(&curve).unwrap().at(t).first.y.abs() < 1e-10));
    assert!(Bezier::new(&curve).unwrap().is_monotone(0) && !Bezier::new(&curve).unwrap().is_monotone(1));
}

/// The mean of the product of `1 - r` for `ones` of the factors and `-r` for the others, over all choices.
fn blossom_of_product(roots: &[f64], ones: usize) -> f64 {
    let choices = (0_u32..1 << roots.len()).filter(|choice| choice.count_ones() as usize == ones);
    let product = |choice: u32| roots.iter().enumerate().map(|(i, r)| f64::from(choice >> i & 1) - r).product::<f64>();
    let values: Vec<f64> = choices.map(product).collect();
    values.iter().sum::<f64>() / values.len() as f64
}

#[test]
fn bad_input_is_an_error_with_numbers() {
    let knots = |knots: &[f64], degree| KnotVector::new(knots, degree).unwrap_err();
    assert_eq!(knots(&[0.0; 40], 16), SplineError::Degree { degree: 16 });
    assert_eq!(knots(&[0.0, 1.0, 2.0], 1), SplineError::KnotCount { knots: 3, least: 4 });
    assert_eq!(knots(&[0.0, 0.0, f64::NAN, 1.0], 1), SplineError::KnotNotFinite { index: 2 });
    assert_eq!(knots(&[0.0, 0.0, 1.0, 0.5], 1), SplineError::Decreasing { index: 3, knots: [1.0, 0.5] });
    assert_eq!(knots(&[0.0, 0.0, 0.0, 1.0, 1.0], 1), SplineError::Multiplicity { index: 2, most: 2 });
    assert_eq!(knots(&[0.0, 1.0, 1.0, 2.0], 1), SplineError::EmptyDomain);
    let line = KnotVector::new(&[0.0, 0.0, 1.0, 1.0], 1).unwrap();
    let wrong = |points: &[DVec3]| BSpline::new(line, points).unwrap_err();
    assert_eq!(wrong(&[DVec3::ONE]), SplineError::PointCount { points: 1, wanted: 2 });
    assert_eq!(wrong(&[DVec3::ONE, DVec3::NAN]), SplineError::NotFinite { index: 1 });
    let weights = [1.0, -0.5].map(|weight| Homogeneous::new(DVec3::ONE, weight));
    assert_eq!(Bezier::new(&weights).unwrap_err(), SplineError::Weight { index: 1, weight: -0.5 });
    assert_eq!(BSpline::new(line, &weights).unwrap_err(), SplineError::Weight { index: 1, weight: -0.5 });
    let uneven = [0.0, 1.0, 2.0, 3.0, 4.5];
    let uneven = KnotVector::new(&uneven, 1).unwrap();
    assert_eq!(BSpline::closed(uneven, &[1.0; 2]).unwrap_err(), SplineError::NotPeriodic { index: 4 });
    let curve = Bezier::new(&[0.0, 1.0]).unwrap();
    let outside = SplineError::Parameter { parameter: 2.0, domain: [0.0, 1.0] };
    assert_eq!(curve.split(2.0, &mut [0.0; 2], &mut [0.0; 2]), Err(outside));
    assert_eq!(curve.split(0.5, &mut [0.0; 1], &mut [0.0; 2]), Err(SplineError::Buffer { length: 1, wanted: 2 }));
    assert!(format!("{}", SplineError::Weight { index: 1, weight: -0.5 }).contains("-0.5"));
}

/// Whatever the parameter, nothing panics.
#[test]
fn any_parameter_gives_a_result() {
    let mut random = Random(17);
    for degree in 0..=MAX_DEGREE {
        let owned = if degree == 0 {
            OwnedBSpline::new(vec![0.0, 0.5, 1.0], 0, random.points(2)).unwrap()
        } else {
            random_curve(&mut random, degree)
        };
        for t in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1e300, 1e300, -0.0, 5.0] {
            let _ = (owned.curve().at(t), owned.curve().point(t), owned.curve().next_break(t));
            owned.curve().derivatives(t, &mut [DVec3::ZERO; 20]);
        }
        let _ = (owned.curve().nearest(DVec3::NAN), owned.curve().bezier(1000, &mut vec![DVec3::ZERO; degree + 1]));
    }
}
