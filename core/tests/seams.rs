//! Seams: where a surface goes on from one chart or object to the next, its light goes on too, and nothing else changes.

mod common;

use common::*;
use glam::{Affine3A, Vec2, Vec3};
use radiosity::bake::{Bake, BakeSettings, Keep, Quality};
use radiosity::geometry::Mesh;
use radiosity::light::{Light, LightSource, PointLight};
use radiosity::progress::Progress;
use radiosity::scene::{Receiver, Scene};
use radiosity::transport::{Relighter, Transport};

/// Texels further than this from a border of a chart are as they were.
const REACH: u32 = 9;
/// Points of an edge at which both sides are compared.
const POINTS: usize = 40;

fn keeping(texels_per_meter: f32) -> BakeSettings {
    BakeSettings { keep: Keep::Transport, ..settings(texels_per_meter, Quality::Draft) }
}

/// A room of 3 m x 2.5 m x 3 m with a lamp, without its floor.
fn hall() -> Scene {
    let mut scene = room([0.0; 3], [3.0, 2.5, 3.0], grey(0.6, 0.0));
    scene.surfaces.remove(0);
    let (position, intensity) = (Vec3::new(2.1, 1.9, 1.2), Vec3::splat(50.0));
    let lamp = PointLight { position, intensity, range: f32::INFINITY, radius: 0.2 };
    scene.lights.push(Light { name: "lamp".into(), source: LightSource::Point(lamp) });
    scene
}

fn add_floor(scene: &mut Scene, [low, high]: [Vec2; 2], density: f32) {
    let corners = [[low.x, 0.0, low.y], [low.x, 0.0, high.y], [high.x, 0.0, high.y], [high.x, 0.0, low.y]];
    let index = add_quad(scene, "tile", corners, 0);
    scene.surfaces[index].receiver = Receiver::Lightmap { density };
}

/// A floor of nine objects with four densities.
fn tiles() -> Scene {
    let mut scene = hall();
    for tile in 0..9 {
        let low = Vec2::new((tile % 3) as f32, (tile / 3) as f32);
        add_floor(&mut scene, [low, low + 1.0], 1.0 + 0.37 * (tile % 4) as f32);
    }
    scene
}

/// A floor of two panels that end at the side of a third.
fn t_junction() -> Scene {
    let mut scene = hall();
    for [low, high] in [[[0.0, 0.0], [3.0, 1.3]], [[0.0, 1.3], [1.7, 3.0]], [[1.7, 1.3], [3.0, 3.0]]] {
        add_floor(&mut scene, [low.into(), high.into()], 1.0 + 0.3 * low[0]);
    }
    scene
}

/// A floor in two charts: one is turned and smaller.
fn two_charts() -> Scene {
    let mut scene = hall();
    let floor = |x: f32, z: f32| Vec3::new(x, 0.0, z);
    let halves = [[0.0, 1.6], [1.6, 3.0]];
    let positions = halves.map(|[low, high]| [floor(low, 0.0), floor(low, 3.0), floor(high, 3.0), floor(high, 0.0)]);
    let upright = [[0.0, 0.0], [0.0, 1.0], [0.55, 1.0], [0.55, 0.0]];
    let turned = [[1.0, 0.0], [0.63, 0.0], [0.63, 0.28], [1.0, 0.28]];
    let mesh = Mesh {
        name: "floor".into(),
        positions: positions.concat(),
        uv_1: [upright, turned].concat().into_iter().map(Vec2::from).collect(),
        triangles: vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]],
        ..Default::default()
    };
    add_mesh(&mut scene, mesh, 0);
    scene
}

