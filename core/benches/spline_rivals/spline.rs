//! Points, derivatives and lengths of curves, beside `bevy_math`, `kurbo`, `uniform-cubic-splines`, `curvo` and
//! `truck-geometry`: a thousand random parameters each.

use std::hint::black_box;

use bevy_math::cubic_splines::{CubicBSpline, CubicGenerator};
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, criterion_group, criterion_main};
use curvo::prelude::NurbsCurve3D;
use glam::{DVec2, DVec3, Vec3};
use kurbo::{CubicBez, ParamCurve, ParamCurveArclen, ParamCurveDeriv};
use nalgebra::{Point3, Point4};
use radiosity::spline::*;
use truck_geometry::prelude::{BSplineCurve, KnotVec, NurbsCurve, ParametricCurve, Vector4};
use uniform_cubic_splines::basis::Bspline;
use uniform_cubic_splines::spline;

/// Numbers in `[0, 1)` that look random: the golden ratio's multiples.
fn numbers(count: usize) -> Vec<f64> {
    (1..=count).map(|i| (i as f64 * 0.618_033_988_749_894_8).fract()).collect()
}

fn points(count: usize) -> Vec<DVec3> {
    let numbers = numbers(3 * count);
    (0..count)
        .map(|i| DVec3::new(i as f64 + numbers[3 * i], 5.0 * numbers[3 * i + 1], 5.0 * numbers[3 * i + 2]))
        .collect()
}

/// The time of a thousand calls.
fn time<T: Copy, R>(group: &mut BenchmarkGroup<WallTime>, name: &str, arguments: &[T], call: impl Fn(T) -> R) {
    group.bench_function(name, |bench| {
        bench.iter(|| {
            for &argument in arguments {
                black_box(call(black_box(argument)));
            }
        });
    });
}

/// One cubic in the plane, f64.
fn bezier(c: &mut Criterion) {
    let t = numbers(1000);
    let corners = [DVec2::new(0.0, 0.0), DVec2::new(1.0, 3.0), DVec2::new(4.0, -1.0), DVec2::new(5.0, 2.0)];
    let own = Bezier::new(&corners).unwrap();
    let cubic = Cubic::from_bezier(corners);
    let [a, b, p, q] = corners.map(|p| kurbo::Point::new(p.x, p.y));
    let theirs = CubicBez::new(a, b, p, q);
    let mut group = c.benchmark_group("cubic Bezier, f64, 2-D: point");
    time(&mut group, "radiosity Bezier", &t, |t| own.point(t));
    time(&mut group, "radiosity Cubic", &t, |t| cubic.point(t));
    time(&mut group, "kurbo", &t, |t| theirs.eval(t));
    group.finish();
    let mut group = c.benchmark_group("cubic Bezier, f64, 2-D: point and first derivative");
    time(&mut group, "radiosity Bezier, second derivative too", &t, |t| own.at(t));
    time(&mut group, "radiosity Cubic, second derivative too", &t, |t| cubic.at(t));
    time(&mut group, "kurbo", &t, |t| (theirs.eval(t), theirs.deriv().eval(t)));
    group.finish();
    for tolerance in [1e-3, 1e-6, 1e-9] {
        let mut group = c.benchmark_group(format!("cubic Bezier, f64, 2-D: length to {tolerance:e}"));
        let all: Vec<[DVec2; 4]> = t.iter().map(|&t| corners.map(|p| p + DVec2::new(p.y, p.x * p.y) * t)).collect();
        time(&mut group, "radiosity Cubic", &all, |p| arc_length(&Cubic::from_bezier(p), [0.0, 1.0], tolerance));
        time(&mut group, "radiosity Bezier", &all, |p| arc_length(&Bezier::new(&p).unwrap(), [0.0, 1.0], tolerance));
        let theirs = |p: [DVec2; 4]| {
            let [a, b, c, d] = p.map(|p| kurbo::Point::new(p.x, p.y));
            CubicBez::new(a, b, c, d)
        };
        time(&mut group, "kurbo", &all, |p| theirs(p).arclen(tolerance));
        group.finish();
    }
}

