//! The hemicube, Nusselt's projection and its rays against known form factors, each within the error that it tells.

use std::ops::Range;

use glam::{DVec3, Vec2, Vec3};
use radiosity::form_factor::*;
use radiosity::geometry::BruteForce;

#[path = "../../examples/nusselt.rs"]
#[expect(dead_code, reason = "the test looks at the picture only")]
mod nusselt;
#[path = "reference/occluded.rs"]
#[expect(dead_code, reason = "these methods are for polygons")]
mod occluded;

const N: usize = 256;

/// Seen from the origin, which looks along `normal`.
struct PointCase {
    name: &'static str,
    normal: DVec3,
    polygon: Vec<DVec3>,
    blocker: Vec<DVec3>,
    factor: f64,
}

/// One polygon to another.
struct PairCase {
    name: String,
    from: Vec<DVec3>,
    to: Vec<DVec3>,
    blockers: Vec<Vec<DVec3>>,
    factor: f64,
}

/// A disc as a polygon of the same area, which looks down.
fn disc(center: [f64; 3], radius: f64) -> Vec<DVec3> {
    let step = std::f64::consts::TAU / 360.0;
    let rim = radius * (step / step.sin()).sqrt();
    let corner =
        |k: i32| DVec3::from(center) + DVec3::new((f64::from(k) * step).cos(), -(f64::from(k) * step).sin(), 0.0) * rim;
    (0..360).map(corner).collect()
}

/// A rectangle that looks down.
fn down(x: Range<f64>, y: Range<f64>, z: f64) -> Vec<DVec3> {
    [[x.start, y.start], [x.start, y.end], [x.end, y.end], [x.end, y.start]].map(|[x, y]| DVec3::new(x, y, z)).to_vec()
}

/// A rectangle at a distance along x that looks back.
fn wall(x: f64, y: Range<f64>, z: Range<f64>) -> Vec<DVec3> {
    [[y.start, z.start], [y.start, z.end], [y.end, z.end], [y.end, z.start]].map(|[y, z]| DVec3::new(x, y, z)).to_vec()
}

/// Howell's catalogue, B-3, B-4, B-12 to B-14, and Lambert's sum.
fn point_cases() -> Vec<PointCase> {
    let case = |name, normal, polygon, factor| PointCase { name, normal, polygon, blocker: Vec::new(), factor };
    let up = DVec3::Z;
    let triangle = [[0.3, -0.2, 1.0], [0.5, 1.1, 1.6], [1.4, 0.1, 0.7]].map(DVec3::from).to_vec();
    vec![
        case("square, corner above", up, down(0.0..1.0, 0.0..1.0, 1.0), 0.138_531_605_994_9),
        case("rectangle, corner above", up, down(0.0..2.0, 0.0..1.0, 0.5), 0.220_777_622_334_8),
        case("wall on the horizon", up, wall(1.0, 0.0..1.0, 0.0..1.0), 0.055_734_197_002_55),
        case("high wall on the horizon", up, wall(0.5, 0.0..1.0, 0.0..2.0), 0.158_774_804_514_3),
        case("wall through the horizon", up, wall(1.0, -1.0..1.0, -0.5..1.5), 0.160_578_813_342_4),
        case("triangle", DVec3::new(0.2, 0.1, 1.0).normalize(), triangle, 0.095_350_005_369_94),
        case("disc above", up, disc([0.0, 0.0, 2.0], 0.5), 1.0 / 17.0),
        case("wide disc above", up, disc([0.0, 0.0, 1.0], 3.0), 0.9),
        case("disc beside the axis", up, disc([0.5, 0.0, 1.0], 1.0), 0.437_982_632_705_4),
        case("disc far beside the axis", up, disc([2.0, 0.0, 1.0], 1.0), 0.052_786_404_500_04),
        case("disc across", DVec3::X, disc([1.0, 0.0, 2.0], 0.5), 0.018_649_625_152_6),
        PointCase {
            name: "square behind a square",
            normal: up,
            polygon: down(-0.5..0.5, -0.5..0.5, 1.0),
            blocker: down(-0.125..0.125, -0.125..0.125, 0.5),
            factor: 0.165_978_835_648_3,
        },
        PointCase {
            name: "disc behind a disc",
            normal: up,
            polygon: disc([0.0, 0.0, 2.0], 1.0),
            blocker: disc([0.0, 0.0, 1.0], 0.3),
            factor: 0.117_431_192_660_6,
        },
    ]
}

