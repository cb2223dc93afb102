//! Flat panes that let light through, and what a camera sees of them: on the screen and by the core's exact composite, in
//! which the order of arrival does not count.

use bevy::prelude::*;
use bevy::render::settings::WgpuSettings;
use radiosity::composite::{Framebuffer, Layers, Pixel, PremultipliedRgba, Samples, StraightRgba};

use crate::render::{SIDE, Studio};

/// What the main texture in half precision loses, and the blending of many layers in it.
pub const CLOSE: f32 = 0.004;

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

/// A triangle in the world and its color.
pub type ColoredTriangle = ([Vec3; 3], StraightRgba);

/// The triangles of all panes.
pub fn triangles_of_panes(studio: &mut Studio) -> Vec<ColoredTriangle> {
    let world = studio.app.world_mut();
    let mut panes = world.query::<(&Pane, &GlobalTransform)>();
    let triangles = panes.iter(world).flat_map(|(pane, place)| {
        let half = pane.size / 2.0;
        let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
        let corners = corners.map(|[x, y]| place.transform_point(vec3(x, y, 0.0)));
        let color = StraightRgba { rgb: pane.rgb, alpha: pane.alpha };
        [[0, 1, 2], [0, 2, 3]].map(|triangle| (triangle.map(|corner: usize| corners[corner]), color))
    });
    triangles.collect()
}

/// What triangles look like from a camera before the background, each pixel a list of layers sorted by depth.
///
/// # Panics
///
/// Where there is no such camera.
pub fn exact(studio: &Studio, camera: Entity, samples: Samples, triangles: &[ColoredTriangle]) -> Vec<Vec3> {
    let world = studio.app.world();
    let clip_from_view = world.get::<Camera>(camera).expect("a camera").clip_from_view();
    let view_from_world = world.get::<GlobalTransform>(camera).expect("a camera").affine().inverse();
    let clip_from_world = clip_from_view * Mat4::from(view_from_world);
    let count = match samples {
        Samples::One => 1,
        Samples::Four => 4,
    };
    let mut pixels = vec![Layers::<16>::EMPTY; (SIDE * SIDE * count) as usize];
    let mut frame = Framebuffer::new([SIDE; 2], samples, &mut pixels).expect("as many as the size asks for");
    for (corners, color) in triangles {
        frame.draw(&corners.map(|corner| clip_from_world * corner.extend(1.0)), |_| color.premultiplied());
    }
    let mut picture = vec![PremultipliedRgba::TRANSPARENT; (SIDE * SIDE) as usize];
    frame.resolve(&mut picture).expect("one for each pixel");
    let background = StraightRgba { rgb: BACKGROUND, alpha: 1.0 }.premultiplied();
    picture.iter().map(|&color| Vec4::from_array(color.over(background).to_array()).truncate()).collect()
}

/// In how many pixels a picture is not what it should be.
///
/// # Panics
///
/// Where the picture was not read back, or shows nothing.
pub fn differing(seen: &[Vec3], truth: &[Vec3], tolerance: f32) -> usize {
    assert_eq!(seen.len(), truth.len(), "the picture was read back");
    assert!(truth.iter().any(|pixel| pixel.distance(Vec3::from(BACKGROUND)) > 0.1), "something is in view");
    seen.iter().zip(truth).filter(|(seen, truth)| !seen.abs_diff_eq(**truth, tolerance)).count()
}

/// How many pixels of panes are not what they should be.
///
/// # Panics
///
/// Where no pane is in view.
pub fn wrong_pixels(studio: &mut Studio, camera: Entity, samples: Samples) -> usize {
    let seen = studio.picture(camera);
    let triangles = triangles_of_panes(studio);
    differing(&seen, &exact(studio, camera, samples, &triangles), CLOSE)
}

/// So too in the very next frame; the camera is off afterwards.
///
/// # Panics
///
/// Where no pane is in view.
pub fn wrong_pixels_at_once(studio: &mut Studio, camera: Entity) -> usize {
    let seen = studio.next_picture(camera);
    let triangles = triangles_of_panes(studio);
    differing(&seen, &exact(studio, camera, Samples::One, &triangles), CLOSE)
}

/// A studio with the background behind it; none where there is no GPU.
pub fn studio(settings: WgpuSettings, msaa: Msaa) -> Option<Studio> {
    let mut studio = Studio::with_settings(settings, msaa)?;
    let [red, green, blue] = BACKGROUND;
    studio.app.insert_resource(ClearColor(Color::linear_rgb(red, green, blue)));
    Some(studio)
}
