//! Paths of light against what is known: closed boxes, form factors, images in mirrors, lamps.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};
use radiosity::form_factor::point_to_polygon;
use radiosity::geometry::{BruteForce, Hit, hash};
use radiosity::light::{DirectLight, DirectionalLight, LightSource, PointLight, RectLight, SpotLight};
use radiosity::parallel::Workers;
use radiosity::progress::Progress;
use radiosity::render::{Camera, Estimate, Facet, Facets, PathLamp, PathPicture, PathTracer};
use radiosity::scatter::*;
use radiosity::spectrum::{Bands, CORNELL_WHITE, cornell_lamp};

/// Triangles with their materials.
#[derive(Default)]
struct Room<S> {
    corners: Vec<[Vec3; 3]>,
    of_triangle: Vec<u32>,
    materials: Vec<Facet<S>>,
}

type Surroundings<'a, S, F> = Facets<'a, S, BruteForce<&'a [[Vec3; 3]]>, F>;

impl<S: Colored> Room<S> {
    /// Adds a quadrilateral, counter-clockwise seen from its front.
    fn add(&mut self, [a, b, c, d]: [Vec3; 4], matter: Matter<S>, emission: S) {
        self.corners.extend([[a, b, c], [a, c, d]]);
        self.of_triangle.extend([self.materials.len() as u32; 2]);
        self.materials.push(Facet { matter, emission });
    }

    /// Adds a box whose fronts look outside, or inside; one matter and emission for each side, in the order -x, x, -y, y,
    /// -z, z.
    fn add_box(&mut self, low: Vec3, high: Vec3, inside: bool, side: impl Fn(usize) -> (Matter<S>, S)) {
        for index in 0..6 {
            let axis = index / 2;
            let corner = |u: bool, v: bool| {
                let mut bits = [index % 2 == 1; 3];
                bits[(axis + 1) % 3] = u;
                bits[(axis + 2) % 3] = v;
                let pick = |k: usize| if bits[k] { high[k] } else { low[k] };
                Vec3::new(pick(0), pick(1), pick(2))
            };
            let mut corners = [corner(false, false), corner(true, false), corner(true, true), corner(false, true)];
            if (index % 2 == 0) != inside {
                corners.reverse();
            }
            let (matter, emission) = side(index);
            self.add(corners, matter, emission);
        }
    }

    fn under<F: Fn(Vec3) -> S + Sync>(&self, sky: F) -> Surroundings<'_, S, F> {
        let Self { corners, of_triangle, materials } = self;
        Facets { corners, of_triangle, materials, occluders: BruteForce(corners), sky }
    }
}

fn lambert<S: Colored>(reflectance: S) -> Matter<S> {
    Matter::Lambert(Lambert { reflectance })
}

/// A square of 2 m around a point of the z axis that looks up, or down.
fn square(z: f32, up: bool) -> [Vec3; 4] {
    let mut corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| Vec3::new(x, y, z));
    if !up {
        corners.reverse();
    }
    corners
}

fn hit(triangle: u32, barycentric: Vec2) -> Hit {
    Hit { triangle, distance: 0.0, barycentric, front: true }
}

const MIDDLE: Vec2 = Vec2::new(0.25, 0.5);

fn assert_within(what: &str, estimate: Estimate<f32>, expected: f32) {
    let (mean, error) = (estimate.mean, estimate.standard_error());
    assert!((mean - expected).abs() <= 3.0 * error + 1e-4 * expected, "{what}: {mean} +- {error}, not {expected}");
    assert!(error < 0.03 * expected.max(0.1), "{what}: {mean} +- {error} is not sharp");
}

/// One pixel that looks from a point at another.
fn seen<S: Colored, F: Fn(Vec3) -> S + Sync>(room: &Room<S>, sky: F, eye: Vec3, steps: usize) -> Estimate<S> {
    let tracer = PathTracer::new(room.under(sky), Vec::new());
    let mut picture = PathPicture::new([1, 1], 5);
    let camera = Camera::looking_at(eye, Vec3::ZERO, 0.001);
    for _ in 0..steps {
        picture.step(&tracer, &camera, &Workers::new(1), &Progress::with_clock(|| 0.0)).unwrap();
    }
    picture.pixels[0]
}

