//! Surfaces against closed forms, laws and differences.

use glam::{DVec3, Vec3};
use radiosity::spline::*;

type Nurbs3 = OwnedSurface<Homogeneous<DVec3>>;

const TAU: f64 = core::f64::consts::TAU;
const Z: Axis<DVec3> = Axis { origin: DVec3::ZERO, direction: DVec3::Z };

fn knots(knots: &[f64], degree: usize) -> KnotVector<'_, f64> {
    KnotVector::new(knots, degree).unwrap()
}

/// A point that seems to lie anywhere.
fn anywhere(k: usize) -> DVec3 {
    let x = k as f64;
    DVec3::new((1.3 * x).sin(), (2.9 * x * x + 0.3).cos(), (0.7 * x * x * x + 1.1).sin())
}

/// Shares of the domain that hit no knot.
fn places(surface: &BSplineSurface<impl SurfacePoint<Scalar = f64>>) -> Vec<[f64; 2]> {
    let [[u0, u1], [v0, v1]] = surface.domain();
    let at = |k: usize| {
        [u0 + (u1 - u0) * (0.37 + 0.618_034 * k as f64).fract(), v0 + (v1 - v0) * (0.11 + 0.754_878 * k as f64).fract()]
    };
    (0..60).map(at).collect()
}

fn wavy() -> OwnedSurface<DVec3> {
    let points = (0..6 * 5).map(|k| DVec3::new((k % 6) as f64, (k / 6) as f64, 0.0) + 0.3 * anywhere(k)).collect();
    let u = vec![0.0, 0.0, 0.0, 0.0, 0.4, 0.7, 1.0, 1.0, 1.0, 1.0];
    let v = vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0];
    OwnedSurface::new([u, v], [3, 2], points).unwrap()
}

fn rational() -> Nurbs3 {
    let wavy = wavy();
    let points =
        wavy.points().iter().enumerate().map(|(k, &p)| Homogeneous::new(p, 1.0 + 0.6 * (1.7 * k as f64).sin()));
    let all = [Direction::U, Direction::V].map(|d| wavy.surface().knots(d).knots().to_vec());
    OwnedSurface::new(all, [3, 2], points.collect()).unwrap()
}

