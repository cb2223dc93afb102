//! Direct light against closed forms and against all lamps asked one by one, and what it claims of its own error.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;

use std::f32::consts::PI;

use common::*;
use glam::{Affine2, Vec2, Vec3};
use radiosity::bake::Quality;
use radiosity::form_factor::point_to_polygon;
use radiosity::geometry::tree;
use radiosity::light::{DirectLight, Lamps, LightSource, PointLight, RectLight};
use radiosity::lightmap::{
    Blocks, Direct, DirectTexel, LayoutSettings, Resolution, ShadowRays, Texel, Texels, check, layout,
};
use radiosity::material::{Filter, Material, Texels as PictureTexels, Texture, TextureRef, UvSet, Wrap};
use radiosity::parallel::Workers;
use radiosity::progress::Progress;
use radiosity::scene::{Receiver, Scene, World};
use radiosity::transport::Tracer;

/// The valid texels of a scene with their direct light, and with that of all lamps one by one at their middles.
fn lit(scene: &Scene, density: f32, rays: ShadowRays, lights: &[LightSource]) -> Vec<(Texel, DirectTexel, Vec3)> {
    let (progress, workers) = (Progress::default(), Workers::new(2));
    let resolution = Resolution::TexelsPerMeter(density);
    let layout = layout(scene, &LayoutSettings { resolution, ..Default::default() }, &progress).unwrap();
    let world = World::new(scene);
    let tracer = Tracer::new(&world, tree(world.corners.clone()));
    let mut texels = Texels::new(&world, &layout, 0..layout.images.len(), &progress).unwrap();
    let is_valid = check(&mut texels, &tracer, &workers, 1, &progress).unwrap();
    let lights: Vec<DirectLight> = lights.iter().map(DirectLight::from).collect();
    let lamps = Lamps::new(lights.iter().map(|light| (light, Vec3::ONE)).collect());
    let direct =
        Direct { texels: &texels, blocks: &Blocks::new(&texels), is_valid: &is_valid, tracer: &tracer, rays, seed: 3 };
    let light = direct.light(&lamps, &workers, &progress).unwrap();
    let one_by_one = |texel: &Texel| {
        let flat = world.normals[texel.triangle as usize];
        let of_light = |light: &DirectLight| {
            let ray = light.shadow_ray(Vec2::splat(0.5), texel.position, texel.normal);
            let ray = tracer.leave_for(texel.triangle, texel.position, flat, &ray);
            light.irradiance(texel.position, texel.normal) * tracer.visibility(&ray)
        };
        lights.iter().map(of_light).sum::<Vec3>() / PI
    };
    let valid = (0..light.len()).filter(|&index| is_valid[index]);
    valid.map(|index| (texels.list[index], light[index], one_by_one(&texels.list[index]))).collect()
}

/// Half of a rectangular lamp 2 m above a floor hides behind the edge of a sheet at 1 m. The noise that is claimed is the
/// error that is made, to a factor of 2, and falls with the tolerated noise.
#[test]
fn penumbra_of_an_edge() {
    const DENSITY: f32 = 32.0;
    let lamp = RectLight {
        center: Vec3::new(0.0, 2.0, 0.0),
        half_width: Vec3::X * 0.4,
        half_height: Vec3::Z * 0.3,
        radiance: Vec3::splat(10.0),
        range: f32::INFINITY,
    };
    let mut scene = Scene { materials: vec![grey(0.5, 0.0)], ..Default::default() };
    add_quad(&mut scene, "floor", [[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]], 0);
    // Turned a little, as edges are; its front looks down.
    let sheet = [[-6.0, 1.0, -6.0], [-0.9, 1.0, -6.0], [0.9, 1.0, 6.0], [-6.0, 1.0, 6.0]];
    let sheet = add_quad(&mut scene, "sheet", sheet, 0);
    scene.surfaces[sheet].receiver = Receiver::Nothing;
    let exact = |point: Vec3| {
        // What of the lamp is seen beyond the edge x = 0.15 z at a height of 1 m, from below.
        let edge = |z: f32| (0.15 * (z + point.z) - point.x).clamp(-0.4, 0.4);
        let strip = |k: i32| {
            let [low, high] = [k, k + 1].map(|k| 0.3 * (k as f32 / 8.0 - 1.0));
            let seen = [[edge(low), 2.0, low], [0.4, 2.0, low], [0.4, 2.0, high], [edge(high), 2.0, high]];
            point_to_polygon(point, Vec3::Y, &seen.map(Vec3::from_array)).abs()
        };
        10.0 * (0..16).map(strip).sum::<f32>()
    };
    // A texel holds the mean of its square.
    let mean = |texel: Vec3| {
        let offset = |k: i32| ((k % 4) as f32 - 1.5) / (4.0 * DENSITY);
        (0..16).map(|k| exact(texel + Vec3::new(offset(k), 0.0, offset(k / 4)))).sum::<f32>() / 16.0
    };
    let mut last = f32::INFINITY;
    for (most, noise) in [(16, 0.0), (64, 0.0), (256, 0.0), (1024, 0.002)] {
        let rays = ShadowRays { first: 8, sharp: 4, most, noise };
        let texels = lit(&scene, DENSITY, rays, &[LightSource::Rect(lamp)]);
        let within = |texel: &Texel| texel.position.x.abs() < 0.7 && texel.position.z.abs() < 0.6;
        let (mut claimed, mut made, mut count) = (0.0, 0.0, 0.0);
        for (texel, light, _) in texels.iter().filter(|(texel, light, _)| within(texel) && light.error.noise > 0.0) {
            claimed += light.error.noise;
            made += (light.irradiance.x - mean(texel.position)).powi(2);
            count += 1.0;
        }
        let (claimed, made) = ((claimed / count).sqrt(), (made / count).sqrt());
        assert!(count > 300.0 && made < 0.7 * last, "{made} for {count} texels after {last}");
        assert!((0.5..2.0).contains(&(claimed / made)), "{claimed} is claimed, {made} is true with {most} rays");
        last = made;
    }
}