/// Walls that emit 1 and reflect a half: 2 everywhere.
#[test]
fn a_closed_furnace() {
    let mut room: Room<f32> = Room::default();
    room.add_box(Vec3::ZERO, Vec3::new(1.0, 2.0, 3.0), true, |_| (lambert(0.5), 1.0));
    let tracer = PathTracer::new(room.under(|_| 0.0), Vec::new());
    for triangle in 0..12 {
        let [a, b, c] = room.corners[triangle as usize];
        let normal = (b - a).cross(c - a).normalize();
        assert_within("furnace", tracer.received(&hit(triangle, MIDDLE), normal, 64, triangle), 2.0);
    }
}

/// In a sky of 1 every matter shows its albedo; that of the lobes is integrated.
#[test]
fn an_open_furnace_shows_the_albedo() {
    let ggx = Ggx::new(0.9, 0.5);
    let glossy = Mixture { first: ggx, second: Lambert { reflectance: 0.5 }, share: 0.3 };
    let matters = [
        lambert(0.8),
        Matter::Mirror(Mirror { reflectance: 0.8 }),
        Matter::Phong(Phong { reflectance: 0.8, exponent: 20.0 }),
        Matter::Ggx(ggx),
        Matter::Glossy(glossy),
    ];
    for matter in matters {
        for eye in [Vec3::new(0.1, 0.2, 3.0), Vec3::new(2.0, -0.3, 1.0)] {
            let mut room: Room<f32> = Room::default();
            room.add(square(0.0, true), matter, 0.0);
            let albedo = match matter {
                Matter::Mirror(mirror) => mirror.reflectance,
                _ => albedo(&matter, eye.normalize()),
            };
            assert_within(&format!("{matter:?}"), seen(&room, |_| 1.0, eye, 200), albedo);
        }
    }
}

/// The integral of BSDF times cosine by the rule of midpoints.
fn albedo(matter: &Matter<f32>, departure: Vec3) -> f32 {
    const STEPS: usize = 400;
    let at = |i: usize| {
        let (cos, angle) = (((i / STEPS) as f32 + 0.5) / STEPS as f32, 2.0 * PI * (i % STEPS) as f32 / STEPS as f32);
        let sin = (1.0 - cos * cos).sqrt();
        let arrival = Vec3::new(sin * angle.cos(), sin * angle.sin(), cos);
        f64::from(matter.evaluate(arrival, departure) * cos)
    };
    (0..STEPS * STEPS).map(at).sum::<f64>() as f32 * 2.0 * PI / (STEPS * STEPS) as f32
}

/// Clear glass is invisible in a furnace; colored glass darkens by the way through it.
#[test]
fn glass_in_a_furnace() {
    let block = |absorption| {
        let mut room: Room<f32> = Room::default();
        let glass = Matter::Glass(Glass { index: 1.5, absorption });
        room.add_box(Vec3::splat(-0.5), Vec3::splat(0.5), false, |_| (glass, 0.0));
        room
    };
    assert_within("clear", seen(&block(0.0), |_| 1.0, Vec3::new(2.0, 1.0, 3.0), 100), 1.0);
    // Straight through: (1 - R)^2 T / (1 - R^2 T^2) passes and R + R (1 - R)^2 T^2 / (1 - R^2 T^2) comes back.
    let (r, t) = (0.04_f32, (-0.7_f32).exp());
    let passes = (1.0 - r).powi(2) * t / (1.0 - r * r * t * t);
    let expected = passes + r + r * passes * t;
    assert_within("colored", seen(&block(0.7), |_| 1.0, Vec3::new(0.0, 0.0, 3.0).with_x(1e-3), 400), expected);
}