/// Half a circle in the plane `y = 0` from the lower to the upper pole.
fn half_circle(middle: f64, radius: f64, full: bool) -> Nurbs3 {
    let w = core::f64::consts::FRAC_1_SQRT_2;
    let corner = [
        [0.0, -1.0],
        [1.0, -1.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
        [-1.0, 1.0],
        [-1.0, 0.0],
        [-1.0, -1.0],
        [0.0, -1.0],
    ];
    let count = if full { 9 } else { 5 };
    let at = |k: usize| {
        let [x, z] = corner[k];
        Homogeneous::new(DVec3::new(middle + radius * x, 0.0, radius * z), if k.is_multiple_of(2) { 1.0 } else { w })
    };
    let points: Vec<_> = (0..count).map(at).collect();
    let all: &[f64] =
        if full { &[0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.] } else { &[0., 0., 0., 1., 1., 2., 2., 2.] };
    revolution(&BSpline::new(knots(all, 2), &points).unwrap(), Z, TAU).unwrap()
}

/// Three by three control points, of degree 0 in a direction or in both.
fn steps(degrees: [usize; 2]) -> Nurbs3 {
    let all = degrees.map(|degree| {
        let mut knots = vec![0.0; 3 + degree + 1];
        clamped_knots(&mut knots, degree);
        knots
    });
    OwnedSurface::new(all, degrees, (0..9).map(|k| Homogeneous::new(anywhere(k), 1.0 + k as f64)).collect()).unwrap()
}

fn sphere() -> Nurbs3 {
    half_circle(0.0, 2.0, false)
}

/// Radii 3 and 1.
fn torus() -> Nurbs3 {
    half_circle(3.0, 1.0, true)
}

#[test]
fn derivatives_are_limits_of_differences() {
    let (polynomial, rational) = (wavy(), rational());
    check_derivatives(&polynomial.surface());
    check_derivatives(&rational.surface());
    check_derivatives(&torus().surface());
}

fn check_derivatives<P: SurfacePoint<Scalar = f64, Point = DVec3>>(surface: &BSplineSurface<P>) {
    let h = 1e-5;
    for [u, v] in places(surface) {
        let all = surface.derivatives::<4>(u, v);
        let [before_u, after_u] = [u - h, u + h].map(|u| surface.derivatives::<4>(u, v));
        let [before_v, after_v] = [v - h, v + h].map(|v| surface.derivatives::<4>(u, v));
        for (a, b) in (0..3).flat_map(|a| (0..3 - a).map(move |b| (a, b))) {
            let by_u = (after_u[a][b] - before_u[a][b]) / (2.0 * h);
            let by_v = (after_v[a][b] - before_v[a][b]) / (2.0 * h);
            let size = 1.0 + all.iter().flatten().map(|d| d.length()).fold(0.0, f64::max);
            assert!((all[a + 1][b] - by_u).length() < 1e-6 * size, "{a} {b} at {u} {v}");
            assert!((all[a][b + 1] - by_v).length() < 1e-6 * size, "{a} {b} at {u} {v}");
        }
        let jet = surface.at(u, v);
        assert_eq!(jet.point, all[0][0]);
        assert!((jet.duv - all[1][1]).length() < 1e-12 * (1.0 + jet.duv.length()));
        assert!((surface.point(u, v) - jet.point).length() < 1e-13);
    }
}

/// The same from the existing Bezier surface, from the general one and from the Bernstein polynomials.
#[test]
fn a_bezier_surface_is_a_spline_without_inner_knots() {
    let points: Vec<DVec3> = (0..20).map(anywhere).collect();
    let (bezier, general) = (BezierSurface::new(&points, 5).unwrap(), BSplineSurface::bezier(&points, 5).unwrap());
    for [u, v] in places(&general) {
        let (a, b) = (bezier.at(u, v), general.at(u, v));
        assert!((a.point - b.point).length() < 1e-13 && (a.du - b.du).length() < 1e-12);
        assert!((a.duu - b.duu).length() + (a.duv - b.duv).length() + (a.dvv - b.dvv).length() < 1e-11);
        assert!((bezier.normal(u, v) - general.normal(u, v)).length() < 1e-12);
    }
}

/// A grid has the points of its pairs of parameters, whatever their order.
#[test]
fn grids_are_the_same_points() {
    let mut us: Vec<f64> = (0..37).map(|i| f64::from(i) / 36.0).collect();
    us.extend([0.7, 0.1, -0.2, 1.3]);
    let vs = [0.0, 0.3, 1.0, 1.9, 2.0, 0.4];
    let mut points = vec![DVec3::ZERO; us.len() * vs.len()];
    for surface in [rational(), sphere(), rational().elevated(Direction::V).unwrap()] {
        let surface = surface.surface();
        surface.sample(&us, &vs, &mut points).unwrap();
        for (k, point) in points.iter().enumerate() {
            let [u, v] = [us[k % us.len()], vs[k / us.len()]];
            assert!((surface.point(u, v) - *point).length() < 1e-13 * (1.0 + point.length()));
        }
    }
    assert!(wavy().surface().sample(&us, &vs, &mut points[1..]).is_err());
    assert!(wavy().surface().sample(&[], &vs, &mut []).is_ok());
}

/// A knot that was put in comes out again; another one leaves a surface as far away as is said.
#[test]
fn knots_are_removed() {
    for direction in [Direction::U, Direction::V] {
        let (surface, knot) = (rational(), 0.55);
        let more = surface.with_knots(direction, &[knot]).unwrap();
        let (less, distance) = more.without_knot(direction, knot).unwrap();
        assert!(distance < 1e-14, "{distance}");
        for [u, v] in places(&surface.surface()) {
            assert!((surface.surface().point(u, v) - less.surface().point(u, v)).length() < 1e-13);
        }
    }
    let surface = wavy();
    let (less, distance) = surface.without_knot(Direction::U, 0.4).unwrap();
    let apart = places(&surface.surface()).into_iter();
    let apart = apart.map(|[u, v]| (surface.surface().point(u, v) - less.surface().point(u, v)).length());
    let worst = apart.fold(0.0, f64::max);
    assert!(0.1 * distance < worst && worst <= distance, "{worst} of {distance}");
    assert!(matches!(surface.without_knot(Direction::U, 0.5), Err(SplineError::Parameter { .. })));
}

/// Corners, tangents and twists make a patch and come back; it has them as derivatives.
#[test]
fn hermite_patches() {
    let corner = |k: usize| HermiteCorner {
        point: DVec3::new((k % 2) as f64, (k / 2) as f64, 0.0) + 0.2 * anywhere(k),
        du: DVec3::X + anywhere(k + 4),
        dv: DVec3::Y + anywhere(k + 8),
        duv: anywhere(k + 12),
    };
    let corners = [[corner(0), corner(1)], [corner(2), corner(3)]];
    let points = hermite_patch(corners);
    let patch = BezierSurface::new(&points, 4).unwrap();
    let back = hermite_corners(&points);
    for (j, i) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let (at, is) = (patch.at(i as f64, j as f64), corners[j][i]);
        let of_patch = HermiteCorner { point: at.point, du: at.du, dv: at.dv, duv: at.duv };
        for found in [of_patch, back[j][i]] {
            let pairs = [(found.point, is.point), (found.du, is.du), (found.dv, is.dv), (found.duv, is.duv)];
            assert!(pairs.into_iter().all(|(a, b)| (a - b).length() < 1e-13), "{found:?} {is:?}");
        }
    }
}

