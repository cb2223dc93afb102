//! A bake in several parts, for want of memory, is as good as one that has all texels at hand.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;

use common::*;
use glam::Vec3;
use radiosity::bake::{Bake, BakeError, BakeSettings, Keep, Quality, bake, bake_into};
use radiosity::geometry::NoLog;
use radiosity::light::{Light, LightSource, PointLight};
use radiosity::lightmap::{LayoutSettings, TexelState};
use radiosity::progress::{Cancelled, Progress};
use radiosity::scene::Scene;

/// A room with two boxes and a lamp, in images so small that it needs several.
fn furnished() -> Scene {
    let mut scene = room([0.0; 3], [3.0, 2.5, 4.0], grey(0.7, 0.0));
    add_box(&mut scene, "box", [0.5, 0.0, 1.0], [1.3, 0.8, 1.8], 0, false);
    add_box(&mut scene, "column", [2.0, 0.0, 2.5], [2.4, 2.5, 2.9], 0, false);
    let lamp = PointLight {
        position: Vec3::new(1.6, 2.0, 1.9),
        intensity: Vec3::splat(100.0),
        range: f32::INFINITY,
        radius: 0.0,
    };
    scene.lights.push(Light { name: "lamp".into(), source: LightSource::Point(lamp) });
    scene
}

fn small_images(memory_bytes: u64) -> BakeSettings {
    let settings = settings(32.0, Quality::Draft);
    BakeSettings { layout: LayoutSettings { max_image_size: 128, ..settings.layout }, memory_bytes, ..settings }
}

/// With the least memory in which the scene can be baked, found by asking.
fn in_parts(scene: &Scene) -> BakeSettings {
    match bake(scene, &small_images(1), &Progress::default()) {
        Err(BakeError::OutOfMemory { needed, .. }) => small_images(needed),
        other => panic!("{other:?}"),
    }
}

/// Root mean square and mean of the difference between the valid texels of two bakes, over the mean of the first.
fn difference(one: &Bake, other: &Bake) -> [f64; 2] {
    let (mut squares, mut sums) = (Vec::new(), [0.0; 2]);
    for (one, other) in one.images.iter().zip(&other.images) {
        assert_eq!(one.states, other.states);
        for at in (0..one.texels.len()).filter(|&at| one.states[at] == TexelState::Valid) {
            let [one, other] = [one, other].map(|image| f64::from(image.texels[at].element_sum()));
            squares.push((one - other) * (one - other));
            sums = [sums[0] + one, sums[1] + other];
        }
    }
    let count = squares.len() as f64;
    [(squares.iter().sum::<f64>() / count).sqrt() * count / sums[0], sums[1] / sums[0] - 1.0]
}

/// Parts add no more than another seed does, and that mean is not off.
#[test]
fn parts_differ_by_less_than_noise() {
    let scene = furnished();
    let whole = small_images(u64::MAX);
    let settings = in_parts(&scene);
    let one = baked(&scene, &whole);
    let many = baked(&scene, &settings);
    let noise = difference(&one, &baked(&scene, &BakeSettings { seed: 1, ..whole }));
    let parts = difference(&one, &many);
    assert!(parts[0] < 1.05 * noise[0] && parts[1].abs() < 0.01, "{parts:?}, with another seed {noise:?}");
    assert_eq!(one.report.parts, 1);
    assert!(many.report.parts >= 3, "{} parts of {} images", many.report.parts, many.report.images);
    assert!(many.report.estimated_memory_bytes <= settings.memory_bytes);
    assert!(many.report.estimated_memory_bytes < one.report.estimated_memory_bytes);
    assert!(many.report.warnings.iter().any(|warning| warning.contains("parts")));
    let errors = [&one, &many].map(|bake| bake.report.estimated_error.rms);
    assert!((errors[0] / errors[1] - 1.0).abs() < 0.2, "{errors:?}");
}

/// What a closed room says does not depend on how it is cut.
#[test]
fn a_furnace_in_parts() {
    let scene = room([0.0; 3], [2.0, 2.0, 3.0], grey(0.5, 1.0));
    let bake = baked(&scene, &in_parts(&scene));
    assert!(bake.report.parts > 1 && bake.report.energy_balance.abs() < 1e-3);
    assert!(valid_texels(&bake).all(|texel| (texel / 2.0 - 1.0).abs().max_element() < 3e-3));
}

#[test]
fn parts_and_threads_do_not_matter() {
    let scene = furnished();
    let settings = in_parts(&scene);
    let [one, four] = [1, 4].map(|threads| baked(&scene, &BakeSettings { threads, ..settings.clone() }));
    assert_eq!(one.images, four.images);
}

/// Images that are handed over are those that are collected, and need less memory.
#[test]
fn images_are_handed_over() {
    let scene = furnished();
    let settings = in_parts(&scene);
    // Whoever takes an image may make a copy of it.
    let settings = BakeSettings { memory_bytes: settings.memory_bytes + (1 << 20), ..settings };
    let collected = baked(&scene, &settings);
    let mut images = vec![None; collected.images.len()];
    let mut take = |index: usize, image| {
        images[index] = Some(image);
        Ok(())
    };
    let progress = Progress::default();
    let rest = bake_into(&scene, &settings, &progress, &NoLog, &mut take).unwrap();
    let exact = BakeSettings { memory_bytes: rest.report.estimated_memory_bytes, ..settings.clone() };
    assert!(rest.images.is_empty() && images.iter().all(Option::is_some));
    if rest.report.parts == collected.report.parts {
        assert_eq!(images.into_iter().flatten().collect::<Vec<_>>(), collected.images);
    }
    let mut refuse = |_, _| Err(Cancelled);
    assert_eq!(bake_into(&scene, &exact, &progress, &NoLog, &mut refuse), Err(BakeError::Cancelled));
}

/// A transport needs all texels at once.
#[test]
fn a_transport_is_not_made_in_parts() {
    let scene = furnished();
    let settings = BakeSettings { keep: Keep::Transport, ..in_parts(&scene) };
    let refused = bake(&scene, &settings, &Progress::default());
    assert!(matches!(refused, Err(BakeError::OutOfMemory { .. })), "{refused:?}");
}