/// Two unit squares in different positions; what they exchange unoccluded is found by the contour integral.
fn pair_cases() -> Vec<PairCase> {
    let floor: Vec<DVec3> =
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    let tilted = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let far = DVec3::new(cos, 0.0, sin);
        vec![DVec3::ZERO, DVec3::Y, DVec3::Y + far, far]
    };
    let mut others: Vec<_> =
        [0.1, 0.5, 1.0, 2.0, 10.0].map(|d| (format!("parallel at {d}"), down(0.0..1.0, 0.0..1.0, d))).to_vec();
    others.extend([30.0, 60.0, 90.0, 150.0].map(|angle| (format!("edge in common, {angle} degrees"), tilted(angle))));
    others.push(("offset".to_owned(), down(0.7..1.9, -0.4..0.3, 0.6)));
    let unoccluded = others.into_iter().map(|(name, to)| {
        let factor = polygon_to_polygon(&floor, &to);
        PairCase { name, from: floor.clone(), to, blockers: Vec::new(), factor }
    });
    let corners = |polygon: &[occluded::Point]| polygon.iter().map(|&corner| DVec3::from(corner)).collect::<Vec<_>>();
    let occluded = occluded::PAIRS.iter().filter(|pair| !pair.blockers.is_empty()).map(|pair| PairCase {
        name: pair.name.to_owned(),
        from: corners(pair.a),
        to: corners(pair.b),
        blockers: pair.blockers.iter().map(|blocker| corners(blocker)).collect(),
        factor: pair.factor,
    });
    unoccluded.chain(occluded).collect()
}

struct Buffers {
    items: Vec<u32>,
    depths: Vec<f32>,
    deltas: Vec<f64>,
}

impl Buffers {
    fn new() -> Self {
        let pixels = hemicube_pixels(N);
        Self { items: vec![0; pixels], depths: vec![0.0; pixels], deltas: vec![0.0; hemicube_deltas(N)] }
    }

    fn hemicube(&mut self) -> Hemicube<'_> {
        let Self { items, depths, deltas } = self;
        Hemicube::new(N, HemicubeBuffers { items, depths, deltas }).unwrap()
    }
}

/// The value lies within its error, which is useful: below a share of the value or an absolute limit.
fn assert_within(name: &str, found: Estimate<f64>, factor: f64, [relative, absolute]: [f64; 2]) {
    println!("{name:45} {factor:.6} {:+.1e} of {:.1e}", found.value - factor, found.error);
    assert!((found.value - factor).abs() <= found.error, "{name}: {found:?} is not {factor}");
    assert!(found.error <= (relative * factor).max(absolute), "{name}: {found:?} tells little");
}

fn fan(polygon: &[DVec3]) -> impl Iterator<Item = [Vec3; 3]> + '_ {
    (2..polygon.len()).map(|k| [polygon[0], polygon[k - 1], polygon[k]].map(|corner| corner.as_vec3()))
}

#[test]
fn nusselts_area_of_points() {
    for PointCase { name, normal, polygon, blocker, factor } in point_cases() {
        let area = nusselt_area(DVec3::ZERO, normal, &polygon);
        assert!(
            (area - point_to_polygon(DVec3::ZERO, normal, &polygon)).abs() < 1e-14,
            "{name}: Lambert's sum differs"
        );
        let single: Vec<Vec3> = polygon.iter().map(|corner| corner.as_vec3()).collect();
        let single = nusselt_area(Vec3::ZERO, normal.as_vec3(), &single);
        assert!((f64::from(single) - area).abs() < 1e-6, "{name}: {single} in single precision");
        // The polygons that stand for discs are good to 1e-8; past one blocker only centered cases are differences.
        let scale = if name.starts_with("square b") { 2.0 } else { 1.0 };
        let shadow: Vec<DVec3> = blocker.iter().map(|&corner| corner * DVec3::new(scale, scale, scale)).collect();
        let visible = area - nusselt_area(DVec3::ZERO, normal, &shadow);
        let tolerance = if name.contains("disc") { 1e-7 } else { 1e-12 };
        assert!((visible - factor).abs() < tolerance, "{name}: {visible}");
    }
}