/// The nearest surface to points of a surface is that one; to what is left over from a fit, it is zero.
#[test]
fn nearest_surfaces_to_points() {
    let surface = wavy();
    let ([us, vs], [p, q]) = ([12, 9].map(|count| (0..count).map(move |k| k as f64 / (count - 1) as f64)), [3, 2]);
    let (us, vs): (Vec<f64>, Vec<f64>) = (us.collect(), vs.map(|v| 2.0 * v).collect());
    let knots = || [Direction::U, Direction::V].map(|d| surface.surface().knots(d).knots().to_vec());
    let mut points = vec![DVec3::ZERO; us.len() * vs.len()];
    surface.surface().sample(&us, &vs, &mut points).unwrap();
    let (same, distance) = OwnedSurface::near(knots(), [p, q], [&us, &vs], &points).unwrap();
    assert!(distance < 1e-14 && same.points().iter().zip(surface.points()).all(|(a, b)| (a - b).length() < 1e-12));

    let noisy: Vec<DVec3> = points.iter().enumerate().map(|(k, &point)| point + 0.1 * anywhere(k)).collect();
    let (nearest, distance) = OwnedSurface::near(knots(), [p, q], [&us, &vs], &noisy).unwrap();
    let noise = noisy.iter().zip(&points).map(|(noisy, point)| (noisy - point).length_squared()).sum::<f64>();
    let noise = (noise / points.len() as f64).sqrt();
    assert!(0.5 * noise < distance && distance < noise, "{distance} of {noise}");
    nearest.surface().sample(&us, &vs, &mut points).unwrap();
    let left: Vec<DVec3> = noisy.iter().zip(&points).map(|(noisy, point)| noisy - point).collect();
    let (zero, _) = OwnedSurface::near(knots(), [p, q], [&us, &vs], &left).unwrap();
    assert!(zero.points().iter().all(|point| point.length() < 1e-12));
    let few = OwnedSurface::near(knots(), [p, q], [&us, &vs], &left[1..]).unwrap_err();
    assert_eq!(few, SplineError::PointCount { points: 107, wanted: 108 });
}

/// Knots as often as the degree change nothing.
#[test]
fn pieces_are_the_surface() {
    check_decomposed(&wavy());
    check_decomposed(&rational());
    check_decomposed(&torus());
}

fn check_decomposed<P: SurfacePoint<Scalar = f64, Point = DVec3>>(surface: &OwnedSurface<P>) {
    let pieces = surface.decomposed();
    let [whole, pieces] = [surface.surface(), pieces.surface()];
    for direction in [Direction::U, Direction::V] {
        let knots = pieces.knots(direction);
        assert!(knots.spans().all(|span| knots.multiplicity(knots.knots()[span]) >= knots.degree()));
    }
    for [u, v] in places(&whole) {
        assert!((whole.point(u, v) - pieces.point(u, v)).length() < 1e-14);
        assert!((whole.normal(u, v) - pieces.normal(u, v)).length() < 1e-12);
    }
}

