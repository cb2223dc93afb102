//! A scene under many lamps.

use glam::Vec3;
use radiosity::light::{Light, LightSource, PointLight};
use radiosity::scene::Scene;

use super::common::*;

/// A hall of 12 m x 3 m x 12 m with four pillars under a grid of so many lamps of 1 cd to 5 cd.
pub fn hall(lamps: usize) -> Scene {
    let mut scene = room([0.0; 3], [12.0, 3.0, 12.0], grey(0.5, 0.0));
    for [x, z] in [[3.1, 3.2], [8.3, 2.9], [2.7, 8.8], [9.1, 8.4]] {
        add_box(&mut scene, "pillar", [x, 0.0, z], [x + 0.6, 3.0, z + 0.6], 0, false);
    }
    let columns = (lamps as f32).sqrt().ceil() as usize;
    let place = |k: usize| (k as f32 + 0.37) / columns as f32 * 12.0;
    scene.lights.extend((0..lamps).map(|k| {
        let position = Vec3::new(place(k % columns), 2.2 + 0.1 * (k % 7) as f32, place(k / columns));
        let intensity = Vec3::splat(1.0 + (k % 5) as f32);
        let lamp = PointLight { position, intensity, range: f32::INFINITY, radius: 0.0 };
        Light { name: format!("lamp {k}"), source: LightSource::Point(lamp) }
    }));
    scene
}
