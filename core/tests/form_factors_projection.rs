//! The hemicube, Nusselt's projection and its rays on all known form factors that they apply to, each within the error
//! that it tells.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3, Vec2, Vec3};
use radiosity::form_factor::*;
use radiosity::geometry::{BruteForce, Hit, Occluders, Ray};

use methods::{strip_polygons, surface_polygons, target_polygon};
use points::{POINT_CASES, PointCase, Target};
use surfaces::{SURFACE_CASES, Surfaces};

#[path = "reference/methods.rs"]
#[expect(dead_code, reason = "closed forms have other tests")]
mod methods;
#[path = "../../examples/nusselt.rs"]
#[expect(dead_code, reason = "the test looks at the picture only")]
mod nusselt;
#[path = "reference/occluded.rs"]
#[expect(dead_code, reason = "its points are among the points")]
mod occluded;
#[path = "reference/points.rs"]
mod points;
#[path = "reference/surfaces.rs"]
mod surfaces;

const N: usize = 256;
/// Half the length of strips without end: what lies beyond counts with the cube of height over distance.
const FAR: f64 = 300.0;
/// Half the side of the ground: what lies beyond counts with height over distance.
const HORIZON: f64 = 1e4;

type Polygon = Vec<DVec3>;

/// A rectangle in a plane at height `z`: counter-clockwise seen from above, or from below.
fn up([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], z: f64) -> Polygon {
    [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|[x, y]| DVec3::new(x, y, z)).to_vec()
}

fn down(x: [f64; 2], y: [f64; 2], z: f64) -> Polygon {
    up(x, y, z).into_iter().rev().collect()
}

/// A disc as a polygon of 720 corners and the same area, counter-clockwise seen along `axis`.
fn disc(center: DVec3, radius: f64, axis: DVec3) -> Polygon {
    let step = TAU / 720.0;
    let rim = radius * (step / step.sin()).sqrt();
    let turn = DQuat::from_rotation_arc(DVec3::Z, axis);
    let corner = |k: i32| center + turn * DVec3::from((glam::DVec2::from_angle(f64::from(-k) * step), 0.0)) * rim;
    (0..720).map(corner).collect()
}

/// What a point sees, as polygons: the target, and what stands before it. Of the sky it is the ground.
fn target_polygons(target: &Target) -> [Polygon; 2] {
    let alone = |polygon| [polygon, Vec::new()];
    match *target {
        Target::Disc { center, radius } => alone(disc(center.into(), radius, DVec3::Z)),
        // A point sees of a sphere the disc inside the cone around it.
        Target::Sphere { distance, degrees } => {
            let axis = DQuat::from_rotation_y(degrees.to_radians()) * DVec3::Z;
            let sine = 1.0 / distance;
            alone(disc(axis * (distance - sine), (1.0 - sine * sine).sqrt(), axis))
        }
        Target::Sky { degrees } => {
            let turn = DQuat::from_rotation_y(degrees.to_radians());
            alone(up([-HORIZON, HORIZON], [-HORIZON, HORIZON], -1.0).into_iter().map(|p| turn * p).collect())
        }
        Target::SquareLessShadow => [down([-0.5, 0.5], [-0.5, 0.5], 1.0), down([-0.125, 0.125], [-0.125, 0.125], 0.5)],
        Target::DiscLessShadow => [disc(DVec3::Z * 2.0, 1.0, DVec3::Z), disc(DVec3::Z, 0.3, DVec3::Z)],
        _ => alone(target_polygon(target, FAR).expect("a polygon")),
    }
}

/// What a method should find: the sky is what the ground leaves.
fn expected(PointCase { target, factor, .. }: &PointCase) -> f64 {
    if matches!(target, Target::Sky { .. }) { 1.0 - factor } else { *factor }
}