/// Pieces in powers of the parameters are the same surface, with its tangents, inside and outside of its domain.
#[test]
fn bicubic_pieces_are_the_same_surface() {
    for surface in [rational(), sphere(), torus()] {
        let surface = surface.surface();
        let mut memory = vec![Bicubic::default(); Bicubics::count(&surface)];
        let pieces = Bicubics::new(&surface, &mut memory).unwrap();
        let [[u0, u1], [v0, v1]] = surface.domain();
        let corners = [[u0, v0], [u1, v0], [u0, v1], [u1, v1], [u1 + 0.1, v0 - 0.1]];
        for [u, v] in places(&surface).into_iter().chain(corners) {
            let (exact, found) = (surface.tangents(u, v), pieces.tangents(u, v));
            for (exact, found) in exact.into_iter().zip(found) {
                assert!((exact - found).length() < 1e-12 * (1.0 + exact.length()), "{exact} {found} at {u}, {v}");
            }
            assert!((pieces.point(u, v) - exact[0]).length() < 1e-12 * (1.0 + exact[0].length()));
        }
    }
    let (surface, mut memory) = (rational(), [Bicubic::default(); 2]);
    let wanted = Bicubics::count(&surface.surface());
    assert_eq!(
        Bicubics::new(&surface.surface(), &mut memory).unwrap_err(),
        SplineError::PointCount { points: 2, wanted }
    );
    let steep = surface.elevated(Direction::U).unwrap();
    assert_eq!(Bicubics::new(&steep.surface(), &mut memory).unwrap_err(), SplineError::Degree { degree: 4 });
}

/// Weights sum to one, move with their points, and points lie in the box around them.
#[test]
fn partition_of_unity_affine_invariance_and_convex_hull() {
    let surface = rational();
    let still = surface.points().iter().map(|p| Homogeneous::new(DVec3::ONE, p.weight)).collect::<Vec<_>>();
    let map = |p: DVec3| DVec3::new(2.0 * p.x - p.z + 3.0, p.y + 0.5 * p.x, p.z - 4.0 * p.y - 1.0);
    let moved = surface.points().iter().map(|p| Homogeneous::new(map(p.project()), p.weight)).collect::<Vec<_>>();
    let (mut one, mut other) = (surface.clone(), surface.clone());
    one.set_points(&still).unwrap();
    other.set_points(&moved).unwrap();
    let [low, high] = surface.surface().bounds();
    for [u, v] in places(&surface.surface()) {
        assert!((one.surface().point(u, v) - DVec3::ONE).length() < 1e-14);
        let point = surface.surface().point(u, v);
        assert!((other.surface().point(u, v) - map(point)).length() < 1e-12);
        assert!(point.cmpge(low - 1e-12).all() && point.cmple(high + 1e-12).all());
    }
}

#[test]
fn a_finer_net_of_a_higher_degree_is_the_same_surface() {
    let surface = rational();
    let finer =
        surface.with_knots(Direction::U, &[0.2, 0.4, 0.55]).unwrap().with_knots(Direction::V, &[0.3, 1.7]).unwrap();
    let higher = finer.elevated(Direction::V).unwrap().elevated(Direction::U).unwrap();
    let transposed = higher.transposed();
    for [u, v] in places(&surface.surface()) {
        let point = surface.surface().point(u, v);
        for other in [&finer, &higher] {
            assert!((other.surface().point(u, v) - point).length() < 1e-12);
        }
        assert!((transposed.surface().point(v, u) - point).length() < 1e-12);
        assert!((surface.isocurve(Direction::U, v).curve().point(u) - point).length() < 1e-13);
        assert!((surface.isocurve(Direction::V, u).curve().point(v) - point).length() < 1e-13);
        for (direction, t) in [(Direction::U, 0.33), (Direction::V, 0.9)] {
            let parts = surface.split(direction, t).unwrap();
            let part = &parts[usize::from([u, v][direction as usize] > t)];
            assert!((part.surface().point(u, v) - point).length() < 1e-12);
        }
    }
    assert!(surface.with_knots(Direction::U, &[1.5]).is_err() && surface.split(Direction::V, 2.0).is_err());
}

