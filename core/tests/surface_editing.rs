//! Surfaces that are closed, refined and cut into curves, and those of degree 0.
#![cfg(feature = "alloc")]

#[path = "common/splines.rs"]
#[expect(dead_code, reason = "knots are for other tests")]
mod splines;

use glam::DVec3;
use radiosity::math::VectorSpace as _;
use radiosity::spline::*;
use splines::Random;

type Nurbs3 = OwnedSurface<Homogeneous<DVec3>>;

const BOTH: [Direction; 2] = [Direction::U, Direction::V];

/// So many derivatives are compared.
const ORDERS: usize = 6;

/// Control points with weights.
fn net(random: &mut Random, count: usize) -> Vec<Homogeneous<DVec3>> {
    (0..count).map(|_| Homogeneous::new(random.point(), random.between(0.5, 2.0))).collect()
}

/// Knots at uneven distances that repeat themselves after so many pieces.
fn periodic(random: &mut Random, degree: usize, pieces: usize) -> Vec<f64> {
    let steps: Vec<f64> = (0..pieces).map(|_| random.between(0.5, 1.5)).collect();
    let mut knots = vec![-2.0];
    (0..pieces + 2 * degree).for_each(|i| knots.push(knots[i] + steps[i % pieces]));
    knots
}

fn clamped(degree: usize, count: usize) -> Vec<f64> {
    let mut knots = vec![0.0; count + degree + 1];
    clamped_knots(&mut knots, degree);
    knots
}

/// How far all derivatives of orders up to `a` in `u` and `b` in `v` differ, relative to their sizes.
fn apart(surface: &Nurbs3, [one, other]: [[f64; 2]; 2], [a, b]: [usize; 2]) -> f64 {
    let [one, other] = [one, other].map(|[u, v]| surface.surface().derivatives::<ORDERS>(u, v));
    let pairs = (0..=a).flat_map(|i| (0..=b).filter(move |j| i + j < ORDERS).map(move |j| (one[i][j], other[i][j])));
    pairs.map(|(x, y)| (x - y).length() / (1.0 + x.length())).fold(0.0, f64::max)
}

/// Over a seam of degree p, p - 1 derivatives go on and the next one does not.
#[test]
fn closed_surfaces_have_no_seam() {
    let mut random = Random(31);
    for degree in 1..=3 {
        for directions in [&BOTH[..1], &BOTH[1..], &BOTH] {
            let (degrees, counts) = ([degree, degree], [7, 6]);
            let is_closed = BOTH.map(|direction| directions.contains(&direction));
            let knots = [0, 1].map(|k| match is_closed[k] {
                true => periodic(&mut random, degree, counts[k]),
                false => clamped(degree, counts[k]),
            });
            let points = net(&mut random, counts[0] * counts[1]);
            let surface = OwnedSurface::closed(directions, knots, degrees, &points).unwrap();
            let [[u0, u1], [v0, v1]] = surface.surface().domain();
            for share in [0.05, 0.43, 0.87] {
                let (u, v) = (u0 + (u1 - u0) * share, v0 + (v1 - v0) * share);
                let over_u = [[u0, v], [u1, v]];
                let over_v = [[u, v0], [u, v1]];
                if is_closed[0] {
                    assert!(apart(&surface, over_u, [degree - 1, 1]) < 1e-10, "degree {degree} in u");
                    assert!(apart(&surface, over_u, [degree, 0]) > 1e-3);
                }
                if is_closed[1] {
                    assert!(apart(&surface, over_v, [1, degree - 1]) < 1e-10, "degree {degree} in v");
                    assert!(apart(&surface, over_v, [0, degree]) > 1e-3);
                }
            }
        }
    }
}

/// A row of a closed surface is a closed curve, even with less points than its degree.
#[test]
fn rows_of_closed_surfaces_are_closed_curves() {
    let mut random = Random(32);
    for count in 1..=5 {
        let ring = net(&mut random, count);
        let knots = periodic(&mut random, 3, count);
        let curve = OwnedBSpline::new(knots.clone(), 3, ring.clone()).unwrap();
        assert!(curve.curve().is_closed());
        let both = [ring.clone(), ring].concat();
        let tube = OwnedSurface::closed(&[Direction::U], [knots, clamped(1, 2)], [3, 1], &both).unwrap();
        let [[start, end], _] = tube.surface().domain();
        for t in (0..20).map(|k| start + (end - start) * f64::from(k) / 20.0) {
            assert!((tube.surface().point(t, 0.3) - curve.curve().point(t)).length() < 1e-13);
        }
    }
}