/// A uniform cubic B-spline of 20 points.
fn uniform(c: &mut Criterion) {
    let control: Vec<Vec3> = points(20).iter().map(|p| p.as_vec3()).collect();
    let theirs =
        CubicBSpline::new(control.iter().map(|p| bevy_math::Vec3::from_array(p.to_array()))).to_curve().unwrap();
    let pieces: Vec<Cubic<Vec3>> = control.windows(4).map(|p| Cubic::from_bspline(p.try_into().unwrap())).collect();
    let own = Cubics::new(&pieces).unwrap();
    let knots: Vec<f32> = (0..24).map(|i| i as f32 - 3.0).collect();
    let spline_on_knots = BSpline::new(KnotVector::new(&knots, 3).unwrap(), &control).unwrap();
    let t: Vec<f32> = numbers(1000).iter().map(|&t| 17.0 * t as f32).collect();
    assert!((own.point(3.3).to_array()).iter().zip(theirs.position(3.3).to_array()).all(|(a, b)| (a - b).abs() < 1e-4));
    let mut group = c.benchmark_group("uniform cubic B-spline, f32, 3-D: point");
    time(&mut group, "radiosity Cubics", &t, |t| own.point(t));
    time(&mut group, "radiosity BSpline", &t, |t| spline_on_knots.point(t));
    time(&mut group, "bevy_math", &t, |t| theirs.position(t));
    group.finish();
    let mut group = c.benchmark_group("uniform cubic B-spline, f32, 3-D: first derivative");
    time(&mut group, "radiosity Cubics", &t, |t| own.at(t).first);
    time(&mut group, "bevy_math", &t, |t| theirs.velocity(t));
    group.finish();
    let heights: Vec<f64> = points(20).iter().map(|p| p.y).collect();
    let pieces: Vec<Cubic<f64>> = heights.windows(4).map(|p| Cubic::from_bspline(p.try_into().unwrap())).collect();
    let own = Cubics::new(&pieces).unwrap();
    assert!((own.point(0.3 * 17.0) - spline::<Bspline, _, _>(0.3, &heights).unwrap()).abs() < 1e-12);
    let t = numbers(1000);
    let mut group = c.benchmark_group("uniform cubic B-spline, f64, 1-D: point");
    time(&mut group, "radiosity Cubics", &t, |t| own.point(17.0 * t));
    time(&mut group, "uniform-cubic-splines", &t, |t| spline::<Bspline, _, _>(t, &heights));
    group.finish();
}

/// Curves on knots: degree, number of points.
fn nurbs(c: &mut Criterion) {
    for (degree, count) in [(3, 20), (2, 9), (7, 20)] {
        let control = points(count);
        let mut knots = vec![0.0; count + degree + 1];
        clamped_knots(&mut knots, degree);
        let weights: Vec<f64> = numbers(count).iter().map(|x| 0.5 + x).collect();
        let weighted: Vec<_> = control.iter().zip(&weights).map(|(&p, &w)| Homogeneous::new(p, w)).collect();
        let own = Nurbs::new(KnotVector::new(&knots, degree).unwrap(), &weighted).unwrap();
        let homogeneous = weighted.iter().map(|p| Point4::new(p.scaled.x, p.scaled.y, p.scaled.z, p.weight)).collect();
        let curvo = NurbsCurve3D::try_new(degree, homogeneous, knots.clone()).unwrap();
        let vectors = weighted.iter().map(|p| Vector4::new(p.scaled.x, p.scaled.y, p.scaled.z, p.weight)).collect();
        let truck = NurbsCurve::new(BSplineCurve::new(KnotVec::from(knots.clone()), vectors));
        let t = numbers(1000);
        let (a, b) = (own.point(0.3), curvo.point_at(0.3));
        assert!((a - DVec3::new(b.x, b.y, b.z)).length() < 1e-12);
        let mut group = c.benchmark_group(format!("NURBS of degree {degree}, {count} points, f64, 3-D: point"));
        time(&mut group, "radiosity", &t, |t| own.point(t));
        time(&mut group, "curvo", &t, |t| curvo.point_at(t));
        time(&mut group, "truck-geometry", &t, |t| truck.subs(t));
        group.finish();
        let mut group =
            c.benchmark_group(format!("NURBS of degree {degree}, {count} points, f64, 3-D: two derivatives"));
        time(&mut group, "radiosity", &t, |t| own.at(t));
        time(&mut group, "curvo", &t, |t| curvo.rational_derivatives(t, 2));
        time(&mut group, "truck-geometry", &t, |t| (truck.subs(t), truck.der(t), truck.der2(t)));
        group.finish();
        let mut group = c.benchmark_group(format!("NURBS of degree {degree}, {count} points, f64, 3-D: length"));
        time(&mut group, "radiosity, to 1e-6", &[0], |_| arc_length(&own, [0.0, 1.0], 1e-6));
        time(&mut group, "curvo", &[0], |_| curvo.try_length());
        group.finish();
        let mut group = c.benchmark_group(format!("NURBS of degree {degree}, {count} points, f64, 3-D: nearest point"));
        let to: Vec<DVec3> = points(10);
        time(&mut group, "radiosity", &to, |to| own.nearest(to));
        time(&mut group, "curvo", &to, |to| curvo.find_closest_point(&Point3::new(to.x, to.y, to.z)));
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(std::time::Duration::from_millis(200))
        .measurement_time(std::time::Duration::from_millis(500));
    targets = bezier, uniform, nurbs
}
criterion_main!(benches);
