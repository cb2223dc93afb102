//! Images that surround a scene: by paths of light, in a bake, in mirrors and from a stored transport.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;

use std::f32::consts::PI;

use common::*;
use glam::{Quat, Vec2, Vec3};
use radiosity::bake::{Bake, BakeError, BakeSettings, Keep, Quality};
use radiosity::geometry::{BruteForce, Hit};
use radiosity::light::{Light, LightSource, SkyImage};
use radiosity::progress::Progress;
use radiosity::render::{Facet, Facets, PathTracer, truth};
use radiosity::scatter::{Lambert, Matter};
use radiosity::scene::Scene;
use radiosity::transport::{Lighting, Relighter};

/// Blue above, pale towards the horizon, dark ground, a glow in one direction, and a sun.
fn evening() -> SkyImage {
    let sun = Vec3::new(0.6, 0.5, 0.62).normalize();
    let radiance = |direction: Vec3| {
        let height = direction.y.max(0.0);
        let air = Vec3::new(0.2, 0.4, 1.0) * height + Vec3::new(0.9, 0.8, 0.7) * (1.0 - height);
        let glow = Vec3::new(6.0, 3.0, 1.0) * direction.dot(Vec3::new(0.8, 0.1, -0.6)).max(0.0).powi(16);
        let disc = if direction.dot(sun) > 0.9999 { Vec3::new(1.0, 0.9, 0.7) * 4e4 } else { Vec3::ZERO };
        if direction.y < 0.0 { Vec3::splat(0.1) } else { air + glow + disc }
    };
    SkyImage::from_fn(512, 256, radiance).unwrap()
}

/// A court with a block in it and a roof over a part of it.
fn court() -> Scene {
    let mut scene = Scene { materials: vec![grey(0.6, 0.0), grey(0.3, 0.0)], ..Default::default() };
    add_quad(&mut scene, "floor", [[-2.0, 0.0, 2.0], [2.0, 0.0, 2.0], [2.0, 0.0, -2.0], [-2.0, 0.0, -2.0]], 0);
    add_quad(&mut scene, "wall", [[-2.0, 0.0, -2.0], [2.0, 0.0, -2.0], [2.0, 2.0, -2.0], [-2.0, 2.0, -2.0]], 0);
    add_box(&mut scene, "block", [-0.5, 0.0, -0.5], [0.5, 1.0, 0.5], 1, false);
    add_box(&mut scene, "roof", [-2.0, 1.5, -2.0], [0.0, 1.6, 0.0], 1, false);
    scene
}

/// The court in the evening, the sun a lamp.
fn evening_court() -> Scene {
    let mut sky = evening().turned(Quat::from_rotation_y(0.7));
    let suns = sky.take_suns();
    assert_eq!(suns.len(), 1);
    let lights = suns.into_iter().map(|sun| Light { name: "sun".into(), source: LightSource::Directional(sun) });
    Scene { lights: lights.collect(), sky: Vec3::splat(3.0), sky_image: Some(sky), ..court() }
}

/// What a triangle that looks up gets of a sky is its integral. By chance paths miss the sun.
#[test]
fn paths_know_the_integral() {
    let sky = evening();
    let (width, height) = (512, 256);
    let mut expected = Vec3::ZERO;
    for (row, column) in (0..height / 2).flat_map(|row| (0..width).map(move |column| (row, column))) {
        let [top, bottom] = [row, row + 1].map(|border| (PI * border as f32 / height as f32).cos());
        let (longitude, middle) = (2.0 * PI * ((column as f32 + 0.5) / width as f32 - 0.5), 0.5 * (top + bottom));
        let across = (1.0 - middle * middle).sqrt();
        let direction = Vec3::new(across * longitude.sin(), middle, -across * longitude.cos());
        // The integral of the cosine over the texel, over pi.
        expected += sky.radiance(direction) * ((top * top - bottom * bottom) * 0.5 * 2.0 * PI / width as f32 / PI);
    }
    let corners = [[Vec3::ZERO, Vec3::Z, Vec3::X]];
    let materials = [Facet { matter: Matter::Lambert(Lambert { reflectance: Vec3::ZERO }), emission: Vec3::ZERO }];
    let hit = Hit { triangle: 0, distance: 0.0, barycentric: Vec2::splat(0.3), front: true };
    let by_chance = |direction: Vec3| sky.radiance(direction);
    let facets = Facets {
        corners: &corners,
        materials: &materials,
        of_triangle: &[0],
        occluders: BruteForce(&corners),
        sky: by_chance,
    };
    let chance = PathTracer::new(facets, Vec::new()).received(&hit, Vec3::Y, 256, 1);
    let facets = Facets {
        corners: &corners,
        materials: &materials,
        of_triangle: &[0],
        occluders: BruteForce(&corners),
        sky: sky.clone(),
    };
    let asked = PathTracer::new(facets, Vec::new()).received(&hit, Vec3::Y, 256, 1);
    let off = (asked.mean - expected).abs();
    assert!((off - 3.0 * asked.standard_error()).max_element() < 0.0, "{asked:?} {expected}");
    assert!((asked.standard_error() / expected).max_element() < 0.01, "{asked:?}");
    assert!(chance.mean.x < 0.5 * expected.x, "4 096 paths meet a sun of 1.6 degrees by chance: {chance:?}");
}

