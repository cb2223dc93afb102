//! Laws that form factors obey in any geometry: reciprocity, closure, additivity, and agreement of all methods.

#[path = "reference/small_patch.rs"]
mod small_patch;

use glam::{DQuat, DVec3, Vec3};
use radiosity::form_factor::*;
use radiosity::geometry::hash;
use small_patch::small_patch;

/// Numbers in `[-1, 1)` that look random.
struct Numbers(u32);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 += 1;
        f64::from(hash(self.0, 77)) / 2.0_f64.powi(31) - 1.0
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }

    fn rotation(&mut self) -> DQuat {
        DQuat::from_xyzw(self.next(), self.next(), self.next(), self.next() + 1.5).normalize()
    }

    /// A convex polygon of 3 to 7 corners on an ellipse, counter-clockwise around its normal.
    fn polygon(&mut self, center: DVec3) -> Vec<DVec3> {
        let rotation = self.rotation();
        let (count, wide, high) = (3 + self.0 % 5, 0.2 + self.next().abs(), 0.2 + self.next().abs());
        let corner = |k| {
            let (sin, cos) = (std::f64::consts::TAU * (f64::from(k) + 0.35 * self.next()) / f64::from(count)).sin_cos();
            center + rotation * DVec3::new(wide * cos, high * sin, 0.0)
        };
        (0..count).map(corner).collect()
    }
}

fn area_vector(polygon: &[DVec3]) -> DVec3 {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(a, b)| 0.5 * (a - polygon[0]).cross(b - polygon[0])).sum()
}

fn area(polygon: &[DVec3]) -> f64 {
    area_vector(polygon).length()
}

fn single(polygon: &[DVec3]) -> Vec<Vec3> {
    polygon.iter().map(|corner| corner.as_vec3()).collect()
}

fn reversed(polygon: &[DVec3]) -> Vec<DVec3> {
    polygon.iter().rev().copied().collect()
}

/// Pairs at all distances; near ones pass through the planes of each other, and through each other.
fn pairs(count: usize, distance: f64) -> impl Iterator<Item = (Vec<DVec3>, Vec<DVec3>)> {
    let mut numbers = Numbers(hash(count as u32, distance as u32) % 1000);
    std::iter::repeat_with(move || {
        let center = numbers.vector() * distance;
        (numbers.polygon(DVec3::ZERO), numbers.polygon(center))
    })
    .take(count)
}

#[test]
fn reciprocity() {
    let mut seen = 0;
    for distance in [0.3, 1.0, 3.0, 10.0, 100.0] {
        for (a, b) in pairs(100, distance) {
            let (there, back) = (polygon_to_polygon(&a, &b), polygon_to_polygon(&b, &a));
            assert!((0.0..=1.0).contains(&there));
            assert!((area(&a) * there - area(&b) * back).abs() < 1e-14 * area(&a), "{a:?} {b:?}: {there} {back}");
            let other = polygon_to_polygon(&single(&a), &single(&b));
            assert!((f64::from(other) - there).abs() < 1e-5, "{a:?} {b:?}: {there} {other}");
            seen += usize::from(there > 0.0);
        }
    }
    assert!(seen > 100, "{seen}");
}

/// A polygon is the sum of its triangles, as a sender and as a receiver, wherever planes cut them.
#[test]
fn parts_add_up() {
    for distance in [0.5, 2.0, 20.0] {
        for (a, b) in pairs(60, distance) {
            let fan = |polygon: &[DVec3]| -> Vec<Vec<DVec3>> {
                (2..polygon.len()).map(|k| vec![polygon[0], polygon[k - 1], polygon[k]]).collect()
            };
            let whole = polygon_to_polygon(&a, &b);
            let to_parts: f64 = fan(&b).iter().map(|part| polygon_to_polygon(&a, part)).sum();
            let from_parts: f64 = fan(&a).iter().map(|part| area(part) * polygon_to_polygon(part, &b)).sum();
            assert!((whole - to_parts).abs() < 1e-10, "{a:?} {b:?}: {whole} {to_parts}");
            assert!((whole - from_parts / area(&a)).abs() < 1e-10, "{a:?} {b:?}: {whole} {from_parts}");
        }
    }
}

fn check_closure(name: &str, faces: &[Vec<DVec3>]) {
    let center_of = |face: &[DVec3]| face.iter().sum::<DVec3>() / face.len() as f64;
    let center = faces.iter().map(|face| center_of(face)).sum::<DVec3>() / faces.len() as f64;
    for (i, a) in faces.iter().enumerate() {
        let others = || faces.iter().enumerate().filter(move |(j, _)| *j != i).map(|(_, face)| face);
        let sum: f64 = others().map(|b| polygon_to_polygon(a, b)).sum();
        assert!((sum - 1.0).abs() < 1e-9, "{name} {i}: {sum}");
        let sum: f32 = others().map(|b| polygon_to_polygon(&single(a), &single(b))).sum();
        assert!((sum - 1.0).abs() < 1e-5, "{name} {i}: {sum}");
        let normal = area_vector(a).normalize();
        let sum: f64 = others().map(|b| point_to_polygon(center_of(a), normal, b)).sum();
        assert!((sum - 1.0).abs() < 1e-12, "{name} {i}: {sum}");
        let found: f64 = faces.iter().map(|b| point_to_polygon(center, normal, b)).sum();
        assert!((found - 1.0).abs() < 1e-12, "{name} {i}: {found}");
    }
}

