//! Surfaces as triangles: no cracks, near enough, with normals and charts; and what a bake makes of them.

use std::collections::HashMap;

use glam::{Affine3A, DVec3, Vec3};
use radiosity::bake::{BakeSettings, Quality, bake};
use radiosity::geometry::Mesh;
use radiosity::light::{Light, LightSource, PointLight};
use radiosity::lightmap::{LayoutSettings, Resolution, UvOrigin};
use radiosity::material::Material;
use radiosity::progress::Progress;
use radiosity::scene::{Receiver, Scene, Surface};
use radiosity::spline::*;

type Nurbs3 = OwnedSurface<Homogeneous<DVec3>>;

const TAU: f64 = core::f64::consts::TAU;

/// In meters and radians.
fn tolerance(chord: f64, angle: f64) -> Tolerance<f64> {
    Tolerance::new(chord, angle).unwrap()
}

fn knots(knots: &[f64], degree: usize) -> KnotVector<'_, f64> {
    KnotVector::new(knots, degree).unwrap()
}

fn turned(profile: &[[f64; 3]], all: &[f64], degree: usize) -> Nurbs3 {
    let points: Vec<_> = profile.iter().map(|&[r, z, w]| Homogeneous::new(DVec3::new(r, 0.0, z), w)).collect();
    let axis = Axis { origin: DVec3::ZERO, direction: DVec3::Z };
    revolution(&BSpline::new(knots(all, degree), &points).unwrap(), axis, TAU).unwrap()
}

fn sphere() -> Nurbs3 {
    let w = core::f64::consts::FRAC_1_SQRT_2;
    let profile = [[0.0, -1.0, 1.0], [1.0, -1.0, w], [1.0, 0.0, 1.0], [1.0, 1.0, w], [0.0, 1.0, 1.0]];
    turned(&profile, &[0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0], 2)
}

/// Radii 1 and 0.4.
fn torus() -> Nurbs3 {
    let w = core::f64::consts::FRAC_1_SQRT_2;
    let corner = [[0, -1], [1, -1], [1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1]];
    let profile: Vec<_> = (0..9)
        .map(|k| [1.0 + 0.4 * f64::from(corner[k][0]), 0.4 * f64::from(corner[k][1]), if k % 2 == 0 { 1.0 } else { w }])
        .collect();
    turned(&profile, &[0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.], 2)
}

fn vase() -> Nurbs3 {
    let profile =
        [[0.16, 0.0], [0.34, 0.1], [0.4, 0.35], [0.12, 0.55], [0.14, 0.7], [0.22, 0.8]].map(|[r, z]| [r, z, 1.0]);
    turned(&profile, &[0., 0., 0., 0., 0.4, 0.7, 1., 1., 1., 1.], 3)
}

/// Four bicubic patches in a square of two by two; heights are different at each control point.
fn quilt() -> Vec<OwnedSurface<DVec3>> {
    let height = |i: usize, j: usize| 0.6 * (2.3 * i as f64 + 0.4).sin() * (1.7 * j as f64).cos();
    let net = |i: usize, j: usize| {
        DVec3::new(
            i as f64 / 3.0,
            j as f64 / 3.0,
            if i > 3 && j < 4 { 4.0 } else { 1.0 } * if i == 3 || j == 3 { 1.0 } else { height(i, j) },
        )
    };
    let unit = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    let patch = |[x, y]: [usize; 2]| {
        let points = (0..16).map(|k| net(3 * x + k % 4, 3 * y + k / 4)).collect();
        OwnedSurface::new([unit.clone(), unit.clone()], [3, 3], points).unwrap()
    };
    // One patch runs the other way in both directions, one has both exchanged.
    let mut patches: Vec<_> = [[0, 0], [1, 0], [0, 1], [1, 1]].map(patch).into();
    let mut reversed = patches[3].points().to_vec();
    reversed.reverse();
    patches[3].set_points(&reversed).unwrap();
    patches[2] = patches[2].transposed();
    patches
}