/// A sign with a picture lights what is before it in its colors.
#[test]
fn signs_light_in_their_colors() {
    let mut scene = Scene { materials: vec![grey(0.5, 0.0)], ..Default::default() };
    add_quad(&mut scene, "floor", [[-2.0, 0.0, 2.0], [2.0, 0.0, 2.0], [2.0, 0.0, -2.0], [-2.0, 0.0, -2.0]], 0);
    scene.textures.push(Texture {
        name: String::new(),
        width: 2,
        height: 1,
        texels: PictureTexels::Linear32(vec![[1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]]),
        wrap_u: Wrap::Clamp,
        wrap_v: Wrap::Clamp,
        filter: Filter::Nearest,
    });
    let picture = TextureRef { texture: 0, uv_set: UvSet::Uv0, transform: Affine2::IDENTITY };
    scene.materials.push(Material { emissive_texture: Some(picture), ..grey(0.0, 10.0) });
    let corners = [[-1.0, 0.3, -0.3], [1.0, 0.3, -0.3], [1.0, 0.3, 0.3], [-1.0, 0.3, 0.3]];
    let sign = add_quad(&mut scene, "sign", corners, 1);
    let mesh = scene.surfaces[sign].mesh;
    scene.meshes[mesh].uv_0 = vec![Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    let bake = baked(&scene, &settings(8.0, Quality::Draft));
    for x in [0.3, 0.6, 0.9_f32] {
        let half = |left: f32| [[left, -0.3], [left + 1.0, -0.3], [left + 1.0, 0.3], [left, 0.3]];
        let from = |left: f32| {
            let corners = half(left).map(|[x, z]| Vec3::new(x, 0.3, z));
            10.0 * point_to_polygon(Vec3::new(x, 0.0, 0.0), Vec3::Y, &corners).abs()
        };
        let (near, far) = (from(0.0), from(-1.0));
        let [right, left] = [x, -x].map(|x| lookup(&scene, &bake, Vec3::new(x, 0.0, 0.0), Vec3::Y));
        for (got, expected) in [(right, Vec3::new(far, 0.0, near)), (left, Vec3::new(near, 0.0, far))] {
            assert!((got - expected).length() < 0.05 * expected.length(), "{got} instead of {expected} at {x}");
        }
    }
}

/// Rooms with doors under so many lamps of any range.
fn rooms(count: usize) -> (Scene, Vec<LightSource>) {
    let mut scene = Scene { materials: vec![grey(0.5, 0.0)], ..Default::default() };
    add_box(&mut scene, "hall", [0.0; 3], [12.0, 3.0, 12.0], 0, true);
    for along in [4.0, 8.0] {
        add_box(&mut scene, "wall", [0.0, 0.0, along], [7.0, 3.0, along + 0.1], 0, false);
        add_box(&mut scene, "wall", [along, 0.0, 5.0], [along + 0.1, 3.0, 12.0], 0, false);
    }
    let columns = (count as f32).sqrt().ceil() as usize;
    let place = |k: usize| (k as f32 + 0.37) / columns as f32 * 12.0;
    let light = |k: usize| {
        let position = Vec3::new(place(k % columns), 2.2 + 0.7 * (k % 7) as f32 / 7.0, place(k / columns));
        let range = if k.is_multiple_of(3) { 5.0 } else { f32::INFINITY };
        LightSource::Point(PointLight { position, intensity: Vec3::splat(1.0 + (k % 5) as f32), range, radius: 0.0 })
    };
    (scene, (0..count).map(light).collect())
}

/// Texels hold the light of their middles: what is asked lies there.
const MIDDLES: ShadowRays = ShadowRays { first: 8, sharp: 1, most: 64, noise: 0.03 };

/// Up to 32 lamps are asked one by one.
#[test]
fn few_lamps_are_exact() {
    let (scene, lights) = rooms(32);
    for (texel, light, exact) in lit(&scene, 3.0, MIDDLES, &lights) {
        let difference = (light.irradiance - exact).length();
        assert!(difference <= 1e-5 * exact.length(), "{} instead of {exact} at {}", light.irradiance, texel.position);
        assert_eq!(light.error.noise, 0.0);
    }
}

/// 1 000 lamps behind walls: no bias, and the noise that is claimed is not exceeded.
#[test]
fn many_lamps_are_fair() {
    let (scene, lights) = rooms(1000);
    let texels = lit(&scene, 3.0, MIDDLES, &lights);
    let count = texels.len() as f32;
    let mean = texels.iter().map(|(.., exact)| exact.x).sum::<f32>() / count;
    let (mut bias, mut made, mut claimed) = (0.0, 0.0, 0.0);
    for (_, light, exact) in &texels {
        let scale = exact.x + 0.1 * mean;
        bias += (light.irradiance.x - exact.x) / scale / count;
        made += ((light.irradiance.x - exact.x) / scale).powi(2) / count;
        claimed += light.error.noise / (scale * scale) / count;
    }
    assert!(bias.abs() < 4.0 * (made / count).sqrt(), "{bias} with an error of {}", made.sqrt());
    assert!(made.sqrt() < 0.05 && made < 1.5 * claimed && claimed < 9.0 * made, "{made} {claimed}");
}