/// Revolution makes circles: in double precision within 4 roundings of the radius, in single precision too.
#[test]
fn a_turned_line_is_a_cylinder() {
    let line = [DVec3::new(0.7, 0.0, 0.0), DVec3::new(0.7, 0.0, 2.0)];
    let all = [0.0, 0.0, 1.0, 1.0];
    let surface = revolution(&BSpline::new(knots(&all, 1), &line).unwrap(), Z, TAU).unwrap();
    let line = line.map(|p| p.as_vec3());
    let single = [0.0, 0.0, 1.0, 1.0];
    let axis = Axis { origin: Vec3::ZERO, direction: Vec3::Z };
    let curve = BSpline::new(KnotVector::new(&single, 1).unwrap(), &line).unwrap();
    let single = revolution(&curve, axis, core::f32::consts::TAU).unwrap();
    for step in 0..=4000 {
        let u = step as f64 / 1000.0;
        let point = surface.surface().point(u, 0.3);
        let off = (point.x.hypot(point.y) - 0.7).abs() / (0.7 * f64::EPSILON);
        let point = single.surface().point(u as f32, 0.3);
        let off_single = (point.x.hypot(point.y) - 0.7).abs() / (0.7 * f32::EPSILON);
        assert!(off <= 4.0 && off_single <= 4.0, "{off} and {off_single} roundings at {u}");
    }
    let [first, last] = [0.0, 4.0].map(|u| surface.surface().point(u, 0.6));
    assert_eq!(first, last);
    let part = revolution(&curve, axis, 1.9).unwrap();
    let [_, [_, _]] = part.surface().domain();
    let end = part.surface().point(part.surface().domain()[0][1], 0.0);
    assert!((end.y.atan2(end.x) - 1.9).abs() < 1e-6);
}

#[test]
fn curvature_of_sphere_torus_and_saddle() {
    let sphere = sphere();
    for [u, v] in places(&sphere.surface()) {
        let point = sphere.surface().point(u, v);
        assert!((point.length() - 2.0).abs() < 1e-14 * 4.0);
        assert!((sphere.surface().normal(u, v) - point / 2.0).length() < 1e-12);
        let Curvature { gaussian, mean, principal } = sphere.surface().curvature(u, v);
        // The front is outside, from which the sphere bends away.
        assert!((gaussian - 0.25).abs() < 1e-9 && (mean + 0.5).abs() < 1e-9, "{gaussian} {mean}");
        assert!((principal[0] + 0.5).abs() < 1e-4 && (principal[1] + 0.5).abs() < 1e-4);
    }
    let torus = torus();
    for [u, v] in places(&torus.surface()) {
        let point = torus.surface().point(u, v);
        let cosine = point.x.hypot(point.y) - 3.0;
        let around = cosine / (3.0 + cosine);
        let Curvature { gaussian, mean, .. } = torus.surface().curvature(u, v);
        assert!((gaussian - around).abs() < 1e-9 && (mean + 0.5 * (1.0 + around)).abs() < 1e-9, "{gaussian} {mean}");
    }
    // z = x y has K = -1 and H = 0 at the origin.
    let saddle = [DVec3::new(-1., -1., 1.), DVec3::new(1., -1., -1.), DVec3::new(-1., 1., -1.), DVec3::new(1., 1., 1.)];
    let Curvature { gaussian, mean, principal } = BSplineSurface::bezier(&saddle, 2).unwrap().curvature(0.5, 0.5);
    assert!((gaussian + 1.0).abs() < 1e-14 && mean.abs() < 1e-14 && (principal[0] - 1.0).abs() < 1e-14);
}

/// At a pole the derivative around it vanishes; the normal is still that of the sphere.
#[test]
fn normals_at_poles_and_collapsed_edges() {
    let sphere = sphere();
    for step in 0..=40 {
        let u = step as f64 / 10.0;
        for (v, pole) in [(0.0, DVec3::NEG_Z), (2.0, DVec3::Z)] {
            assert!((sphere.surface().normal(u, v) - pole).length() < 1e-7);
            for near in [1e-4, 1e-6, 1e-8, 1e-10] {
                let v = if v == 0.0 { near } else { v - near };
                let point = sphere.surface().point(u, v);
                assert!((sphere.surface().normal(u, v) - point / 2.0).length() < 1e-6, "{near} from a pole at {u}");
            }
        }
    }
    // A triangle as a bilinear surface with two equal corners.
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Y];
    let triangle = BSplineSurface::bezier(&corners, 2).unwrap();
    assert_eq!(triangle.normal(0.3, 1.0), DVec3::Z);
    // All points equal: there is no normal, and nothing fails.
    assert_eq!(BSplineSurface::bezier(&[DVec3::X; 9], 3).unwrap().normal(0.2, 0.4), DVec3::ZERO);
}