/// How often each edge is used, its ends by their positions.
fn edges(parts: &[Tessellation<DVec3>]) -> HashMap<[[u64; 3]; 2], usize> {
    let mut edges = HashMap::new();
    for part in parts {
        for t in &part.triangles {
            for k in 0..3 {
                let key = |i: usize| part.positions[t[i % 3] as usize].to_array().map(|x| (x + 0.0).to_bits());
                let (a, b) = (key(k), key(k + 1));
                *edges.entry([a.min(b), a.max(b)]).or_insert(0) += 1;
            }
        }
    }
    edges
}

fn area(part: &Tessellation<DVec3>) -> f64 {
    let of = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| part.positions[i as usize]);
        0.5 * (b - a).cross(c - a).length()
    };
    part.triangles.iter().map(of).sum()
}

/// The largest distance of the surface from triangles, and the largest angle between the interpolated and the true normal.
fn errors<P: SurfacePoint<Scalar = f64, Point = DVec3>>(
    surface: &BSplineSurface<P>,
    part: &Tessellation<DVec3>,
) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    for t in &part.triangles {
        let t = t.map(|i| i as usize);
        let [a, b, c] = t.map(|i| part.positions[i]);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        for (i, j) in (0..=4).flat_map(|i| (0..=4 - i).map(move |j| (i, j))) {
            let weights = [i as f64 / 4.0, j as f64 / 4.0, (4 - i - j) as f64 / 4.0];
            let uv = [0, 1].map(|k| (0..3).map(|m| weights[m] * part.parameters[t[m]][k]).sum::<f64>());
            let point = surface.point(uv[0], uv[1]);
            let smooth: DVec3 = (0..3).map(|m| part.normals[t[m]] * weights[m]).sum();
            worst[0] = worst[0].max((point - a).dot(normal).abs());
            // Where a straight border twists, normals are true only a little inside.
            let domain = surface.domain();
            let is_inside = (0..2).all(|k| {
                let margin = (domain[k][1] - domain[k][0]) / 16.0;
                domain[k][0] + margin < uv[k] && uv[k] < domain[k][1] - margin
            });
            if is_inside {
                worst[1] = worst[1].max(smooth.angle_between(surface.normal(uv[0], uv[1])));
            }
        }
    }
    worst
}

#[test]
fn closed_surfaces_are_watertight_and_have_their_area() {
    let pi = core::f64::consts::PI;
    for (surface, exact) in [(sphere(), 4.0 * pi), (torus(), 4.0 * pi * pi * 0.4)] {
        let mut last = f64::INFINITY;
        for chord in [0.03, 0.003, 0.0003] {
            let part = tessellate(&surface.surface(), &tolerance(chord, 1.0), ChartScale::Area);
            assert!(edges(core::slice::from_ref(&part)).values().all(|&count| count == 2), "a crack at {chord}");
            let error = (area(&part) / exact - 1.0).abs();
            assert!(error < 4.0 * chord && error < last, "{error} at {chord}");
            last = error;
            println!("chord {chord}: {} triangles, area off by {error:.2e}", part.triangles.len());
        }
    }
}

#[test]
fn neighbors_of_different_density_have_no_cracks() {
    let patches = quilt();
    for (chord, angle) in [(0.03, 0.5), (0.003, 0.1), (0.0004, 3.0)] {
        let cut =
            |patch: &OwnedSurface<DVec3>| tessellate(&patch.surface(), &tolerance(chord, angle), ChartScale::Area);
        let parts: Vec<_> = patches.iter().map(cut).collect();
        let counts: Vec<usize> = parts.iter().map(|part| part.triangles.len()).collect();
        assert!(counts.iter().max() > counts.iter().min(), "{counts:?}");
        let is_border = |point: [u64; 3]| {
            let [x, y, _] = point.map(f64::from_bits);
            [x == 0.0, x == 2.0, y == 0.0, y == 2.0]
        };
        for ([a, b], count) in edges(&parts) {
            let outside = is_border(a).iter().zip(is_border(b)).any(|(&a, b)| a && b);
            assert_eq!(count, if outside { 1 } else { 2 }, "an edge from {:?} with {counts:?}", a.map(f64::from_bits));
        }
    }
}

