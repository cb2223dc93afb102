//! Mirrors and glass in bakes: against closed forms, doubled rooms and paths of light.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;

use std::f32::consts::PI;

use common::*;
use glam::Vec3;
use radiosity::bake::{BakeSettings, Keep, Quality};
use radiosity::light::{DirectionalLight, Light, LightSource, PointLight};
use radiosity::material::{AlphaMode, Material};
use radiosity::progress::Progress;
use radiosity::render::{Camera, PathSettings, path_traced, truth};
use radiosity::scatter::{Ggx, Scatter};
use radiosity::scene::{Receiver, Scene, Surface};
use radiosity::transport::{Lighting, Relighter};

/// A perfect mirror of one color.
fn mirror(color: Vec3) -> Material {
    Material { base_color: color.extend(1.0), metallic: 1.0, roughness: 0.0, ..Default::default() }
}

/// Clear glass of one color, seen from both sides.
fn glass(color: Vec3) -> Material {
    Material { base_color: color.extend(1.0), transmission: 1.0, double_sided: true, ..Default::default() }
}

/// A room of three materials for the walls, and a wide lamp below its ceiling; material 1 is that of the wall at `x = 0`.
fn room_with_lamp(wall: Material) -> Scene {
    let lamp = Material { emissive: Vec3::splat(3.0), ..grey(0.5, 0.0) };
    let mut scene = Scene { materials: vec![grey(0.6, 0.0), wall, lamp], ..Default::default() };
    add_box(&mut scene, "room", [0.0; 3], [3.0, 2.0, 2.0], 0, true);
    scene.surfaces[2].material = 1;
    let y = 1.99;
    add_quad(&mut scene, "lamp", [[1.0, y, 0.4], [2.5, y, 0.4], [2.5, y, 1.6], [1.0, y, 1.6]], 2);
    scene
}

fn relative(got: Vec3, expected: Vec3) -> f32 {
    ((got - expected) / expected).abs().max_element()
}

fn median(mut errors: Vec<f32>) -> f32 {
    errors.sort_by(f32::total_cmp);
    errors[errors.len() / 2]
}

/// Points of the floor of a room, and of its wall at `z = 0`.
fn places() -> impl Iterator<Item = (Vec3, Vec3)> {
    (0..200).map(|k| {
        let (a, b) = ((k % 20) as f32 / 20.0 + 0.02, (k / 20) as f32 / 10.0 + 0.04);
        if k % 2 == 0 {
            (Vec3::new(3.0 * a, 0.0, 2.0 * b), Vec3::Y)
        } else {
            (Vec3::new(3.0 * a, 2.0 * b, 0.0), Vec3::Z)
        }
    })
}

/// The room beside its image: the wall at `x = 0` is gone.
fn doubled(scene: &Scene) -> Scene {
    let mut both = scene.clone();
    both.surfaces.remove(2);
    for surface in both.surfaces.clone() {
        let mut mesh = scene.meshes[surface.mesh].clone();
        mesh.positions.iter_mut().for_each(|position| position.x = -position.x);
        mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        both.surfaces.push(Surface { name: format!("image of {}", surface.name), mesh: both.meshes.len(), ..surface });
        both.meshes.push(mesh);
    }
    both
}

/// A wall that is a mirror shows the room again: the bake of both rooms without the mirror is the same, in the light of
/// lamps and in that of all bounces. Paths of light say so too. No light is lost or made.
#[test]
fn a_mirror_doubles_a_room() {
    let scene = room_with_lamp(mirror(Vec3::ONE));
    let both = doubled(&scene);
    let [bake, expected] = [&scene, &both].map(|scene| baked(scene, &settings(16.0, Quality::Medium)));
    let at = |(place, normal): (Vec3, Vec3)| {
        relative(lookup(&scene, &bake, place, normal), lookup(&both, &expected, place, normal))
    };
    let error = median(places().map(at).collect());
    assert!(error < 0.01, "{error}");
    assert_eq!(bake.report.closure_error, 0.0);
    assert!(bake.report.energy_balance.abs() < 0.005, "{}", bake.report.energy_balance);
    let truth = truth(&scene, &bake, 200, &Progress::default()).unwrap();
    assert!(truth.p50 < 0.03 && truth.bias.abs() < 0.02, "{truth:?}");
}