/// A sender and all that it sends to, where they are polygons or discs.
fn sender_and_targets(surfaces: &Surfaces) -> Option<(Polygon, Vec<Polygon>)> {
    match *surfaces {
        Surfaces::CoaxialDiscs { from, to, distance } => {
            Some((disc(DVec3::ZERO, from, DVec3::NEG_Z), vec![disc(DVec3::Z * distance, to, DVec3::Z)]))
        }
        _ => surface_polygons(surfaces).or_else(|| strip_polygons(surfaces, FAR)),
    }
}

/// What rays meet that is not flat, or a disc; all around the z axis.
enum Shape {
    Flat(Vec<[Vec3; 3]>),
    Disc {
        height: f32,
        radius: f32,
    },
    Sphere {
        center: Vec3,
        radius: f32,
    },
    /// The part of a sphere around the origin that lies above.
    Dome {
        radius: f32,
    },
    Cylinder {
        radius: f32,
        height: f32,
    },
}

impl Shape {
    fn hits(&self, ray: &Ray) -> Vec<f32> {
        let (o, d) = (ray.origin, ray.direction);
        let at = |distance: f32| o + d * distance;
        let flat = Vec3::new(1.0, 1.0, 0.0);
        let hits = match self {
            Self::Flat(triangles) => BruteForce(triangles).nearest(ray).map(|hit| hit.distance).into_iter().collect(),
            Self::Disc { height, radius } => {
                let distance = (height - o.z) / d.z;
                [distance].into_iter().filter(|&t| (at(t) * flat).length() < *radius).collect()
            }
            Self::Sphere { center, radius } => roots(d, o - *center, *radius),
            Self::Dome { radius } => roots(d, o, *radius).into_iter().filter(|&t| at(t).z > 0.0).collect(),
            Self::Cylinder { radius, height } => {
                roots(d * flat, o * flat, *radius).into_iter().filter(|&t| (0.0..*height).contains(&at(t).z)).collect()
            }
        };
        hits.into_iter().filter(|&t| t > 0.0 && t < ray.end).collect()
    }
}

/// Where `o + t d` has this length.
fn roots(d: Vec3, o: Vec3, radius: f32) -> Vec<f32> {
    let (a, b, c) = (d.dot(d), o.dot(d), o.dot(o) - radius * radius);
    let root = (b * b - a * c).sqrt();
    if root.is_nan() { Vec::new() } else { vec![(-b - root) / a, (-b + root) / a] }
}

impl Occluders for Shape {
    fn first(&self, ray: &Ray, place: impl Fn(&Hit) -> Option<f32>) -> Option<Hit> {
        let hit = |distance| Hit { triangle: 0, distance, barycentric: Vec2::ZERO, front: true };
        let places = self.hits(ray).into_iter().map(hit).filter_map(|hit| Some((place(&hit)?, hit)));
        places.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, hit)| hit)
    }

    fn any(&self, ray: &Ray, mut stop: impl FnMut(&Hit) -> bool) -> bool {
        self.first(ray, |hit| Some(hit.distance)).is_some_and(|hit| stop(&hit))
    }
}

type Sender = Box<dyn Fn(Vec2) -> [Vec3; 2]>;