/// A smooth ball that has no lightmap coordinates of its own.
fn ball() -> Scene {
    let mut scene = hall();
    add_floor(&mut scene, [Vec2::ZERO, Vec2::splat(3.0)], 1.0);
    let (rings, sectors) = (16, 32);
    let point = |ring: u32, sector: u32| {
        let (polar, around) = (
            core::f32::consts::PI * ring as f32 / rings as f32,
            core::f32::consts::TAU * sector as f32 / sectors as f32,
        );
        Vec3::new(polar.sin() * around.cos(), polar.cos(), -polar.sin() * around.sin())
    };
    let normals: Vec<Vec3> = (0..=rings).flat_map(|ring| (0..sectors).map(move |sector| point(ring, sector))).collect();
    let at = |ring: u32, sector: u32| ring * sectors + sector % sectors;
    let triangles = (0..rings).flat_map(|ring| {
        (0..sectors).flat_map(move |sector| {
            let [a, b] = [at(ring, sector), at(ring, sector + 1)];
            let [c, d] = [at(ring + 1, sector), at(ring + 1, sector + 1)];
            [[a, c, d], [a, d, b]]
        })
    });
    let has_area = |[a, b, c]: [Vec3; 3]| (b - a).cross(c - a).length() > 1e-6;
    let middle = Vec3::new(1.3, 1.1, 1.6);
    let mesh = Mesh {
        name: "ball".into(),
        positions: normals.iter().map(|normal| middle + 0.6 * normal).collect(),
        triangles: triangles.filter(|&t| has_area(t.map(|k| normals[k as usize]))).collect(),
        normals,
        ..Default::default()
    };
    add_mesh(&mut scene, mesh, 0);
    scene
}

fn transport_of(bake: &Bake) -> &Transport {
    bake.transport.as_ref().expect("it was asked for")
}

/// The same bake as its transport lights it.
fn relit(bake: &Bake, transport: &Transport) -> Bake {
    let relit = Relighter::new(transport, 1).relight(&transport.lighting, &Progress::default()).unwrap();
    let mut images = bake.images.clone();
    images.iter_mut().zip(relit.images).for_each(|(image, texels)| image.texels = texels);
    Bake { images, uvs: bake.uvs.clone(), placements: bake.placements.clone(), ..Default::default() }
}

/// The bake as it would be if nothing was done about seams, and as it is.
fn before_and_after(bake: &Bake) -> [Bake; 2] {
    let mut unmended = transport_of(bake).clone();
    unmended.seams.points.clear();
    unmended.seams.rows.clear();
    [relit(bake, &unmended), relit(bake, transport_of(bake))]
}

/// An edge of a triangle: its ends in the world, in the image, and the shading normals there.
struct Edge {
    ends: [Vec3; 2],
    uvs: [Vec2; 2],
    normals: [Vec3; 2],
    image: usize,
}

fn edges(scene: &Scene, bake: &Bake) -> Vec<Edge> {
    let mut edges = Vec::new();
    for (surface, placement) in scene.surfaces.iter().zip(&bake.placements) {
        let (Some(placement), Some(uv)) = (placement, &bake.uvs[surface.mesh]) else { continue };
        let mesh = &scene.meshes[surface.mesh];
        assert_eq!(surface.transform, Affine3A::IDENTITY);
        for triangle in &uv.triangles {
            let [a, b, c] = triangle.map(|vertex| mesh.positions[uv.sources[vertex as usize] as usize]);
            let flat = (b - a).cross(c - a).normalize();
            let corner = |vertex: u32| {
                let source = uv.sources[vertex as usize] as usize;
                let uv = placement.min + uv.uv_1[vertex as usize] * (placement.max - placement.min);
                (mesh.positions[source], uv, mesh.normals.get(source).copied().unwrap_or(flat))
            };
            for k in 0..3 {
                let [first, second] = [corner(triangle[k]), corner(triangle[(k + 1) % 3])];
                let (ends, uvs) = ([first.0, second.0], [first.1, second.1]);
                edges.push(Edge { ends, uvs, normals: [first.2, second.2], image: placement.image });
            }
        }
    }
    edges
}