/// What a lamp with an area gives is its form factor, with or without bounces into the dark.
#[test]
fn light_from_a_polygon_is_its_form_factor() {
    let mut room: Room<f32> = Room::default();
    room.add(square(0.0, true), lambert(0.5), 0.0);
    room.add(square(1.5, false), lambert(0.0), 10.0);
    let tracer = PathTracer::new(room.under(|_| 0.0), Vec::new());
    for (index, at) in [MIDDLE, Vec2::new(0.1, 0.1), Vec2::new(0.9, 0.05)].into_iter().enumerate() {
        let hit = hit(0, at);
        let factor = point_to_polygon(hit.interpolate(room.corners[0]), Vec3::Z, &square(1.5, false));
        assert_within("plates", tracer.received(&hit, Vec3::Z, 64, index as u32), 10.0 * factor);
    }
}

/// The triangle at a point, and where on it.
fn hit_at(corners: &[[Vec3; 3]], point: Vec3) -> Hit {
    let at = |[a, b, c]: &[Vec3; 3]| {
        let ([u, v], normal) = ([b - a, c - a], (b - a).cross(c - a));
        let off = point - a;
        let [s, t] = [off.cross(v), u.cross(off)].map(|area| area.dot(normal) / normal.length_squared());
        let is_in = off.dot(normal).abs() < 1e-5 * normal.length() && s >= 0.0 && t >= 0.0 && s + t <= 1.0;
        is_in.then_some(Vec2::new(s, t))
    };
    let found = corners.iter().zip(0..).find_map(|(corners, triangle)| Some(hit(triangle, at(corners)?)));
    found.expect("a point of the room")
}

/// The unit cube with a floor of exitance 1 and reflectance 1/2 everywhere. Radiosities by Galerkin and by collocation
/// on up to 80 x 80 cells a face, with exact form factors; both agree to 2e-5.
#[test]
fn the_cube_that_varies_within_its_faces() {
    let mut room: Room<f32> = Room::default();
    room.add_box(Vec3::ZERO, Vec3::ONE, true, |side| (lambert(0.5), if side == 2 { 1.0 } else { 0.0 }));
    let tracer = PathTracer::new(room.under(|_| 0.0), Vec::new());
    let points = [
        ([0.5, 0.0, 0.5], Vec3::Y, 1.091_805_1),
        ([0.05, 0.0, 0.5], Vec3::Y, 1.112_644),
        ([0.5, 1.0, 0.5], Vec3::NEG_Y, 0.197_604_48),
        ([0.25, 1.0, 0.25], Vec3::NEG_Y, 0.177_532_1),
        ([0.0, 0.05, 0.5], Vec3::X, 0.311_179_3),
        ([0.0, 0.25, 0.25], Vec3::X, 0.230_713_5),
        ([0.0, 0.95, 0.5], Vec3::X, 0.118_107_6),
    ];
    for (index, (point, normal, radiosity)) in points.into_iter().enumerate() {
        let emission = if normal == Vec3::Y { 1.0 } else { 0.0 };
        let hit = hit_at(&room.corners, Vec3::from_array(point));
        let received = tracer.received(&hit, normal, 512, index as u32);
        assert_within("cube", received, (radiosity - emission) / 0.5);
    }
}

/// A ball that shines within a larger one, both gray: by the form factors of concentric spheres, `r^2 / R^2` from the outer
/// one to the inner one, each has one radiosity.
#[test]
fn concentric_spheres() {
    let (inner, outer, [rho, sigma]) = (0.5_f32, 1.0_f32, [0.3, 0.6]);
    let mut room: Room<f32> = Room::default();
    add_ball(&mut room, inner, true, (lambert(rho), 1.0));
    add_ball(&mut room, outer, false, (lambert(sigma), 0.0));
    let share = inner * inner / (outer * outer);
    // b = 1 + rho c and c = sigma (share b + (1 - share) c).
    let c = sigma * share / (1.0 - sigma * (1.0 - share) - sigma * share * rho);
    let b = 1.0 + rho * c;
    let tracer = PathTracer::new(room.under(|_| 0.0), Vec::new());
    let half = room.corners.len() as u32 / 2;
    for (triangle, expected) in [(half / 3, c), (half + half / 3, share * b + (1.0 - share) * c)] {
        let [p, q, r] = room.corners[triangle as usize];
        let normal = (q - p).cross(r - p).normalize();
        let received = tracer.received(&hit(triangle, Vec2::splat(0.3)), normal, 1024, triangle);
        let (mean, error) = (received.mean, received.standard_error());
        assert!((mean - expected).abs() < 3.0 * error + 0.01 * expected, "{mean} +- {error}, not {expected}");
        assert!(error < 0.01 * expected, "{mean} +- {error} is not sharp");
    }
}