#[test]
fn extrusion_ruled_loft_and_coons() {
    let points: Vec<DVec3> = (0..5).map(|k| DVec3::X * k as f64 + 0.2 * anywhere(k)).collect();
    let all = [0.0, 0.0, 0.0, 0.3, 0.6, 1.0, 1.0, 1.0];
    let curve = BSpline::new(knots(&all, 2), &points).unwrap();
    let other_points: Vec<DVec3> =
        (0..4).map(|k| DVec3::new(1.3 * k as f64, 2.0, 0.0) + 0.2 * anywhere(k + 9)).collect();
    let other_knots = [2.0, 2.0, 2.0, 2.0, 6.0, 6.0, 6.0, 6.0];
    let other = BSpline::new(knots(&other_knots, 3), &other_points).unwrap();
    let extruded = extrusion(&curve, DVec3::new(0.1, 0.2, 3.0)).unwrap();
    let between = ruled(&curve, &other).unwrap();
    let sections =
        [0.0, 1.0, 2.5, 3.0].map(|y| points.iter().map(|&p| p * (1.0 + 0.1 * y) + DVec3::Y * y).collect::<Vec<_>>());
    let sections = sections.each_ref().map(|points| BSpline::new(knots(&all, 2), points).unwrap());
    let skin = loft(&sections, 3).unwrap();
    for step in 0..=20 {
        let t = step as f64 / 20.0;
        let (a, b) = (curve.point(t), other.point(2.0 + 4.0 * t));
        assert!((extruded.surface().point(t, 0.5) - a - DVec3::new(0.05, 0.1, 1.5)).length() < 1e-13);
        assert!((between.surface().point(t, 0.25) - a.lerp(b, 0.25)).length() < 1e-13);
        assert!((skin.surface().point(t, 0.0) - sections[0].point(t)).length() < 1e-12);
        assert!((skin.surface().point(t, 1.0) - sections[3].point(t)).length() < 1e-12);
    }
    // Each section lies on the skin.
    let target = sections[1].point(0.4);
    assert!(skin.surface().nearest(target).distance < 1e-9);
    let left_points = [points[0], points[0] + DVec3::new(0.5, 1.0, 1.0), other_points[0]];
    let right_points = [points[4], points[4] + DVec3::Y, other_points[3]];
    let quadratic = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
    let [left, right] = [&left_points, &right_points].map(|points| BSpline::new(knots(&quadratic, 2), points).unwrap());
    let patch = coons([&curve, &right, &other, &left]).unwrap();
    for step in 0..=20 {
        let t = step as f64 / 20.0;
        let at = |u: f64, v: f64| patch.surface().point(u, v);
        let [bottom, top] = [curve.point(t), other.point(2.0 + 4.0 * t)];
        assert!((at(t, 0.0) - bottom).length() < 1e-12 && (at(t, 1.0) - top).length() < 1e-12);
        assert!((at(0.0, t) - left.point(t)).length() < 1e-12 && (at(1.0, t) - right.point(t)).length() < 1e-12);
        let bilinear = points[0].lerp(points[4], t).lerp(other_points[0].lerp(other_points[3], t), 0.5);
        let blended = bottom.lerp(top, 0.5) + left.point(0.5).lerp(right.point(0.5), t) - bilinear;
        assert!((at(t, 0.5) - blended).length() < 1e-12);
    }
    let wrong = coons([&curve, &left, &other, &right]);
    assert!(matches!(wrong, Err(SplineError::Corner { .. })), "{wrong:?}");
}