/// Light on both sides of every seam of smooth surfaces, at points of all that two edges have in common.
fn sides(scene: &Scene, bake: &Bake) -> Vec<[Vec3; 2]> {
    let edges = edges(scene, bake);
    let mut sides = Vec::new();
    for (index, edge) in edges.iter().enumerate() {
        for other in &edges[index + 1..] {
            let along = edge.ends[1] - edge.ends[0];
            let is_against = along.dot(other.ends[1] - other.ends[0]) < 0.0;
            let is_smooth = edge.normals.iter().any(|normal| normal.dot(other.normals[0]) > 0.99);
            for k in if is_against && is_smooth { 0..POINTS } else { 0..0 } {
                let on_other = (k as f32 + 0.5) / POINTS as f32;
                let at = other.ends[0].lerp(other.ends[1], on_other);
                let share = (at - edge.ends[0]).dot(along) / along.length_squared();
                let is_on = (0.0..=1.0).contains(&share) && at.distance(edge.ends[0] + share * along) < 1e-4;
                let normal = edge.normals[0].lerp(edge.normals[1], share);
                let other_normal = other.normals[0].lerp(other.normals[1], on_other);
                let is_smooth = normal.normalize().dot(other_normal.normalize()) > 0.99;
                let uv = edge.uvs[0].lerp(edge.uvs[1], share);
                let other_uv = other.uvs[0].lerp(other.uvs[1], on_other);
                let is_same = edge.image == other.image && uv.distance(other_uv) < 1e-5;
                if is_on && is_smooth && !is_same {
                    sides.push([bilinear(bake, edge.image, uv), bilinear(bake, other.image, other_uv)]);
                }
            }
        }
    }
    sides
}

/// Root mean square of |left - right| / (mean of both + a tenth of the mean light).
fn step(sides: &[[Vec3; 2]], bake: &Bake) -> f32 {
    let mean = mean(bake);
    let relative = |[left, right]: &[Vec3; 2]| (left.x - right.x) / (0.5 * (left.x + right.x) + 0.1 * mean);
    (sides.iter().map(|sides| relative(sides).powi(2)).sum::<f32>() / sides.len() as f32).sqrt()
}

fn mean(bake: &Bake) -> f32 {
    let sum: f64 = valid_texels(bake).map(|texel| f64::from(texel.x)).sum();
    (sum / valid_texels(bake).count() as f64) as f32
}

/// In one mesh and across objects, turned, of other densities, partly overlapping, smooth: a tenth of the step is left.
#[test]
fn both_sides_agree() {
    for (name, scene, density) in [
        ("tiles", tiles(), 12.0),
        ("t-junction", t_junction(), 12.0),
        ("two charts", two_charts(), 12.0),
        ("ball", ball(), 16.0),
    ] {
        let bake = baked(&scene, &keeping(density));
        let [before, after] = before_and_after(&bake);
        let (sides_before, sides_after) = (sides(&scene, &before), sides(&scene, &after));
        let (step_before, step_after) = (step(&sides_before, &before), step(&sides_after, &after));
        println!("{name}: {} points, {step_before} -> {step_after}, {:?}", sides_after.len(), bake.report.seams);
        assert!(sides_after.len() > 20 && step_before > 0.003, "{name}: {step_before} at {}", sides_after.len());
        assert!(step_after < 0.1 * step_before, "{name}: {step_before} -> {step_after}");
    }
}

/// Charts change near their borders only, no light is lost or made, and what is stored mends as the bake did.
#[test]
fn nothing_else_changes() {
    let bake = baked(&tiles(), &keeping(24.0));
    let [before, after] = before_and_after(&bake);
    assert!((mean(&after) / mean(&before) - 1.0).abs() < 1e-3, "{} {}", mean(&before), mean(&after));
    let mut changed = 0;
    for (surface, placement) in bake.placements.iter().enumerate() {
        let Some(placement) = placement else { continue };
        let [before, after] = [&before, &after].map(|bake| &bake.images[placement.image]);
        let size = Vec2::new(before.width as f32, before.height as f32);
        let [low, high] = [placement.min, placement.max].map(|corner| (corner * size).as_uvec2());
        for (y, x) in (low.y..high.y).flat_map(|y| (low.x..high.x).map(move |x| (y, x))) {
            let at = (y * before.width + x) as usize;
            let inside = (x - low.x).min(high.x - 1 - x).min(y - low.y).min(high.y - 1 - y);
            changed += usize::from(before.texels[at] != after.texels[at]);
            assert!(inside <= REACH || before.texels[at] == after.texels[at], "surface {surface} at {x}, {y}");
        }
    }
    assert!(changed > 100);
    for (image, again) in bake.images.iter().zip(&after.images) {
        for (texel, again) in image.texels.iter().zip(&again.texels) {
            assert!((*texel - *again).abs().max_element() < 2e-3 * (texel.x + 0.1 * mean(&bake)), "{texel} {again}");
        }
    }
}