/// Adds a ball of triangles of the same area as the sphere, whose fronts look outside, or inside.
fn add_ball(room: &mut Room<f32>, radius: f32, outside: bool, (matter, emission): (Matter<f32>, f32)) {
    const RINGS: usize = 24;
    let at = |ring: usize, column: usize| {
        let (polar, around) = (PI * ring as f32 / RINGS as f32, PI * column as f32 / RINGS as f32);
        Vec3::new(polar.sin() * around.cos(), polar.cos(), polar.sin() * around.sin())
    };
    let first = room.corners.len();
    for (ring, column) in (0..RINGS).flat_map(|ring| (0..2 * RINGS).map(move |column| (ring, column))) {
        let quad = [at(ring, column), at(ring, column + 1), at(ring + 1, column + 1), at(ring + 1, column)];
        let [a, b, c, d] = quad;
        let parts = [(ring > 0).then_some([a, b, c]), (ring + 1 < RINGS).then_some([a, c, d])];
        room.corners.extend(parts.into_iter().flatten());
    }
    let area = |[a, b, c]: &[Vec3; 3]| 0.5 * (b - a).cross(c - a).length();
    let whole: f32 = room.corners[first..].iter().map(area).sum();
    let scale = radius * (4.0 * PI / whole).sqrt();
    for [a, b, c] in &mut room.corners[first..] {
        [*a, *b, *c] = [*a * scale, *b * scale, *c * scale];
        if ((*b - *a).cross(*c - *a).dot(*a) > 0.0) != outside {
            std::mem::swap(b, c);
        }
    }
    room.of_triangle.resize(room.corners.len(), room.materials.len() as u32);
    room.materials.push(Facet { matter, emission });
}

/// A mirror shows a lamp behind it: light comes from both.
#[test]
fn a_mirror_doubles_a_lamp() {
    let mut room: Room<f32> = Room::default();
    room.add(square(0.0, true), lambert(0.5), 0.0);
    let lamp = [[-0.5, -0.5, 1.0], [-0.5, 0.5, 1.0], [0.5, 0.5, 1.0], [0.5, -0.5, 1.0]].map(Vec3::from_array);
    room.add(lamp, lambert(0.0), 10.0);
    let far = 50.0;
    let wall = [[1.0, -far, -far], [1.0, -far, far], [1.0, far, far], [1.0, far, -far]].map(Vec3::from_array);
    room.add(wall, Matter::Mirror(Mirror { reflectance: 0.7 }), 0.0);
    let tracer = PathTracer::new(room.under(|_| 0.0), Vec::new());
    let hit = hit(0, Vec2::new(0.5, 0.2));
    let point = hit.interpolate(room.corners[0]);
    let mut image = lamp.map(|corner| corner.with_x(2.0 - corner.x));
    image.reverse();
    let factors = [lamp, image].map(|polygon| point_to_polygon(point, Vec3::Z, &polygon));
    assert_within("mirror", tracer.received(&hit, Vec3::Z, 256, 3), 10.0 * (factors[0] + 0.7 * factors[1]));
}

