//! Points, derivatives, lengths and nearest points of curves: a thousand random parameters each.

use bevy_math::cubic_splines::{CubicBSpline, CubicGenerator};
use curvo::prelude::NurbsCurve3D;
use glam::{DVec2, DVec3, Vec3};
use kurbo::{CubicBez, ParamCurve, ParamCurveArclen, ParamCurveDeriv, ParamCurveNearest};
use nalgebra::{Point3, Point4};
use radiosity::spline::*;
use truck_geometry::prelude::{BSplineCurve, KnotVec, NurbsCurve, ParametricCurve, Vector4};
use uniform_cubic_splines::basis::Bspline;
use uniform_cubic_splines::spline;

use super::{Case, forever, numbers};

pub fn cases() -> Vec<Case> {
    let degrees = [(3, 20), (2, 9), (7, 20)];
    [bezier(), uniform()].into_iter().chain(degrees.map(|(degree, count)| nurbs(degree, count))).flatten().collect()
}

fn points(count: usize) -> Vec<DVec3> {
    let numbers = numbers(3 * count);
    (0..count)
        .map(|i| DVec3::new(i as f64 + numbers[3 * i], 5.0 * numbers[3 * i + 1], 5.0 * numbers[3 * i + 2]))
        .collect()
}

/// One cubic in the plane, f64.
fn bezier() -> Vec<Case> {
    let t = numbers(1000);
    let corners = forever([DVec2::new(0.0, 0.0), DVec2::new(1.0, 3.0), DVec2::new(4.0, -1.0), DVec2::new(5.0, 2.0)]);
    let kurbo_of = |p: [DVec2; 4]| {
        let [a, b, c, d] = p.map(|p| kurbo::Point::new(p.x, p.y));
        CubicBez::new(a, b, c, d)
    };
    let (own, cubic, theirs) = (Bezier::new(corners).unwrap(), Cubic::from_bezier(*corners), kurbo_of(*corners));
    let to: Vec<DVec2> = points(100).iter().map(|p| DVec2::new(0.05 * p.x, p.y - 1.0)).collect();
    let mut cases = vec![
        Case::new("cubic Bezier, f64, 2-D: 1000 points")
            .call("radiosity Bezier", &t, move |t| own.point(t))
            .call("radiosity Cubic", &t, move |t| cubic.point(t))
            .call("kurbo", &t, move |t| theirs.eval(t)),
        Case::new("cubic Bezier, f64, 2-D: 1000 points with first derivatives")
            .call("radiosity Bezier, second ones too", &t, move |t| own.at(t))
            .call("radiosity Cubic, second ones too", &t, move |t| cubic.at(t))
            .call("kurbo", &t, move |t| (theirs.eval(t), theirs.deriv().eval(t))),
        Case::new("cubic Bezier, f64, 2-D: 100 nearest points")
            .call("radiosity Bezier", &to, move |to| own.nearest(to))
            .call("kurbo, to 1e-9", &to, move |to| theirs.nearest(kurbo::Point::new(to.x, to.y), 1e-9)),
    ];
    let all: Vec<[DVec2; 4]> = t.iter().map(|&t| corners.map(|p| p + DVec2::new(p.y, p.x * p.y) * t)).collect();
    for tolerance in [1e-3, 1e-6, 1e-9] {
        cases.push(
            Case::new(&format!("1000 cubic Beziers, f64, 2-D: length to {tolerance:e}"))
                .call("radiosity Cubic", &all, move |p| arc_length(&Cubic::from_bezier(p), [0.0, 1.0], tolerance))
                .call("radiosity Bezier", &all, move |p| arc_length(&Bezier::new(&p).unwrap(), [0.0, 1.0], tolerance))
                .call("kurbo", &all, move |p| kurbo_of(p).arclen(tolerance)),
        );
    }
    cases
}

