//! All methods for form factors on all known cases: the largest error and the mean time of a call, as a table.

#[path = "../tests/reference/methods.rs"]
mod methods;
#[path = "../tests/reference/occluded.rs"]
#[expect(dead_code, reason = "names and tolerances are for the tests")]
mod occluded;
#[path = "../tests/reference/points.rs"]
#[expect(dead_code, reason = "names are for the tests")]
mod points;
#[path = "../tests/reference/surfaces.rs"]
#[expect(dead_code, reason = "names are for the tests")]
mod surfaces;

use std::hint::black_box;
use std::time::{Duration, Instant};

use glam::{DVec3, Vec3};
use methods::{closed_form, point_closed_form, strip_polygons, surface_polygons, target_polygon};
use occluded::{DISCS, OccludedPair, PAIRS, POINTS};
use points::POINT_CASES;
use radiosity::form_factor::*;
use radiosity::geometry::{BruteForce, PolygonOccluders};
use radiosity::math::{Real, Vector};
use surfaces::SURFACE_CASES;

/// Time spent on one call, repeated; of several measurements the best one counts.
const PATIENCE: Duration = Duration::from_millis(2);
const ROUNDS: usize = 5;
/// Where endless strips end for methods that draw points from them or cover them with pixels.
const SHORT: f64 = 30.0;
/// And for all others.
const FAR: f64 = 1e4;
/// Pixels along an edge of the hemicube.
const RESOLUTION: usize = 256;
/// For methods with points on the sender.
const SAMPLES: Samples = Samples { scrambles: 16, points: 1024, seed: 1 };

/// One call on one case.
struct Call {
    expected: f64,
    /// How well that is known.
    tolerance: f64,
    find: Box<dyn Fn() -> Estimate<f64>>,
}