/// Whatever is emitted in a closed box is absorbed by its walls, though a mirror and glass stand in between.
#[test]
fn energy_is_kept() {
    let mut room: Room<f32> = Room::default();
    let reflectance = 0.6;
    room.add_box(Vec3::splat(-1.0), Vec3::ONE, true, |side| match side {
        0 => (Matter::Mirror(Mirror { reflectance: 1.0 }), 0.0),
        5 => (lambert(reflectance), 3.0),
        _ => (lambert(reflectance), 0.0),
    });
    let glass = Matter::Glass(Glass { index: 1.5, absorption: 0.0 });
    room.add_box(Vec3::splat(-0.4), Vec3::new(0.3, 0.4, 0.2), false, |_| (glass, 0.0));
    let tracer = PathTracer::new(room.under(|_| 0.0), Vec::new());
    let mut absorbed = Estimate::default();
    for index in 0..2000_u32 {
        let number = |k: u32| (hash(hash(index, 3), k) >> 8) as f32 / 16_777_216.0;
        // All sides have the same area; the first, of two triangles, is the mirror.
        let triangle = 2 + ((number(0) * 10.0) as u32).min(9);
        let [a, b, c] = room.corners[triangle as usize];
        let root = number(1).sqrt();
        let at = Vec2::new(root * (1.0 - number(2)), root * number(2));
        let normal = (b - a).cross(c - a).normalize();
        absorbed.add(tracer.received(&hit(triangle, at), normal, 2, index).mean * (1.0 - reflectance));
    }
    assert_within("absorbed", absorbed, 3.0 / 5.0);
}

/// The measured spectra: in a closed box of white paint that shines everywhere each band is `e / (1 - rho)`.
#[test]
fn bands_do_not_mix() {
    let mut room: Room<Bands<76>> = Room { corners: vec![], of_triangle: vec![], materials: vec![] };
    room.add_box(Vec3::ZERO, Vec3::ONE, true, |_| (lambert(CORNELL_WHITE), cornell_lamp()));
    let tracer = PathTracer::new(room.under(|_| Bands::default()), Vec::new());
    let estimate = tracer.received(&hit(4, MIDDLE), Vec3::Y, 256, 1);
    let (mean, error) = (estimate.mean, estimate.standard_error());
    for band in 0..76 {
        let expected = cornell_lamp().0[band] / (1.0 - CORNELL_WHITE.0[band]);
        assert!((mean.0[band] - expected).abs() <= 3.0 * error.0[band] + 1e-4, "{band}: {} {expected}", mean.0[band]);
        assert!(error.0[band] <= 0.03 * expected, "{band}: {}", error.0[band]);
    }
}

/// Each lamp alone gives what its formula says; all together, the sum.
#[test]
fn lamps_give_what_their_formulas_say() {
    let point = PointLight { position: Vec3::new(0.3, 0.2, 1.0), intensity: Vec3::ONE, range: 20.0, radius: 0.05 };
    let direction = Vec3::new(0.0, 0.6, -0.8);
    let sources = [
        LightSource::Point(point),
        LightSource::Spot(SpotLight { point, direction, inner_angle: 0.8, outer_angle: 1.2 }),
        LightSource::Directional(DirectionalLight { direction, illuminance: Vec3::ONE, angular_diameter: 0.01 }),
        LightSource::Rect(RectLight {
            center: Vec3::new(0.0, 0.5, 0.7),
            half_width: Vec3::Y * 0.3,
            half_height: Vec3::X * 0.5,
            radiance: Vec3::ONE,
            range: f32::INFINITY,
        }),
    ];
    let mut room: Room<f32> = Room::default();
    room.add(square(0.0, true), lambert(0.5), 0.0);
    let lamp = |source| PathLamp { light: DirectLight::from(source), strength: 7.0, mirror: None };
    let lit = |lamps: Vec<PathLamp<f32>>| {
        let expected = lamps.iter().map(|lamp| 7.0 / PI * lamp.light.irradiance(Vec3::ZERO, Vec3::Z).x).sum();
        let tracer = PathTracer::new(room.under(|_| 0.0), lamps);
        assert!(expected > 0.1, "{expected}");
        assert_within("lamps", tracer.received(&hit(0, Vec2::new(0.0, 0.5)), Vec3::Z, 256, 9), expected);
    };
    sources.iter().for_each(|source| lit(vec![lamp(source)]));
    lit(sources.iter().map(lamp).collect());
}

