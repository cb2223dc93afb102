//! Which emissive surfaces are lights with shadow rays of their own, and which are patches that shine.

use alloc::vec;
use alloc::vec::Vec;

use glam::{Vec2, Vec3};

use crate::geometry::{Hit, Sobol, normal_and_area};
use crate::light::{AreaLight, DirectLight, PlaneMirror};
use crate::material::Material;
use crate::scene::World;
use crate::transport::Origin;

/// Emissive surfaces with more than this share of all area are seen well enough by the rays that gather. A luminous
/// ceiling is below: as a light it leaves two thirds of the error, or a third where nothing stands in its way.
const LARGEST_SHARE: f32 = 0.25;
/// Points of a part of a triangle at which its textures are looked up.
const POINTS: u32 = 16;

/// A surface with a picture is cut into so many parts at most, unless it has more triangles: a sign of two triangles
/// into 32. Each is a closed form for each texel.
const MOST_PARTS: usize = 64;

/// A light of strength 1 with shadow rays of its own.
pub(super) struct Lamp {
    pub origin: Origin,
    pub light: DirectLight,
    /// In which it is seen, where it is an image of a lamp.
    pub mirror: Option<PlaneMirror>,
}

/// The lights of a scene, each of strength 1, and for each surface whether its emission is among them.
///
/// Small emitters would be noise in gathered light: as lights they are a closed form times a visible share. A
/// triangle with a picture shines in parts, each with the mean of the picture there.
pub(super) fn lamps(world: &World) -> (Vec<Lamp>, Vec<bool>) {
    let lights = world.scene.lights.iter().enumerate();
    let mut lamps: Vec<Lamp> = lights
        .map(|(index, light)| Lamp {
            origin: Origin::Lamp(index as u32),
            light: (&light.source.with_strength(Vec3::ONE)).into(),
            mirror: None,
        })
        .collect();
    let mut is_light = vec![false; world.scene.surfaces.len()];
    let triangles = triangles_of_surfaces(world);
    let area = |&triangle: &u32| normal_and_area(&world.corners[triangle as usize]).map_or(0.0, |(_, area)| area);
    let areas: Vec<f32> = triangles.iter().map(|of_surface| of_surface.iter().map(area).sum()).collect();
    let whole: f32 = areas.iter().sum();
    for (index, surface) in world.scene.surfaces.iter().enumerate() {
        let material = &world.scene.materials[surface.material];
        if !surface.casts || !material.is_emissive() || areas[index] > LARGEST_SHARE * whole {
            continue;
        }
        let parts = parts(material, triangles[index].len());
        let emitters = triangles[index].iter().flat_map(|&triangle| {
            let corners = world.corners[triangle as usize];
            let part = move |part: &[Vec2; 3]| (part.map(|at| at_corners(triangle, at).interpolate(corners)), *part);
            parts.iter().map(part).map(move |(corners, part)| (corners, mean_of_white(world, triangle, &part)))
        });
        let light = DirectLight::Area(AreaLight::new(emitters, material.double_sided));
        is_light[index] = true;
        lamps.push(Lamp { origin: Origin::Material(surface.material as u32), light, mirror: None });
    }
    lamps.retain(|lamp| !matches!(&lamp.light, DirectLight::Area(light) if light.is_empty()));
    let images: Vec<Lamp> = lamps.iter().flat_map(|lamp| images(lamp, world)).collect();
    lamps.extend(images);
    (lamps, is_light)
}

/// A lamp as the mirrors of a scene show it.
fn images(lamp: &Lamp, world: &World) -> impl Iterator<Item = Lamp> {
    let image = |mirror: &PlaneMirror| {
        let light = mirror.image_of(&lamp.light)?;
        Some(Lamp { origin: lamp.origin, light, mirror: Some(*mirror) })
    };
    world.mirrors.iter().filter_map(image)
}

/// A place on a triangle by the weights of its second and third corner.
fn at_corners(triangle: u32, barycentric: Vec2) -> Hit {
    Hit { triangle, distance: 0.0, barycentric, front: true }
}

/// The parts in which each of so many triangles shines, by weights of their second and third corners: the whole where
/// the material has no picture, else quarters, and quarters of them, as far as the surface may have parts.
fn parts(material: &Material, triangles: usize) -> Vec<[Vec2; 3]> {
    let mut parts = vec![[Vec2::ZERO, Vec2::X, Vec2::Y]];
    if material.emissive_texture.is_none() && material.is_opaque() {
        return parts;
    }
    while 4 * parts.len() * triangles.max(1) <= MOST_PARTS {
        let quarters = |[a, b, c]: [Vec2; 3]| {
            let [ab, bc, ca] = [a.midpoint(b), b.midpoint(c), c.midpoint(a)];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]]
        };
        parts = parts.into_iter().flat_map(quarters).collect();
    }
    parts
}

/// The mean radiance of a part of a triangle whose material has radiance 1; where it lets light through it emits less.
fn mean_of_white(world: &World, triangle: u32, [a, b, c]: &[Vec2; 3]) -> Vec3 {
    let emission = |at: Vec2| {
        let hit = at_corners(triangle, at);
        world.emission_of_white(&hit) * world.opacity(&hit)
    };
    if world.material(triangle).emissive_texture.is_none() && world.sides[triangle as usize].is_opaque {
        return emission(*a);
    }
    let sequence = Sobol::new(0);
    let points = (0..POINTS).map(|index| {
        let Vec2 { x, y } = sequence.square(index);
        let (x, y) = if x + y > 1.0 { (1.0 - x, 1.0 - y) } else { (x, y) };
        *a + (*b - *a) * x + (*c - *a) * y
    });
    points.map(emission).sum::<Vec3>() / POINTS as f32
}

fn triangles_of_surfaces(world: &World) -> Vec<Vec<u32>> {
    let mut triangles = vec![Vec::new(); world.scene.surfaces.len()];
    for (triangle, source) in world.sources.iter().enumerate() {
        triangles[source.surface as usize].push(triangle as u32);
    }
    triangles
}
