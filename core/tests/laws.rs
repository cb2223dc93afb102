//! Laws of diffuse light that every bake must obey, in scenes whose answer is known in closed form.

mod common;
#[path = "common/lamps.rs"]
mod lamps;

use common::*;
use core::f32::consts::PI;
use glam::Vec3;
use lamps::*;
use radiosity::bake::Quality;
use radiosity::light::*;
use radiosity::material::AlphaMode;
use radiosity::scene::Scene;

fn lamp(source: LightSource) -> Light {
    Light { name: "lamp".into(), source }
}

fn point(position: [f32; 3], candela: f32) -> PointLight {
    PointLight {
        position: Vec3::from_array(position),
        intensity: Vec3::splat(candela),
        range: f32::INFINITY,
        radius: 0.0,
    }
}

fn floor(material: radiosity::material::Material) -> Scene {
    let mut scene = Scene { materials: vec![material], ..Default::default() };
    add_quad(&mut scene, "floor", [[-2.0, 0.0, 2.0], [2.0, 0.0, 2.0], [2.0, 0.0, -2.0], [-2.0, 0.0, -2.0]], 0);
    scene
}

/// In a closed room whose walls all emit L and reflect rho, every texel holds L / (1 - rho).
#[test]
fn white_furnace() {
    for (reflectance, quality) in [(0.5, Quality::Draft), (0.75, Quality::Medium)] {
        let bake = baked(&room([-1.0, 0.0, -2.0], [1.0, 3.0, 1.0], grey(reflectance, 1.0)), &settings(8.0, quality));
        let expected = 1.0 / (1.0 - reflectance);
        for texel in valid_texels(&bake) {
            assert!((texel / expected - 1.0).abs().max_element() < 3e-3, "{texel} for {expected}");
        }
        assert_eq!(bake.report.closure_error, 0.0);
        assert!(bake.report.energy_balance.abs() < 1e-3);
        assert_eq!(bake.report.invalid_texels, 0);
    }
}

/// Irradiance / pi under a point light on an open floor: I cos / (pi r^2).
#[test]
fn point_light_over_a_plane() {
    let mut scene = floor(grey(0.5, 0.0));
    scene.lights.push(lamp(LightSource::Point(point([0.3, 1.5, -0.2], 100.0))));
    let bake = baked(&scene, &settings(16.0, Quality::Draft));
    for [x, z] in [[0.3, -0.2], [1.0, 1.0], [-1.7, 0.4]] {
        let at = Vec3::new(x, 0.0, z);
        let squared = at.distance_squared(Vec3::new(0.3, 1.5, -0.2));
        let expected = 100.0 * 1.5 / squared.sqrt() / squared / PI;
        let got = lookup(&scene, &bake, at, Vec3::Y);
        assert!((got / expected - 1.0).abs().max_element() < 5e-3, "{got} for {expected}");
    }
}

/// Directional, spot and rectangular lights give what their definitions say.
#[test]
fn other_lights_over_a_plane() {
    let direction = Vec3::new(0.6, -0.8, 0.0);
    let sun = DirectionalLight { direction, illuminance: Vec3::splat(1000.0), angular_diameter: 0.0093 };
    let spot =
        SpotLight { point: point([0.0, 2.0, 0.0], 50.0), direction: Vec3::NEG_Y, inner_angle: 0.3, outer_angle: 0.5 };
    let panel = RectLight {
        center: Vec3::new(0.0, 1.0, 0.0),
        half_width: Vec3::X * 0.5,
        half_height: Vec3::Z * 0.5,
        radiance: Vec3::splat(10.0),
        range: f32::INFINITY,
    };
    // A square of side 1 seen from 1 below its center: four times Howell's B-3 with both sides 1/2.
    let quarter = 0.5 / 1.25_f32.sqrt() * (0.5 / 1.25_f32.sqrt()).atan() * 2.0 / (2.0 * PI);
    for (source, expected) in [
        (LightSource::Directional(sun), 800.0 / PI),
        (LightSource::Spot(spot), 50.0 / 4.0 / PI),
        (LightSource::Rect(panel), 10.0 * 4.0 * quarter),
    ] {
        let mut scene = floor(grey(0.5, 0.0));
        scene.lights.push(lamp(source));
        let got = lookup(&scene, &baked(&scene, &settings(32.0, Quality::Draft)), Vec3::ZERO, Vec3::Y);
        assert!((got / expected - 1.0).abs().max_element() < 2e-3, "{got} for {expected}");
    }
}