/// What a mirror throws back of lamps lights a room in its bake and for paths of light alike: a bulb with a radius and the
/// sun, which falls in where the ceiling was and would be dark spots and patches if either left it out.
#[test]
fn mirrored_lamps_are_true() {
    let tint = Vec3::new(0.9, 0.8, 0.6);
    let bulb =
        PointLight { position: Vec3::new(1.2, 1.3, 0.8), intensity: Vec3::splat(2.0), range: 20.0, radius: 0.05 };
    let direction = Vec3::new(-SUN.x, SUN.y, 0.0);
    let sun = DirectionalLight { direction, illuminance: Vec3::splat(8.0), angular_diameter: 0.02 };
    for source in [LightSource::Point(bulb), LightSource::Directional(sun)] {
        let mut scene = room_with_lamp(mirror(tint));
        scene.surfaces.truncate(6);
        if let LightSource::Directional(_) = source {
            scene.surfaces.remove(1);
        }
        scene.lights.push(Light { name: "lamp".into(), source });
        let bake = baked(&scene, &settings(16.0, Quality::Medium));
        let truth = truth(&scene, &bake, 200, &Progress::default()).unwrap();
        assert!(truth.p50 < 0.03 && truth.bias.abs() < 0.02, "{truth:?}");
    }
}

/// A floor of 4 m by 4 m under the sun, which shines down at an angle.
fn sunny_floor() -> Scene {
    let sun = DirectionalLight { direction: SUN, illuminance: Vec3::splat(PI), angular_diameter: 0.0 };
    let light = Light { name: "sun".into(), source: LightSource::Directional(sun) };
    let mut scene = Scene { materials: vec![grey(0.0, 0.0)], lights: vec![light], ..Default::default() };
    add_quad(&mut scene, "floor", [[-2.0, 0.0, 2.0], [2.0, 0.0, 2.0], [2.0, 0.0, -2.0], [-2.0, 0.0, -2.0]], 0);
    scene
}

/// Where the sun shines to.
const SUN: Vec3 = Vec3::new(0.6, -0.8, 0.0);

/// Adds a level sheet of 1 m by 2 m over the floor, at this height and with its middle at this `x`.
fn add_sheet(scene: &mut Scene, x: f32, y: f32, material: Material) {
    let corners = [[x - 0.5, y, 1.0], [x + 0.5, y, 1.0], [x + 0.5, y, -1.0], [x - 0.5, y, -1.0]];
    let surface = add_quad(scene, &material.name.clone(), corners, scene.materials.len());
    scene.surfaces[surface].receiver = Receiver::Nothing;
    scene.materials.push(material);
}

/// Light that falls through panes has their colors, exactly: one pane, two, what is blended, and bodies with a thickness.
#[test]
fn panes_color_the_sun() {
    let (red, blue) = (Vec3::new(0.9, 0.1, 0.05), Vec3::new(0.1, 0.3, 0.8));
    let mut scene = sunny_floor();
    let shift = 0.6 / 0.8;
    add_sheet(&mut scene, -1.5 - shift, 1.0, glass(red));
    add_sheet(&mut scene, -0.5 - shift, 1.0, glass(blue));
    add_sheet(&mut scene, -0.5 - 0.5 * shift, 0.5, glass(red));
    let blended = Material { base_color: red.extend(0.5), alpha: AlphaMode::Blend, ..Default::default() };
    add_sheet(&mut scene, 0.5 - shift, 1.0, blended);
    let absorption = Vec3::new(2.0, 0.5, 8.0);
    let (body, sheet) =
        (Material { absorption, ..glass(blue) }, Material { absorption, thickness: 0.25, ..glass(red) });
    add_sheet(&mut scene, 1.5 - 0.2 * shift, 0.2, sheet);
    scene.materials.push(body);
    let solid = scene.materials.len() - 1;
    add_box(&mut scene, "body", [1.0 - shift, 0.9, -1.0], [2.0 - shift, 1.1, 1.0], solid, false);
    // Its sides are meshes of their own, each of them open: sheets without a thickness.
    let expected = [
        (-1.5, red),
        (-0.5, red * blue),
        (0.5, (Vec3::ONE + red / 0.9) * 0.25),
        (1.5, red * (absorption * -0.25).exp() * blue * blue),
    ];
    let bake = baked(&scene, &settings(16.0, Quality::Draft));
    for (x, tint) in expected {
        let got = lookup(&scene, &bake, Vec3::new(x, 0.0, 0.0), Vec3::Y);
        assert!(got.abs_diff_eq(tint * 0.8, 2e-4), "{got} at {x}: {}", tint * 0.8);
    }
    assert!(lookup(&scene, &bake, Vec3::new(0.0, 0.0, 1.5), Vec3::Y).abs_diff_eq(Vec3::splat(0.8), 1e-4));
}