#[test]
fn hemicube_of_points() {
    let mut buffers = Buffers::new();
    let mut hemicube = buffers.hemicube();
    for PointCase { name, normal, polygon, blocker, factor } in point_cases() {
        for turn in [0.0, 0.3, 0.6] {
            let mut row = [Estimate::default(); 2];
            let bins = hemicube.point_row([DVec3::ZERO, normal], turn, &[&polygon, &blocker], &mut row);
            assert_eq!(row[0].value + row[1].value + bins.sky + bins.void, 1.0);
            assert_within(name, row[0], factor, [0.08, 1e-3]);
            assert!((row[0].value / factor - 1.0).abs() < 0.01, "{name}: {:?}", row[0]);
        }
    }
}

#[test]
fn rays_from_points() {
    let samples = Samples { scrambles: 16, points: 1024, seed: 5 };
    for PointCase { name, normal, polygon, blocker, factor } in point_cases() {
        let triangles: Vec<_> = fan(&polygon).chain(fan(&blocker)).collect();
        let patch = |hit: &radiosity::geometry::Hit| (hit.triangle < polygon.len() as u32 - 2).then_some(0);
        let sender = |_: Vec2| [Vec3::ZERO, normal.as_vec3()];
        let mut row = [Estimate::<f64>::default()];
        let bins = nusselt_rays(sender, &BruteForce(&triangles), patch, &samples, &mut row, &mut [0]);
        assert!((row[0].value + bins.sky + bins.void - 1.0).abs() < 1e-12);
        assert_within(name, row[0], factor, [0.1, 1e-3]);
    }
}

/// Unit squares to half a percent, all to their own error.
#[test]
fn hemicube_of_pairs() {
    let mut buffers = Buffers::new();
    let mut hemicube = buffers.hemicube();
    let samples = Samples { scrambles: 16, points: 32, seed: 2 };
    for PairCase { name, from, to, blockers, factor } in pair_cases() {
        let patches: Vec<&[DVec3]> = [&to].into_iter().chain(&blockers).map(Vec::as_slice).collect();
        let mut rows = vec![[Estimate::default(); 2]; patches.len()].concat();
        let (row, scratch) = rows.split_at_mut(patches.len());
        let bins = hemicube.polygon_row(&from, &patches, &samples, row, scratch);
        let sum: f64 = row.iter().map(|entry| entry.value).sum();
        assert!((sum + bins.sky + bins.void - 1.0).abs() < 1e-12);
        assert_within(&name, row[0], factor, [0.05, 1e-3]);
        if blockers.is_empty() {
            assert!((row[0].value / factor - 1.0).abs() < 0.005, "{name}: {:?} is not {factor}", row[0]);
        }
    }
}

#[test]
fn rays_of_pairs() {
    let samples = Samples { scrambles: 16, points: 4096, seed: 9 };
    let is_small = |polygon: &Vec<DVec3>| polygon.iter().all(|corner| corner.length() < 1e3);
    let in_single_precision = |pair: &PairCase| [&pair.from, &pair.to].into_iter().chain(&pair.blockers).all(is_small);
    for PairCase { name, from, to, blockers, factor } in pair_cases().into_iter().filter(in_single_precision) {
        let triangles: Vec<_> = fan(&to).chain(blockers.iter().flat_map(|blocker| fan(blocker))).collect();
        let from: Vec<Vec3> = from.iter().map(|corner| corner.as_vec3()).collect();
        let patch = |hit: &radiosity::geometry::Hit| (hit.triangle < to.len() as u32 - 2 && hit.front).then_some(0);
        let mut row = [Estimate::<f64>::default()];
        nusselt_rays(polygon_sender(&from), &BruteForce(&triangles), patch, &samples, &mut row, &mut [0]);
        assert_within(&name, row[0], factor, [0.06, 1e-3]);
    }
}

/// The picture in the documentation is what the example draws.
#[test]
fn the_picture_is_drawn_from_the_arcs() {
    assert_eq!(nusselt::picture(), include_str!("../src/form_factor/nusselt.svg"));
}
