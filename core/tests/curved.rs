//! Meshes of curved surfaces: texels have the true normals, however few triangles there are.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;

use common::*;
use glam::{Affine3A, Vec2, Vec3};
use radiosity::bake::{Bake, Quality};
use radiosity::light::{DirectionalLight, Light, LightSource};
use radiosity::lightmap::{TexelState, UvOrigin};
use radiosity::scene::{CurvedMesh, Scene};
use radiosity::spline::{
    Axis, ChartScale, Homogeneous, KnotVector, Nurbs, OwnedSurface, Tessellation, Tolerance, revolution, tessellate,
};

type Surface = OwnedSurface<Homogeneous<Vec3>>;

const SUN: Vec3 = Vec3::new(-0.6, -0.5, -0.62);
const ILLUMINANCE: f32 = 1000.0;

/// What turns around the vertical axis; the third number is the weight.
fn turned(profile: &[[f32; 3]], knots: &[f32], degree: usize) -> Surface {
    let points: Vec<_> = profile.iter().map(|&[x, y, w]| Homogeneous::new(Vec3::new(x, y, 0.0), w)).collect();
    let curve = Nurbs::new(KnotVector::new(knots, degree).unwrap(), &points).unwrap();
    let axis = Axis { origin: Vec3::ZERO, direction: Vec3::Y };
    revolution(&curve, axis, core::f32::consts::TAU).unwrap()
}

fn cylinder() -> Surface {
    turned(&[[1.0, -1.0, 1.0], [1.0, 1.0, 1.0]], &[0.0, 0.0, 1.0, 1.0], 1)
}

fn sphere() -> Surface {
    let w = core::f32::consts::FRAC_1_SQRT_2;
    let profile = [[0.0, -1.0, 1.0], [1.0, -1.0, w], [1.0, 0.0, 1.0], [1.0, 1.0, w], [0.0, 1.0, 1.0]];
    turned(&profile, &[0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0], 2)
}

/// Few triangles, as a game has them.
fn coarse(surface: &Surface) -> Tessellation<Vec3> {
    tessellate(&surface.surface(), &Tolerance::new(0.1, 1.0).unwrap(), ChartScale::Area)
}

/// A black surface in the sun at this place.
fn in_the_sun(surface: &Surface, place: Affine3A) -> Scene {
    let mut scene = Scene { materials: vec![grey(0.0, 0.0)], ..Default::default() };
    let index = add_mesh(&mut scene, coarse(surface).mesh("curved".into()), 0);
    scene.surfaces[index].transform = place;
    let sun =
        DirectionalLight { direction: SUN.normalize(), illuminance: Vec3::splat(ILLUMINANCE), angular_diameter: 0.0 };
    scene.lights.push(Light { name: "sun".into(), source: LightSource::Directional(sun) });
    scene
}

/// The point of the surface that stands for the center of a texel, if a triangle covers that.
fn point_at(surface: &Surface, part: &Tessellation<Vec3>, at: Vec2) -> Option<Vec3> {
    part.triangles.iter().find_map(|t| {
        let [a, b, c] = t.map(|i| Vec2::from(part.uv_1[i as usize]));
        let area = (b - a).perp_dot(c - a);
        let [v, w] = [(at - a).perp_dot(c - a) / area, (b - a).perp_dot(at - a) / area];
        (v >= 0.0 && w >= 0.0 && v + w <= 1.0).then(|| {
            let [p, q, r] = t.map(|i| Vec2::from(part.parameters[i as usize]));
            let at = p + (q - p) * v + (r - p) * w;
            surface.surface().point(at.x, at.y)
        })
    })
}

/// Texels nearer than this to a border of the chart are changed for the sake of the seam, or of the pole: there triangles
/// of two corners at the pole have none of the surface between them.
const REACH: f32 = 20.0;

/// The largest and the root of the mean squared error of all texels well in the sun, over the irradiance that it has
/// where it falls straight down. `normal_at` is the closed form.
fn errors(scene: &Scene, surface: &Surface, normal_at: impl Fn(Vec3) -> Vec3) -> [f32; 2] {
    let bake: Bake = baked(scene, &settings(32.0, Quality::Draft));
    assert!(bake.uvs.iter().flatten().all(|uv| uv.origin == UvOrigin::Kept), "it is a chart by nature");
    let (part, image, placement) = (coarse(surface), &bake.images[0], bake.placements[0].unwrap());
    let (mut largest, mut sum, mut count) = (0.0_f32, 0.0, 0);
    for (index, texel) in image.texels.iter().enumerate() {
        let pixel = Vec2::new((index as u32 % image.width) as f32, (index as u32 / image.width) as f32) + 0.5;
        let at = pixel / Vec2::new(image.width as f32, image.height as f32);
        let at = (at - placement.min) / (placement.max - placement.min);
        let size = (placement.max - placement.min) * Vec2::new(image.width as f32, image.height as f32);
        let Some(point) = point_at(surface, &part, at) else { continue };
        if (at.min(Vec2::ONE - at) * size).min_element() < REACH {
            continue;
        }
        let cosine = normal_at(point).dot(-SUN.normalize());
        // Where the sun grazes, the facets shadow each other.
        if image.states[index] == TexelState::Valid && cosine > 0.4 {
            let error = (texel.x * core::f32::consts::PI / ILLUMINANCE - cosine).abs();
            (largest, sum, count) = (largest.max(error), sum + error * error, count + 1);
        }
    }
    assert!(count > 500, "{count} texels");
    [largest, (sum / count as f32).sqrt()]
}

#[test]
fn irradiance_is_that_of_the_true_normal() {
    let place = Affine3A::from_scale(Vec3::new(1.0, 1.0, -1.0));
    let upright: fn(Vec3) -> Vec3 = |point| point.with_y(0.0).normalize();
    for (name, surface, normal_at) in
        [("cylinder", cylinder(), upright), ("sphere", sphere(), |point: Vec3| point.normalize())]
    {
        for (way, place) in [("", Affine3A::IDENTITY), (", mirrored", place)] {
            let in_world = |point| place.transform_vector3(normal_at(point));
            let mut scene = in_the_sun(&surface, place);
            let triangles = scene.meshes[0].triangles.len();
            let interpolated = errors(&scene, &surface, in_world);
            scene.curved.push(CurvedMesh { mesh: 0, surface: surface.clone() });
            let curved = errors(&scene, &surface, in_world);
            println!("{name}{way}, {triangles} triangles: largest and mean error {interpolated:?}, true {curved:?}");
            assert!(curved[0] < 1e-4 && curved[1] < 3e-5, "{name}: {curved:?}");
            assert!(interpolated[1] > 100.0 * curved[1], "{name}: {interpolated:?} {curved:?}");
        }
    }
}

/// Nothing about a mesh that the scene does not have, or one without coordinates.
#[test]
fn what_does_not_fit_changes_nothing() {
    let surface = sphere();
    let scene = in_the_sun(&surface, Affine3A::IDENTITY);
    let plain = baked(&scene, &settings(8.0, Quality::Draft));
    let mut other = scene.clone();
    other.curved.push(CurvedMesh { mesh: 7, surface: surface.clone() });
    assert_eq!(baked(&other, &settings(8.0, Quality::Draft)).images, plain.images);
    let mut bare = scene.clone();
    bare.meshes[0].uv_0.clear();
    bare.curved.push(CurvedMesh { mesh: 0, surface });
    assert_eq!(baked(&bare, &settings(8.0, Quality::Draft)).images, plain.images);
}
