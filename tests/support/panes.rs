//! Flat panes that let light through, and what a camera sees of them: on the screen and by the core's exact composite, in
//! which the order of arrival does not count.

use bevy::prelude::*;
use radiosity::composite::{Framebuffer, Layers, Pixel, PremultipliedRgba, Samples, StraightRgba};

use crate::render::{SIDE, Studio};

/// What the main texture in half precision loses, and the blending of many layers in it.
const CLOSE: f32 = 0.004;

/// What stands behind all panes.
pub const BACKGROUND: [f32; 3] = [0.2, 0.3, 0.4];

/// A square in its own plane z = 0 that lets light through.
#[derive(Component, Clone, Copy)]
pub struct Pane {
    /// Straight, linear.
    pub rgb: [f32; 3],
    /// What it blocks.
    pub alpha: f32,
    /// Its side.
    pub size: f32,
}

/// A red one.
pub const RED: Pane = Pane { rgb: [0.9, 0.1, 0.1], alpha: 0.5, size: 0.9 };
/// A green one, smaller.
pub const GREEN: Pane = Pane { rgb: [0.1, 0.8, 0.1], alpha: 0.6, size: 0.7 };

/// Puts a pane into the scene.
pub fn spawn(studio: &mut Studio, pane: Pane, transform: Transform) -> Entity {
    let world = studio.app.world_mut();
    let mesh = world.resource_mut::<Assets<Mesh>>().add(Rectangle::new(pane.size, pane.size));
    let [red, green, blue] = pane.rgb;
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial {
        base_color: Color::linear_rgba(red, green, blue, pane.alpha),
        alpha_mode: AlphaMode::Blend,
        unlit: true,
        cull_mode: None,
        ..default()
    });
    world.spawn((pane, Mesh3d(mesh), MeshMaterial3d(material), transform)).id()
}

/// The red pane behind the green one, then before it: how many pixels are wrong.
pub fn swap_two_panes(studio: &mut Studio) -> [usize; 2] {
    let red = spawn(studio, RED, Transform::from_xyz(0.1, 0.05, -0.5));
    spawn(studio, GREEN, Transform::from_xyz(-0.1, -0.05, 0.0));
    let camera = studio.camera;
    let before = wrong_pixels(studio, camera, Samples::One);
    move_to(studio, red, vec3(0.1, 0.05, 0.5));
    [before, wrong_pixels(studio, camera, Samples::One)]
}

/// Moves an entity.
///
/// # Panics
///
/// Where it has no transform.
pub fn move_to(studio: &mut Studio, entity: Entity, place: Vec3) {
    studio.app.world_mut().get_mut::<Transform>(entity).expect("it has a transform").translation = place;
}

/// What the panes of the world look like from a camera, each pixel a list of layers sorted by depth.
///
/// # Panics
///
/// Where there is no such camera.
pub fn truth(studio: &mut Studio, camera: Entity, samples: Samples) -> Vec<Vec3> {
    let world = studio.app.world_mut();
    let clip_from_view = world.get::<Camera>(camera).expect("a camera").clip_from_view();
    let view_from_world = world.get::<GlobalTransform>(camera).expect("a camera").affine().inverse();
    let clip_from_world = clip_from_view * Mat4::from(view_from_world);
    let count = match samples {
        Samples::One => 1,
        Samples::Four => 4,
    };
    let mut pixels = vec![Layers::<16>::EMPTY; (SIDE * SIDE * count) as usize];
    let mut frame = Framebuffer::new([SIDE; 2], samples, &mut pixels).expect("as many as the size asks for");
    for (pane, place) in world.query::<(&Pane, &GlobalTransform)>().iter(world) {
        let half = pane.size / 2.0;
        let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
        let corners =
            corners.map(|[x, y]| clip_from_world * place.affine().transform_point3(vec3(x, y, 0.0)).extend(1.0));
        let color = StraightRgba { rgb: pane.rgb, alpha: pane.alpha }.premultiplied();
        for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
            frame.draw(&[corners[a], corners[b], corners[c]], |_| color);
        }
    }
    let mut picture = vec![PremultipliedRgba::TRANSPARENT; (SIDE * SIDE) as usize];
    frame.resolve(&mut picture).expect("one for each pixel");
    let background = StraightRgba { rgb: BACKGROUND, alpha: 1.0 }.premultiplied();
    picture.iter().map(|&color| Vec4::from_array(color.over(background).to_array()).truncate()).collect()
}

/// How many pixels are not what they should be.
///
/// # Panics
///
/// Where no pane is in view.
pub fn wrong_pixels(studio: &mut Studio, camera: Entity, samples: Samples) -> usize {
    let seen = studio.picture(camera);
    let truth = truth(studio, camera, samples);
    assert_eq!(seen.len(), truth.len(), "the picture was read back");
    assert!(truth.iter().any(|pixel| pixel.distance(Vec3::from(BACKGROUND)) > 0.1), "panes are in view");
    seen.iter().zip(&truth).filter(|(seen, truth)| !seen.abs_diff_eq(**truth, CLOSE)).count()
}
