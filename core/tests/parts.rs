//! A bake in several parts, for want of memory, is as good as one that has all texels at hand.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;

use common::*;
use glam::Vec3;
use radiosity::bake::{Bake, BakeError, BakeSettings, Keep, Quality, bake, bake_into};
use radiosity::light::{Light, LightSource, PointLight};
use radiosity::lightmap::{LayoutSettings, LightmapImage, TexelState};
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
    with_least(|settings| bake(scene, settings, &Progress::default()))
}

fn with_least(bake: impl Fn(&BakeSettings) -> Result<Bake, BakeError>) -> BakeSettings {
    match bake(&small_images(1)) {
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

/// Parts add no more than another seed does, and that mean is not off. A little more noise they have: what is bright in
/// another part is met by chance only.
#[test]
fn parts_differ_by_less_than_noise() {
    let scene = furnished();
    let whole = small_images(u64::MAX);
    let settings = in_parts(&scene);
    let one = baked(&scene, &whole);
    let many = baked(&scene, &settings);
    let noise = difference(&one, &baked(&scene, &BakeSettings { seed: 1, ..whole }));
    let parts = difference(&one, &many);
    assert!(parts[0] < 1.15 * noise[0] && parts[1].abs() < 0.01, "{parts:?}, with another seed {noise:?}");
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

/// The number of threads changes no bit; that of parts changes the noise, here by 5 % at most, the mean by 1 %.
#[test]
fn parts_and_threads_do_not_matter() {
    let scene = furnished();
    let least = in_parts(&scene);
    let [one, four] = [1, 4].map(|threads| baked(&scene, &BakeSettings { threads, ..least.clone() }));
    assert_eq!(one.images, four.images);
    let other = [least.memory_bytes / 100 * 115, u64::MAX].map(|memory| baked(&scene, &small_images(memory)));
    let parts = [&one, &other[0], &other[1]].map(|bake| bake.report.parts);
    assert!(parts.is_sorted_by(|a, b| a > b), "{parts:?} parts");
    for other in &other {
        let [rms, mean] = difference(&one, other);
        assert!(rms < 0.05 && mean.abs() < 0.01, "{rms}, {mean} in {parts:?} parts");
    }
}

/// A part that is darker than the rest measures its errors by the light of all.
#[test]
fn parts_share_one_measure() {
    let scene = furnished();
    let [one, many] = [small_images(u64::MAX), in_parts(&scene)].map(|settings| baked(&scene, &settings));
    // Each image by itself: in its own mean a dark one would seem to be noisier.
    for (one, many) in one.images.iter().zip(&many.images) {
        let rms = |image: &LightmapImage| {
            let valid = image.errors.iter().zip(&image.states).filter(|(_, state)| **state == TexelState::Valid);
            let squares: Vec<f64> = valid.map(|(error, _)| f64::from(error * error)).collect();
            (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
        };
        let ratio = rms(many) / rms(one);
        assert!((0.8..1.25).contains(&ratio), "{ratio}");
    }
}

/// Images that are handed over are those that are collected, in as many parts as in one.
#[test]
fn images_are_handed_over() {
    let (scene, progress) = (furnished(), Progress::default());
    let hand_over = |settings: &BakeSettings, take: &mut dyn FnMut(usize, LightmapImage) -> Result<(), Cancelled>| {
        bake_into(&scene, settings, &progress, None, take)
    };
    let least = with_least(|settings| hand_over(settings, &mut |_, _| Ok(())));
    for (settings, collected) in [(&least, in_parts(&scene)), (&small_images(u64::MAX), small_images(u64::MAX))] {
        let collected = baked(&scene, &collected);
        let mut images = vec![None; collected.images.len()];
        let mut take = |index: usize, image| {
            images[index] = Some(image);
            Ok(())
        };
        let rest = hand_over(settings, &mut take).expect("it fits");
        assert!(rest.images.is_empty() && images.iter().all(Option::is_some));
        assert_eq!(rest.report.parts, collected.report.parts);
        assert_eq!(images.into_iter().flatten().collect::<Vec<_>>(), collected.images);
    }
    assert_eq!(hand_over(&least, &mut |_, _| Err(Cancelled)), Err(BakeError::Cancelled));
}

/// A transport needs all texels at once.
#[test]
fn a_transport_is_not_made_in_parts() {
    let scene = furnished();
    let settings = BakeSettings { keep: Keep::Transport, ..in_parts(&scene) };
    let refused = bake(&scene, &settings, &Progress::default());
    assert!(matches!(refused, Err(BakeError::OutOfMemory { .. })), "{refused:?}");
}

/// A seam is either made to agree or counted as lying between two parts: together they are all seams of the bake.
#[test]
fn seams_between_parts_are_counted() {
    let mut scene = Scene { materials: vec![grey(0.7, 0.0)], sky: Vec3::splat(100.0), ..Default::default() };
    for [column, row] in (0..5).flat_map(|row| (0..5).map(move |column| [column as f32, row as f32])) {
        let (low, high) = ([1.7 * column, 1.7 * row], [1.7 * (column + 1.0), 1.7 * (row + 1.0)]);
        let corners = [[low[0], 0.0, low[1]], [low[0], 0.0, high[1]], [high[0], 0.0, high[1]], [high[0], 0.0, low[1]]];
        add_quad(&mut scene, "tile", corners, 0);
    }
    let one = baked(&scene, &small_images(u64::MAX));
    let many = baked(&scene, &in_parts(&scene));
    let counts = |bake: &Bake| {
        let warning = bake.report.warnings.iter().find(|warning| warning.contains("different parts, where their two"));
        let counts = warning.map(|text| text.split(' ').filter_map(|word| word.parse().ok()).collect::<Vec<usize>>());
        (bake.report.parts, counts)
    };
    assert_eq!(counts(&one), (1, None));
    let all = one.report.seams.pairs;
    assert!(many.report.parts > 1 && many.report.seams.pairs < all, "{:?} of {all}", many.report.seams);
    assert_eq!(counts(&many).1, Some(vec![all - many.report.seams.pairs, all]));
}