/// Gradients, a glow and the shadow of a sun: a bake that knows the sky in patches only is as good as its estimate.
#[test]
fn a_bake_under_an_image_is_true() {
    let scene = evening_court();
    let bake = baked(&scene, &settings(24.0, Quality::Medium));
    let found = truth(&scene, &bake, 200, &Progress::default()).unwrap();
    println!("{found:?} {:?}", bake.report.estimated_error);
    assert!(found.p50 < 0.01 && found.bias.abs() < 0.01 && found.rms_without_worst < 0.08, "{found:?}");
    assert_eq!(bake.report.closure_error, 0.0);
    assert!(bake.report.energy_balance.abs() < 0.01, "{}", bake.report.energy_balance);
}

/// An image of one color is a sky of that color.
#[test]
fn an_even_image_is_no_image() {
    let even = SkyImage::new(4, 2, vec![Vec3::new(1.0, 0.5, 0.25); 8]).unwrap();
    let [with, without] = [
        Scene { sky: Vec3::splat(2.0), sky_image: Some(even), ..court() },
        Scene { sky: Vec3::new(2.0, 1.0, 0.5), ..court() },
    ]
    .map(|scene| baked(&scene, &settings(12.0, Quality::Draft)));
    let texels = |bake: &Bake| valid_texels(bake).collect::<Vec<_>>();
    for (with, without) in texels(&with).into_iter().zip(texels(&without)) {
        assert!(with.abs_diff_eq(without, 1e-4), "{with} {without}");
    }
}

/// What is kept of a bake lights it under the same sky at another hour, and in a mirror the sky is where it belongs.
#[test]
fn kept_transport_has_the_sky() {
    let mut scene = evening_court();
    scene.materials[1] = radiosity::material::Material { metallic: 1.0, roughness: 0.0, ..grey(0.9, 0.0) };
    let bake_of = |scene: &Scene, keep| baked(scene, &BakeSettings { keep, ..settings(12.0, Quality::Medium) });
    let transport = bake_of(&scene, Keep::Transport).transport.unwrap();
    assert!(radiosity::transport::Transport::read(&transport.write()).unwrap() == transport);
    scene.sky = Vec3::new(0.5, 1.0, 2.0);
    scene.lights.iter_mut().for_each(|light| light.source = light.source.with_strength(Vec3::ZERO));
    let relit = Relighter::new(&transport, 1).relight(&Lighting::from(&scene), &Progress::default()).unwrap();
    let bake = bake_of(&scene, Keep::Lightmaps);
    let pairs = bake.images.iter().zip(&relit.images).flat_map(|(image, relit)| image.texels.iter().zip(relit));
    let lit = pairs.filter(|(texel, _)| texel.min_element() > 0.05);
    let mut errors: Vec<f32> = lit.map(|(texel, relit)| ((*relit - *texel) / *texel).abs().max_element()).collect();
    errors.sort_by(f32::total_cmp);
    assert!(errors[errors.len() / 2] < 0.02, "{}", errors[errors.len() / 2]);
    let found = truth(&scene, &bake, 100, &Progress::default()).unwrap();
    assert!(found.p50 < 0.02 && found.bias.abs() < 0.02, "{found:?}");
}

/// A sky that is no light is refused by name.
#[test]
fn a_negative_sky_is_refused() {
    let scene = Scene { sky: Vec3::new(1.0, -1.0, 1.0), ..court() };
    let error = radiosity::bake::bake(&scene, &settings(8.0, Quality::Draft), &Progress::default()).unwrap_err();
    assert!(matches!(&error, BakeError::Invalid(_)) && error.to_string().contains("sky"), "{error}");
    let black = SkyImage::new(2, 1, vec![Vec3::ZERO; 2]).unwrap();
    let scene = Scene { sky: Vec3::ONE, sky_image: Some(black), ..court() };
    let error = radiosity::bake::bake(&scene, &settings(8.0, Quality::Draft), &Progress::default()).unwrap_err();
    assert_eq!(error, BakeError::NoLight);
}