/// A pot with its lid on, closed: four quarters of eight rings, bicubic patches that share nothing but control points.
fn pot() -> Vec<[DVec3; 16]> {
    /// Radius and height along the outline, three more for each ring.
    const OUTLINE: [[f64; 2]; 25] = [
        [0.0, 0.0],
        [0.3, 0.0],
        [0.6, 0.0],
        [0.8, 0.05],
        [1.0, 0.1],
        [1.3, 0.3],
        [1.5, 0.6],
        [1.7, 0.9],
        [1.7, 1.2],
        [1.6, 1.5],
        [1.5, 1.8],
        [1.3, 2.0],
        [1.1, 2.1],
        [1.0, 2.15],
        [1.0, 2.25],
        [1.1, 2.3],
        [0.9, 2.4],
        [0.5, 2.5],
        [0.3, 2.55],
        [0.1, 2.6],
        [0.1, 2.7],
        [0.2, 2.8],
        [0.3, 2.9],
        [0.2, 3.1],
        [0.0, 3.1],
    ];
    const ARC: [[f64; 2]; 4] = [[1.0, 0.0], [1.0, 0.5523], [0.5523, 1.0], [0.0, 1.0]];
    let quarter = |ring: usize, turns: usize| {
        std::array::from_fn(|k| {
            let ([x, y], [radius, height]) = (ARC[k % 4], OUTLINE[3 * ring + k / 4]);
            let [x, y] = (0..turns).fold([x, y], |[x, y], _| [-y, x]);
            DVec3::new(radius * x, radius * y, height)
        })
    };
    (0..32).map(|k| quarter(k / 4, k % 4)).collect()
}

/// Patches cut each on its own, with as many triangles as each needs, make a body without a crack.
#[test]
fn a_pot_of_32_patches_is_watertight() {
    let patches = pot();
    for (chord, angle) in [(0.03, 0.6), (0.002, 0.15)] {
        let cut = |points: &[DVec3; 16]| {
            tessellate(&BSplineSurface::bezier(points, 4).unwrap(), &tolerance(chord, angle), ChartScale::Area)
        };
        let parts: Vec<_> = patches.iter().map(cut).collect();
        assert!(edges(&parts).values().all(|&count| count == 2));
        // Its volume by the divergence theorem: the profile's revolution, to what the chord leaves out.
        let of = |part: &Tessellation<DVec3>| -> f64 {
            let corner = |t: &[u32; 3], k: usize| part.positions[t[k] as usize];
            part.triangles.iter().map(|t| corner(t, 0).dot(corner(t, 1).cross(corner(t, 2))) / 6.0).sum()
        };
        let (volume, area): (f64, f64) = (parts.iter().map(of).sum(), parts.iter().map(area).sum());
        let exact = turned_volume(&patches);
        println!(
            "pot: {} triangles, volume {volume} of {exact}",
            parts.iter().map(|p| p.triangles.len()).sum::<usize>()
        );
        assert!((volume - exact).abs() < chord * area, "{volume} is not {exact}");
    }
}

/// `pi r^2 dz` along the outline; the patches' arcs are round to 0.03 percent.
fn turned_volume(patches: &[[DVec3; 16]]) -> f64 {
    let ring = |points: &[DVec3; 16]| {
        let outline = [0, 4, 8, 12].map(|k| points[k]);
        let curve = Bezier::new(&outline).unwrap();
        let slices = (0..1000).map(|k| curve.at((f64::from(k) + 0.5) / 1000.0));
        slices.map(|jet| core::f64::consts::PI * jet.point.x.powi(2) * jet.first.z / 1000.0).sum::<f64>()
    };
    patches.iter().step_by(4).map(ring).sum()
}

