//! All triangles of a scene in world space, and what a ray that meets one of them finds there.

use alloc::vec;
use alloc::vec::Vec;

use glam::{Vec2, Vec3, Vec4};

use super::specular::{is_closed, plane_mirrors};
use super::{CurvedMesh, Scene, Surface};
use crate::geometry::{Hit, Mesh, Ray, lift, normal_and_area};
use crate::light::{PlaneMirror, SKY_PATCHES, sky_patch};
use crate::material::Material;

/// So large a share of the way to the middle of its triangle is a point moved before the normal of a curved surface is
/// taken there: on a crease it then has the normal of its side.
const INWARDS: f32 = 1e-4;

/// The triangles of a scene in world space. Those without area or with infinite corners are left out.
#[derive(Clone, Debug)]
pub struct World<'a> {
    /// What the triangles belong to.
    pub scene: &'a Scene,
    /// Corners of each triangle, counter-clockwise seen from the front; those that block light come first.
    pub corners: Vec<[Vec3; 3]>,
    /// For each triangle its normal of length 1.
    pub normals: Vec<Vec3>,
    /// For each triangle where it comes from.
    pub sources: Vec<Source>,
    /// For each triangle what rays must know of its material.
    pub sides: Vec<Sides>,
    /// How many triangles, from the first, block light.
    pub blockers: usize,
    /// For each triangle that was left out because a corner is not finite where it comes from.
    pub not_finite: Vec<Source>,
    /// The planes in which lamps are seen.
    pub mirrors: Vec<PlaneMirror>,
    /// For each triangle the [`PlaneMirror::number`] of its plane, or `u32::MAX`; empty where no lamp is seen in any.
    pub mirror_of: Vec<u32>,
    /// For each surface whether it encloses a body of glass.
    is_body: Vec<bool>,
    /// For each mesh the curved surface that it stands for.
    curved: Vec<Option<&'a CurvedMesh>>,
}

/// Where a triangle comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Source {
    /// Index of the surface in the scene.
    pub surface: u32,
    /// Index of the triangle in its mesh.
    pub triangle: u32,
}

/// What rays must know of the material of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sides {
    /// Whether no light passes anywhere.
    pub is_opaque: bool,
    /// Whether the back reflects and emits too.
    pub both: bool,
    /// Whether it is a mirror, at least in places.
    pub is_mirror: bool,
    /// Whether light that passes may change its color.
    pub filters: bool,
}

impl<'a> World<'a> {
    /// Carries all triangles to their places.
    pub fn new(scene: &'a Scene) -> Self {
        let mut world = Self {
            scene,
            corners: Vec::new(),
            normals: Vec::new(),
            sources: Vec::new(),
            sides: Vec::new(),
            blockers: 0,
            not_finite: Vec::new(),
            mirrors: Vec::new(),
            mirror_of: Vec::new(),
            is_body: scene.surfaces.iter().map(|surface| is_body(scene, surface)).collect(),
            curved: curved_of_meshes(scene),
        };
        world.add_surfaces(|surface| surface.casts);
        world.blockers = world.corners.len();
        world.add_surfaces(|surface| !surface.casts);
        (world.mirrors, world.mirror_of) = plane_mirrors(&world);
        world
    }

    /// How many patches the sky has.
    pub(crate) fn sky_patches(&self) -> u32 {
        if self.scene.sky_image.is_some() { SKY_PATCHES } else { 1 }
    }

    /// The patch of the sky in a direction.
    #[inline]
    pub(crate) fn sky_patch(&self, direction: Vec3) -> u32 {
        if self.scene.sky_image.is_some() { sky_patch(direction) } else { 0 }
    }

    fn add_surfaces(&mut self, belongs: impl Fn(&Surface) -> bool) {
        let scene = self.scene;
        for (index, surface) in scene.surfaces.iter().enumerate().filter(|(_, surface)| belongs(surface)) {
            for triangle in 0..scene.meshes[surface.mesh].triangles.len() {
                self.add_triangle(Source { surface: index as u32, triangle: triangle as u32 });
            }
        }
    }

    fn add_triangle(&mut self, source: Source) {
        let (surface, mesh) = (self.surface_of(source), self.mesh_of(source));
        let corners = self.vertices(source).map(|vertex| match mesh.positions.get(vertex) {
            Some(&position) => surface.transform.transform_point3(position),
            None => Vec3::NAN,
        });
        if !corners.iter().all(|corner| corner.is_finite()) {
            self.not_finite.push(source);
        } else if let Some((normal, _)) = normal_and_area(&corners) {
            self.corners.push(corners);
            self.normals.push(normal);
            self.sources.push(source);
            let material = &self.scene.materials[surface.material];
            self.sides.push(Sides {
                is_opaque: material.is_opaque(),
                both: material.double_sided,
                is_mirror: material.may_be_mirror(),
                filters: material.may_filter(!mesh.colors.is_empty()),
            });
        }
    }

    /// The vertices of a triangle in the order of its world corners.
    pub fn vertices(&self, source: Source) -> [usize; 3] {
        let vertices = self.mesh_of(source).triangles[source.triangle as usize];
        self.in_order(source, vertices.map(|vertex| vertex as usize))
    }

