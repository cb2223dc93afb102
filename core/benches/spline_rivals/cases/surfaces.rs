//! Points, normals and triangles of surfaces.

use std::hint::black_box;

use curvo::prelude::{AdaptiveTessellationOptions, NurbsSurface3D, Tessellation as _};
use glam::{DVec3, Vec3};
use nalgebra::Point4;
use radiosity::spline::*;
use truck_geometry::prelude::{
    BSplineSurface as TruckBSpline, KnotVec, NurbsSurface as TruckNurbs, ParameterDivision2D, ParametricSurface3D,
    Vector4,
};

use super::{Case, forever};

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

pub fn cases() -> Vec<Case> {
    let Same { own, single, curvo, truck } = forever(same());
    let decomposed = forever(own.decomposed()).surface();
    let (own, single, uv) = (own.surface(), single.surface(), parameters());
    let (us, vs): (Vec<f64>, Vec<f64>) =
        ((0..40).map(share).collect(), (0..25).map(|k| share(k) * 39.0 / 24.0).collect());
    let grid: Vec<[f64; 2]> = vs.iter().flat_map(|&v| us.iter().map(move |&u| [u, v])).collect();
    let title = |what: &str| format!("bicubic NURBS surface, 8 x 7 points: {what}");
    let mut points = vec![DVec3::ZERO; grid.len()];
    let pieces = Bicubics::new(&own, vec![Bicubic::default(); Bicubics::count(&own)].leak()).unwrap();
    vec![
        Case::new(&title("1000 points anywhere"))
            .call("radiosity Bicubics", &uv, move |[u, v]| pieces.point(u, v))
            .call("radiosity", &uv, move |[u, v]| own.point(u, v))
            .call("radiosity, decomposed", &uv, move |[u, v]| decomposed.point(u, v))
            .call("radiosity, f32", &uv, move |[u, v]| single.point(u as f32, v as f32))
            .call("curvo", &uv, |[u, v]| curvo.point_at(u, v))
            .call("truck-geometry", &uv, |[u, v]| truck.subs(u, v)),
        Case::new(&title("1000 points of a grid"))
            .call("radiosity, sample", &[0], move |_| own.sample(&us, &vs, black_box(&mut points)))
            .call("radiosity, point by point", &grid, move |[u, v]| own.point(u, v))
            .call("curvo", &grid, |[u, v]| curvo.point_at(u, v))
            .call("truck-geometry", &grid, |[u, v]| truck.subs(u, v)),
        Case::new(&title("1000 normals"))
            .call("radiosity Bicubics", &uv, move |[u, v]| {
                let [_, du, dv] = pieces.tangents(u, v);
                du.cross(dv).normalize_or_zero()
            })
            .call("radiosity", &uv, move |[u, v]| own.normal(u, v))
            .call("curvo", &uv, |[u, v]| curvo.normal_at(u, v))
            .call("truck-geometry", &uv, |[u, v]| truck.normal(u, v)),
        tessellation(Case::new(&title("triangles"))),
    ]
}

fn share(k: u32) -> f64 {
    f64::from(k) / 39.0
}

/// Each as it is made to be used: the numbers of triangles stand beside the times.
fn tessellation(case: Case) -> Case {
    let Same { own, curvo, truck, .. } = forever(same());
    let tolerance = Tolerance::new(5e-3, 0.2).unwrap();
    let cut = move || tessellate(&own.surface(), &tolerance, ChartScale::Area);
    let default = || curvo.tessellate(Some(AdaptiveTessellationOptions::<f64>::default()));
    let grid = || {
        let (us, vs) = truck.parameter_division(((0.0, 1.0), (0.0, 1.0)), 5e-3);
        let at = vs.iter().flat_map(|&v| us.iter().map(move |&u| (u, v)));
        let vertices: Vec<_> = at.map(|(u, v)| (truck.subs(u, v), truck.normal(u, v))).collect();
        (2 * (us.len() - 1) * (vs.len() - 1), vertices)
    };
    let counts = [cut().triangles.len(), default().faces().len(), grid().0];
    case.call(&format!("radiosity, 5 mm, {} triangles", counts[0]), &[0], move |_| cut())
        .call(&format!("curvo, by default, {} triangles", counts[1]), &[0], move |_| default())
        .call(&format!("truck-geometry's grid, 5 mm, {} triangles", counts[2]), &[0], move |_| grid())
}