#[test]
fn surfaces_go_through_rows_of_points() {
    let points: Vec<DVec3> =
        (0..6 * 5).map(|k| DVec3::new((k % 6) as f64, (k / 6) as f64, 0.0) + 0.2 * anywhere(k)).collect();
    for degrees in [[3, 3], [2, 4], [1, 1], [5, 3]] {
        let surface = OwnedSurface::through(&points, 6, degrees).unwrap();
        for &point in &points {
            assert!(surface.surface().nearest(point).distance < 1e-9);
        }
    }
    // Those of a plane give the plane.
    let flat: Vec<DVec3> = (0..20).map(|k| DVec3::new((k % 4) as f64, (k / 4) as f64, (k % 4) as f64 * 0.5)).collect();
    let plane = OwnedSurface::through(&flat, 4, [3, 2]).unwrap();
    for [u, v] in places(&plane.surface()) {
        let point = plane.surface().point(u, v);
        assert!((point.z - 0.5 * point.x).abs() < 1e-13);
        assert!((plane.surface().normal(u, v) - DVec3::new(-0.5, 0.0, 1.0).normalize()).length() < 1e-12);
    }
    assert_eq!(OwnedSurface::through(&points, 7, [3, 3]), Err(SplineError::Ragged { points: 30, columns: 7 }));
    assert!(OwnedSurface::through(&points, 6, [6, 3]).is_err());
    assert!(OwnedSurface::through(&points, 6, [3, 5]).is_err());
    assert!(OwnedSurface::through(&[points[0]; 20], 4, [3, 3]).is_err());
}

#[test]
fn rays_meet_spheres_and_tori_where_the_closed_forms_say() {
    let (sphere, torus) = (sphere(), torus());
    let mut hits = 0;
    for k in 0..300 {
        let origin = 8.0 * anywhere(3 * k).normalize();
        let direction = 2.6 * anywhere(3 * k + 1) - origin;
        let expected = sphere_hit(origin, direction);
        let found = sphere.surface().ray(origin, direction);
        assert_eq!(found.is_some(), expected.is_some(), "ray {k}");
        if let (Some(found), Some(expected)) = (found, expected) {
            assert!((found.distance - expected).abs() < 1e-9, "{} is not {expected}", found.distance);
            let [u, v] = found.parameters;
            assert!((sphere.surface().point(u, v) - origin - direction * found.distance).length() < 1e-8);
        }
        let found = torus.surface().ray(origin, direction).map(|hit| hit.distance);
        let expected = torus_hit(origin, direction);
        assert_eq!(found.is_some(), expected.is_some(), "ray {k}: {found:?} is not {expected:?}");
        if let (Some(found), Some(expected)) = (found, expected) {
            assert!((found - expected).abs() < 1e-7, "{found} is not {expected}");
            hits += 1;
        }
    }
    assert!(hits > 50);
    let along_axis = sphere.surface().ray(DVec3::new(0.0, 0.0, 9.0), DVec3::NEG_Z).unwrap();
    assert!((along_axis.distance - 7.0).abs() < 1e-6);
    assert!(sphere.surface().ray(DVec3::ZERO, DVec3::ZERO).is_none());
}

fn sphere_hit(origin: DVec3, direction: DVec3) -> Option<f64> {
    let (a, b, c) = (direction.length_squared(), origin.dot(direction), origin.length_squared() - 4.0);
    let root = (b * b - a * c).sqrt();
    [(-b - root) / a, (-b + root) / a].into_iter().find(|&t| t >= 0.0)
}

/// By marching in small steps and bisection on the implicit form.
fn torus_hit(origin: DVec3, direction: DVec3) -> Option<f64> {
    let value = |t: f64| {
        let p = origin + direction * t;
        (p.x.hypot(p.y) - 3.0).powi(2) + p.z * p.z - 1.0
    };
    let steps = 40_000;
    let first = (0..steps).find(|&k| {
        let [t, next] = [k, k + 1].map(|k| 3.0 * k as f64 / steps as f64);
        (value(t) > 0.0) != (value(next) > 0.0)
    })?;
    let [mut low, mut high] = [first, first + 1].map(|k| 3.0 * k as f64 / steps as f64);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (value(middle) > 0.0) == (value(low) > 0.0) { low = middle } else { high = middle }
    }
    Some(low)
}