/// A wall without thickness between a bright and a dark room lets nothing through.
#[test]
fn no_light_through_walls() {
    let mut scene = room([0.0, 0.0, 0.0], [2.0, 2.0, 2.0], grey(0.7, 0.0));
    add_box(&mut scene, "dark", [2.0, 0.0, 0.0], [4.0, 2.0, 2.0], 0, true);
    scene.lights.push(lamp(LightSource::Point(point([1.9, 1.0, 1.0], 100.0))));
    for density in [4.0, 16.0] {
        let bake = baked(&scene, &settings(density, Quality::Draft));
        let bright = lookup(&scene, &bake, Vec3::new(1.0, 0.0, 1.0), Vec3::Y).x;
        for at in [Vec3::new(2.01, 0.0, 1.0), Vec3::new(3.0, 0.0, 1.0)] {
            assert!(lookup(&scene, &bake, at, Vec3::Y).x <= 1e-3 * bright, "at {at} with {density} texels per meter");
        }
    }
}

/// A blended sheet lets its share through; a masked one is open where its alpha is below the cutoff.
#[test]
fn transparent_sheets() {
    for (alpha, mode, expected) in [
        (0.25, AlphaMode::Blend, 0.75),
        (0.25, AlphaMode::Mask(0.5), 1.0),
        (0.75, AlphaMode::Mask(0.5), 0.0),
        (0.25, AlphaMode::Opaque, 0.0),
    ] {
        let mut scene = floor(grey(0.5, 0.0));
        let mut sheet = grey(0.0, 0.0);
        (sheet.base_color.w, sheet.alpha, sheet.double_sided) = (alpha, mode, true);
        scene.materials.push(sheet);
        add_quad(&mut scene, "sheet", [[-2.0, 1.0, 2.0], [2.0, 1.0, 2.0], [2.0, 1.0, -2.0], [-2.0, 1.0, -2.0]], 1);
        let sun = DirectionalLight { direction: Vec3::NEG_Y, illuminance: Vec3::splat(PI), angular_diameter: 0.0 };
        scene.lights.push(lamp(LightSource::Directional(sun)));
        let got = lookup(&scene, &baked(&scene, &settings(8.0, Quality::Draft)), Vec3::new(0.1, 0.0, 0.1), Vec3::Y);
        assert!((got - expected).abs().max_element() < 1e-3, "{got} for {expected} with {mode:?}");
    }
}

/// What lies inside a solid box is found and takes the light of what lies outside.
#[test]
fn texels_inside_geometry_are_refilled() {
    let mut scene = room([-2.0, 0.0, -2.0], [2.0, 2.0, 2.0], grey(0.5, 0.0));
    add_box(&mut scene, "block", [-0.5, -0.01, -0.5], [0.5, 0.5, 0.5], 0, false);
    scene.lights.push(lamp(LightSource::Point(point([0.0, 1.8, 0.0], 100.0))));
    let bake = baked(&scene, &settings(8.0, Quality::Draft));
    assert!((30..=64).contains(&bake.report.invalid_texels), "{}", bake.report.invalid_texels);
    let darkest = bake
        .images
        .iter()
        .flat_map(|image| image.texels.iter().zip(&image.states))
        .filter(|(_, state)| **state == radiosity::lightmap::TexelState::Invalid)
        .fold(f32::INFINITY, |darkest, (texel, _)| darkest.min(texel.min_element()));
    assert!(darkest > 0.0);
}

/// Twice the light gives twice the lightmap, bit for bit.
#[test]
fn light_is_linear() {
    let with = |candela: f32| {
        let mut scene = room([0.0, 0.0, 0.0], [2.0, 2.0, 2.0], grey(0.5, 0.0));
        scene.lights.push(lamp(LightSource::Point(point([1.0, 1.5, 0.7], candela))));
        baked(&scene, &settings(8.0, Quality::Draft))
    };
    let (one, two) = (with(64.0), with(128.0));
    assert!(one.images[0].texels.iter().zip(&two.images[0].texels).all(|(one, two)| *one * 2.0 == *two));
}

/// What 100 lamps emit is what a closed hall absorbs, `sum A E (1 - rho) = sum 4 pi I`: lamps that are chosen by chance
/// neither lose light nor make any.
#[test]
fn light_of_many_lamps_is_absorbed() {
    let mut scene = hall(100);
    // The pillars stand on the floor and hold the ceiling: without them every texel counts whole.
    scene.surfaces.truncate(6);
    let bake = baked(&scene, &settings(8.0, Quality::Draft));
    let emitted: f32 = scene.lights.iter().map(|light| 4.0 * PI * light.source.strength().x).sum();
    let mut absorbed = 0.0;
    for surface in 0..6 {
        let Some(placement) = bake.placements[surface] else { panic!("it has a lightmap") };
        let (image, [low, high]) = (&bake.images[placement.image], [placement.min, placement.max]);
        let size = glam::Vec2::new(image.width as f32, image.height as f32);
        let [low, high] = [low, high].map(|corner| (corner * size).round().as_uvec2());
        let within = (low.y..high.y).flat_map(|y| (low.x..high.x).map(move |x| (y * image.width + x) as usize));
        let valid = within.filter(|&at| image.states[at] == radiosity::lightmap::TexelState::Valid);
        let (sum, count) = valid.fold((0.0, 0), |(sum, count), at| (sum + image.texels[at].x, count + 1));
        let area = if surface_is_flat(&scene, surface) { 144.0 } else { 36.0 };
        absorbed += area * PI * (1.0 - 0.5) * sum / count as f32;
    }
    assert!((absorbed / emitted - 1.0).abs() < 0.01, "{absorbed} lm of {emitted} lm");
}

