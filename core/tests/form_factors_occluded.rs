//! Form factors past blockers against known values and laws.

#[path = "reference/occluded.rs"]
mod occluded;

use glam::{DVec3, Vec3};
use occluded::{DISCS, OccludedPair, PAIRS, POINT_TO_RING, POINTS, Point};
use radiosity::form_factor::{
    Estimate, point_to_point, polygon_to_polygon, polygon_to_polygon_among, visible_coaxial_discs,
    visible_point_to_polygon, visible_polygon_to_polygon, visible_polygon_to_polygon_by_rays,
};
use radiosity::geometry::{Occluders, PolygonOccluders, Ray, Sobol};
use radiosity::math::Vector;

type Polygon = Vec<DVec3>;

/// The corners, with coordinates of endless strips cut at `end`.
fn polygon<V: Vector>(corners: &[Point], end: f64) -> Vec<V> {
    corners.iter().map(|corner| V::from_dvec3(DVec3::from_array(corner.map(|x| x.clamp(-end, end))))).collect()
}

/// Both polygons and the blockers of a case.
fn geometry<V: Vector>(case: &OccludedPair, end: f64) -> (Vec<V>, Vec<V>, Vec<Vec<V>>) {
    let blockers = case.blockers.iter().map(|blocker| polygon(blocker, end)).collect();
    (polygon(case.a, end), polygon(case.b, end), blockers)
}

fn slices<V>(polygons: &[Vec<V>]) -> Vec<&[V]> {
    polygons.iter().map(Vec::as_slice).collect()
}

#[test]
fn known_pairs_in_double_precision() {
    for accuracy in [1e-3, 1e-6, 1e-8] {
        for case in PAIRS {
            let (a, b, blockers) = geometry::<DVec3>(case, f64::MAX);
            let found = visible_polygon_to_polygon(&a, &b, &slices(&blockers), accuracy);
            let error = (found.value - case.factor).abs();
            assert!(error <= accuracy + case.tolerance, "{}: {error:e} at {accuracy:e}", case.name);
            assert!(error <= found.error + case.tolerance, "{}: {error:e} at {accuracy:e}, {found:?}", case.name);
            assert!(found.error <= accuracy, "{}: {found:?} at {accuracy:e}", case.name);
        }
    }
}

#[test]
fn known_pairs_by_the_method_that_fits() {
    for accuracy in [1e-3, 1e-6] {
        for case in PAIRS {
            let (a, b, blockers) = geometry::<DVec3>(case, f64::MAX);
            let found = polygon_to_polygon_among(&a, &b, &slices(&blockers), accuracy);
            let error = (found.value - case.factor).abs();
            assert!(error <= found.error + case.tolerance, "{}: {error:e} at {accuracy:e}, {found:?}", case.name);
            assert!(found.error <= accuracy, "{}: {found:?} at {accuracy:e}", case.name);
        }
    }
}

/// The mean of what points of `a`, a parallelogram or a regular polygon, see of `b`, with four standard errors.
fn mean_over_points(a: &[DVec3], b: &[DVec3], blockers: &[&[DVec3]]) -> Estimate<f64> {
    const POINTS: u32 = 64;
    let normal = (a[1] - a[0]).cross(a[2] - a[0]).normalize();
    // Equal triangles, a fan around the center.
    let center = a.iter().sum::<DVec3>() / a.len() as f64;
    let see = |sequence: &Sobol, index: u32| {
        let square = sequence.square(index).as_dvec2();
        let (place, root) = (square.x * a.len() as f64, square.y.sqrt());
        let edge = place as usize;
        let rim = a[edge].lerp(a[(edge + 1) % a.len()], place.fract());
        visible_point_to_polygon(center.lerp(rim, root), normal, b, blockers)
    };
    let mean = |seed| (0..POINTS).map(|index| see(&Sobol::new(seed), index)).sum::<f64>() / f64::from(POINTS);
    let means: [f64; 16] = std::array::from_fn(|seed| mean(seed as u32));
    let value = means.iter().sum::<f64>() / 16.0;
    let squares: f64 = means.iter().map(|mean| (mean - value).powi(2)).sum();
    Estimate { value, error: 4.0 * (squares / (16.0 * 15.0)).sqrt() }
}

