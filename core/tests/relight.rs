//! Laws of stored transport: other lamps and colors without a ray give what a bake anew gives.

#[expect(dead_code, reason = "each test uses a part of the helpers")]
mod common;

use common::*;
use glam::Vec3;
use radiosity::bake::{Bake, BakeError, BakeSettings, Keep, Quality, bake};
use radiosity::light::{Light, LightSource, PointLight};
use radiosity::lightmap::TexelState;
use radiosity::material::Material;
use radiosity::progress::Progress;
use radiosity::scene::{Scene, cornell_box};
use radiosity::transport::{Layers, Lighting, Origin, RelightError, Relighter, Relit, Transport, TransportError};

/// A closed room of two materials with a block and two lamps, the second off.
fn scene() -> Scene {
    let mut scene = room([0.0; 3], [3.0, 2.0, 2.0], grey(0.6, 0.0));
    scene.materials.push(Material { base_color: Vec3::new(0.8, 0.2, 0.1).extend(1.0), ..grey(0.0, 0.0) });
    scene.surfaces[2].material = 1;
    add_box(&mut scene, "block", [1.2, 0.0, 0.6], [1.8, 0.7, 1.1], 0, false);
    for (position, candela) in [([0.7, 1.5, 1.3], 10.0), ([2.4, 1.2, 0.4], 0.0)] {
        let intensity = Vec3::splat(candela);
        let point = PointLight { position: Vec3::from_array(position), intensity, range: f32::INFINITY, radius: 0.05 };
        scene.lights.push(Light { name: "lamp".into(), source: LightSource::Point(point) });
    }
    scene
}

fn keeping(texels_per_meter: f32) -> BakeSettings {
    BakeSettings { keep: Keep::Transport, ..settings(texels_per_meter, Quality::Draft) }
}

fn transport_of(bake: &Bake) -> &Transport {
    bake.transport.as_ref().expect("it was asked for")
}

fn relit(transport: &Transport, lighting: &Lighting) -> Relit {
    Relighter::new(transport, 1).relight(lighting, &Progress::default()).unwrap()
}

/// The texels that hold light of their own.
fn own_texels<'a>(relit: &'a Relit, bake: &'a Bake) -> impl Iterator<Item = Vec3> + 'a {
    let states = bake.images.iter().flat_map(|image| &image.states);
    let texels = relit.images.iter().flatten().zip(states);
    texels.filter(|(_, state)| **state == TexelState::Valid).map(|(texel, _)| *texel)
}

/// Root mean square of |a - b| / (b + 0.1 mean b).
fn difference(a: impl Iterator<Item = Vec3>, b: impl Iterator<Item = Vec3>) -> f32 {
    let b: Vec<Vec3> = b.collect();
    let mean = b.iter().sum::<Vec3>() / b.len() as f32;
    let squares = a.zip(&b).map(|(a, b)| ((a - b) / (b + 0.1 * mean)).length_squared() / 3.0);
    (squares.sum::<f32>() / b.len() as f32).sqrt()
}

#[test]
fn the_light_of_the_bake_comes_back() {
    for (scene, density) in [(scene(), 16.0), (cornell_box(), 100.0)] {
        let bake = baked(&scene, &keeping(density));
        let transport = transport_of(&bake);
        assert_eq!(transport.lighting, Lighting::from(&scene));
        assert_eq!(bake.report.transport_bytes, transport.bytes().total() as u64);
        let again = relit(transport, &transport.lighting);
        let error = difference(own_texels(&again, &bake), valid_texels(&bake));
        assert!(error < 5e-4, "{error}");
        // Gutters too, where no light is of their own.
        for (image, texels) in bake.images.iter().zip(&again.images) {
            assert!(image.texels.iter().zip(texels).all(|(a, b)| (*a == Vec3::ZERO) == (*b == Vec3::ZERO)));
        }
    }
}

/// Another color of the lamp or of a wall: what a bake anew finds, within 0.5 %.
#[test]
fn other_light_is_that_of_a_bake_anew() {
    let (lamp, wall) = (
        |scene: &mut Scene| {
            let lamp = scene.materials.iter_mut().find(|material| material.is_emissive()).unwrap();
            lamp.emissive *= Vec3::new(0.3, 2.0, 4.0);
        },
        |scene: &mut Scene| scene.materials[0].base_color = Vec3::new(0.1, 0.5, 0.8).extend(1.0),
    );
    let base = cornell_box();
    let bake = baked(&base, &keeping(100.0));
    for change in [&lamp as &dyn Fn(&mut Scene), &wall] {
        let mut scene = base.clone();
        change(&mut scene);
        let relit = relit(transport_of(&bake), &Lighting::from(&scene));
        let anew = baked(&scene, &keeping(100.0));
        let error = difference(own_texels(&relit, &bake), valid_texels(&anew));
        let changed = difference(valid_texels(&bake), valid_texels(&anew));
        assert!(error < 0.005 && changed > 0.05, "{error} of {changed}");
    }
}