/// A closed body colors light once, where it enters, and absorbs it by the way through, straight and slanted.
#[test]
fn bodies_absorb_by_the_way_through() {
    let absorption = Vec3::new(2.0, 0.5, 8.0);
    let color = Vec3::new(0.9, 0.8, 0.7);
    let mut scene = sunny_floor();
    scene.materials.push(Material { absorption, thickness: 9.0, double_sided: false, ..glass(color) });
    let mut sides = Scene { materials: scene.materials.clone(), ..Default::default() };
    add_box(&mut sides, "body", [-1.0, 0.5, -1.0], [0.5, 0.7, 1.0], 1, false);
    let mut body = sides.meshes[0].clone();
    for mesh in &sides.meshes[1..] {
        let first = body.positions.len() as u32;
        body.positions.extend(&mesh.positions);
        body.triangles.extend(mesh.triangles.iter().map(|triangle| triangle.map(|vertex| vertex + first)));
    }
    let body = add_mesh(&mut scene, body, 1);
    scene.surfaces[body].receiver = Receiver::Nothing;
    let bake = baked(&scene, &settings(16.0, Quality::Draft));
    let got = lookup(&scene, &bake, Vec3::new(0.2, 0.0, 0.0), Vec3::Y);
    let expected = color * (absorption * (-0.2 / 0.8)).exp() * 0.8;
    assert!(got.abs_diff_eq(expected, 2e-4), "{got} {expected}");
}

/// A wall of glass between a lit room and a black one: all that gets there has its color, in the same amount.
#[test]
fn glass_between_rooms() {
    let tint = Vec3::new(0.8, 0.4, 0.1);
    let through = |tint: Vec3| {
        let mut scene = room_with_lamp(glass(tint));
        scene.materials.push(grey(0.0, 0.0));
        add_box(&mut scene, "black", [-2.0, 0.0, 0.0], [0.0, 2.0, 2.0], 3, true);
        scene.surfaces.remove(7 + 3);
        let bake = baked(&scene, &settings(16.0, Quality::Medium));
        let points = (0..100).map(|k| Vec3::new(-0.1 - 0.2 * (k % 10) as f32, 0.0, 0.1 + 0.2 * (k / 10) as f32));
        points.map(|place| lookup(&scene, &bake, place, Vec3::Y)).collect::<Vec<_>>()
    };
    let (colored, clear) = (through(tint), through(Vec3::ONE));
    let errors = colored.iter().zip(&clear).map(|(colored, clear)| relative(*colored, *clear * tint));
    let error = median(errors.collect());
    assert!(error < 0.01, "{error}");
}