/// A sender and what it sends to, where one of them is round. Insides are lifted a little.
fn round(surfaces: &Surfaces) -> Option<(Sender, Shape)> {
    let sphere = |radius: f64, side: f32| -> Sender {
        Box::new(move |square| {
            let z = 1.0 - 2.0 * square.y;
            let normal = (Vec2::from_angle(TAU as f32 * square.x) * (1.0 - z * z).max(0.0).sqrt()).extend(z);
            [normal * (radius as f32 + 1e-5 * side), normal * side]
        })
    };
    let cylinder = |radius: f64, height: f64, side: f32| -> Sender {
        Box::new(move |square| {
            let normal = Vec2::from_angle(TAU as f32 * square.x).extend(0.0);
            [normal * (radius as f32 + 1e-5 * side) + Vec3::Z * square.y * height as f32, normal * side]
        })
    };
    let ball = |distance: f64, radius: f64| Shape::Sphere { center: Vec3::Z * distance as f32, radius: radius as f32 };
    let tube = |radius: f64, height: f64| Shape::Cylinder { radius: radius as f32, height: height as f32 };
    Some(match *surfaces {
        Surfaces::SphereToDisc { radius, distance } => {
            (sphere(1.0, 1.0), Shape::Disc { height: distance as f32, radius: radius as f32 })
        }
        Surfaces::SphereToRectangle { width, height, distance } => {
            (sphere(1.0, 1.0), Shape::Flat(fan(&down([0.0, width], [0.0, height], distance)).collect()))
        }
        Surfaces::SphereToCubeFace => {
            (sphere(0.3, 1.0), Shape::Flat(fan(&down([-0.5, 0.5], [-0.5, 0.5], 0.5)).collect()))
        }
        Surfaces::CubeFaceToSphere { radius } => {
            let face: Sender = Box::new(|square| [(square - 0.5).extend(-0.5), Vec3::Z]);
            (face, ball(0.0, radius))
        }
        Surfaces::OuterSphereToInner { inner, outer } => (sphere(outer, -1.0), ball(0.0, inner)),
        Surfaces::TwoSpheres { from, to, distance } => (sphere(from, 1.0), ball(distance, to)),
        Surfaces::CoaxialCylinders { inner, outer, height } => (cylinder(inner, height, 1.0), tube(outer, height)),
        Surfaces::CylinderSideToItself { radius, height } => (cylinder(radius, height, -1.0), tube(radius, height)),
        Surfaces::CylinderBaseToSide { radius, height } => {
            let base: Sender =
                Box::new(move |square| [radiosity::geometry::disc(square).extend(0.0) * (radius as f32), Vec3::Z]);
            (base, tube(radius, height))
        }
        Surfaces::Hemisphere => {
            let dome: Sender = Box::new(|square| {
                let normal =
                    (Vec2::from_angle(TAU as f32 * square.x) * (1.0 - square.y * square.y).sqrt()).extend(square.y);
                [normal * (1.0 - 1e-5), -normal]
            });
            (dome, Shape::Dome { radius: 1.0 })
        }
        _ => return None,
    })
}

fn fan(polygon: &[DVec3]) -> impl Iterator<Item = [Vec3; 3]> + '_ {
    (2..polygon.len()).map(|k| [polygon[0], polygon[k - 1], polygon[k]].map(|corner| corner.as_vec3()))
}