#[test]
fn known_pairs_from_their_points() {
    for case in PAIRS {
        let (a, b, blockers) = geometry::<DVec3>(case, f64::MAX);
        let found = mean_over_points(&a, &b, &slices(&blockers));
        let error = (found.value - case.factor).abs();
        assert!(error <= found.error + 1e-10, "{}: {error:e}, {found:?}", case.name);
        assert!(found.error < 2e-3, "{}: {found:?}", case.name);
    }
}

#[test]
fn known_pairs_in_single_precision() {
    for case in PAIRS {
        let (a, b, blockers) = geometry::<Vec3>(case, 1000.0);
        let found = visible_polygon_to_polygon(&a, &b, &slices(&blockers), 1e-6);
        let error = (f64::from(found.value) - case.factor).abs();
        assert!(error <= f64::from(found.error), "{}: {error:e}, {found:?}", case.name);
        assert!(found.error < 4e-6, "{}: {found:?}", case.name);
    }
}

#[test]
fn known_pairs_by_rays() {
    for accuracy in [4e-3, 4e-4] {
        for case in PAIRS {
            let (a, b, blockers) = geometry::<Vec3>(case, 30.0);
            let blockers = slices(&blockers);
            let found = visible_polygon_to_polygon_by_rays(&a, &b, &PolygonOccluders(&blockers), accuracy);
            let error = (f64::from(found.value) - case.factor).abs();
            // The ends of the strips are seen at 3e-6.
            assert!(error < f64::from(found.error) + 3e-6, "{}: {error:e}, {found:?}", case.name);
            // A million rays do not reach more where polygons share an edge or most of one is far away.
            let is_hard = ["share an edge", "endless"].iter().any(|kind| case.name.contains(kind));
            let least = if is_hard { 1.5e-3 } else { 0.0 };
            assert!(found.error <= accuracy.max(least), "{}: {found:?}", case.name);
        }
    }
}

#[test]
fn known_points() {
    for case in POINTS {
        let (at, blocker) = (DVec3::from_array(case.point), polygon(case.blocker, f64::MAX));
        let seen = visible_point_to_polygon(at, DVec3::Z, &polygon(case.polygon, f64::MAX), &[&blocker]);
        assert!((seen - case.factor).abs() < 2.0 * case.tolerance, "{}: {seen}", case.name);
        let (at, blocker) = (at.as_vec3(), polygon(case.blocker, 1000.0));
        let seen = visible_point_to_polygon(at, Vec3::Z, &polygon(case.polygon, 1000.0), &[&blocker]);
        assert!((f64::from(seen) - case.factor).abs() < 1e-6, "{}: {seen}", case.name);
    }
}

#[test]
fn known_discs() {
    for case in DISCS {
        let [a, b] = case.radii;
        let factor = visible_coaxial_discs(a, b, case.distance, case.blocker_radius, case.blocker_distance);
        assert!((factor - case.factor).abs() < case.tolerance, "{}: {factor}", case.name);
        let beyond = case.distance - case.blocker_distance;
        let reverse = visible_coaxial_discs(b, a, case.distance, case.blocker_radius, beyond);
        assert!((a * a * factor - b * b * reverse).abs() < 1e-13, "{}: reciprocity", case.name);
        let single = [a, b, case.distance, case.blocker_radius, case.blocker_distance].map(|length| length as f32);
        let [a, b, distance, blocker, blocker_distance] = single;
        let single = visible_coaxial_discs(a, b, distance, blocker, blocker_distance);
        assert!((f64::from(single) - case.factor).abs() < 1e-7, "{}: {single}", case.name);
    }
}

/// A regular polygon with the area of a disc that looks down.
fn disc(corners: u32, radius: f64, height: f64) -> Polygon {
    let step = std::f64::consts::TAU / f64::from(corners);
    let radius = radius * (step / step.sin()).sqrt();
    let angles = (0..corners).rev().map(|k| f64::from(k) * step);
    angles.map(|angle| DVec3::new(angle.cos() * radius, angle.sin() * radius, height)).collect()
}

/// Regular polygons with the areas of discs, so large that they are handled in parts.
#[test]
fn large_polygons() {
    for corners in [50, 64, 200] {
        let (receiver, blocker) = (disc(corners, 1.0, 2.0), disc(corners, 0.3, 1.0));
        let seen = visible_point_to_polygon(DVec3::ZERO, DVec3::Z, &receiver, &[&blocker]);
        // The areas agree, so that the error falls with the fourth power of the number of corners.
        let error = (seen - POINT_TO_RING).abs();
        assert!(error < 100.0 / f64::from(corners).powi(4), "{corners}: {error:e}");
    }
    for case in DISCS {
        let (mut a, b) = (disc(64, case.radii[0], 0.0), disc(64, case.radii[1], case.distance));
        a.reverse();
        let blocker = disc(64, case.blocker_radius, case.blocker_distance);
        let found = polygon_to_polygon_among(&a, &b, &[&blocker], 1e-4);
        assert!((found.value - case.factor).abs() < 1e-4, "{}: {found:?}", case.name);
        let found = mean_over_points(&a, &b, &[&blocker]);
        assert!((found.value - case.factor).abs() < found.error + 1e-5, "{}: {found:?}", case.name);
    }
}