#[test]
fn errors_of_closed_surfaces_have_numbers() {
    let mut random = Random(33);
    let (ring, points) = (periodic(&mut random, 2, 5), net(&mut random, 15));
    let closed = |u: &[f64], count: usize| {
        OwnedSurface::closed(&[Direction::U], [u.to_vec(), clamped(2, 3)], [2, 2], &points[..count])
    };
    assert!(closed(&ring, 15).is_ok());
    assert_eq!(closed(&ring, 14), Err(SplineError::PointCount { points: 14, wanted: 15 }));
    assert_eq!(closed(&clamped(2, 7), 15), Err(SplineError::NotPeriodic { index: 5 }));
    assert!(matches!(closed(&ring[..5], 15), Err(SplineError::KnotCount { .. })));
    let negative = vec![Homogeneous::new(DVec3::X, -1.0); 15];
    let knots = [ring.clone(), clamped(2, 3)];
    let error = OwnedSurface::closed(&[Direction::U], knots, [2, 2], &negative).unwrap_err();
    assert_eq!(error, SplineError::Weight { index: 0, weight: -1.0 });
}

/// Into slices, what the heap has.
#[test]
fn knots_and_curves_without_a_heap() {
    let mut random = Random(34);
    let surface = OwnedSurface::new([clamped(3, 6), clamped(2, 5)], [3, 2], net(&mut random, 30)).unwrap();
    let borrowed = surface.surface();
    for (direction, t, wider) in [(Direction::U, 0.4, [7, 5]), (Direction::V, 1.0 / 3.0, [6, 6])] {
        let mut knots = vec![0.0; borrowed.knots(direction).knots().len() + 1];
        let mut points = vec![Homogeneous::default(); wider[0] * wider[1]];
        borrowed.insert(direction, t, &mut knots, &mut points).unwrap();
        let mut all = BOTH.map(|direction| borrowed.knots(direction).knots().to_vec());
        all[direction as usize] = knots.clone();
        let finer = OwnedSurface::new(all, [3, 2], points.clone()).unwrap();
        let other = surface.with_knots(direction, &[t]).unwrap();
        let same = finer.points().iter().zip(other.points()).all(|(a, b)| (*a - *b).length() < 1e-14);
        assert!(same, "{direction:?}");
        for share in (0..30).map(|k| f64::from(k) / 29.0) {
            let other = finer.surface().point(share, 1.0 - share);
            assert!((other - borrowed.point(share, 1.0 - share)).length() < 1e-13);
        }
        assert!(borrowed.insert(direction, t, &mut knots, &mut points[1..]).is_err());
        assert!(borrowed.insert(direction, t, &mut knots[1..], &mut points).is_err());
        assert!(borrowed.insert(direction, 1.5, &mut knots, &mut points).is_err());
        assert!(borrowed.insert(direction, 0.0, &mut knots, &mut points).is_err());

        let knots = borrowed.knots(direction);
        let mut points = vec![Homogeneous::default(); knots.count()];
        for t in [-1.0, 0.0, 0.3, 1.0, f64::INFINITY] {
            borrowed.isocurve(direction, t, &mut points).unwrap();
            let (curve, held) = (BSpline::new(knots, &points).unwrap(), t.clamp(0.0, 1.0));
            for s in (0..30).map(|k| f64::from(k) / 29.0) {
                let [u, v] = if direction == Direction::U { [s, held] } else { [held, s] };
                assert!((curve.point(s) - borrowed.point(u, v)).length() < 1e-13);
            }
        }
        assert!(borrowed.isocurve(direction, 0.5, &mut points[1..]).is_err());
    }
}

/// Of degree 0, a surface is single points, or curves: rays through them hit, in the interval of the point.
#[test]
fn rays_meet_points_and_curves() {
    let at = |i: usize, j: usize| DVec3::new(i as f64, j as f64, 5.0 + i as f64 * j as f64);
    let points: Vec<DVec3> = (0..9).map(|k| at(k % 3, k / 3)).collect();
    let dots = OwnedSurface::new([clamped(0, 3), clamped(0, 3)], [0, 0], points.clone()).unwrap();
    let (i, j) = (2, 1);
    let hit = dots.surface().ray(DVec3::new(2.0, 1.0, 0.0), DVec3::Z).unwrap();
    assert_eq!(hit.distance, at(i, j).z);
    let [u, v] = hit.parameters;
    assert_eq!(dots.surface().point(u, v), at(i, j));
    assert!(dots.surface().ray(DVec3::new(1.5, 1.0, 0.0), DVec3::Z).is_none());
    // Lines along v at u = 0, 1, 2.
    let lines = OwnedSurface::new([clamped(0, 3), clamped(1, 3)], [0, 1], points.clone()).unwrap();
    let turned = OwnedSurface::new([clamped(1, 3), clamped(0, 3)], [1, 0], lines.transposed().points().to_vec());
    for surface in [lines, turned.unwrap()] {
        let hit = surface.surface().ray(DVec3::new(1.0, 1.3, 0.0), DVec3::Z).unwrap();
        assert!((hit.distance - 6.3).abs() < 1e-12, "{}", hit.distance);
        assert!(surface.surface().ray(DVec3::new(1.1, 1.3, 0.0), DVec3::Z).is_none());
    }
}