fn single(polygon: &[DVec3]) -> Vec<Vec3> {
    polygon.iter().map(|corner| corner.as_vec3()).collect()
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

/// Polygons are exact; those that stand for discs are good to 1e-8, strips to the square of their width over length.
#[test]
fn nusselts_area_of_points() {
    for case in POINT_CASES {
        let (name, normal, [polygon, blocker]) = (case.name, case.normal.into(), target_polygons(&case.target));
        let area = |polygon: &[DVec3]| {
            let area = nusselt_area(DVec3::ZERO, normal, polygon);
            assert!((area - point_to_polygon(DVec3::ZERO, normal, polygon)).abs() < 1e-14, "{name}: not Lambert's sum");
            let single = nusselt_area(Vec3::ZERO, normal.as_vec3(), &single(polygon));
            assert!((f64::from(single) - area).abs() < 1e-5, "{name}: {single} in single precision");
            area
        };
        // What stands wholly before the target hides as much of the disc as it covers.
        let visible = area(&polygon) - area(&blocker);
        let tolerance = match case.target {
            Target::Disc { .. } | Target::Sphere { .. } | Target::DiscLessShadow => 2e-8,
            Target::Strip { .. } => 1e-7,
            Target::Sky { .. } => 1e-4,
            _ => 1e-12,
        };
        println!("{name:45} {:+.1e}", visible - expected(case));
        assert!((visible - expected(case)).abs() < tolerance, "{name}: {visible}");
    }
}

#[test]
fn hemicube_of_points() {
    let mut buffers = Buffers::new();
    let mut hemicube = buffers.hemicube();
    for case in POINT_CASES {
        let [polygon, blocker] = target_polygons(&case.target);
        for turn in [0.0, 0.3, 0.6] {
            let mut row = [Estimate::default(); 2];
            let bins = hemicube.point_row([DVec3::ZERO, case.normal.into()], turn, &[&polygon, &blocker], &mut row);
            assert_eq!(row[0].value + row[1].value + bins.sky + bins.void, 1.0);
            assert_within(case.name, row[0], expected(case), [0.15, 1e-3]);
            assert!((row[0].value / expected(case) - 1.0).abs() < 0.02, "{}: {row:?}", case.name);
        }
    }
}

#[test]
fn rays_from_points() {
    let samples = Samples { scrambles: 16, points: 1024, seed: 5 };
    for case in POINT_CASES {
        let [polygon, blocker] = target_polygons(&case.target);
        let triangles: Vec<_> = fan(&polygon).chain(fan(&blocker)).collect();
        let patch = |hit: &Hit| (hit.triangle < polygon.len() as u32 - 2).then_some(0);
        let normal = DVec3::from(case.normal).as_vec3();
        let mut row = [Estimate::<f64>::default()];
        let bins = nusselt_rays(|_| [Vec3::ZERO, normal], &BruteForce(&triangles), patch, &samples, &mut row, &mut [0]);
        assert!((row[0].value + bins.sky + bins.void - 1.0).abs() < 1e-12);
        assert_within(case.name, row[0], expected(case), [0.1, 2e-3]);
    }
}

/// Sender, targets and blockers, with the form factor to all targets together.
struct PolygonCase {
    name: &'static str,
    from: Polygon,
    targets: Vec<Polygon>,
    blockers: Vec<Polygon>,
    factor: f64,
}

fn polygon_cases() -> Vec<PolygonCase> {
    let unoccluded = SURFACE_CASES.iter().filter_map(|case| {
        let (from, targets) = sender_and_targets(&case.surfaces)?;
        Some(PolygonCase { name: case.name, from, targets, blockers: Vec::new(), factor: case.factor })
    });
    let corners = |polygon: &[occluded::Point]| -> Polygon { polygon.iter().map(|&corner| corner.into()).collect() };
    let occluded = occluded::PAIRS.iter().filter(|pair| !pair.blockers.is_empty()).map(|pair| PolygonCase {
        name: pair.name,
        from: corners(pair.a),
        targets: vec![corners(pair.b)],
        blockers: pair.blockers.iter().map(|blocker| corners(blocker)).collect(),
        factor: pair.factor,
    });
    let discs = occluded::DISCS.iter().map(|case| PolygonCase {
        name: case.name,
        from: disc(DVec3::ZERO, case.radii[0], DVec3::NEG_Z),
        targets: vec![disc(DVec3::Z * case.distance, case.radii[1], DVec3::Z)],
        blockers: vec![disc(DVec3::Z * case.blocker_distance, case.blocker_radius, DVec3::Z)],
        factor: case.factor,
    });
    unoccluded.chain(occluded).chain(discs).collect()
}

/// Whatever lies open to half a percent, all to their own error.
#[test]
fn hemicube_of_polygons() {
    let mut buffers = Buffers::new();
    let mut hemicube = buffers.hemicube();
    let samples = Samples { scrambles: 16, points: 32, seed: 2 };
    for PolygonCase { name, from, targets, blockers, factor } in polygon_cases() {
        let patches: Vec<&[DVec3]> = targets.iter().chain(&blockers).map(Vec::as_slice).collect();
        let (mut row, mut scratch) =
            (vec![Estimate::default(); patches.len()], vec![Estimate::default(); patches.len()]);
        let bins = hemicube.polygon_row(&from, &patches, &samples, &mut row, &mut scratch);
        let sum: f64 = row.iter().map(|entry| entry.value).sum();
        assert!((sum + bins.sky + bins.void - 1.0).abs() < 1e-12);
        let all = row[..targets.len()].iter().fold(Estimate::default(), |all, entry| Estimate {
            value: all.value + entry.value,
            error: all.error + entry.error,
        });
        assert_within(name, all, factor, [0.1, 2e-3]);
        assert!(!blockers.is_empty() || (all.value / factor - 1.0).abs() < 0.005, "{name}: {all:?} is not {factor}");
    }
}

#[test]
fn rays_of_polygons() {
    let samples = Samples { scrambles: 16, points: 4096, seed: 9 };
    // In single precision triangles 10^4 times as long as they are wide have no edges to speak of.
    let is_bounded = |polygon: &Polygon| polygon.iter().all(|corner| corner.length() < 1e3);
    let cases = polygon_cases()
        .into_iter()
        .filter(|case| [&case.from].into_iter().chain(&case.targets).chain(&case.blockers).all(is_bounded));
    for PolygonCase { name, from, targets, blockers, factor } in cases {
        let targets: Vec<_> = targets.iter().flat_map(|target| fan(target)).collect();
        let triangles: Vec<_> =
            targets.iter().copied().chain(blockers.iter().flat_map(|blocker| fan(blocker))).collect();
        let patch = |hit: &Hit| (hit.triangle < targets.len() as u32 && hit.front).then_some(0);
        let mut row = [Estimate::default()];
        nusselt_rays(polygon_sender(&single(&from)), &BruteForce(&triangles), patch, &samples, &mut row, &mut [0]);
        assert_within(name, row[0], factor, [0.08, 1e-3]);
    }
}

/// Without samples one is taken, whose error nobody knows.
#[test]
fn no_samples_count_as_one() {
    let none = Samples { scrambles: 0, points: 0, seed: 1 };
    let [from, to] = [up([0.0, 1.0], [0.0, 1.0], 0.0), down([0.0, 1.0], [0.0, 1.0], 1.0)];
    let (mut rays, mut cubes, mut scratch) =
        ([Estimate::<f64>::default(); 1], [Estimate::default(); 1], [Estimate::default(); 1]);
    let triangles: Vec<_> = fan(&to).collect();
    let corners = single(&from);
    let bins = nusselt_rays(polygon_sender(&corners), &BruteForce(triangles), |_| Some(0), &none, &mut rays, &mut [0]);
    assert_eq!((rays[0].value + bins.sky + bins.void, rays[0].error), (1.0, f64::INFINITY));
    let bins = Buffers::new().hemicube().polygon_row(&from, &[&to], &none, &mut cubes, &mut scratch);
    assert!(
        (cubes[0].value + bins.sky + bins.void - 1.0).abs() < 1e-12 && cubes[0].error == f64::INFINITY,
        "{cubes:?}"
    );
}

#[test]
fn rays_of_round_surfaces() {
    let samples = Samples { scrambles: 16, points: 4096, seed: 4 };
    let mut count = 0;
    for case in SURFACE_CASES {
        if let Some((sender, shape)) = round(&case.surfaces) {
            let mut row = [Estimate::default()];
            nusselt_rays(sender, &shape, |_| Some(0), &samples, &mut row, &mut [0]);
            assert_within(case.name, row[0], case.factor, [0.1, 1e-3]);
            count += 1;
        }
    }
    let polygons = SURFACE_CASES.iter().filter(|case| sender_and_targets(&case.surfaces).is_some()).count();
    assert_eq!(count + polygons, SURFACE_CASES.len(), "rays do them all");
}

/// The picture in the documentation is what the example draws.
#[test]
fn the_picture_is_drawn_from_the_arcs() {
    assert_eq!(nusselt::picture(), include_str!("../src/form_factor/nusselt.svg"));
}