#[test]
fn sheared_boxes_are_closed() {
    let mut numbers = Numbers(3);
    for _ in 0..40 {
        let rotation = numbers.rotation();
        let flat = 0.1 + numbers.next().abs();
        let [u, v, w] = [
            rotation * DVec3::X,
            rotation * DVec3::new(0.5 * numbers.next(), flat, 0.0),
            rotation * DVec3::new(numbers.next(), numbers.next(), 0.5 + numbers.next().abs()),
        ];
        let corner = numbers.vector() * 3.0;
        let face = |o: DVec3, u: DVec3, v: DVec3| vec![o, o + u, o + u + v, o + v];
        let faces = [
            face(corner, u, v),
            face(corner, v, w),
            face(corner, w, u),
            face(corner + w, v, u),
            face(corner + u, w, v),
            face(corner + v, u, w),
        ];
        check_closure("box", &faces);
    }
}

#[test]
fn tetrahedra_are_closed() {
    let mut numbers = Numbers(5);
    let mut checked = 0;
    while checked < 60 {
        let [a, b, c, d] = [numbers.vector(), numbers.vector(), numbers.vector(), numbers.vector()];
        let volume = (b - a).cross(c - a).dot(d - a);
        if volume.abs() < 0.05 {
            continue;
        }
        let [b, c] = if volume > 0.0 { [b, c] } else { [c, b] };
        check_closure("tetrahedron", &[vec![a, b, c], vec![a, d, b], vec![b, d, c], vec![c, d, a]]);
        checked += 1;
    }
}

/// The double integral is within its own error of the contour integral, also for polygons that cut each other.
#[test]
fn both_integrals_agree() {
    for distance in [0.5, 1.5, 5.0] {
        for (a, b) in pairs(25, distance) {
            let contour = polygon_to_polygon(&a, &b);
            for accuracy in [1e-4, 1e-7] {
                let found = double_integral(&a, &b, accuracy);
                assert!(found.error <= accuracy, "{a:?} {b:?}: {found:?}");
                assert!((found.value - contour).abs() <= found.error + 1e-12, "{a:?} {b:?}: {found:?} {contour}");
            }
        }
    }
}

/// Light comes from fronts and gets to fronts: both sides of a polygon get something only where its plane cuts the
/// sender.
#[test]
fn backs_get_nothing() {
    for (a, b) in pairs(50, 4.0) {
        let [front, back] = [polygon_to_polygon(&a, &b), polygon_to_polygon(&a, &reversed(&b))];
        let sent = polygon_to_polygon(&reversed(&a), &b) + polygon_to_polygon(&reversed(&a), &reversed(&b));
        assert!(front + back <= 1.0 && sent <= 1.0);
        let distance = (b[0] - a[0]).dot(area_vector(&b).normalize());
        let is_cut = a.iter().any(|&p| (b[0] - p).dot(area_vector(&b)).signum() != distance.signum());
        assert!(is_cut || front == 0.0 || back == 0.0, "{a:?} {b:?}: {front} {back}");
    }
}

/// The point formula differs from the exact form factor by at most its bound, and the more it is worth the farther.
#[test]
fn the_point_formula_keeps_its_bound() {
    let mut worst = [0.0_f64; 3];
    for (step, distance) in [5.0, 50.0, 500.0].into_iter().enumerate() {
        for (a, b) in pairs(200, distance) {
            let (p, q) = (small_patch(&a), small_patch(&b));
            let (exact, found) =
                (polygon_to_polygon(&a, &b), point_to_point(p.center, p.normal, q.center, q.normal, q.area));
            let bound = point_to_point_error(&p, &q);
            assert!((found - exact).abs() <= bound + 1e-15, "{a:?} {b:?}: {found} {exact} {bound}");
            let to_q = q.center - p.center;
            let steep = to_q.dot(p.normal).min(-to_q.dot(q.normal)) / to_q.length();
            if steep > 0.5 && exact > 0.0 {
                let share = (p.radius + q.radius) / to_q.length();
                worst[step] = worst[step].max((found / exact - 1.0).abs());
                assert!((found / exact - 1.0).abs() < 3.0 * share * share, "{found} {exact} {share}");
            }
        }
    }
    assert!(worst[2] < 0.02 * worst[1] && worst[2] > 0.0, "{worst:?}");
}

/// A wall that stands on the floor away from its edges, and one that goes through it.
#[test]
fn polygons_that_touch_inside() {
    let floor = [
        DVec3::new(-1.0, -1.0, 0.0),
        DVec3::new(1.0, -1.0, 0.0),
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::new(-1.0, 1.0, 0.0),
    ];
    let wall = |low: f64| {
        [DVec3::new(0.2, -0.5, low), DVec3::new(0.2, -0.5, 0.6), DVec3::new(0.2, 0.7, 0.6), DVec3::new(0.2, 0.7, low)]
    };
    let [on, through] = [wall(0.0), wall(-0.4)].map(|wall| polygon_to_polygon(&floor, &wall));
    let expected = perpendicular_rectangles_offset(
        Bounds { x: [0.0, 1.2], y: [-1.0, 1.0] },
        Bounds { x: [0.0, 0.6], y: [-0.5, 0.7] },
    ) * 0.6;
    assert!((on - expected).abs() < 1e-13 && (through - expected).abs() < 1e-13, "{on} {through} {expected}");
    let tip = [DVec3::new(0.2, 0.1, 0.0), DVec3::new(0.3, -0.4, 0.8), DVec3::new(-0.2, 0.5, 0.9)];
    let found = polygon_to_polygon(&floor, &tip);
    assert!((double_integral(&floor, &tip, 1e-9).value - found).abs() < 1e-9, "{found}");
}