/// The edges of a box are no seams, in one mesh or between objects: the images are the same, bit by bit.
#[test]
fn sharp_edges_are_left_alone() {
    let mut scene = hall();
    add_floor(&mut scene, [Vec2::ZERO, Vec2::splat(3.0)], 1.0);
    let first = scene.meshes.len();
    add_box(&mut scene, "block", [1.0, 0.0, 1.0], [1.6, 0.7, 1.5], 0, false);
    let corners = |mesh: &Mesh| mesh.triangles.as_flattened().iter().map(|&k| mesh.positions[k as usize]).collect();
    let positions: Vec<Vec3> = scene.meshes[first..].iter().flat_map(|mesh| -> Vec<Vec3> { corners(mesh) }).collect();
    let triangles = (0..positions.len() as u32 / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let positions = positions.iter().map(|position| *position - 0.7 * Vec3::X).collect();
    add_mesh(&mut scene, Mesh { name: "in one".into(), positions, triangles, ..Default::default() }, 0);
    let bake = baked(&scene, &keeping(12.0));
    assert_eq!(bake.report.seams, Default::default());
    let [before, after] = before_and_after(&bake);
    assert_eq!(before.images, after.images);
}

/// Where the light is the same everywhere it stays so.
#[test]
fn white_furnace() {
    let mut scene = room([0.0; 3], [3.0, 2.5, 3.0], grey(0.5, 1.0));
    scene.surfaces.remove(0);
    for tile in 0..4 {
        let low = 1.5 * Vec2::new((tile % 2) as f32, (tile / 2) as f32);
        add_floor(&mut scene, [low, low + 1.5], 1.0 + 0.3 * tile as f32);
    }
    let bake = baked(&scene, &keeping(8.0));
    assert!(bake.report.seams.pairs > 100 && bake.report.seams.largest_before < 1e-3, "{:?}", bake.report.seams);
    let [before, after] = before_and_after(&bake);
    for (before, after) in valid_texels(&before).zip(valid_texels(&after)) {
        assert!((before / after - 1.0).abs().max_element() < 1e-3, "{before} {after}");
    }
}

/// A wall without thickness stands where two floors meet: its rooms have nothing to do with each other.
#[test]
fn walls_on_seams_part_the_light() {
    let mut scene = hall();
    add_floor(&mut scene, [Vec2::ZERO, Vec2::new(1.5, 3.0)], 1.0);
    add_floor(&mut scene, [Vec2::new(1.5, 0.0), Vec2::splat(3.0)], 1.0);
    let wall = [[1.5, 0.0, 0.0], [1.5, 0.0, 3.0], [1.5, 2.5, 3.0], [1.5, 2.5, 0.0]];
    let [a, b, c, d] = wall;
    add_quad(&mut scene, "wall", [a, b, c, d], 0);
    add_quad(&mut scene, "wall", [d, c, b, a], 0);
    for density in [2.0, 12.0] {
        let bake = baked(&scene, &keeping(density));
        assert_eq!(bake.report.seams.pairs, 0);
        let bright = lookup(&scene, &bake, Vec3::new(2.2, 0.0, 1.5), Vec3::Y).x;
        let dark = lookup(&scene, &bake, Vec3::new(1.499, 0.0, 1.5), Vec3::Y).x;
        assert!(bright > 1.0 && dark < 1e-3 * bright, "{dark} beside {bright}");
    }
}

/// The same bits for any number of threads.
#[test]
fn threads_do_not_matter() {
    let scene = ball();
    let with = |threads| baked(&scene, &BakeSettings { threads, ..keeping(12.0) });
    let one = with(1);
    assert!(one.report.seams.pairs > 0);
    for threads in [2, 16] {
        let other = with(threads);
        assert_eq!((&one.images, &one.transport), (&other.images, &other.transport));
        assert_eq!(one.report.seams, other.report.seams);
    }
}