/// A method: its name, and its calls for points, for surfaces and past blockers.
type Method = (&'static str, [Vec<Call>; 3]);

fn main() {
    println!("| method | | A: points | B: surfaces | C: occluded |");
    println!("|---|---|---|---|---|");
    for ((name, double), (_, single)) in methods::<DVec3>().into_iter().zip(methods::<Vec3>()) {
        println!("| {name} | f64 | {} |", double.map(|calls| measure(&calls)).join(" | "));
        println!("| | f32 | {} |", single.map(|calls| measure(&calls)).join(" | "));
    }
}

/// The largest error, how that is to the one that the method tells at most, and the mean time.
fn measure(calls: &[Call]) -> String {
    if calls.is_empty() {
        return String::from("-");
    }
    let (mut worst, mut ratio, mut time) = (0.0_f64, 0.0_f64, Duration::ZERO);
    for Call { expected, tolerance, find } in calls {
        let found = find();
        let error = (found.value - expected).abs();
        worst = worst.max(error);
        ratio = ratio.max(if found.error > 0.0 { (error - tolerance).max(0.0) / found.error } else { 0.0 });
        time += (0..ROUNDS).map(|_| duration(find)).min().unwrap_or_default();
    }
    let told = if ratio > 0.0 { format!(" ({ratio:.2} of its own)") } else { String::new() };
    let nanoseconds = time.as_nanos() as f64 / calls.len() as f64;
    let (scale, unit) = match nanoseconds {
        small if small < 1e3 => (1.0, "ns"),
        middle if middle < 1e6 => (1e-3, "us"),
        _ => (1e-6, "ms"),
    };
    format!("{worst:.0e}{told}, {:.3} {unit}", nanoseconds * scale)
}

/// The mean time of a call.
fn duration(find: &dyn Fn() -> Estimate<f64>) -> Duration {
    let start = Instant::now();
    let mut count = 0;
    loop {
        black_box(find());
        count += 1;
        if start.elapsed() >= PATIENCE {
            break;
        }
    }
    start.elapsed() / count
}

fn methods<V: Vector>() -> Vec<Method> {
    let mut all = exact_methods::<V>();
    all.extend(visible_methods::<V>());
    all.extend(projections::<V>());
    all
}

fn exact_methods<V: Vector>() -> Vec<Method> {
    let number = V::Scalar::from_f64;
    let none = Vec::new;
    vec![
        (
            "point formula, 16 x 16 pieces",
            [
                seen::<V>(SHORT, |point, normal, polygon| exact(point_to_pieces(point, normal, polygon))),
                pairs::<V>(SHORT, |a, b| exact(pieces_to_pieces(a, b))),
                none(),
            ],
        ),
        (
            "Lambert's form",
            [seen::<V>(FAR, |point, normal, polygon| exact(point_to_polygon(point, normal, polygon))), none(), none()],
        ),
        ("closed forms", [closed_points::<V>(), closed_surfaces::<V>(), closed_discs::<V::Scalar>()]),
        ("contour integral", [none(), pairs::<V>(FAR, |a, b| exact(polygon_to_polygon(a, b))), none()]),
        ("double integral, 1e-6", [none(), pairs::<V>(FAR, move |a, b| double_integral(a, b, number(1e-6))), none()]),
        (
            "double integral of points, 1e-2",
            [none(), pairs::<V>(SHORT, move |a, b| double_integral_of_points(a, b, number(1e-2))), none()],
        ),
    ]
}

fn visible_methods<V: Vector>() -> Vec<Method> {
    let number = V::Scalar::from_f64;
    let none = Vec::new;
    vec![
        (
            "exact clipping, 1e-6",
            [
                clipped_points::<V>(),
                none(),
                occluded::<V>(1e3, move |a, b, c| visible_polygon_to_polygon(a, b, c, number(1e-6))),
            ],
        ),
        (
            "exact clipping, 1e-8",
            [none(), none(), occluded::<V>(1e3, move |a, b, c| visible_polygon_to_polygon(a, b, c, number(1e-8)))],
        ),
        (
            "rays between points, 1e-3",
            [
                none(),
                none(),
                occluded::<V>(SHORT, move |a, b, c| {
                    visible_polygon_to_polygon_by_rays(a, b, &PolygonOccluders(c), number(1e-3))
                }),
            ],
        ),
    ]
}

fn projections<V: Vector>() -> Vec<Method> {
    let none = Vec::new;
    vec![
        (
            "Nusselt's projection, exact",
            [seen::<V>(FAR, |point, normal, polygon| exact(nusselt_area(point, normal, polygon))), none(), none()],
        ),
        (
            "Nusselt's projection, 16384 rays",
            [
                seen::<V>(SHORT, |point, normal, polygon| {
                    let [point, normal] = [point, normal].map(|vector| vector.to_dvec3().as_vec3());
                    shoot(move |_| [point, normal], polygon, &[])
                }),
                pairs::<V>(SHORT, |a, b| shoot(polygon_sender(&single(a)), b, &[])),
                occluded::<V>(SHORT, |a, b, blockers| shoot(polygon_sender(&single(a)), b, blockers)),
            ],
        ),
        (
            "hemicube, 256 pixels",
            [seen::<V>(SHORT, draw_from_point), pairs::<V>(SHORT, |a, b| draw(a, b, &[])), occluded::<V>(SHORT, draw)],
        ),
    ]
}

/// The corners, those of endless strips cut at `end`.
fn corners<V: Vector>(corners: &[DVec3], end: f64) -> Vec<V> {
    corners.iter().map(|corner| V::from_dvec3(corner.clamp(DVec3::splat(-end), DVec3::splat(end)))).collect()
}

fn exact<R: Real>(value: R) -> Estimate<R> {
    Estimate { value, error: R::ZERO }
}

fn call<R: Real>(expected: f64, find: impl Fn() -> Estimate<R> + 'static) -> Call {
    let find = move || {
        let found = find();
        Estimate { value: found.value.to_f64(), error: found.error.to_f64() }
    };
    Call { expected, tolerance: 1e-12, find: Box::new(find) }
}

/// A method for points on all polygons of group A.
fn seen<V: Vector>(end: f64, method: impl Fn(V, V, &[V]) -> Estimate<V::Scalar> + Copy + 'static) -> Vec<Call> {
    let calls = POINT_CASES.iter().filter_map(|case| {
        let polygon = corners::<V>(&target_polygon(&case.target, end)?, end);
        let normal = V::from_dvec3(DVec3::from_array(case.normal));
        Some(call(case.factor, move || method(V::default(), normal, black_box(&polygon))))
    });
    calls.collect()
}

/// A method for pairs on all polygons of group B; the receivers of one sender are added up.
fn pairs<V: Vector>(end: f64, method: impl Fn(&[V], &[V]) -> Estimate<V::Scalar> + Copy + 'static) -> Vec<Call> {
    let calls = SURFACE_CASES.iter().filter_map(|case| {
        let (a, others) = surface_polygons(&case.surfaces).or_else(|| strip_polygons(&case.surfaces, end))?;
        let a = corners::<V>(&a, end);
        let others: Vec<Vec<V>> = others.iter().map(|b| corners(b, end)).collect();
        Some(call(case.factor, move || {
            others.iter().fold(exact(V::Scalar::ZERO), |sum, b| {
                let found = method(black_box(&a), b);
                Estimate { value: sum.value + found.value, error: sum.error + found.error }
            })
        }))
    });
    calls.collect()
}

/// A method for pairs with blockers on group C.
fn occluded<V: Vector>(
    end: f64,
    method: impl Fn(&[V], &[V], &[&[V]]) -> Estimate<V::Scalar> + Copy + 'static,
) -> Vec<Call> {
    let polygon = |points: &[[f64; 3]]| corners::<V>(&points.iter().map(|&p| DVec3::from(p)).collect::<Vec<_>>(), end);
    let calls = PAIRS.iter().map(|&OccludedPair { a, b, blockers, factor, tolerance, .. }| {
        let (a, b): (Vec<V>, Vec<V>) = (polygon(a), polygon(b));
        let blockers: Vec<Vec<V>> = blockers.iter().map(|blocker| polygon(blocker)).collect();
        let call = call(factor, move || {
            let blockers: Vec<&[V]> = blockers.iter().map(Vec::as_slice).collect();
            method(black_box(&a), &b, &blockers)
        });
        Call { tolerance, ..call }
    });
    calls.collect()
}

fn clipped_points<V: Vector>() -> Vec<Call> {
    let polygon = |points: &[[f64; 3]]| corners::<V>(&points.iter().map(|&p| DVec3::from(p)).collect::<Vec<_>>(), FAR);
    let calls = POINTS.iter().map(|case| {
        let (receiver, blocker) = (polygon(case.polygon), polygon(case.blocker));
        let [point, up] = [case.point, [0.0, 0.0, 1.0]].map(|point| V::from_dvec3(DVec3::from(point)));
        call(case.factor, move || exact(visible_point_to_polygon(point, up, black_box(&receiver), &[&blocker])))
    });
    calls.collect()
}

fn closed_points<V: Vector>() -> Vec<Call> {
    let calls = POINT_CASES.iter().filter_map(|case| {
        point_closed_form::<V>(case.normal, &case.target)?;
        let find =
            || point_closed_form::<V>(black_box(case.normal), &case.target).map_or(V::Scalar::ZERO, |value| value);
        Some(call(case.factor, move || exact(find())))
    });
    calls.collect()
}

fn closed_surfaces<V: Vector>() -> Vec<Call> {
    let calls = SURFACE_CASES.iter().filter_map(|case| {
        closed_form::<V::Scalar>(&case.surfaces)?;
        let find = || closed_form::<V::Scalar>(black_box(&case.surfaces)).map_or(V::Scalar::ZERO, |value| value);
        Some(call(case.factor, move || exact(find())))
    });
    calls.collect()
}

fn closed_discs<R: Real>() -> Vec<Call> {
    let calls = DISCS.iter().map(|case| {
        let [a, b] = case.radii;
        let lengths = [a, b, case.distance, case.blocker_radius, case.blocker_distance].map(R::from_f64);
        call(case.factor, move || {
            let [a, b, distance, radius, blocker_distance] = black_box(lengths);
            exact(visible_coaxial_discs(a, b, distance, radius, blocker_distance))
        })
    });
    calls.collect()
}

/// The cells of a grid on a polygon with three or four corners: their centers, and their areas times their normals.
fn pieces<V: Vector>(polygon: &[V]) -> impl Iterator<Item = (V, V)> {
    const COUNT: u32 = 16;
    let [a, b, c, d] = core::array::from_fn(|k| polygon[k.min(polygon.len() - 1)]);
    let share = |k: u32, part: f64| V::Scalar::from_f64((f64::from(k) + part) / f64::from(COUNT));
    let at = move |x, y| a.lerp(b, x).lerp(d.lerp(c, x), y);
    (0..COUNT * COUNT).map(move |k| {
        let [x, y] = [k % COUNT, k / COUNT].map(|k| [share(k, 0.0), share(k, 0.5), share(k, 1.0)]);
        let diagonals = [at(x[2], y[2]) - at(x[0], y[0]), at(x[0], y[2]) - at(x[2], y[0])];
        (at(x[1], y[1]), diagonals[0].cross(diagonals[1]) * V::Scalar::from_f64(0.5))
    })
}

fn point_to_pieces<V: Vector>(point: V, normal: V, polygon: &[V]) -> V::Scalar {
    pieces(polygon).map(|(q, area)| point_to_point(point, normal, q, area.normalize_or_zero(), area.length())).sum()
}

fn pieces_to_pieces<V: Vector>(a: &[V], b: &[V]) -> V::Scalar {
    let all: V::Scalar = pieces(a).map(|(_, area)| area.length()).sum();
    let weighted = |(p, area): (V, V)| point_to_pieces(p, area.normalize_or_zero(), b) * area.length();
    pieces(a).map(weighted).sum::<V::Scalar>() / all
}

fn single<V: Vector>(polygon: &[V]) -> Vec<Vec3> {
    polygon.iter().map(|corner| corner.to_dvec3().as_vec3()).collect()
}

/// Cosine-weighted rays from a sender: the share that meets a polygon first, past blockers.
fn shoot<V: Vector>(sender: impl Fn(glam::Vec2) -> [Vec3; 2], polygon: &[V], blockers: &[&[V]]) -> Estimate<V::Scalar> {
    let fan = |polygon: &[V]| {
        let corners = single(polygon);
        (2..corners.len()).map(move |k| [corners[0], corners[k - 1], corners[k]]).collect::<Vec<_>>()
    };
    let mut triangles = fan(polygon);
    let own = triangles.len() as u32;
    blockers.iter().for_each(|blocker| triangles.extend(fan(blocker)));
    let patch = |hit: &radiosity::geometry::Hit| (hit.triangle < own && hit.front).then_some(0);
    let mut row = [Estimate::default()];
    nusselt_rays(sender, &BruteForce(triangles), patch, &SAMPLES, &mut row, &mut [0]);
    row[0]
}

fn draw_from_point<V: Vector>(point: V, normal: V, polygon: &[V]) -> Estimate<V::Scalar> {
    let mut row = [Estimate::default()];
    with_hemicube(|cube| cube.point_row([point, normal], 0.0, &[polygon], &mut row));
    row[0]
}

fn draw<V: Vector>(a: &[V], b: &[V], blockers: &[&[V]]) -> Estimate<V::Scalar> {
    let patches: Vec<&[V]> = [b].into_iter().chain(blockers.iter().copied()).collect();
    let mut row = vec![Estimate::default(); patches.len()];
    let mut scratch = row.clone();
    let samples = Samples { points: 4, ..SAMPLES };
    with_hemicube(|cube| cube.polygon_row(a, &patches, &samples, &mut row, &mut scratch));
    row[0]
}

/// On memory that is kept.
fn with_hemicube<T>(use_it: impl FnOnce(&mut Hemicube) -> T) -> T {
    thread_local! {
        static MEMORY: std::cell::RefCell<(Vec<u32>, Vec<f32>, Vec<f64>)> = std::cell::RefCell::new((
            vec![0; hemicube_pixels(RESOLUTION)],
            vec![0.0; hemicube_pixels(RESOLUTION)],
            vec![0.0; hemicube_deltas(RESOLUTION)],
        ));
    }
    MEMORY.with_borrow_mut(|(items, depths, deltas)| {
        let mut cube = Hemicube::new(RESOLUTION, HemicubeBuffers { items, depths, deltas }).expect("the sizes fit");
        use_it(&mut cube)
    })
}