#[test]
fn triangles_and_normals_are_near_enough() {
    for (chord, angle) in [(0.02, 0.4), (0.003, 0.1)] {
        for surface in [sphere(), torus(), vase()] {
            check_nearness(&surface.surface(), chord, angle);
        }
        quilt().iter().for_each(|patch| check_nearness(&patch.surface(), chord, angle));
    }
}

fn check_nearness<P: SurfacePoint<Scalar = f64, Point = DVec3>>(surface: &BSplineSurface<P>, chord: f64, angle: f64) {
    let part = tessellate(surface, &tolerance(chord, angle), ChartScale::Area);
    let [distance, turn] = errors(surface, &part);
    println!(
        "{} triangles: {:.2} of the chord, {:.2} of the angle",
        part.triangles.len(),
        distance / chord,
        turn / angle
    );
    assert!(distance <= chord && turn <= angle, "{distance} of {chord}, {turn} of {angle}");
}

/// The rim of a pot, a roll of small radius around a wide mouth: many rows and few columns. Where chords alone are checked,
/// slender triangles of H. A. Schwarz's lantern (1880) stand across the surface and shade each other.
#[test]
fn no_triangle_stands_across_the_surface() {
    let profile = [[1.4, 2.4], [1.3375, 2.53125], [1.4375, 2.53125], [1.5, 2.4]];
    let around = [[1.0, 0.0], [1.0, 0.56], [0.56, 1.0], [0.0, 1.0]];
    let control =
        profile.iter().flat_map(|&[r, y]| around.map(|[x, z]| DVec3::new(r * x, y, r * z))).collect::<Vec<_>>();
    let rim = BSplineSurface::bezier(&control, 4).unwrap();
    let angle = 0.15;
    let part = tessellate(&rim, &tolerance(0.005, angle), ChartScale::Area);
    let is_inside = |&vertex: &u32| part.uv_0[vertex as usize].iter().all(|&t| 0.0 < t && t < 1.0);
    let inner = part.triangles.iter().filter(|triangle| triangle.iter().all(is_inside));
    let turns: Vec<f64> = inner
        .map(|triangle| {
            let [a, b, c] = triangle.map(|vertex| part.positions[vertex as usize]);
            let mean: DVec3 = triangle.iter().map(|&vertex| part.normals[vertex as usize]).sum();
            (b - a).cross(c - a).angle_between(mean)
        })
        .collect();
    let worst = turns.iter().copied().fold(0.0, f64::max);
    println!("rim: {} of {} triangles inside, at most {worst:.3}", turns.len(), part.triangles.len());
    assert!(turns.len() > part.triangles.len() / 2);
    // The normal at the center, which is what counts, is a quarter of the angle away from the mean of the corners'.
    assert!(worst <= 2.25 * angle, "{worst}");
}

/// A rational surface of 5 x 4 pieces whose borders bend and twist.
#[test]
fn hills_end() {
    let control = (0..56).map(|k| {
        let [x, y] = [f64::from(k % 8), f64::from(k / 8)];
        let weight = 1.0 + 0.3 * (1.3 * x + 0.7 * y).sin();
        Homogeneous::new(DVec3::new(x, y, (1.1 * x).sin() * (0.9 * y).cos()), weight)
    });
    let clamped = |count: usize| {
        let mut knots = vec![0.0; count + 4];
        clamped_knots(&mut knots, 3);
        knots
    };
    let hills = OwnedSurface::new([clamped(8), clamped(7)], [3; 2], control.collect()).unwrap();
    let part = tessellate(&hills.surface(), &tolerance(5e-3, 0.2), ChartScale::Area);
    println!("hills: {} triangles, {:?}", part.triangles.len(), errors(&hills.surface(), &part));
    assert!(edges(core::slice::from_ref(&part)).values().all(|&count| count <= 2));
    assert!(part.triangles.len() < 60_000);
}

