//! Fog, smoke and glass: closed forms, and stretches that compose to the whole.

use glam::{Vec2, Vec3, vec3};
use radiosity::composite::*;
use radiosity::geometry::Ray;

const GRAY: Vec3 = Vec3::new(0.5, 0.6, 0.7);
const RAY: Ray = Ray { origin: vec3(0.0, 1.0, 0.0), direction: vec3(0.6, 0.48, -0.64), end: 50.0 };

fn assert_near(a: PremultipliedRgba, b: PremultipliedRgba, tolerance: f32) {
    let far = a.to_array().into_iter().zip(b.to_array()).any(|(a, b)| (a - b).abs() > tolerance);
    assert!(!far, "{a:?} {b:?}");
}

fn height_fog() -> HeightFog {
    HeightFog { color: GRAY, extinction: 0.3, base: vec3(0.0, 0.2, 0.0), up: Vec3::Y, scale: 2.5 }
}

/// Densities that rise with each axis, and their product.
fn density(place: Vec3) -> f32 {
    (0.3 + 0.2 * place.x) * (1.0 + 0.5 * place.y) * (0.4 - 0.03 * place.z)
}

const LOW: Vec3 = Vec3::new(-1.0, 0.0, -6.0);
const HIGH: Vec3 = Vec3::new(4.0, 4.0, -1.0);
const COUNTS: [usize; 3] = [6, 9, 4];

fn with_smoke(test: impl FnOnce(&Smoke)) {
    let place = |k: usize| vec3((k % 6) as f32 / 5.0, (k / 6 % 9) as f32 / 8.0, (k / 54) as f32 / 3.0);
    let densities: Vec<f32> = (0..216).map(|k| density(LOW + place(k) * (HIGH - LOW))).collect();
    test(&Smoke::new([LOW, HIGH], COUNTS, &densities, GRAY).unwrap());
}

/// Beer and Lambert: after one mean free path the share 1 / e is left.
#[test]
fn fog_on_known_values() {
    let fog = Fog { color: Vec3::ONE, extinction: 0.25 };
    for (meters, passing) in
        [(0.0, 1.0), (4.0, 0.367_879_44), (8.0, 0.135_335_28), (2.772_588_7, 0.5), (f32::INFINITY, 0.0)]
    {
        let alpha = 1.0 - passing;
        assert_near(fog.layer(&RAY, 0.0, meters), PremultipliedRgba::new([alpha; 4]), 1e-6);
    }
    let thin = Fog { extinction: 1e-9, ..fog }.layer(&RAY, 1.0, 2.0);
    assert!((thin.alpha() - 1e-9).abs() < 1e-15, "thin fog is not lost");
    assert_eq!(Fog { extinction: 0.0, ..fog }.layer(&RAY, 0.0, f32::INFINITY), PremultipliedRgba::TRANSPARENT);
}

#[test]
fn slabs_compose_to_the_whole() {
    let fog = Fog { color: GRAY, extinction: 0.2 };
    let check = |medium: &dyn Medium| {
        let whole = medium.layer(&RAY, 0.5, 8.5);
        assert!(whole.alpha() > 0.2);
        for count in [2, 3, 10, 100] {
            let place = |k: u32| 0.5 + 8.0 * k as f32 / count as f32;
            let slabs = (0..count).map(|k| medium.layer(&RAY, place(k), place(k + 1)));
            assert_near(front_to_back(slabs), whole, 2e-6);
        }
    };
    check(&fog);
    check(&height_fog());
    with_smoke(|smoke| check(smoke));
}

/// The integral of a density along the ray by 100 000 midpoints.
fn integral(density: impl Fn(Vec3) -> f32, from: f32, to: f32) -> f64 {
    let step = f64::from(to - from) / 1e5;
    let at = |k: u32| RAY.origin + RAY.direction * (from + (f64::from(k) * step + 0.5 * step) as f32);
    (0..100_000).map(|k| f64::from(density(at(k)))).sum::<f64>() * step * f64::from(RAY.direction.length())
}

#[test]
fn height_fog_is_its_integral() {
    let fog = height_fog();
    for (from, to) in [(0.0, 1.0), (2.0, 30.0), (0.0, 1e-3)] {
        let expected = integral(|place| fog.extinction * (-(place - fog.base).dot(fog.up) / fog.scale).exp(), from, to);
        let found = f64::from(fog.optical_depth(&RAY, from, to));
        assert!((found - expected).abs() < 1e-5 * expected, "{found} {expected}");
    }
    let along = Ray { direction: Vec3::X, ..RAY };
    let even = Fog { color: GRAY, extinction: 0.3 * (-0.8_f32 / 2.5).exp() };
    assert_near(fog.layer(&along, 1.0, 4.0), even.layer(&along, 1.0, 4.0), 1e-6);
    let steep = Ray { direction: vec3(1.0, 1e-6, 0.0), ..RAY };
    assert_near(fog.layer(&steep, 1.0, 4.0), fog.layer(&along, 1.0, 4.0), 1e-5);
    let up = Ray { direction: Vec3::Y, ..RAY };
    let column = fog.optical_depth(&up, 0.0, f32::INFINITY);
    assert!((column - even.extinction * 2.5).abs() < 1e-6, "the air above is finite: {column}");
}

