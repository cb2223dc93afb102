//! What a bake says of its own errors is true, and errors that are asked for are reached.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;

use common::*;
use glam::Vec3;
use radiosity::bake::{Bake, BakeSettings, Quality};
use radiosity::form_factor::point_to_polygon;
use radiosity::light::{DirectionalLight, Light, LightSource, PointLight};
use radiosity::lightmap::TexelState;
use radiosity::scene::{Scene, cornell_box};

/// For each valid texel its mean over the channels and its estimated error.
fn texels(bake: &Bake) -> Vec<(f32, f32)> {
    let of_image = |image: &radiosity::lightmap::LightmapImage| {
        let all = image.texels.iter().zip(&image.errors).zip(&image.states);
        let valid = all.filter(|(_, state)| **state == TexelState::Valid);
        valid.map(|((texel, error), _)| (texel.element_sum() / 3.0, *error)).collect::<Vec<_>>()
    };
    bake.images.iter().flat_map(of_image).collect()
}

/// Root mean square of |a - b| / (b + 0.1 mean b).
fn difference(a: &Bake, b: &Bake) -> f32 {
    let (a, b) = (texels(a), texels(b));
    let floor = 0.1 * b.iter().map(|(light, _)| light).sum::<f32>() / b.len() as f32;
    let squares = a.iter().zip(&b).map(|((a, _), (b, _))| ((a - b) / (b + floor)).powi(2));
    (squares.sum::<f32>() / b.len() as f32).sqrt()
}

fn with_error(quality: Quality, target_error: f32) -> Bake {
    baked(&cornell_box(), &BakeSettings { target_error, ..settings(50.0, quality) })
}

/// The variance that two halves of the rays of one bake tell is that of many bakes, each with rays of its own.
#[test]
fn halves_tell_the_variance() {
    const BAKES: u64 = 12;
    // Now and then one of 16 rays meets what is bright: more texels are far off than a normal distribution has, and the
    // less noise the others have, the more.
    const FAR_OFF: f32 = 3e-3;
    let bakes: Vec<_> = (0..BAKES)
        .map(|seed| baked(&cornell_box(), &BakeSettings { seed, ..settings(60.0, Quality::Draft) }))
        .map(|bake| texels(&bake))
        .collect();
    let count = bakes[0].len();
    let mean = |texel: usize| bakes.iter().map(|bake| bake[texel].0).sum::<f32>() / BAKES as f32;
    let floor = 0.1 * (0..count).map(mean).sum::<f32>() / count as f32;
    let (mut told, mut found, mut far_off) = (0.0, 0.0, 0);
    for texel in 0..count {
        let mean = mean(texel);
        told += bakes.iter().map(|bake| bake[texel].1.powi(2)).sum::<f32>() / BAKES as f32;
        let error = |bake: &Vec<(f32, f32)>| (bake[texel].0 - mean).abs() / (mean + floor);
        found += bakes.iter().map(|bake| error(bake).powi(2)).sum::<f32>() / (BAKES - 1) as f32;
        far_off += bakes.iter().filter(|bake| error(bake) > (4.0 * bake[texel].1).max(1e-3)).count();
    }
    let ratio = (told / found).sqrt();
    assert!((0.7..1.6).contains(&ratio), "{ratio}");
    // Two halves that agree by chance would claim certainty: their neighbors are asked too.
    let share = far_off as f32 / (count * BAKES as usize) as f32;
    assert!(share < FAR_OFF, "{share}");
}

/// An error that is asked for is there, measured against far more rays; without being asked for it is not.
#[test]
fn a_wanted_error_is_reached() {
    let reference = with_error(Quality::High, 0.0);
    let [draft, wanted] = [0.0, 0.02].map(|error| with_error(Quality::Draft, error));
    let [before, after] = [&draft, &wanted].map(|bake| difference(bake, &reference));
    assert!(before > 0.02 && after < 0.02, "{before} {after}");
    for (bake, error) in [(&draft, before), (&wanted, after)] {
        let ratio = bake.report.estimated_error.noise / error;
        assert!((0.5..2.0).contains(&ratio), "{ratio} of {error}, {:?}", bake.report.estimated_error);
    }
    let rays = |bake: &Bake| bake.report.stages.iter().map(|stage| stage.rays).sum::<u64>();
    assert!(rays(&wanted) < rays(&reference));
}