/// Bent patches with weights from 0.05 to 20, whose parameters crowd together: few triangles; between the places
/// that are looked at the surface is a little further away than the tolerance.
#[test]
fn uneven_weights_do_not_hang() {
    for k in 0..6 {
        let points = (0..16).map(|i| {
            let [x, y] = [f64::from(i % 4), f64::from(i / 4)];
            let phase = f64::from(i * (k + 3)) + f64::from(k);
            Homogeneous::new(DVec3::new(x, y, (1.7 * phase).sin()), (3.0 * (2.3 * phase).cos()).exp())
        });
        let points: Vec<_> = points.collect();
        let patch = BSplineSurface::bezier(&points, 4).unwrap();
        let part = tessellate(&patch, &tolerance(3e-3, 0.2), ChartScale::Area);
        let [distance, _] = errors(&patch, &part);
        println!("{} triangles, {:.2} of the chord", part.triangles.len(), distance / 3e-3);
        assert!(part.triangles.len() < 20_000 && distance < 1.6 * 3e-3, "{}: {distance}", part.triangles.len());
    }
}

/// Right triangles of which each covers the area `2 chord / sqrt(K)` are enough for a sphere and a torus; rounding up to
/// whole columns and rows costs some, normals that turn by `angle` along each edge cost `4 K / angle^2` for an area.
#[test]
fn triangles_are_not_more_than_needed() {
    for (name, surface) in [("sphere", sphere()), ("torus", torus())] {
        let surface = surface.surface();
        for (chord, angle, limit) in [(0.003, 3.0, 1.8), (0.0003, 3.0, 1.6), (0.1, 0.2, 1.7), (0.1, 0.05, 1.4)] {
            let needed = needed(&surface, chord, angle);
            let count = tessellate(&surface, &tolerance(chord, angle), ChartScale::Area).triangles.len();
            println!("{name}, {chord} m, {angle} rad: {count} triangles, {needed:.0} are needed");
            assert!((count as f64) < limit * needed, "{name}: {count}, needed {needed}");
        }
    }
}

fn needed<P: SurfacePoint<Scalar = f64, Point = DVec3>>(surface: &BSplineSurface<P>, chord: f64, angle: f64) -> f64 {
    let [[u0, u1], [v0, v1]] = surface.domain();
    let share = |k: usize| (k as f64 + 0.5) / 100.0;
    let cells = (0..10_000).map(|k| {
        let [u, v] = [u0 + (u1 - u0) * share(k % 100), v0 + (v1 - v0) * share(k / 100)];
        let [_, du, dv] = surface.tangents(u, v);
        let area = du.cross(dv).length() * (u1 - u0) * (v1 - v0) / 1e4;
        let k = surface.curvature(u, v).gaussian;
        // Where the surface is a saddle, edges may follow its straight directions.
        let by_chord = if k > 0.0 { k.sqrt() / (2.0 * chord) } else { (-k).sqrt() / (4.0 * chord) };
        area * by_chord.max(4.0 * k.abs() / (angle * angle))
    });
    cells.sum()
}

/// A flat sheet needs two triangles; a cylinder is cut around its axis only.
#[test]
fn flat_is_cheap() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE - DVec3::Z];
    let flat = tessellate(&BSplineSurface::bezier(&corners, 2).unwrap(), &tolerance(1e-3, 0.1), ChartScale::Area);
    assert_eq!(flat.triangles, [[0, 1, 2], [1, 3, 2]]);
    let cylinder = turned(&[[1.0, 0.0, 1.0], [1.0, 5.0, 1.0]], &[0.0, 0.0, 1.0, 1.0], 1);
    let part = tessellate(&cylinder.surface(), &tolerance(1e-2, 0.4), ChartScale::Area);
    assert!(part.triangles.len() <= 250, "{}", part.triangles.len());
}