/// Trilinear densities are interpolated exactly, and their integral is exact too, whichever way the ray runs.
#[test]
fn smoke_is_its_integral() {
    with_smoke(|smoke| {
        let [begin, end] = smoke.extent(&RAY);
        assert!((begin - 1.0 / 0.64).abs() < 1e-6 && (end - 3.0 / 0.48).abs() < 1e-6);
        for (from, to) in [(begin, end), (2.0, 5.0), (3.3, 3.4)] {
            let expected = integral(density, from, to);
            let found = f64::from(smoke.optical_depth(&RAY, from, to));
            assert!((found - expected).abs() < 2e-5 * expected, "{found} {expected}");
            let back = Ray { origin: RAY.origin + RAY.direction * 9.0, direction: -RAY.direction, end: 50.0 };
            let found = f64::from(smoke.optical_depth(&back, 9.0 - to, 9.0 - from));
            assert!((found - expected).abs() < 3e-5 * expected, "{found} {expected}");
        }
        let axis = Ray { origin: vec3(1.0, 2.0, 5.0), direction: vec3(0.0, 0.0, -2.0), end: 50.0 };
        let expected = 0.5 * 2.0 * (0.4 * 5.0 + 0.015 * (36.0 - 1.0));
        assert!((smoke.optical_depth(&axis, 0.0, 50.0) - expected).abs() < 1e-5);
        let beside = Ray { origin: vec3(9.0, 2.0, 5.0), ..axis };
        assert_eq!(smoke.layer(&beside, 0.0, 50.0), PremultipliedRgba::TRANSPARENT);
    });
}

#[test]
fn grids_must_fit() {
    let smoke = |counts| Smoke::new([LOW, HIGH], counts, &[0.0; 8], GRAY);
    assert!(smoke([2, 2, 2]).is_ok());
    assert_eq!(smoke([1, 2, 4]), Err(GridError::Thin { counts: [1, 2, 4] }));
    assert_eq!(smoke([2, 2, 3]), Err(GridError::Length { entries: 12, length: 8 }));
}

/// Fog, a red pane, fog and a wall: the order in which they stand, multiplied out by hand.
#[test]
fn surfaces_stand_in_the_fog() {
    let fog = Fog { color: GRAY, extinction: 0.1 };
    let pane = StraightRgba { rgb: [1.0, 0.0, 0.0], alpha: 0.5 }.premultiplied();
    let wall = StraightRgba::opaque([0.0, 1.0, 0.0]).premultiplied();
    let seen = through(&RAY, &[&fog], [(3.0, pane), (8.0, wall)]);
    let [a, b] = [(-0.3_f32).exp(), (-0.5_f32).exp()];
    let expected = GRAY * (1.0 - a) + a * 0.5 * (Vec3::X + GRAY * (1.0 - b) + b * Vec3::Y);
    assert_near(seen, PremultipliedRgba::adding(expected, 1.0), 1e-6);
    let behind = through(&RAY, &[&fog], [(3.0, pane), (8.0, wall), (9.0, pane)]);
    assert_eq!(behind, seen);
    let nothing = through(&RAY, &[], [(3.0, pane)]);
    assert_eq!(nothing, pane);
}

/// Two fogs in one place are one fog; a glass pane cuts the way without changing it.
#[test]
fn media_in_one_place_are_mixed() {
    let [blue, red] = [(Vec3::Z, 0.1), (Vec3::X, 0.3)].map(|(color, extinction)| Fog { color, extinction });
    let both = Fog { color: vec3(0.75, 0.0, 0.25), extinction: 0.4 };
    let seen = through(&RAY, &[&blue, &red], []);
    assert_near(seen, both.layer(&RAY, 0.0, RAY.end), 2e-6);
    let clear = PremultipliedRgba::TRANSPARENT;
    assert_near(through(&RAY, &[&red, &blue], [(2.0, clear), (7.0, clear)]), seen, 2e-6);
    let endless = Ray { end: f32::INFINITY, ..RAY };
    assert_near(through(&endless, &[&red, &blue], []), PremultipliedRgba::adding(both.color, 1.0), 1e-6);
}