/// Slats across `from..to` at `height`, of which each hides the first half of its share, in the order of `turn`.
fn slats(count: usize, [from, to]: [f64; 2], height: f64, turn: usize) -> Vec<Polygon> {
    let step = (to - from) / count as f64;
    let slat = |k: usize| {
        let x = from + step * (k * turn % count) as f64;
        [(x, -9.0), (x + 0.5 * step, -9.0), (x + 0.5 * step, 9.0), (x, 9.0)].map(|(x, y)| DVec3::new(x, y, height))
    };
    (0..count).map(|k| slat(k).to_vec()).collect()
}

/// A strip without blockers where the slats have gaps, in any order of the slats.
#[test]
fn a_point_sees_past_thousands_of_blockers() {
    const COUNT: usize = 3000;
    let strip =
        |from: f64, to: f64| [(from, -1.0), (from, 1.0), (to, 1.0), (to, -1.0)].map(|(x, y)| DVec3::new(x, y, 1.0));
    let (point, step) = (DVec3::new(0.1, 0.2, 0.0), 2.0 / COUNT as f64);
    // At half the height the gap from x to x + d shows twice as much of the strip, seen from the point.
    let gap = |k: usize| {
        let [from, to] = [0.5, 1.0].map(|share| 0.5 * (point.x - 1.0) + 0.5 * step * (k as f64 + share));
        let [from, to] = [from, to].map(|x| point.x + 2.0 * (x - point.x));
        visible_point_to_polygon(point, DVec3::Z, &strip(from, to), &[])
    };
    let expected: f64 = (0..COUNT).map(gap).sum();
    let look = move || {
        for turn in [1, 1747] {
            let slats = slats(COUNT, [0.5 * (point.x - 1.0), 0.5 * (point.x + 1.0)], 0.5, turn);
            let seen = visible_point_to_polygon(point, DVec3::Z, &strip(-1.0, 1.0), &slices(&slats));
            assert!((seen - expected).abs() < 1e-11, "{turn}: {seen} {expected}");
        }
    };
    // A quarter of what threads have.
    std::thread::Builder::new().stack_size(512 << 10).spawn(look).unwrap().join().unwrap();
}

/// Numbers in `[0, 1)` that look random.
struct Random(u32);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 += 1;
        f64::from(radiosity::geometry::hash(self.0, 0x51ed)) / 2f64.powi(32)
    }

    fn point(&mut self, low: f64, high: f64) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next()) * (high - low) + low
    }

    /// A parallelogram of any direction around a point of a box.
    fn parallelogram(&mut self, low: f64, high: f64, size: f64) -> Polygon {
        let center = self.point(low, high);
        let (u, v) = (self.point(-size, size), self.point(-size, size));
        vec![center - u - v, center + u - v, center + u + v, center - u + v]
    }
}

fn halves(polygon: &[DVec3]) -> [Polygon; 2] {
    let (start, end) = (polygon[0].lerp(polygon[1], 0.3), polygon[2].lerp(polygon[3], 0.6));
    [vec![polygon[0], start, end, polygon[3]], vec![start, polygon[1], polygon[2], end]]
}

/// Turns the front of a polygon to a point.
fn face(polygon: &mut Polygon, point: DVec3) {
    if (polygon[1] - polygon[0]).cross(polygon[2] - polygon[0]).dot(point - polygon[0]) < 0.0 {
        polygon.reverse();
    }
}