/// An angular profile keeps its creases: the normals of each side are true, and nothing gapes.
#[test]
fn creases_stay_sharp() {
    let drum =
        turned(&[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 1.0]], &[0., 0., 1., 2., 3., 3.], 1);
    let part = tessellate(&drum.surface(), &tolerance(1e-3, 0.2), ChartScale::Area);
    assert!(edges(core::slice::from_ref(&part)).values().all(|&count| count == 2));
    for t in &part.triangles {
        let [a, b, c] = t.map(|i| part.positions[i as usize]);
        // At poles three vertices may lie on a line.
        let flat = (b - a).cross(c - a);
        if flat.length() < 1e-9 * (b - a).length_squared().max((c - a).length_squared()) {
            continue;
        }
        let flat = flat.normalize();
        for i in t.map(|i| i as usize) {
            let ([u, v], normal) = (part.parameters[i], part.normals[i]);
            assert!(normal.dot(flat) > 0.98, "{normal} at {u} {v}, {flat} between {a} {b} {c}");
        }
    }
}

/// Meters of surface for each unit of the chart, the largest over the smallest, between the shares of the area given.
fn spread(part: &Tessellation<DVec3>) -> f64 {
    let ratio = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| part.positions[i as usize]);
        let [p, q, r] = t.map(|i| glam::DVec2::from_array(part.uv_1[i as usize]));
        (b - a).cross(c - a).length() / (q - p).perp_dot(r - p).abs()
    };
    let mut ratios: Vec<f64> = part.triangles.iter().map(ratio).collect();
    ratios.sort_by(f64::total_cmp);
    ratios[ratios.len() - 1] / ratios[0]
}

#[test]
fn texels_have_equal_areas() {
    let fine = tolerance(2e-4, 0.1);
    for (name, surface, limit) in [("torus", torus(), 1.1), ("vase", vase(), 1.12)] {
        let [by_area, by_length] =
            [ChartScale::Area, ChartScale::Length].map(|scale| spread(&tessellate(&surface.surface(), &fine, scale)));
        println!("{name}: spread of the area of texels {by_area:.3}, with equal lengths {by_length:.3}");
        assert!(by_area < limit && by_length > by_area, "{name}: {by_area} {by_length}");
    }
    for part in quilt().iter().map(|patch| tessellate(&patch.surface(), &fine, ChartScale::Area)) {
        assert!(part.uv_1.iter().flatten().all(|x| (0.0..=1.0).contains(x)));
        let corner = |uv: [f64; 2]| part.uv_1.contains(&uv);
        assert!(
            corner([0.0, 0.0])
                && part.triangles.iter().all(|t| {
                    let [p, q, r] = t.map(|i| glam::DVec2::from_array(part.uv_1[i as usize]));
                    (q - p).perp_dot(r - p) > 0.0
                })
        );
    }
}

/// Tolerances that no number of triangles reaches, and coordinates whose squares are no numbers, come to an end.
#[test]
fn everything_ends() {
    let spike = [0.0, 1.0, -1.0, 0.0].map(|z| DVec3::new(z, 2.0 * z, z));
    let fine = tessellate(&BSplineSurface::bezier(&spike, 2).unwrap(), &tolerance(1e-300, 1e-300), ChartScale::Area);
    assert!(fine.triangles.len() < 1_000_000);
    for size in [1e-200, 1e150, 1e200, 1e300] {
        let points: Vec<DVec3> = (0..9).map(|k| DVec3::new(f64::from(k % 3), f64::from(k / 3), 0.0) * size).collect();
        let _ = tessellate(&BSplineSurface::bezier(&points, 3).unwrap(), &tolerance(1.0, 0.5), ChartScale::Area);
    }
}