#[test]
fn nearest_points_lie_on_the_line_to_the_center() {
    let (sphere, torus, waves) = (sphere(), torus(), rational());
    for k in 0..40 {
        let target = 4.0 * anywhere(k);
        let found = sphere.surface().nearest(target);
        assert!((found.distance - (target.length() - 2.0).abs()).abs() < 1e-9, "{target}: {}", found.distance);
        let found = torus.surface().nearest(target);
        let expected = ((target.x.hypot(target.y) - 3.0).hypot(target.z) - 1.0).abs();
        assert!((found.distance - expected).abs() < 1e-3 * expected + 1e-9, "{target}: {} {expected}", found.distance);
        let surface = waves.surface();
        let found = surface.nearest(target);
        for [u, v] in places(&surface) {
            assert!((surface.point(u, v) - target).length() > found.distance * 0.999 - 1e-12);
        }
    }
}

#[test]
fn single_precision_agrees() {
    let double = wavy();
    let points: Vec<Vec3> = double.points().iter().map(|p| p.as_vec3()).collect();
    let all =
        [Direction::U, Direction::V].map(|d| double.surface().knots(d).knots().iter().map(|&k| k as f32).collect());
    let single = OwnedSurface::new(all, [3, 2], points).unwrap();
    for [u, v] in places(&double.surface()) {
        let (a, b) = (double.surface().at(u, v), single.surface().at(u as f32, v as f32));
        assert!((a.point.as_vec3() - b.point).length() < 1e-5 && (a.duv.as_vec3() - b.duv).length() < 1e-3);
    }
}

#[test]
fn errors_have_numbers() {
    let flat = [DVec3::ZERO; 6];
    assert_eq!(BSplineSurface::bezier(&flat, 4).unwrap_err(), SplineError::Ragged { points: 6, columns: 4 });
    assert_eq!(BSplineSurface::bezier(&flat[..0], 4).unwrap_err(), SplineError::Empty);
    assert_eq!(BSplineSurface::bezier(&[DVec3::NAN; 4], 2).unwrap_err(), SplineError::NotFinite { index: 0 });
    let weightless = [Homogeneous::new(DVec3::X, 1.0), Homogeneous::new(DVec3::X, 0.0)];
    assert_eq!(BSplineSurface::bezier(&weightless, 2).unwrap_err(), SplineError::Weight { index: 1, weight: 0.0 });
    let line = [0.0, 0.0, 1.0, 1.0];
    let wrong = BSplineSurface::new([knots(&line, 1), knots(&line, 1)], &flat).unwrap_err();
    assert_eq!(wrong, SplineError::PointCount { points: 6, wanted: 4 });
    let profile = BSpline::new(knots(&line, 1), &flat[..2]).unwrap();
    let axis = Axis { origin: DVec3::ZERO, direction: DVec3::ZERO };
    assert_eq!(revolution(&profile, axis, 1.0).unwrap_err(), SplineError::NoAxis);
    assert_eq!(revolution(&profile, Z, 7.0).unwrap_err(), SplineError::Turn { angle: 7.0 });
    assert!(loft(&[profile], 1).is_err() && loft(&[profile, profile], 1).is_err());
    let text = SplineError::Turn { angle: 7.0 }.to_string();
    assert!(text.contains("7 rad"), "{text}");
}

/// Whatever the parameter, the point or the ray, nothing panics.
#[test]
fn any_number_gives_a_result() {
    let surfaces = [rational(), sphere(), torus(), steps([0, 0]), steps([0, 1]), steps([2, 0])];
    for surface in surfaces.iter().map(OwnedSurface::surface) {
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1e300, 1e300, 5.0] {
            let _ = (surface.point(x, 0.5), surface.at(0.5, x), surface.normal(x, x), surface.curvature(x, 0.1));
            let _ = (surface.ray(DVec3::splat(x), DVec3::X), surface.ray(DVec3::ZERO, DVec3::splat(x)));
            let _ = surface.nearest(DVec3::splat(x));
            let _ = [Side::Bottom, Side::Right, Side::Top, Side::Left].map(|side| surface.edge(side, x));
            assert!(surface.sample(&[x, 0.2], &[x], &mut [DVec3::ZERO; 2]).is_ok());
        }
    }
}
