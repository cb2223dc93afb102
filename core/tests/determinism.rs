//! The same scene, settings and seed give the same bits, whatever the number of threads.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;
#[path = "common/lamps.rs"]
mod lamps;

use common::*;
use lamps::*;
use radiosity::bake::{BakeError, BakeSettings, Quality, bake};
use radiosity::light::{Light, LightSource, PointLight};
use radiosity::progress::Progress;
use radiosity::scene::{Scene, cornell_box};

#[test]
fn threads_do_not_matter() {
    let scene = cornell_box();
    let with = |threads| baked(&scene, &BakeSettings { threads, ..settings(60.0, Quality::Draft) });
    let one = with(1);
    for threads in [2, 16] {
        let other = with(threads);
        assert_eq!((&one.images, &one.uvs, &one.placements), (&other.images, &other.uvs, &other.placements));
    }
}

/// More lamps than are asked one by one: those of the rest are chosen by chance, by the same chance.
#[test]
fn threads_do_not_matter_under_many_lamps() {
    let scene = hall(100);
    let with = |threads| baked(&scene, &BakeSettings { threads, ..settings(4.0, Quality::Draft) });
    let one = with(1);
    for threads in [2, 16] {
        let other = with(threads);
        assert_eq!(one.images, other.images);
        assert_eq!(one.report.estimated_error, other.report.estimated_error);
    }
}

#[test]
fn another_seed_is_another_noise() {
    let scene = cornell_box();
    let with = |seed| baked(&scene, &BakeSettings { seed, ..settings(60.0, Quality::Draft) }).images;
    assert_ne!(with(1), with(2));
}

/// A cancelled bake returns within a tenth of a second.
#[test]
fn cancel() {
    let progress = Progress::default();
    let scene = cornell_box();
    std::thread::scope(|scope| {
        let baker = scope.spawn(|| bake(&scene, &settings(500.0, Quality::High), &progress));
        std::thread::sleep(std::time::Duration::from_millis(700));
        let start = std::time::Instant::now();
        progress.cancel();
        assert_eq!(baker.join().unwrap().err(), Some(BakeError::Cancelled));
        assert!(start.elapsed().as_millis() < 1000, "{:?}", start.elapsed());
    });
}

#[test]
fn errors_name_the_culprit() {
    let fails = |scene: &Scene, settings: &BakeSettings| bake(scene, settings, &Progress::default()).unwrap_err();
    assert_eq!(fails(&Scene::default(), &BakeSettings::default()), BakeError::NothingToBake);
    let dark = room([0.0; 3], [1.0; 3], grey(0.5, 0.0));
    assert_eq!(fails(&dark, &BakeSettings::default()), BakeError::NoLight);
    let mut broken = room([0.0; 3], [1.0; 3], grey(0.5, 1.0));
    broken.meshes[3].triangles[0][1] = 99;
    assert!(fails(&broken, &BakeSettings::default()).to_string().contains("room 3"));
    let mut broken = room([0.0; 3], [1.0; 3], grey(0.5, 1.0));
    broken.lights.push(Light {
        name: "the lamp".into(),
        source: LightSource::Point(PointLight {
            position: glam::Vec3::NAN,
            intensity: glam::Vec3::ONE,
            range: f32::INFINITY,
            radius: 0.0,
        }),
    });
    assert!(fails(&broken, &BakeSettings::default()).to_string().contains("the lamp"));
    let small = BakeSettings { memory_bytes: 1 << 20, ..settings(16.0, Quality::Draft) };
    let message = fails(&room([0.0; 3], [1.0; 3], grey(0.5, 1.0)), &small).to_string();
    assert!(message.contains("may use 1 MiB"), "{message}");
}

/// NaN vertices are left out with a warning, and harm nothing else.
#[test]
fn triangles_that_are_not_finite() {
    let mut scene = room([0.0; 3], [1.0; 3], grey(0.5, 1.0));
    let corners = [[0.2, 0.5, f32::NAN], [0.4, 0.5, 0.4], [0.4, 0.5, 0.2], [0.2, 0.5, 0.2]];
    add_quad(&mut scene, "broken", corners, 0);
    let bake = baked(&scene, &settings(16.0, Quality::Draft));
    assert!(bake.report.warnings.iter().any(|warning| warning.contains("not finite")));
    assert!(valid_texels(&bake).all(|texel| texel.is_finite()));
}