/// Smoke in fog against a fine march in double precision.
#[test]
fn smoke_in_fog() {
    let fog = Fog { color: Vec3::X, extinction: 0.1 };
    with_smoke(|smoke| {
        let (mut light, mut passing) = (glam::DVec3::ZERO, 1.0);
        let step = f64::from(RAY.end) / 1e6;
        let [begin, end] = smoke.extent(&RAY);
        for k in 0..1_000_000 {
            let place = ((f64::from(k) + 0.5) * step) as f32;
            let inside = place > begin && place < end;
            let thick = if inside { f64::from(density(RAY.origin + RAY.direction * place)) } else { 0.0 };
            light += passing * step * (0.1 * glam::DVec3::X + thick * GRAY.as_dvec3());
            passing *= (-step * (0.1 + thick)).exp();
        }
        let expected = PremultipliedRgba::adding(light.as_vec3(), (1.0 - passing) as f32);
        assert_near(through(&RAY, &[&fog, smoke], []), expected, 2e-4);
    });
}

#[test]
fn a_pane_shows_its_picture() {
    let pixels: Vec<_> = (0..6_u8).map(|k| PremultipliedRgba::new([0.0, 0.0, f32::from(k) / 8.0, 0.75])).collect();
    let picture = Sprite::new(3, &pixels).unwrap();
    let pane = GlassPane { corner: vec3(-3.0, 2.0, -4.0), across: Vec3::X * 6.0, down: Vec3::NEG_Y * 4.0, picture };
    for (k, color) in pixels.iter().enumerate() {
        let center = vec3(-2.0 + 2.0 * (k % 3) as f32, 1.0 - 2.0 * (k / 3) as f32, -4.0);
        for origin in [Vec3::ZERO, vec3(1.0, 2.0, -9.0)] {
            let ray = Ray { origin, direction: center - origin, end: 2.0 };
            let (place, seen) = pane.hit(&ray).unwrap();
            assert!((place - 1.0).abs() < 1e-6);
            assert_near(seen, *color, 1e-5);
            assert_eq!(pane.hit(&Ray { end: 0.9, ..ray }), None);
        }
    }
    assert_eq!(picture.at(Vec2::new(0.5, 0.5)).to_array()[2], 2.5 / 8.0, "the mean of the middle");
    assert_eq!(picture.at(Vec2::ZERO), pixels[0]);
    let beside = Ray { origin: Vec3::ZERO, direction: vec3(3.1, 0.0, -4.0), end: f32::INFINITY };
    assert_eq!(pane.hit(&beside), None);
    assert_eq!(pane.hit(&Ray { direction: Vec3::X, ..beside }), None, "seen edge-on");
}

/// Seen from high above, where the fog is nothing, and from far below, where it is everything: never another value than the
/// integral.
#[test]
fn height_fog_from_any_height() {
    for scale in [0.8, 2.5] {
        let fog = HeightFog { scale, ..height_fog() };
        for eye in [3.0, 50.0, 72.0, 80.0, 90.0, 230.0, 300.0, 1e4_f32] {
            let down = Ray { origin: vec3(0.0, eye, 0.0), direction: vec3(0.0, -1.0, 0.0), end: f32::INFINITY };
            let ground = 0.2;
            let above = 1.0 - ((ground - eye) / scale).exp();
            let expected = fog.extinction * scale * above;
            let depth = fog.optical_depth(&down, 0.0, eye - ground);
            assert!((depth / expected - 1.0).abs() < 2e-3, "{scale} {eye}: {depth} {expected}");
            let up = Ray { origin: vec3(0.0, ground, 0.0), direction: Vec3::Y, end: f32::INFINITY };
            let back = fog.optical_depth(&up, 0.0, eye - ground);
            assert!((back / expected - 1.0).abs() < 2e-3, "{scale} {eye}: {back} {expected}");
            assert_eq!(fog.optical_depth(&down, 0.0, f32::INFINITY), f32::INFINITY);
            assert_eq!(fog.optical_depth(&down, eye + 1e3, eye + 1e3), 0.0);
        }
    }
}

#[test]
fn smoke_that_is_none_is_refused() {
    let densities = [1.0; 8];
    let smoke = |low: Vec3, high: Vec3, densities: &[f32]| Smoke::new([low, high], [2; 3], densities, GRAY).err();
    assert_eq!(smoke(LOW, HIGH, &densities), None);
    assert_eq!(smoke(HIGH, LOW, &densities), Some(GridError::Box));
    assert_eq!(smoke(LOW, Vec3::splat(f32::INFINITY), &densities), Some(GridError::Box));
    for wrong in [-1.0, f32::NAN, f32::INFINITY] {
        let mut densities = densities;
        densities[3] = wrong;
        assert_eq!(smoke(LOW, HIGH, &densities), Some(GridError::Extinction { entry: 3 }));
    }
}