/// Whether a side of the hall is its floor or its ceiling.
fn surface_is_flat(scene: &Scene, surface: usize) -> bool {
    let positions = &scene.meshes[scene.surfaces[surface].mesh].positions;
    positions.iter().all(|position| position.y == positions[0].y)
}

/// A sky dome ten kilometers away does not lift rays over what lies two centimeters above a floor.
#[test]
fn far_geometry_does_not_open_contacts() {
    let mut scene = floor(grey(0.5, 0.0));
    add_box(&mut scene, "slab", [-1.0, 0.02, -1.0], [1.0, 0.1, 1.0], 0, false);
    add_box(&mut scene, "dome", [-1e4; 3], [1e4; 3], 0, true);
    for surface in scene.surfaces.iter_mut().filter(|surface| surface.name.starts_with("dome")) {
        surface.receiver = radiosity::scene::Receiver::Nothing;
    }
    let sun = DirectionalLight { direction: Vec3::NEG_Y, illuminance: Vec3::splat(PI), angular_diameter: 0.0 };
    scene.lights.push(lamp(LightSource::Directional(sun)));
    scene.surfaces.iter_mut().filter(|surface| surface.name == "dome 1").for_each(|roof| roof.casts = false);
    let bake = baked(&scene, &settings(8.0, Quality::Draft));
    let lit = lookup(&scene, &bake, Vec3::new(1.5, 0.0, 0.0), Vec3::Y).x;
    let below = lookup(&scene, &bake, Vec3::new(0.1, 0.0, 0.1), Vec3::Y).x;
    assert!((lit - 1.0).abs() < 0.05 && below < 0.02, "{lit} {below}");
}

/// An emitter that its mask cuts away gives no light; one that lets half through gives half.
#[test]
fn emitters_follow_their_alpha() {
    let at = |alpha: f32, mode: AlphaMode| {
        let mut scene = floor(grey(0.5, 0.0));
        let mut panel = grey(0.0, 10.0);
        (panel.base_color.w, panel.alpha) = (alpha, mode);
        scene.materials.push(panel);
        add_quad(&mut scene, "panel", [[-0.2, 1.0, -0.2], [0.2, 1.0, -0.2], [0.2, 1.0, 0.2], [-0.2, 1.0, 0.2]], 1);
        lookup(&scene, &baked(&scene, &settings(8.0, Quality::Draft)), Vec3::ZERO, Vec3::Y).x
    };
    let whole = at(1.0, AlphaMode::Opaque);
    assert!(whole > 0.1);
    assert_eq!(at(0.2, AlphaMode::Mask(0.5)), 0.0);
    assert!((at(0.5, AlphaMode::Blend) / whole - 0.5).abs() < 1e-3);
}

/// A shadow ray ends before the emitter that it asks for, however near that is and however far both are from the origin.
#[test]
fn emitters_do_not_shade_themselves() {
    let under_a_panel = |[x, y, z]: [f32; 3], height: f32| {
        let mut scene = Scene { materials: vec![grey(0.0, 0.0), grey(0.0, 10.0)], ..Default::default() };
        let square = |half: f32, h: f32| {
            [[-half, h, half], [half, h, half], [half, h, -half], [-half, h, -half]]
                .map(|[a, b, c]| [x + a, y + b, z + c])
        };
        add_quad(&mut scene, "floor", square(2.0, 0.0), 0);
        let [a, b, c, d] = square(0.4, height);
        add_quad(&mut scene, "panel", [d, c, b, a], 1);
        lookup(&scene, &baked(&scene, &settings(16.0, Quality::Draft)), Vec3::new(x, y, z), Vec3::Y).x
    };
    for height in [0.05, 0.5, 2.5] {
        let expected = under_a_panel([0.0; 3], height);
        for place in [[3.0, 3.0, 3.0], [0.0, 100.0, 0.0], [1000.0, 0.0, -500.0]] {
            let got = under_a_panel(place, height);
            assert!((got / expected - 1.0).abs() < 0.01, "{got} instead of {expected}, {height} m above {place:?}");
        }
    }
}