/// A lamp that was off can be switched on, a dark wall can shine, and the sky can light up.
#[test]
fn what_was_dark_can_shine() {
    let bake = baked(&scene(), &keeping(8.0));
    let transport = transport_of(&bake);
    let dark = transport.lighting.dark();
    assert!(own_texels(&relit(transport, &dark), &bake).all(|texel| texel == Vec3::ZERO));
    let (mut lamp, mut wall) = (dark.clone(), dark.clone());
    lamp.lamps[1] = Vec3::splat(5.0);
    wall.materials[1].emissive = Vec3::X;
    let brightest = |lighting: &Lighting| own_texels(&relit(transport, lighting), &bake).fold(Vec3::ZERO, Vec3::max);
    assert!(brightest(&lamp).min_element() > 0.1);
    assert!(brightest(&wall).x > 0.1 && brightest(&wall).y == 0.0);
    let open = Scene { surfaces: scene().surfaces[6..].to_vec(), ..scene() };
    let bake = baked(&open, &keeping(8.0));
    let mut sky = transport_of(&bake).lighting.dark();
    sky.sky = Vec3::splat(2.0);
    let top = own_texels(&relit(transport_of(&bake), &sky), &bake).fold(Vec3::ZERO, Vec3::max);
    assert!(top.abs_diff_eq(sky.sky, 1e-4), "{top}");
}

/// What two groups of lamps give adds up, and twice a lamp is twice its light.
#[test]
fn light_is_linear_in_the_lamps() {
    let bake = baked(&scene(), &keeping(8.0));
    let transport = transport_of(&bake);
    let dark = transport.lighting.dark();
    let with = |lamps: [f32; 2], emissive: f32| {
        let mut lighting = dark.clone();
        lighting.lamps = lamps.map(Vec3::splat).to_vec();
        lighting.materials[1].emissive = Vec3::splat(emissive);
        relit(transport, &lighting)
    };
    let [first, second, third] = [with([3.0, 0.0], 0.0), with([0.0, 7.0], 0.0), with([0.0, 0.0], 0.5)];
    let sum = own_texels(&first, &bake).zip(own_texels(&second, &bake)).zip(own_texels(&third, &bake));
    let sum = sum.map(|((a, b), c)| a * 2.0 + b + c * 4.0);
    let error = difference(sum, own_texels(&with([6.0, 7.0], 2.0), &bake));
    assert!(error < 1e-4, "{error}");
}

/// Groups of lights are layers: any mixture of them is a sum, in any colors.
#[test]
fn layers_add_up() {
    let mut scene = scene();
    scene.lights[1].source = scene.lights[1].source.with_strength(Vec3::new(2.0, 6.0, 1.0));
    scene.materials[1].emissive = Vec3::splat(0.3);
    let bake = baked(&scene, &keeping(8.0));
    let transport = transport_of(&bake);
    let mut relighter = Relighter::new(transport, 2);
    let groups =
        [vec![Origin::Lamp(0), Origin::Sky], vec![Origin::Lamp(1)], vec![Origin::Material(1), Origin::Lamp(7)]];
    let layers = Layers::new(&mut relighter, &transport.lighting, &groups, &Progress::default()).unwrap();
    let same = Relit { images: layers.mix(&[Vec3::ONE; 3]), ..Default::default() };
    assert!(difference(own_texels(&same, &bake), valid_texels(&bake)) < 5e-4);
    let weights = [Vec3::ZERO, Vec3::new(1.0, 0.0, 3.0), Vec3::splat(0.5)];
    let mut lighting = transport.lighting.dark();
    lighting.lamps[1] = transport.lighting.lamps[1] * weights[1];
    lighting.materials[1].emissive = transport.lighting.materials[1].emissive * weights[2];
    let (mixed, lit) = (Relit { images: layers.mix(&weights), ..Default::default() }, relit(transport, &lighting));
    assert!(difference(own_texels(&mixed, &bake), own_texels(&lit, &bake)) < 1e-4);
    assert_eq!(layers.bytes(), 3 * 12 * bake.report.texels);
}

/// What the ceiling sends to the top of a block is what it would get from it, for the same radiance: `A_i F_ij = A_j F_ji`.
#[test]
fn reciprocity() {
    let mut scene = scene();
    let walls = [1, 7];
    for wall in walls {
        scene.surfaces[wall].material = scene.materials.len();
        scene.materials.push(grey(0.3 + 0.05 * wall as f32, 0.0));
    }
    let bake = baked(&scene, &keeping(16.0));
    let transport = transport_of(&bake);
    let received = |from: usize, by: usize| {
        let mut lighting = transport.lighting.dark();
        let [sender, receiver] = [from, by].map(|wall| scene.surfaces[walls[wall]].material);
        lighting.materials[sender].emissive = Vec3::ONE;
        let relit = relit(transport, &lighting);
        let (surfaces, stored) = (&transport.surfaces, &transport.images[0]);
        let texels = surfaces.patch_of.iter().zip(&surfaces.texel_areas).zip(&stored.places);
        let material = |patch: u32| surfaces.materials.get(patch as usize).copied();
        let on_receiver = texels.filter(|((patch, _), _)| material(**patch) == Some(receiver as u32));
        on_receiver.map(|((_, area), &place)| relit.images[0][place as usize].x * area).sum::<f32>()
    };
    let (there, back) = (received(0, 1), received(1, 0));
    assert!(there > 0.01 && (there / back - 1.0).abs() < 0.01, "{there} {back}");
}

