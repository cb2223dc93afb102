//! The triangles of a scene at their places, and what a ray finds on them.

use alloc::vec::Vec;
use core::ops::{Add, Mul};

use glam::{Vec2, Vec3, Vec4};

use crate::geometry::{Bvh, Hit, Mesh, Occluders, Ray};
use crate::material::Material;
use crate::scene::{Scene, Surface};

/// All surfaces of a scene as an eye sees them: one-sided ones only from their front.
pub struct View<'a> {
    pub scene: &'a Scene,
    pub tree: Bvh,
    /// Lowest and highest coordinates of all triangles, if there are any.
    pub bounds: Option<[Vec3; 2]>,
    sources: Vec<Source>,
    /// For each surface, whether its transform turns the winding around.
    mirrored: Vec<bool>,
}

/// Where a triangle comes from.
#[derive(Clone, Copy)]
struct Source {
    surface: u32,
    triangle: u32,
}

/// A point on a surface.
pub struct Point<'a> {
    pub surface: usize,
    /// Within the mesh of the surface.
    pub triangle: usize,
    pub material: &'a Material,
    uv_0: Vec2,
    uv_1: Vec2,
    color: Vec4,
}

impl<'a> View<'a> {
    /// Leaves out triangles that are not finite and whatever refers to something missing.
    pub fn new(scene: &'a Scene) -> Self {
        let mut triangles = Vec::new();
        let mut sources = Vec::new();
        for (surface, placed) in scene.surfaces.iter().enumerate() {
            let mesh = scene.meshes.get(placed.mesh).filter(|_| placed.material < scene.materials.len());
            for (triangle, indices) in mesh.iter().flat_map(|mesh| mesh.triangles.iter().enumerate()) {
                let Some(corners) = corners_in_world(placed, &scene.meshes[placed.mesh], indices) else { continue };
                triangles.push(corners);
                sources.push(Source { surface: surface as u32, triangle: triangle as u32 });
            }
        }
        let mirrored = scene.surfaces.iter().map(|surface| surface.transform.matrix3.determinant() < 0.0).collect();
        let bounds = triangles.iter().flatten().map(|&corner| [corner, corner]);
        let bounds = bounds.reduce(|[low, high], [corner, _]| [low.min(corner), high.max(corner)]);
        Self { scene, tree: Bvh::new(&triangles), bounds, sources, mirrored }
    }

    /// The nearest thing that is to be seen along a ray, behind another hit if there is one.
    pub fn nearest(&self, ray: &Ray, behind: Option<&Hit>) -> Option<Hit> {
        self.tree.nearest(ray, |hit| behind.is_none_or(|other| is_behind(hit, other)) && self.is_visible(hit))
    }

    fn is_visible(&self, hit: &Hit) -> bool {
        if !self.shows_side(hit) {
            return false;
        }
        let point = self.point(hit);
        point.material.is_opaque() || point.alpha(self.scene) > 0.0
    }

    /// Whether the side that the ray meets can be seen at all.
    pub fn shows_side(&self, hit: &Hit) -> bool {
        let surface = self.sources[hit.triangle as usize].surface as usize;
        hit.front != self.mirrored[surface] || self.material(surface).double_sided
    }

    /// What the mesh carries to where the ray meets it.
    pub fn point(&self, hit: &Hit) -> Point<'a> {
        let source = self.sources[hit.triangle as usize];
        let (surface, triangle) = (source.surface as usize, source.triangle as usize);
        let mesh = &self.scene.meshes[self.scene.surfaces[surface].mesh];
        let indices = mesh.triangles[triangle];
        Point {
            surface,
            triangle,
            material: self.material(surface),
            uv_0: interpolate(&mesh.uv_0, indices, hit).unwrap_or_default(),
            uv_1: interpolate(&mesh.uv_1, indices, hit).unwrap_or_default(),
            color: interpolate(&mesh.colors, indices, hit).unwrap_or(Vec4::ONE),
        }
    }

    fn material(&self, surface: usize) -> &'a Material {
        &self.scene.materials[self.scene.surfaces[surface].material]
    }
}

impl Point<'_> {
    pub fn alpha(&self, scene: &Scene) -> f32 {
        self.material.alpha_at(&scene.textures, self.uv_0, self.uv_1, self.color)
    }

    /// Radiance towards the eye, given irradiance / pi.
    pub fn radiance(&self, scene: &Scene, irradiance_over_pi: Vec3) -> Vec3 {
        let reflectance = self.material.reflectance_at(&scene.textures, self.uv_0, self.uv_1, self.color);
        reflectance * irradiance_over_pi + self.material.emission_at(&scene.textures, self.uv_0, self.uv_1)
    }
}

/// What three vertices of a list carry, weighted by where the ray meets their triangle.
pub fn interpolate<T>(list: &[T], indices: [u32; 3], hit: &Hit) -> Option<T>
where
    T: Copy + Mul<f32, Output = T> + Add<Output = T>,
{
    match indices.map(|index| list.get(index as usize)) {
        [Some(&a), Some(&b), Some(&c)] => Some(hit.interpolate([a, b, c])),
        _ => None,
    }
}

fn corners_in_world(surface: &Surface, mesh: &Mesh, indices: &[u32; 3]) -> Option<[Vec3; 3]> {
    let [Some(&a), Some(&b), Some(&c)] = indices.map(|index| mesh.positions.get(index as usize)) else { return None };
    let corners = [a, b, c].map(|corner| surface.transform.transform_point3(corner));
    corners.iter().all(|corner| corner.is_finite()).then_some(corners)
}

/// Later in the order of hits along a ray, where the triangle index decides at the same distance.
fn is_behind(hit: &Hit, other: &Hit) -> bool {
    hit.distance > other.distance || (hit.distance == other.distance && hit.triangle > other.triangle)
}
