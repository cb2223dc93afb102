//! Points, normals and triangles of surfaces, beside `curvo` and `truck-geometry`: a thousand random parameters each.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use curvo::prelude::{AdaptiveTessellationOptions, NurbsSurface3D, Tessellation as _};
use glam::{DVec3, Vec3};
use nalgebra::Point4;
use radiosity::spline::*;
use truck_geometry::prelude::{
    BSplineSurface as TruckBSpline, KnotVec, NurbsSurface as TruckNurbs, ParameterDivision2D, ParametricSurface3D,
    Vector4,
};

/// Control points along `u` and `v`.
const SIZE: [usize; 2] = [8, 7];
const DEGREE: usize = 3;

/// Parameters in the unit square that look random.
fn parameters() -> Vec<[f64; 2]> {
    (1..=1000).map(|i| [(f64::from(i) * 0.618_033_988_7).fract(), (f64::from(i) * 0.754_877_666).fract()]).collect()
}

fn clamped(count: usize) -> Vec<f64> {
    let mut knots = vec![0.0; count + DEGREE + 1];
    clamped_knots(&mut knots, DEGREE);
    knots
}

/// A hilly surface, in rows along `u`.
fn control() -> Vec<Homogeneous<DVec3>> {
    (0..SIZE[0] * SIZE[1])
        .map(|k| {
            let [x, y] = [(k % SIZE[0]) as f64, (k / SIZE[0]) as f64];
            let weight = 1.0 + 0.3 * (1.3 * x + 0.7 * y).sin();
            Homogeneous::new(DVec3::new(x, y, (1.1 * x).sin() * (0.9 * y).cos()), weight)
        })
        .collect()
}

/// Columns of control points, as both others have them: the first index runs along `u`.
fn columns<T>(control: &[Homogeneous<DVec3>], make: impl Fn(DVec3, f64) -> T) -> Vec<Vec<T>> {
    let at = |i: usize, j: usize| control[j * SIZE[0] + i];
    let column = |i: usize| (0..SIZE[1]).map(|j| make(at(i, j).scaled, at(i, j).weight)).collect();
    (0..SIZE[0]).map(column).collect()
}

/// The same surface as each has it.
struct Same {
    own: OwnedSurface<Homogeneous<DVec3>>,
    single: OwnedSurface<Homogeneous<Vec3>>,
    curvo: NurbsSurface3D<f64>,
    truck: TruckNurbs<Vector4>,
}

fn same() -> Same {
    let control = control();
    let [u, v] = SIZE.map(clamped);
    let own = OwnedSurface::new([u.clone(), v.clone()], [DEGREE; 2], control.clone()).unwrap();
    let single = control.iter().map(|p| Homogeneous { scaled: p.scaled.as_vec3(), weight: p.weight as f32 }).collect();
    let knots = [&u, &v].map(|knots| knots.iter().map(|&k| k as f32).collect());
    let single = OwnedSurface::new(knots, [DEGREE; 2], single).unwrap();
    let points = columns(&control, |p, w| Point4::new(p.x, p.y, p.z, w));
    let curvo = NurbsSurface3D::new(DEGREE, DEGREE, u.clone(), v.clone(), points);
    let points = columns(&control, |p, w| Vector4::new(p.x, p.y, p.z, w));
    let truck = TruckNurbs::new(TruckBSpline::new((KnotVec::from(u), KnotVec::from(v)), points));
    let [a, b] = [own.surface().point(0.3, 0.6), own.surface().normal(0.3, 0.6)];
    let (p, q, n) = (curvo.point_at(0.3, 0.6), truck.subs(0.3, 0.6), truck.normal(0.3, 0.6));
    assert!((a - DVec3::new(p.x, p.y, p.z)).length() + (a - DVec3::new(q.x, q.y, q.z)).length() < 1e-12);
    assert!((b - DVec3::new(n.x, n.y, n.z)).length() < 1e-12);
    Same { own, single, curvo, truck }
}

fn points(c: &mut Criterion) {
    let (Same { own, single, curvo, truck }, uv) = (same(), parameters());
    let (own, single) = (own.surface(), single.surface());
    let mut group = c.benchmark_group("bicubic NURBS surface, 8 x 7 points: 1000 points");
    group.bench_function("radiosity f64", |b| b.iter(|| uv.iter().for_each(|&[u, v]| _ = black_box(own.point(u, v)))));
    group.bench_function("radiosity f32", |b| {
        b.iter(|| uv.iter().for_each(|&[u, v]| _ = black_box(single.point(u as f32, v as f32))));
    });
    group.bench_function("curvo", |b| b.iter(|| uv.iter().for_each(|&[u, v]| _ = black_box(curvo.point_at(u, v)))));
    group.bench_function("truck", |b| b.iter(|| uv.iter().for_each(|&[u, v]| _ = black_box(truck.subs(u, v)))));
    group.finish();
}

fn normals(c: &mut Criterion) {
    let (Same { own, curvo, truck, .. }, uv) = (same(), parameters());
    let own = own.surface();
    let mut group = c.benchmark_group("bicubic NURBS surface, 8 x 7 points: 1000 normals");
    group.bench_function("radiosity f64", |b| b.iter(|| uv.iter().for_each(|&[u, v]| _ = black_box(own.normal(u, v)))));
    group.bench_function("curvo", |b| b.iter(|| uv.iter().for_each(|&[u, v]| _ = black_box(curvo.normal_at(u, v)))));
    group.bench_function("truck", |b| b.iter(|| uv.iter().for_each(|&[u, v]| _ = black_box(truck.normal(u, v)))));
    group.finish();
}

/// Each as it is made to be used: the numbers of triangles stand beside the times.
fn tessellation(c: &mut Criterion) {
    let Same { own, curvo, truck, .. } = same();
    let mut group = c.benchmark_group("bicubic NURBS surface, 8 x 7 points: tessellation");
    let tolerance = Tolerance::new(5e-3, 0.2).unwrap();
    let cut = || tessellate(&own.surface(), &tolerance, ChartScale::Area);
    group.bench_function(format!("radiosity, 5 mm, {} triangles", cut().triangles.len()), |b| b.iter(cut));
    let default = || curvo.tessellate(Some(AdaptiveTessellationOptions::<f64>::default()));
    group.bench_function(format!("curvo, by default, {} triangles", default().faces().len()), |b| b.iter(default));
    let grid = || {
        let (us, vs) = truck.parameter_division(((0.0, 1.0), (0.0, 1.0)), 5e-3);
        let at = vs.iter().flat_map(|&v| us.iter().map(move |&u| (u, v)));
        let vertices: Vec<_> = at.map(|(u, v)| (truck.subs(u, v), truck.normal(u, v))).collect();
        (2 * (us.len() - 1) * (vs.len() - 1), vertices)
    };
    group.bench_function(format!("truck's grid, 5 mm, {} triangles", grid().0), |b| b.iter(grid));
    group.finish();
}

criterion_group!(benches, points, normals, tessellation);
criterion_main!(benches);
