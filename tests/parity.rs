//! A light that is baked and the same light in real time give the same pixel, within 1 % where light and view follow
//! the normal of a matt surface. Each app renders a wall twice: lit in real time, then by the map without the light.

use bevy::light::RectLight;
use bevy::pbr::Lightmap;
use bevy::prelude::*;
use bevy_radiosity::RadiosityPlugins;
use bevy_radiosity::prelude::*;
use radiosity::composite::StraightRgba;
use radiosity_tests::bake::bake;
use radiosity_tests::render::Studio;

/// Where the light is, above the middle of the wall, in meters.
const HEIGHT: f32 = 1.5;
const TOLERANCE: f32 = 0.01;

fn studio() -> Option<Studio> {
    let mut studio = Studio::new()?;
    studio.app.add_plugins(RadiosityPlugins);
    let world = studio.app.world_mut();
    let mesh = world.resource_mut::<Assets<Mesh>>().add(Rectangle::new(4.0, 4.0));
    let material = matt(Color::srgb(0.9, 0.7, 0.5));
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(material);
    world.spawn((Baked::default(), Mesh3d(mesh), MeshMaterial3d(material)));
    Some(studio)
}

/// Without specular reflection.
fn matt(base_color: Color) -> StandardMaterial {
    StandardMaterial { base_color, perceptual_roughness: 1.0, reflectance: 0.0, ..default() }
}

fn warm() -> Color {
    Color::srgb(1.0, 0.85, 0.6)
}

fn assert_same(baked: Vec3, real_time: Vec3) {
    assert!(real_time.min_element() > 1e-3, "the wall is dark in real time: {real_time}");
    let error = ((baked - real_time) / real_time).abs().max_element();
    println!("{baked} is baked, {real_time} in real time: {:.3} % apart", 100.0 * error);
    assert!(error < TOLERANCE, "{baked} is baked, {real_time} in real time: {:.2} % apart", 100.0 * error);
}

/// Along -z from above the wall.
fn assert_light_is_the_same_baked(light: impl Bundle) {
    let Some(mut studio) = studio() else { return };
    let light = studio.app.world_mut().spawn((Baked::default(), light, Transform::from_xyz(0.0, 0.0, HEIGHT))).id();
    let real_time = studio.center();
    bake(&mut studio.app);
    let with_light = studio.center();
    assert_same(with_light, real_time);
    studio.app.world_mut().despawn(light);
    assert_eq!(studio.center(), with_light, "a baked light adds nothing to a matt surface");
    studio.app.world_mut().trigger(RemoveBake);
    assert_eq!(studio.center(), Vec3::ZERO, "without map and light it is dark");
}

#[test]
fn point_light() {
    assert_light_is_the_same_baked(PointLight { intensity: 20_000.0, color: warm(), ..default() });
}

#[test]
fn spot_light() {
    let (inner_angle, outer_angle) = (0.3, 0.6);
    assert_light_is_the_same_baked(SpotLight {
        intensity: 20_000.0,
        color: warm(),
        inner_angle,
        outer_angle,
        ..default()
    });
}

#[test]
fn directional_light() {
    assert_light_is_the_same_baked(DirectionalLight { illuminance: 1_000.0, color: warm(), ..default() });
}

/// A lightmap on glass: the light on it and what is seen through it, composed as the core does.
#[test]
fn glass_with_a_lightmap() {
    const ALPHA: f32 = 0.35;
    let behind = Vec3::new(0.2, 0.3, 0.4);
    let Some(mut studio) = studio() else { return };
    studio.app.insert_resource(ClearColor(Color::linear_rgb(behind.x, behind.y, behind.z)));
    let light = PointLight { intensity: 20_000.0, color: warm(), ..default() };
    let light = studio.app.world_mut().spawn((Baked::default(), light, Transform::from_xyz(0.0, 0.0, HEIGHT))).id();
    let opaque = studio.center();
    let over = StraightRgba { rgb: opaque.to_array(), alpha: ALPHA }
        .premultiplied()
        .over(StraightRgba { rgb: behind.to_array(), alpha: 1.0 }.premultiplied());
    let modes = [
        (AlphaMode::Blend, Vec4::from_array(over.to_array()).truncate()),
        (AlphaMode::Premultiplied, opaque + (1.0 - ALPHA) * behind),
        (AlphaMode::Add, ALPHA * opaque + behind),
        (AlphaMode::Multiply, (ALPHA * opaque + (1.0 - ALPHA)) * behind),
    ];
    for (mode, composed) in modes {
        blend(&mut studio, mode, ALPHA);
        assert_same(studio.center(), composed);
        bake(&mut studio.app);
        assert_same(studio.center(), composed);
        let lightmaps = studio.app.world_mut().query::<&Lightmap>().iter(studio.app.world()).count();
        assert_eq!(lightmaps, 1, "{mode:?}");
    }
    studio.app.world_mut().despawn(light);
    for (mode, composed) in modes {
        blend(&mut studio, mode, ALPHA);
        assert_same(studio.center(), composed);
    }
}

/// Makes all materials let light through.
fn blend(studio: &mut Studio, mode: AlphaMode, alpha: f32) {
    let mut materials = studio.app.world_mut().resource_mut::<Assets<StandardMaterial>>();
    for (_, material) in materials.iter_mut() {
        material.alpha_mode = mode;
        material.base_color.set_alpha(alpha);
    }
}

#[test]
fn rect_light() {
    assert_light_is_the_same_baked(RectLight {
        intensity: 5_000.0,
        color: warm(),
        width: 1.0,
        height: 0.5,
        ..default()
    });
}

/// An emissive surface lights nothing in real time, so a rectangular light of the same luminance stands in for it.
#[test]
fn emissive_quad() {
    let Some(mut studio) = studio() else { return };
    let (width, height, intensity) = (1.0, 0.5, 5_000.0);
    let light = RectLight { intensity, width, height, ..default() };
    let at = Transform::from_xyz(0.0, 0.0, HEIGHT);
    let light = studio.app.world_mut().spawn((light, at)).id();
    let real_time = studio.center();

    let world = studio.app.world_mut();
    world.despawn(light);
    let luminance = intensity / (width * height * std::f32::consts::PI);
    let emissive = LinearRgba::rgb(luminance, luminance, luminance);
    let mesh = world.resource_mut::<Assets<Mesh>>().add(Rectangle::new(width, height));
    let material = StandardMaterial { emissive, ..matt(Color::BLACK) };
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(material);
    // The camera is behind it and so does not see it.
    let faces_wall = at.looking_to(Vec3::Z, Vec3::Y);
    world.spawn((Baked::default(), Mesh3d(mesh), MeshMaterial3d(material), faces_wall));
    assert_eq!(studio.center(), Vec3::ZERO);
    bake(&mut studio.app);
    assert_same(studio.center(), real_time);
    let lightmaps = studio.app.world_mut().query::<&Lightmap>().iter(studio.app.world()).count();
    assert_eq!(lightmaps, 2);
}