/// Rays that are added depend on what others found, not on who found it.
#[test]
fn threads_do_not_matter() {
    let with = |threads| {
        let settings = BakeSettings { threads, target_error: 0.02, ..settings(40.0, Quality::Draft) };
        baked(&cornell_box(), &settings).images
    };
    let one = with(1);
    assert!(with(3) == one);
}

/// Hard shadows between few texels are beyond what rays can do: a warning says so, and what helps.
#[test]
fn edges_of_shadows_need_texels() {
    let mut scene = room([0.0; 3], [4.0, 3.0, 4.0], grey(0.5, 0.0));
    add_box(&mut scene, "block", [1.5, 0.5, 1.5], [2.5, 1.5, 2.5], 0, false);
    let lamp = PointLight {
        position: Vec3::new(1.2, 2.8, 1.4),
        intensity: Vec3::splat(100.0),
        range: f32::INFINITY,
        radius: 0.0,
    };
    scene.lights.push(Light { name: "lamp".into(), source: LightSource::Point(lamp) });
    let bake = baked(&scene, &BakeSettings { target_error: 0.02, ..settings(4.0, Quality::Draft) });
    let warns = |text: &&String| text.contains("instead of 2.0 %") && text.contains("texels per meter");
    assert_eq!(bake.report.warnings.iter().filter(warns).count(), 1, "{:?}", bake.report.warnings);
    assert!(bake.report.estimated_error.noise < 0.02);
    assert!(texels(&bake).iter().all(|(_, error)| error.is_finite()));
}

/// The sun on a small tile lights a ceiling: the closed form, and hardly any noise even where rays are few. Rays in all
/// directions find the tile once in 140 times.
#[test]
fn small_bright_patches_are_found() {
    let tile = |y: f32, half: f32| [[-half, y, half], [half, y, half], [half, y, -half], [-half, y, -half]];
    let mut scene = Scene { materials: vec![grey(0.0, 0.0), grey(0.5, 0.0)], ..Default::default() };
    add_quad(&mut scene, "floor", tile(0.0, 2.0), 0);
    add_quad(&mut scene, "tile", tile(0.01, 0.15), 1);
    let mut downwards = tile(2.0, 2.0);
    downwards.reverse();
    let ceiling = add_quad(&mut scene, "ceiling", downwards, 0);
    scene.surfaces[ceiling].casts = false;
    let illuminance = Vec3::splat(core::f32::consts::PI);
    let sun = DirectionalLight { direction: Vec3::NEG_Y, illuminance, angular_diameter: 0.0 };
    scene.lights.push(Light { name: "sun".into(), source: LightSource::Directional(sun) });
    let bake = baked(&scene, &settings(20.0, Quality::Draft));
    let (mut squares, mut sum, mut count) = (0.0, 0.0, 0.0);
    for k in 0..15 * 15 {
        let point = Vec3::new(0.2 * ((k % 15) as f32 - 7.0), 2.0, 0.2 * ((k / 15) as f32 - 7.0));
        let expected = 0.5 * point_to_polygon(point, Vec3::NEG_Y, &tile(0.01, 0.15).map(Vec3::from_array)).abs();
        let error = lookup(&scene, &bake, point, Vec3::NEG_Y).x / expected - 1.0;
        (squares, sum, count) = (squares + error * error, sum + error, count + 1.0);
    }
    let (rms, bias): (f32, f32) = ((squares / count).sqrt(), sum / count);
    assert!(rms < 0.03 && bias.abs() < 0.015, "{rms} {bias}");
}