    /// What belongs to the corners of a triangle of a mesh, in the order of its world corners: a mirrored surface turns
    /// its winding around.
    pub fn in_order<T>(&self, source: Source, [a, b, c]: [T; 3]) -> [T; 3] {
        if is_mirrored(self.surface_of(source)) { [a, c, b] } else { [a, b, c] }
    }

    /// How far above a triangle rays must start, in meters: beyond the rounding of its corners and of points on it.
    #[inline]
    pub fn lift(&self, triangle: u32) -> f32 {
        lift(&self.corners[triangle as usize])
    }

    /// The material of a triangle.
    #[inline]
    pub fn material(&self, triangle: u32) -> &'a Material {
        &self.scene.materials[self.surface_of(self.sources[triangle as usize]).material]
    }

    /// Diffuse reflectance at a hit, in `[0, 1]`.
    pub fn reflectance(&self, hit: &Hit) -> Vec3 {
        let [uv_0, uv_1] = self.uvs(hit);
        self.material(hit.triangle).reflectance_at(&self.scene.textures, uv_0, uv_1, self.color(hit))
    }

    /// What textures and vertex colors make of a white base color at a hit, in `[0, 1]`.
    pub fn reflectance_of_white(&self, hit: &Hit) -> Vec3 {
        let [uv_0, uv_1] = self.uvs(hit);
        self.material(hit.triangle).reflectance_of_white_at(&self.scene.textures, uv_0, uv_1, self.color(hit))
    }

    /// What textures make of the emitted radiance of a material at a hit, not negative.
    pub fn emission_of_white(&self, hit: &Hit) -> Vec3 {
        let [uv_0, uv_1] = self.uvs(hit);
        self.material(hit.triangle).emission_of_white_at(&self.scene.textures, uv_0, uv_1)
    }

    /// Emitted radiance at a hit, in cd/m2.
    pub fn emission(&self, hit: &Hit) -> Vec3 {
        let material = self.material(hit.triangle);
        if !material.is_emissive() {
            return Vec3::ZERO;
        }
        let [uv_0, uv_1] = self.uvs(hit);
        material.emission_at(&self.scene.textures, uv_0, uv_1)
    }

    /// The share of light that does not pass straight on at a hit, in `[0, 1]`; it passes out of bodies of glass.
    #[inline]
    pub fn opacity(&self, hit: &Hit) -> f32 {
        if self.sides[hit.triangle as usize].is_opaque {
            return 1.0;
        }
        if self.leaves_glass(hit) {
            return 0.0;
        }
        let material = self.material(hit.triangle);
        let [uv_0, uv_1] = self.uvs(hit);
        material.opacity_at(&self.scene.textures, uv_0, uv_1, self.color(hit))
    }

    /// What the light that meets a surface is multiplied by where it passes straight on, in `[0, 1]`. Bodies of glass color
    /// it where it enters; what they take from it on its way is left out.
    pub fn filter(&self, hit: &Hit) -> Vec3 {
        let side = self.sides[hit.triangle as usize];
        if side.is_opaque || !side.filters {
            return Vec3::splat(1.0 - self.opacity(hit));
        }
        if self.leaves_glass(hit) {
            return Vec3::ONE;
        }
        let material = self.material(hit.triangle);
        let [uv_0, uv_1] = self.uvs(hit);
        let filter = material.filter_at(&self.scene.textures, uv_0, uv_1, self.color(hit));
        let is_sheet = material.is_glass() && !self.is_of_body(hit);
        if is_sheet { filter * material.transmittance(material.thickness) } else { filter }
    }

    /// What a body of glass takes from light, in 1/m, if a hit is on the surface of one.
    pub fn absorption(&self, hit: &Hit) -> Option<Vec3> {
        self.is_of_body(hit).then(|| self.material(hit.triangle).absorption)
    }

    /// What a mirror at a hit multiplies light by, in `[0, 1]`, if one is there and shows to where the ray comes from.
    #[inline]
    pub fn mirror(&self, hit: &Hit) -> Option<Vec3> {
        let side = self.sides[hit.triangle as usize];
        if !side.is_mirror || !(hit.front || side.both) {
            return None;
        }
        let [uv_0, uv_1] = self.uvs(hit);
        self.material(hit.triangle).mirror_at(&self.scene.textures, uv_0, uv_1, self.color(hit))
    }

    /// The lobe beside what is diffuse at a hit: see [`Material::gloss_at`].
    pub fn gloss(&self, hit: &Hit) -> (Vec3, f32) {
        let [uv_0, uv_1] = self.uvs(hit);
        self.material(hit.triangle).gloss_at(&self.scene.textures, uv_0, uv_1, self.color(hit))
    }

    /// The ray that a mirror sends on. Where normals are smooth it stays on the side of the triangle where it came from.
    pub fn reflected(&self, ray: &Ray, hit: &Hit) -> Ray {
        let side = if hit.front { 1.0 } else { -1.0 };
        let [flat, smooth] =
            [self.normals[hit.triangle as usize], self.shading_normal(hit)].map(|normal| normal * side);
        let reflected = ray.direction - smooth * (2.0 * ray.direction.dot(smooth));
        let height = reflected.dot(flat);
        let direction = if height < 0.0 { reflected - flat * (2.0 * height) } else { reflected };
        let point = hit.interpolate(self.corners[hit.triangle as usize]);
        Ray { origin: point + flat * self.lift(hit.triangle), direction, end: f32::INFINITY }
    }

    /// Whether no triangle that blocks light is a mirror or changes the color of light that passes.
    pub fn is_plain(&self) -> bool {
        !self.sides[..self.blockers].iter().any(|side| side.is_mirror || side.filters)
    }

    fn is_of_body(&self, hit: &Hit) -> bool {
        self.is_body[self.sources[hit.triangle as usize].surface as usize]
    }

    fn leaves_glass(&self, hit: &Hit) -> bool {
        !hit.front && self.is_of_body(hit)
    }

    /// The normal at a point of a triangle, of length 1: that of the curved surface which the mesh stands for, else the
    /// interpolated one, that of the triangle where the mesh has none.
    pub fn shading_normal(&self, hit: &Hit) -> Vec3 {
        if let Some(normal) = self.curved_normal(hit) {
            return normal;
        }
        let flat = self.normals[hit.triangle as usize];
        let smooth = hit.interpolate(self.corner_normals(hit.triangle)).normalize_or(flat);
        if smooth.dot(flat) < 0.0 { -smooth } else { smooth }
    }

    /// The normal of the curved surface at the point that a point of a triangle stands for, if it shows to its front.
    fn curved_normal(&self, hit: &Hit) -> Option<Vec3> {
        let source = self.sources[hit.triangle as usize];
        let surface = self.surface_of(source);
        let curved = self.curved[surface.mesh]?.surface.surface();
        let inside = hit.barycentric.lerp(Vec2::splat(1.0 / 3.0), INWARDS);
        let [share, _] = self.uvs(&Hit { barycentric: inside, ..*hit });
        let [u, v] = curved.domain();
        let normal = curved.normal(u[0] + (u[1] - u[0]) * share.x, v[0] + (v[1] - v[0]) * share.y);
        let normal = (surface.transform.matrix3.inverse().transpose() * normal).try_normalize()?;
        (normal.dot(self.normals[hit.triangle as usize]) > 0.0).then_some(normal)
    }

    /// The normals at the corners of a triangle, each of length 1 and on its front side.
    pub fn corner_normals(&self, triangle: u32) -> [Vec3; 3] {
        let (source, flat) = (self.sources[triangle as usize], self.normals[triangle as usize]);
        let normals = &self.mesh_of(source).normals;
        let to_world = self.surface_of(source).transform.matrix3.inverse().transpose();
        self.vertices(source).map(|vertex| {
            let normal = normals.get(vertex).map_or(flat, |&normal| to_world.mul_vec3(normal).normalize_or(flat));
            if normal.dot(flat) < 0.0 { flat } else { normal }
        })
    }

    /// The box around all corners: its lowest and its highest corner.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let corners = self.corners.iter().flatten();
        corners.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), &corner| (low.min(corner), high.max(corner)))
    }

    fn uvs(&self, hit: &Hit) -> [Vec2; 2] {
        let source = self.sources[hit.triangle as usize];
        let (mesh, vertices) = (self.mesh_of(source), self.vertices(source));
        [&mesh.uv_0, &mesh.uv_1]
            .map(|uvs| if uvs.is_empty() { Vec2::NAN } else { hit.interpolate(vertices.map(|vertex| uvs[vertex])) })
    }

    fn color(&self, hit: &Hit) -> Vec4 {
        let source = self.sources[hit.triangle as usize];
        let (mesh, vertices) = (self.mesh_of(source), self.vertices(source));
        if mesh.colors.is_empty() { Vec4::ONE } else { hit.interpolate(vertices.map(|vertex| mesh.colors[vertex])) }
    }

    fn surface_of(&self, source: Source) -> &'a Surface {
        &self.scene.surfaces[source.surface as usize]
    }

    fn mesh_of(&self, source: Source) -> &'a Mesh {
        &self.scene.meshes[self.surface_of(source).mesh]
    }
}

fn is_body(scene: &Scene, surface: &Surface) -> bool {
    let is_glass = scene.materials.get(surface.material).is_some_and(Material::is_glass);
    is_glass && scene.meshes.get(surface.mesh).is_some_and(is_closed)
}

fn curved_of_meshes(scene: &Scene) -> Vec<Option<&CurvedMesh>> {
    let mut of_meshes = vec![None; scene.meshes.len()];
    for curved in &scene.curved {
        if let Some(of_mesh) = of_meshes.get_mut(curved.mesh) {
            *of_mesh = Some(curved);
        }
    }
    of_meshes
}

/// Whether the transform of a surface turns its winding around.
fn is_mirrored(surface: &Surface) -> bool {
    surface.transform.matrix3.determinant() < 0.0
}
