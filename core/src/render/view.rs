//! What an eye sees of a scene.

use core::ops::Deref;

use glam::{Vec2, Vec3};

use crate::bake::Bake;
use crate::geometry::{Bvh, Hit, Occluders, Ray};
use crate::lightmap::Placement;
use crate::scene::{Scene, World};

/// All surfaces of a scene, those that block no light too.
pub struct View<'a> {
    world: World<'a>,
    pub tree: Bvh,
}

impl<'a> Deref for View<'a> {
    type Target = World<'a>;

    fn deref(&self) -> &World<'a> {
        &self.world
    }
}

impl<'a> View<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        let world = World::new(scene);
        let tree = Bvh::new(&world.corners);
        Self { world, tree }
    }

    /// The nearest thing that is to be seen along a ray, behind another hit if there is one.
    pub fn nearest(&self, ray: &Ray, behind: Option<&Hit>) -> Option<Hit> {
        let is_next = |hit: &Hit| behind.is_none_or(|other| is_behind(hit, other));
        let is_there = |hit: &Hit| self.material(hit.triangle).is_glass() || self.opacity(hit) > 0.0;
        let is_seen = |hit: &Hit| is_next(hit) && self.shows_side(hit) && is_there(hit);
        self.tree.first(ray, |hit| is_seen(hit).then_some(hit.distance))
    }

    /// What is behind a hit shows so much of itself, for each channel: blended things hide a share of it, glass colors it.
    pub fn shows_behind(&self, hit: &Hit) -> Vec3 {
        let material = self.material(hit.triangle);
        if !material.is_glass() {
            return Vec3::splat(1.0 - self.opacity(hit));
        }
        // Bodies show one of their two sides, as sheets do.
        let of_body =
            if self.absorption(hit).is_some() { material.transmittance(material.thickness) } else { Vec3::ONE };
        self.filter(hit) * of_body
    }

    /// Whether the side that a ray meets can be seen at all: one-sided surfaces are seen from their front only.
    pub fn shows_side(&self, hit: &Hit) -> bool {
        hit.front || self.sides[hit.triangle as usize].both
    }
}

/// Where a hit lies in the lightmaps, if its surface has one: index of the image, and coordinates in `0..1`.
pub fn lightmap_place(world: &World, bake: &Bake, hit: &Hit) -> Option<(usize, Vec2)> {
    let (placement, corners) = lightmap_corners(world, bake, hit.triangle)?;
    Some((placement.image, hit.interpolate(corners)))
}

/// Where a triangle lies in the lightmaps, if its surface has one; coordinates of its corners in `0..1`.
pub fn lightmap_corners(world: &World, bake: &Bake, triangle: u32) -> Option<(Placement, [Vec2; 3])> {
    let source = world.sources[triangle as usize];
    let placement = (*bake.placements.get(source.surface as usize)?)?;
    let mesh = world.scene.surfaces[source.surface as usize].mesh;
    let lightmap_uv = bake.uvs.get(mesh)?.as_ref()?;
    let corners = lightmap_uv.triangles.get(source.triangle as usize)?.map(|vertex| lightmap_uv.uv_1[vertex as usize]);
    let in_image = |uv: Vec2| placement.min + uv * (placement.max - placement.min);
    Some((placement, world.in_order(source, corners).map(in_image)))
}

/// Later in the order of hits along a ray, where the triangle index decides at the same distance.
fn is_behind(hit: &Hit, other: &Hit) -> bool {
    hit.distance > other.distance || (hit.distance == other.distance && hit.triangle > other.triangle)
}