/// Half of a bulb in a wall, and of a sun at the horizon: the half above is all there is to see, and gives all the light.
#[test]
fn lamps_at_the_horizon() {
    let bulb =
        PointLight { position: Vec3::new(0.5, 0.0, 0.03), intensity: Vec3::ONE, range: f32::INFINITY, radius: 0.2 };
    let direction = Vec3::new(0.999, 0.0, -0.04).normalize();
    let sun = DirectionalLight { direction, illuminance: Vec3::splat(30.0), angular_diameter: 0.2 };
    for source in [LightSource::Point(bulb), LightSource::Directional(sun)] {
        let mut room: Room<f32> = Room::default();
        room.add(square(0.0, true), lambert(0.0), 0.0);
        let lamp = PathLamp { light: DirectLight::from(&source), strength: 1.0, mirror: None };
        let expected = lamp.light.irradiance(Vec3::ZERO, Vec3::Z).x / PI;
        assert!(expected > 0.02, "{expected}");
        let lit = |room: &Room<f32>| {
            let tracer = PathTracer::new(room.under(|_| 0.0), vec![lamp.clone()]);
            tracer.received(&hit(0, Vec2::new(0.0, 0.5)), Vec3::Z, 256, 9)
        };
        assert_within("at the horizon", lit(&room), expected);
        // A screen before the half of it on one side.
        let screen = [[0.1, 0.0, 0.0], [0.1, 1.0, 0.0], [0.1, 1.0, 1.0], [0.1, 0.0, 1.0]].map(Vec3::from);
        let away = if matches!(source, LightSource::Point(_)) { 1.0 } else { -1.0 };
        room.add(screen.map(|corner| corner * Vec3::new(away, 1.0, 1.0)), lambert(0.0), 0.0);
        let half = lit(&room);
        assert!((half.mean / (0.5 * expected) - 1.0).abs() < 0.05, "{half:?} {expected}");
    }
}

/// The sky may differ from direction to direction: a lid of half the sky that is bright.
#[test]
fn half_a_sky_is_half_the_light() {
    let mut room: Room<f32> = Room::default();
    room.add(square(0.0, true), lambert(0.5), 0.0);
    let sky = |direction: Vec3| if direction.x > 0.0 { 6.0 } else { 0.0 };
    let tracer = PathTracer::new(room.under(sky), Vec::new());
    assert_within("sky", tracer.received(&hit(0, MIDDLE), Vec3::Z, 256, 1), 3.0);
}

/// Standard errors are as large as errors: their ratio has a mean square near 1.
#[test]
fn standard_errors_are_honest() {
    let mut room: Room<f32> = Room::default();
    room.add(square(0.0, true), lambert(0.5), 0.0);
    room.add(square(0.7, false), lambert(0.3), 1.0);
    let tracer = PathTracer::new(room.under(|_| 0.5), Vec::new());
    let at = |values, seed| tracer.received(&hit(0, Vec2::new(0.1, 0.1)), Vec3::Z, values, seed);
    let truth = at(16_384, 0).mean;
    let ratio = |seed| {
        let estimate = at(32, seed);
        ((estimate.mean - truth) / estimate.standard_error()).powi(2)
    };
    let mean = (1..=300).map(ratio).sum::<f32>() / 300.0;
    assert!((0.75..1.4).contains(&mean), "{mean}");
}

#[test]
fn threads_do_not_matter() {
    let mut room: Room<f32> = Room::default();
    room.add_box(Vec3::splat(-1.0), Vec3::ONE, true, |side| (lambert(0.7), if side == 5 { 2.0 } else { 0.0 }));
    let tracer = PathTracer::new(room.under(|_| 0.0), Vec::new());
    let camera = Camera::looking_at(Vec3::new(0.0, -0.9, 0.5), Vec3::ZERO, 1.0);
    let picture = |threads| {
        let mut picture = PathPicture::new([12, 8], 1);
        for _ in 0..3 {
            picture.step(&tracer, &camera, &Workers::new(threads), &Progress::with_clock(|| 0.0)).unwrap();
        }
        picture
    };
    let one = picture(1);
    assert!(one.pixels.iter().all(|pixel| pixel.count == 3 && pixel.mean > 0.0));
    assert_eq!(one, picture(2));
    assert_eq!(one, picture(16));
}