/// A uniform cubic B-spline of 20 points.
fn uniform() -> Vec<Case> {
    let control = forever(points(20).iter().map(|p| p.as_vec3()).collect::<Vec<Vec3>>());
    let theirs =
        CubicBSpline::new(control.iter().map(|p| bevy_math::Vec3::from_array(p.to_array()))).to_curve().unwrap();
    let theirs = forever(theirs);
    let pieces =
        forever(control.windows(4).map(|p| Cubic::from_bspline(p.try_into().unwrap())).collect::<Vec<Cubic<Vec3>>>());
    let own = Cubics::new(pieces).unwrap();
    let knots = forever((0..24).map(|i| i as f32 - 3.0).collect::<Vec<f32>>());
    let spline_on_knots = BSpline::new(KnotVector::new(knots, 3).unwrap(), control).unwrap();
    let t: Vec<f32> = numbers(1000).iter().map(|&t| 17.0 * t as f32).collect();
    assert!((own.point(3.3).to_array()).iter().zip(theirs.position(3.3).to_array()).all(|(a, b)| (a - b).abs() < 1e-4));
    let heights = forever(points(20).iter().map(|p| p.y).collect::<Vec<f64>>());
    let scalar =
        forever(heights.windows(4).map(|p| Cubic::from_bspline(p.try_into().unwrap())).collect::<Vec<Cubic<f64>>>());
    let scalar = Cubics::new(scalar).unwrap();
    assert!((scalar.point(0.3 * 17.0) - spline::<Bspline, _, _>(0.3, heights.as_slice()).unwrap()).abs() < 1e-12);
    let share = numbers(1000);
    vec![
        Case::new("uniform cubic B-spline, f32, 3-D: 1000 points")
            .call("radiosity Cubics", &t, move |t| own.point(t))
            .call("radiosity BSpline", &t, move |t| spline_on_knots.point(t))
            .call("bevy_math", &t, |t| theirs.position(t)),
        Case::new("uniform cubic B-spline, f32, 3-D: 1000 first derivatives")
            .call("radiosity Cubics", &t, move |t| own.at(t).first)
            .call("bevy_math", &t, |t| theirs.velocity(t)),
        Case::new("uniform cubic B-spline, f64, 1-D: 1000 points")
            .call("radiosity Cubics", &share, move |t| scalar.point(17.0 * t))
            .call("uniform-cubic-splines", &share, |t| spline::<Bspline, _, _>(t, heights.as_slice())),
    ]
}

/// A curve on knots.
fn nurbs(degree: usize, count: usize) -> Vec<Case> {
    let control = points(count);
    let mut knots = vec![0.0; count + degree + 1];
    clamped_knots(&mut knots, degree);
    let knots = forever(knots);
    let weights: Vec<f64> = numbers(count).iter().map(|x| 0.5 + x).collect();
    let weighted =
        forever(control.iter().zip(&weights).map(|(&p, &w)| Homogeneous::new(p, w)).collect::<Vec<Homogeneous<_>>>());
    let own = Nurbs::new(KnotVector::new(knots, degree).unwrap(), weighted).unwrap();
    let homogeneous = weighted.iter().map(|p| Point4::new(p.scaled.x, p.scaled.y, p.scaled.z, p.weight)).collect();
    let curvo = forever(NurbsCurve3D::try_new(degree, homogeneous, knots.clone()).unwrap());
    let vectors = weighted.iter().map(|p| Vector4::new(p.scaled.x, p.scaled.y, p.scaled.z, p.weight)).collect();
    let truck = forever(NurbsCurve::new(BSplineCurve::new(KnotVec::from(knots.clone()), vectors)));
    let t = numbers(1000);
    let (a, b) = (own.point(0.3), curvo.point_at(0.3));
    assert!((a - DVec3::new(b.x, b.y, b.z)).length() < 1e-12);
    let title = |what: &str| format!("NURBS of degree {degree}, {count} points, f64, 3-D: {what}");
    let to = points(10);
    vec![
        Case::new(&title("1000 points"))
            .call("radiosity", &t, move |t| own.point(t))
            .call("curvo", &t, |t| curvo.point_at(t))
            .call("truck-geometry", &t, |t| truck.subs(t)),
        Case::new(&title("1000 points with two derivatives"))
            .call("radiosity", &t, move |t| own.at(t))
            .call("curvo", &t, |t| curvo.rational_derivatives(t, 2))
            .call("truck-geometry", &t, |t| (truck.subs(t), truck.der(t), truck.der2(t))),
        Case::new(&title("length")).call("radiosity, to 1e-6", &[0], move |_| arc_length(&own, [0.0, 1.0], 1e-6)).call(
            "curvo",
            &[0],
            |_| curvo.try_length(),
        ),
        Case::new(&title("10 nearest points")).call("radiosity", &to, move |to| own.nearest(to)).call(
            "curvo",
            &to,
            |to| curvo.find_closest_point(&Point3::new(to.x, to.y, to.z)),
        ),
    ]
}