/// The definition: the point formula over many points of the polygon, those left out that a blocker hides.
fn by_definition(point: DVec3, normal: DVec3, polygon: &[DVec3], blockers: &[&[DVec3]]) -> f64 {
    const COUNT: u32 = 1 << 13;
    let (u, v) = (polygon[1] - polygon[0], polygon[3] - polygon[0]);
    let cross = u.cross(v);
    let sequence = Sobol::new(1);
    let seen = |i| {
        let square = sequence.square(i).as_dvec2();
        let target = polygon[0] + u * square.x + v * square.y;
        let (origin, direction) = (point.as_vec3(), (target - point).as_vec3());
        let ray = Ray { origin, direction, end: 1.0 - 1e-5 };
        let is_hidden = PolygonOccluders(blockers).any(&ray, |hit| hit.distance > 1e-5);
        if is_hidden { 0.0 } else { point_to_point(point, normal, target, cross.normalize(), cross.length()) }
    };
    (0..COUNT).map(seen).sum::<f64>() / f64::from(COUNT)
}

/// Blockers anywhere: across the horizon, across the plane of the polygon, behind either, over one another.
#[test]
fn the_share_a_point_sees_is_what_its_definition_says() {
    let mut random = Random(0);
    let mut partly = 0;
    for round in 0..300 {
        let receiver = random.parallelogram(-1.0, 1.0, 0.8);
        let point = random.point(-1.0, 1.0) * 2.0;
        let normal = (random.point(-1.0, 1.0) - point).normalize();
        let count = 1 + round % 5;
        let blockers: Vec<Polygon> = (0..count).map(|_| random.parallelogram(-2.0, 2.0, 0.8)).collect();
        let blockers = slices(&blockers);
        let seen = visible_point_to_polygon(point, normal, &receiver, &blockers);
        let expected = by_definition(point, normal, &receiver, &blockers);
        let whole = visible_point_to_polygon(point, normal, &receiver, &[]);
        // Near a polygon the definition converges slowly.
        assert!((seen - expected).abs() < 0.002 + 0.05 * expected, "round {round}: {seen} {expected}");
        assert!(seen <= whole + 1e-15);
        partly += u32::from(seen > 0.05 * whole && seen < 0.95 * whole);
    }
    assert!(partly > 30, "{partly} points lie in a penumbra");
}

#[test]
fn splitting_a_blocker_changes_nothing_and_another_one_hides_more() {
    let mut random = Random(7000);
    for round in 0..200 {
        let receiver = random.parallelogram(-1.0, 1.0, 0.8);
        let point = random.point(-2.0, 2.0);
        let normal = (random.point(-1.0, 1.0) - point).normalize();
        let (first, second) = (random.parallelogram(-2.0, 2.0, 1.0), random.parallelogram(-2.0, 2.0, 1.0));
        let [left, right] = halves(&first);
        let see = |blockers: &[&[DVec3]]| visible_point_to_polygon(point, normal, &receiver, blockers);
        let both = see(&[&first, &second]);
        assert!((both - see(&[&second, &left, &right])).abs() < 1e-13, "round {round}");
        assert!((both - see(&[&second, &first, &first])).abs() < 1e-13, "round {round}");
        assert!(both <= see(&[&first]) + 1e-14 && both <= see(&[&second]) + 1e-14, "round {round}");
    }
}

#[test]
fn polygons_among_few_blockers() {
    let mut random = Random(90_000);
    let mut partly = 0;
    for round in 0..40 {
        let (mut a, mut b) = (random.parallelogram(-1.0, 1.0, 0.7), random.parallelogram(-1.0, 1.0, 0.7));
        face(&mut a, b[0]);
        face(&mut b, a[0]);
        let blockers: Vec<Polygon> = (0..1 + round % 3).map(|_| random.parallelogram(-1.0, 1.0, 0.5)).collect();
        let find = |a: &[DVec3], b: &[DVec3], blockers: &[&[DVec3]]| visible_polygon_to_polygon(a, b, blockers, 1e-4);
        let found = find(&a, &b, &slices(&blockers));
        let whole = polygon_to_polygon(&a, &b);
        let bound = |other: Estimate<f64>| found.error + other.error + 1e-12;

        assert!((find(&a, &b, &[]).value - whole).abs() < 1e-12, "round {round}: nothing between");
        let reverse = find(&b, &a, &slices(&blockers));
        let area = |polygon: &[DVec3]| (polygon[1] - polygon[0]).cross(polygon[3] - polygon[0]).length();
        let difference = area(&a) * found.value - area(&b) * reverse.value;
        let errors = area(&a) * found.error + area(&b) * reverse.error;
        assert!(difference.abs() <= errors + 1e-12, "round {round}: reciprocity");
        let mut split: Vec<Polygon> = blockers[1..].to_vec();
        split.extend(halves(&blockers[0]));
        let split = find(&a, &b, &slices(&split));
        assert!((found.value - split.value).abs() <= bound(split), "round {round}: {found:?} {split:?}");
        let fewer = find(&a, &b, &slices(&blockers[1..]));
        assert!(found.value <= fewer.value + bound(fewer), "round {round}: {found:?} {fewer:?}");
        let finer = visible_polygon_to_polygon(&a, &b, &slices(&blockers), 1e-6);
        assert!((found.value - finer.value).abs() <= bound(finer), "round {round}: {found:?} {finer:?}");
        let rays = visible_polygon_to_polygon_by_rays(&a, &b, &PolygonOccluders(&slices(&blockers)), 4e-3);
        assert!((finer.value - rays.value).abs() < rays.error + 1e-6, "round {round}: {finer:?} {rays:?}");
        partly += u32::from(found.value > 0.02 * whole && found.value < 0.98 * whole);
    }
    assert!(partly > 10, "{partly} pairs are hidden in part");
}