/// The sun in a mirror on a wall lights the floor before it as much as the sun itself, and a lamp as from behind it.
#[test]
fn mirrors_throw_light() {
    let gold = Vec3::new(0.95, 0.8, 0.4);
    for (is_sun, radius) in [(true, 0.0), (false, 0.0), (false, 0.05)] {
        let mut scene = sunny_floor();
        let corners = [[1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [1.0, 1.0, -1.0]];
        add_quad(&mut scene, "mirror", corners, 1);
        scene.surfaces[1].receiver = Receiver::Nothing;
        scene.materials.push(Material { double_sided: true, ..mirror(gold) });
        let lamp =
            PointLight { position: Vec3::new(0.5, 1.5, 0.0), intensity: Vec3::ONE, range: f32::INFINITY, radius };
        let image = Vec3::new(1.5, 1.5, 0.0);
        if !is_sun {
            scene.lights[0].source = LightSource::Point(lamp);
        }
        let bake = baked(&scene, &settings(16.0, Quality::Medium));
        let place = Vec3::new(0.53, 0.0, 0.03);
        let by = |light: Vec3| {
            let way = light - place;
            way.y / way.length().powi(3) / PI
        };
        let expected = if is_sun { (Vec3::ONE + gold) * 0.8 } else { by(lamp.position) + gold * by(image) };
        let got = lookup(&scene, &bake, place, Vec3::Y);
        assert!(relative(got, expected) < 2e-3, "{got} {expected}");
        // The mirror does not reach so far up.
        let place = Vec3::new(-1.03, 0.0, 0.03);
        let expected =
            if is_sun { Vec3::splat(0.8) } else { Vec3::splat((1.5 / (place - lamp.position).length().powi(3)) / PI) };
        let got = lookup(&scene, &bake, place, Vec3::Y);
        assert!(relative(got, expected) < 2e-3, "{got} {expected}");
    }
}

/// A room with a window of three colors under a bright sky panel outside.
fn chapel() -> Scene {
    let mut scene = room_with_lamp(grey(0.6, 0.0));
    scene.surfaces.remove(2);
    let colors = [Vec3::new(0.9, 0.1, 0.1), Vec3::new(0.1, 0.7, 0.2), Vec3::new(0.1, 0.2, 0.9)];
    for (k, color) in colors.into_iter().enumerate() {
        let [low, high] = [2.0 * k as f32 / 3.0, 2.0 * (k + 1) as f32 / 3.0];
        scene.materials.push(glass(color));
        add_quad(&mut scene, "pane", [[0.0, low, 0.0], [0.0, high, 0.0], [0.0, high, 2.0], [0.0, low, 2.0]], 3 + k);
    }
    scene.sky = Vec3::splat(2.0);
    scene
}

/// Light of the sky through stained glass, and of the lamp that leaves by it, against paths of light.
#[test]
fn stained_glass_is_true() {
    let scene = chapel();
    let bake = baked(&scene, &settings(16.0, Quality::Medium));
    let truth = truth(&scene, &bake, 200, &Progress::default()).unwrap();
    assert!(truth.p50 < 0.03 && truth.bias.abs() < 0.02, "{truth:?}");
    assert_eq!(bake.report.closure_error, 0.0);
    assert!(bake.report.energy_balance.abs() < 0.005, "{}", bake.report.energy_balance);
}

/// What is kept lights the rooms as the bake did, by mirrors and through glass, for the same lamps and for others.
#[test]
fn kept_transport_has_mirrors_and_glass() {
    let mut scene = chapel();
    scene.materials.push(mirror(Vec3::new(0.9, 0.8, 0.5)));
    scene.surfaces[2].material = scene.materials.len() - 1;
    let bake_of = |scene: &Scene, keep| {
        let settings = BakeSettings { keep, ..settings(12.0, Quality::Medium) };
        baked(scene, &settings)
    };
    let transport = bake_of(&scene, Keep::Transport).transport.unwrap();
    let read = radiosity::transport::Transport::read(&transport.write()).unwrap();
    assert!(read == transport);
    let mut other = scene.clone();
    other.sky = Vec3::new(0.5, 1.0, 0.2);
    other.materials[2].emissive = Vec3::new(1.0, 2.0, 6.0);
    for scene in [&scene, &other] {
        let relit = Relighter::new(&transport, 1).relight(&Lighting::from(scene), &Progress::default()).unwrap();
        let bake = bake_of(scene, Keep::Lightmaps);
        let pairs = bake.images.iter().zip(&relit.images).flat_map(|(image, relit)| image.texels.iter().zip(relit));
        let lit = pairs.filter(|(texel, _)| texel.min_element() > 0.05);
        let error = median(lit.map(|(texel, relit)| relative(*relit, *texel)).collect());
        assert!(error < 0.02, "{error}");
    }
}

/// Rough metal and varnish under a sky of 1: black and matt as the bake takes them, with gloss what their lobes reflect.
#[test]
fn gloss_reflects_as_bevy_draws_it() {
    for (metallic, roughness) in [(1.0, 0.5), (0.0, 0.4)] {
        let base = Vec3::new(0.9, 0.6, 0.3);
        let material = Material { base_color: base.extend(1.0), metallic, roughness, ..Default::default() };
        let mut scene = Scene { materials: vec![material], sky: Vec3::ONE, ..Default::default() };
        add_quad(&mut scene, "floor", [[-9.0, 0.0, 9.0], [9.0, 0.0, 9.0], [9.0, 0.0, -9.0], [-9.0, 0.0, -9.0]], 0);
        let eye = Vec3::new(0.0, 2.0, 1.5);
        let camera = Camera::looking_at(eye, Vec3::ZERO, 0.01);
        let seen = |gloss| {
            let settings = PathSettings { paths: 4096, gloss, seed: 3, threads: 1 };
            path_traced(&scene, &camera, [1, 1], &settings, &Progress::default()).unwrap().pixels[0]
        };
        assert!(seen(false).mean.abs_diff_eq(base * (1.0 - metallic), 1e-4));
        let f0 = if metallic == 1.0 { base } else { Vec3::splat(0.04) };
        let departure = Vec3::new(0.6, 0.0, 0.8);
        let lobe = Ggx::new(f0, roughness);
        let (rows, columns) = (400, 400);
        let mut expected = base * (1.0 - metallic) * (Vec3::ONE - f0);
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
            let cos = (row as f32 + 0.5) / rows as f32;
            let (sin, angle) = ((1.0 - cos * cos).sqrt(), 2.0 * PI * (column as f32 + 0.5) / columns as f32);
            let arrival = Vec3::new(sin * angle.cos(), sin * angle.sin(), cos);
            expected += lobe.evaluate(arrival, departure) * (cos * 2.0 * PI / (rows * columns) as f32);
        }
        let found = seen(true);
        let off = (found.mean - expected).abs();
        assert!((off - 3.0 * found.standard_error() - 2e-3).max_element() < 0.0, "{found:?} {expected}");
    }
}