#[test]
fn tolerances_are_checked() {
    assert_eq!(Tolerance::new(0.0, 0.1).unwrap_err(), TessellationError::Chord { chord: 0.0 });
    assert!(Tolerance::new(0.1, f64::NAN).is_err());
    // All points equal: nothing is left, and nothing fails.
    let point = [DVec3::X; 16];
    let nothing = tessellate(&BSplineSurface::bezier(&point, 4).unwrap(), &tolerance(1e-3, 0.1), ChartScale::Area);
    assert!(nothing.triangles.is_empty());
}

/// Half a cylinder of two exact arcs, in two bays: four patches that join smoothly.
fn vault() -> Vec<Nurbs3> {
    let w = core::f64::consts::FRAC_1_SQRT_2;
    let arcs = [[[1.0, 1.0, 1.0], [1.0, 2.0, w], [0.0, 2.0, 1.0]], [[0.0, 2.0, 1.0], [-1.0, 2.0, w], [-1.0, 1.0, 1.0]]];
    let bay = |arc: &[[f64; 3]; 3], y: f64| {
        let points = arc.map(|[x, z, w]| Homogeneous::new(DVec3::new(x, y, z), w));
        extrusion(&BSpline::new(KnotVector::bezier(2).unwrap(), &points).unwrap(), DVec3::Y).unwrap()
    };
    arcs.iter().flat_map(|arc| [bay(arc, -1.0), bay(arc, 0.0)]).collect()
}

fn add(scene: &mut Scene, mesh: Mesh) {
    scene.surfaces.push(Surface {
        name: mesh.name.clone(),
        mesh: scene.meshes.len(),
        material: 0,
        transform: Affine3A::IDENTITY,
        receiver: Receiver::Lightmap { density: 1.0 },
        casts: true,
    });
    scene.meshes.push(mesh);
}

/// A vase on a floor under a vault of four patches, each cut on its own.
fn chapel() -> Scene {
    let base_color = Vec3::splat(0.6).extend(1.0);
    let material = Material { base_color, double_sided: true, ..Default::default() };
    let mut scene = Scene { materials: vec![material], ..Default::default() };
    let cut = |patch: &Nurbs3, name: String| {
        tessellate(&patch.surface(), &tolerance(1e-3, 0.15), ChartScale::Area).mesh(name)
    };
    add(&mut scene, cut(&vase(), "vase".into()));
    vault().iter().enumerate().for_each(|(k, patch)| add(&mut scene, cut(patch, format!("vault {k}"))));
    let floor = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
    let floor = BSplineSurface::bezier(&floor, 2).unwrap();
    add(&mut scene, tessellate(&floor, &tolerance(1e-3, 0.15), ChartScale::Area).mesh("floor".into()));
    let (position, intensity) = (Vec3::new(0.5, -0.3, 1.4), Vec3::splat(40.0));
    let lamp = PointLight { position, intensity, range: f32::INFINITY, radius: 0.05 };
    scene.lights.push(Light { name: "lamp".into(), source: LightSource::Point(lamp) });
    scene
}

/// The bake takes the charts of splines as they are, and makes the two sides of the borders of patches agree.
#[test]
fn a_vase_under_a_vault_needs_no_unwrap() {
    let scene = chapel();
    let layout = LayoutSettings { resolution: Resolution::TexelsPerMeter(24.0), ..Default::default() };
    let settings = BakeSettings { layout, quality: Quality::Draft, ..Default::default() };
    let bake = bake(&scene, &settings, &Progress::default()).unwrap();
    let report = &bake.report;
    println!("{} texels, {} valid, {} invalid", report.texels, report.valid_texels, report.invalid_texels);
    println!("{:?} {:?}", report.seams, report.warnings);
    assert!(bake.uvs.iter().flatten().all(|uv| uv.origin == UvOrigin::Kept));
    assert!(report.warnings.is_empty(), "{:?}", report.warnings);
    assert!(
        report.seams.pairs > 0 && report.seams.step_after < 0.01 && report.seams.step_after < report.seams.step_before
    );
}