/// What passes a slit is what a needle in its place stops: shadows narrower than the points of any rule.
#[test]
fn slits_and_needles() {
    let (a, b, _) = geometry::<DVec3>(&PAIRS[0], f64::MAX);
    let strip = |from: f64, to: f64, height: f64| {
        [(from, -4.0), (to, -4.0), (to, 5.0), (from, 5.0)].map(|(x, y)| DVec3::new(x + 0.1 * y, y, height))
    };
    let whole = polygon_to_polygon(&a, &b);
    for (width, height) in [(0.1, 0.5), (0.01, 0.9), (0.01, 0.2), (0.001, 0.5), (1e-5, 0.99)] {
        let (from, to) = (0.37, 0.37 + width);
        let (left, right, needle) = (strip(-5.0, from, height), strip(to, 6.0, height), strip(from, to, height));
        for accuracy in [1e-3, 1e-5, 1e-7] {
            let through = visible_polygon_to_polygon(&a, &b, &[&left, &right], accuracy);
            let past = visible_polygon_to_polygon(&a, &b, &[&needle], accuracy);
            let difference = (through.value + past.value - whole).abs();
            let told = through.error + past.error + 1e-12;
            assert!(difference <= told, "{width} at {height} to {accuracy:e}: {difference:e} {through:?} {past:?}");
            assert!(told <= 4.0 * accuracy, "{width} at {height}: {told:e} for {accuracy:e}");
        }
    }
}

#[test]
fn what_is_fully_hidden_gets_nothing() {
    let mut random = Random(400);
    for _ in 0..50 {
        let (a, b) = (random.parallelogram(0.0, 0.2, 0.5), random.parallelogram(3.0, 3.2, 0.5));
        let wall = [(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)]
            .map(|(u, v)| DVec3::splat(1.6) + DVec3::new(1.0, -1.0, 0.0) * u + DVec3::new(1.0, 1.0, -2.0) * v);
        let found = visible_polygon_to_polygon(&a, &b, &[&wall], 1e-6);
        assert_eq!(found, Estimate { value: 0.0, error: 0.0 });
    }
}

/// Walls of the room themselves among the blockers, also those that share edges with the two polygons.
#[test]
fn senders_and_receivers_do_not_hide_themselves() {
    let corner = |k: usize| DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64);
    let sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let walls = sides.map(|side| side.map(corner));
    let all: Vec<&[DVec3]> = walls.iter().map(|wall| &wall[..]).collect();
    for i in 0..6 {
        let row = |j: usize| visible_polygon_to_polygon(&walls[i], &walls[j], &all, 1e-8).value;
        let sum: f64 = (0..6).map(row).sum();
        assert!((sum - 1.0).abs() < 1e-12, "{sum}");
        for j in 0..6 {
            assert!((row(j) - polygon_to_polygon(&walls[i], &walls[j])).abs() < 1e-14);
        }
    }
}