/// No light is lost or made, whatever the lamps and colors.
#[test]
fn energy_balance() {
    let bake = baked(&scene(), &keeping(8.0));
    let transport = transport_of(&bake);
    let mut lighting = transport.lighting.clone();
    for (lamp, color) in [(0, Vec3::new(1.0, 5.0, 2.0)), (1, Vec3::splat(20.0))] {
        lighting.lamps[lamp] = color;
        lighting.materials[lamp].base_color = Vec3::splat(0.9 - 0.6 * lamp as f32);
        let mut relighter = Relighter::new(transport, 1);
        relighter.relight(&lighting, &Progress::default()).unwrap();
        let balance = relighter.energy_balance();
        assert!(balance.abs() < 0.01, "{balance}");
    }
    assert_eq!(transport.patches.closure_error().max(transport.nodes.closure_error()), 0.0);
}

/// The bits depend neither on the threads nor on what was lit before.
#[test]
fn threads_and_starts_do_not_matter() {
    let bake = baked(&scene(), &keeping(8.0));
    let transport = transport_of(&bake);
    let mut other = transport.lighting.clone();
    other.lamps[1] = Vec3::splat(30.0);
    let one = relit(transport, &other);
    for threads in [2, 4] {
        let mut relighter = Relighter::new(transport, threads);
        assert_eq!(relighter.relight(&other, &Progress::default()).unwrap().images, one.images);
        relighter.relight(&transport.lighting, &Progress::default()).unwrap();
        let warm = relighter.relight(&other, &Progress::default()).unwrap();
        assert!(difference(own_texels(&warm, &bake), own_texels(&one, &bake)) < 1e-4);
    }
    for threads in [1, 2] {
        assert_eq!(baked(&scene(), &BakeSettings { threads, ..keeping(8.0) }).transport, bake.transport);
    }
}

#[test]
fn lighting_of_another_scene_is_refused() {
    let bake = baked(&scene(), &keeping(4.0));
    let transport = transport_of(&bake);
    let mut relighter = Relighter::new(transport, 1);
    let mut refuses = |change: &dyn Fn(&mut Lighting), text: &str| {
        let mut lighting = transport.lighting.clone();
        change(&mut lighting);
        match relighter.relight(&lighting, &Progress::default()) {
            Err(RelightError::Lighting(error)) => assert!(error.to_string().contains(text), "{error}"),
            other => panic!("{other:?}"),
        }
    };
    refuses(&|lighting| lighting.lamps.truncate(1), "1 lamps");
    refuses(&|lighting| lighting.lamps[1].y = f32::NAN, "lamp 1");
    refuses(&|lighting| lighting.materials[0].base_color.x = -0.1, "material 0");
    refuses(&|lighting| lighting.sky.z = f32::INFINITY, "sky");
}

#[test]
fn bytes_come_back() {
    let bake = baked(&scene(), &keeping(8.0));
    let bytes = transport_of(&bake).write();
    assert_eq!(Transport::read(&bytes).as_ref(), Ok(transport_of(&bake)));
    assert!(bytes.len() < 2 * transport_of(&bake).bytes().total());
}

/// A byte that changed anywhere, an end that is missing, another version: an error each time.
#[test]
fn broken_bytes_are_errors() {
    let bake = baked(&scene(), &keeping(4.0));
    let bytes = transport_of(&bake).write();
    for at in (0..64).chain((64..bytes.len()).step_by(bytes.len() / 400)) {
        let mut broken = bytes.clone();
        broken[at] ^= 1 << (at % 8);
        assert!(Transport::read(&broken).is_err(), "byte {at}");
    }
    for length in [0, 7, 31, 32, bytes.len() / 2, bytes.len() - 1] {
        assert!(Transport::read(&bytes[..length]).is_err());
    }
    let mut newer = bytes.clone();
    newer[8] += 1;
    assert_eq!(Transport::read(&newer), Err(TransportError::Version { found: u32::from(newer[8]) }));
    let mut longer = bytes;
    longer.push(0);
    assert!(matches!(Transport::read(&longer), Err(TransportError::Length { .. })));
}

/// The memory of what is kept counts.
#[test]
fn memory_is_known_before() {
    let needed = |keep| baked(&scene(), &BakeSettings { keep, ..settings(16.0, Quality::Draft) }).report;
    let (without, with) = (needed(Keep::Lightmaps), needed(Keep::Transport));
    assert!(with.estimated_memory_bytes > without.estimated_memory_bytes + with.transport_bytes);
    let memory_bytes = without.estimated_memory_bytes;
    let little = BakeSettings { memory_bytes, ..keeping(16.0) };
    assert!(matches!(bake(&scene(), &little, &Progress::default()), Err(BakeError::OutOfMemory { .. })));
}