#[test]
fn the_method_that_fits() {
    let (a, b, _) = geometry::<DVec3>(&PAIRS[0], f64::MAX);
    let at = |x: f64, y: f64| DVec3::new(x, y, 0.5);
    // An L, and the two rectangles that it is made of.
    let shape = vec![at(0.2, 0.2), at(0.8, 0.2), at(0.8, 0.4), at(0.4, 0.4), at(0.4, 0.8), at(0.2, 0.8)];
    let parts = [
        vec![at(0.2, 0.2), at(0.8, 0.2), at(0.8, 0.4), at(0.2, 0.4)],
        vec![at(0.2, 0.4), at(0.4, 0.4), at(0.4, 0.8), at(0.2, 0.8)],
    ];
    let exact = polygon_to_polygon_among(&a, &b, &slices(&parts), 1e-8);
    assert!(exact.error < 1e-8);
    let rays = polygon_to_polygon_among(&a, &b, &[&shape], 5e-4);
    assert!(rays.error > 1e-6 && (exact.value - rays.value).abs() < rays.error, "{exact:?} {rays:?}");
    let aside: Polygon = shape.iter().map(|corner| *corner + DVec3::X * 2.0).collect();
    let free = polygon_to_polygon_among(&a, &b, &[&aside], 1e-3);
    assert!((free.value - polygon_to_polygon(&a, &b)).abs() < 1e-15 && free.error <= 1e-12);
    let mut random = Random(5);
    let many: Vec<Polygon> = (0..30).map(|_| random.parallelogram(0.2, 0.8, 0.08)).collect();
    let rays = polygon_to_polygon_among(&a, &b, &slices(&many), 1e-3);
    let exact = visible_polygon_to_polygon(&a, &b, &slices(&many), 1e-3);
    assert!((exact.value - rays.value).abs() < rays.error + exact.error, "{exact:?} {rays:?}");
}

/// Blockers in one plane hide what each of them hides.
#[test]
fn polygons_among_hundreds_of_slats() {
    let (a, b, _) = geometry::<DVec3>(&PAIRS[0], f64::MAX);
    let whole = polygon_to_polygon(&a, &b);
    for (count, accuracy, stated) in [(24, 1e-3, 1e-3), (24, 1e-6, 1e-6), (300, 5e-5, 2e-3)] {
        let slats = slats(count, [0.1, 0.9], 0.5, 7);
        let hidden = |slat: &Polygon| whole - visible_polygon_to_polygon(&a, &b, &[slat], 1e-8).value;
        let expected = whole - slats.iter().map(hidden).sum::<f64>();
        let found = polygon_to_polygon_among(&a, &b, &slices(&slats), accuracy);
        assert!((found.value - expected).abs() <= found.error + 1e-8, "{count}: {found:?} {expected}");
        assert!(found.error <= stated, "{count}: {found:?}");
    }
}

/// A sheet just above the sender hides everything, the sender itself nothing.
#[test]
fn rays_meet_what_lies_on_a_polygon() {
    let (a, b, _) = geometry::<DVec3>(&PAIRS[0], f64::MAX);
    let whole = polygon_to_polygon(&a, &b);
    for (height, expected) in [(0.0, whole), (5e-5, 0.0), (1.0 - 5e-5, 0.0), (1.0, whole)] {
        let sheet = [(-1.0, -1.0), (2.0, -1.0), (2.0, 2.0), (-1.0, 2.0)].map(|(x, y)| DVec3::new(x, y, height));
        let found = visible_polygon_to_polygon_by_rays(&a, &b, &PolygonOccluders(&[&sheet, &a, &b]), 1e-3);
        assert!((found.value - expected).abs() < 1e-15, "{height}: {found:?}");
    }
}

#[test]
fn nothing_to_compute() {
    let (a, b, blockers) = geometry::<DVec3>(&PAIRS[0], f64::MAX);
    let blocker: &[DVec3] = &blockers[0];
    let line = [DVec3::ZERO, DVec3::X, DVec3::X * 2.0];
    for bad in [&[], &a[..1], &a[..2], &line, &[DVec3::NAN; 4]] {
        assert_eq!(visible_polygon_to_polygon(bad, &b, &[blocker], 1e-6).value, 0.0);
        assert_eq!(visible_polygon_to_polygon(&a, bad, &[blocker], 1e-6).value, 0.0);
        assert_eq!(polygon_to_polygon_among(bad, &b, &[blocker], 1e-6).value, 0.0);
        assert_eq!(visible_polygon_to_polygon_by_rays(&a, bad, &PolygonOccluders(&[blocker]), 1e-3).value, 0.0);
        assert_eq!(visible_point_to_polygon(DVec3::ZERO, DVec3::Z, bad, &[blocker]), 0.0);
        let without = visible_polygon_to_polygon(&a, &b, &[bad], 1e-6).value;
        assert!((without - polygon_to_polygon(&a, &b)).abs() < 1e-6);
    }
    assert_eq!(visible_polygon_to_polygon(&b, &a.iter().rev().copied().collect::<Polygon>(), &[], 1e-6).value, 0.0);
}
