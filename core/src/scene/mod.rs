//! What is baked: surfaces with their materials, and lights.

mod cornell;
mod specular;
mod world;

pub use cornell::*;
pub use world::*;

use alloc::string::String;
use alloc::vec::Vec;

use glam::{Affine3A, Vec3};

use crate::geometry::Mesh;
use crate::light::{Light, SkyImage};
use crate::material::{Material, Texture};
use crate::spline::{Homogeneous, OwnedSurface};

/// Everything that takes part in a bake. Lengths are in meters.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Shapes; one shape may be used by many surfaces.
    pub meshes: Vec<Mesh>,
    /// Shapes at their places.
    pub surfaces: Vec<Surface>,
    /// Indexed by `Surface::material`.
    pub materials: Vec<Material>,
    /// Indexed by the materials.
    pub textures: Vec<Texture>,
    /// Light sources beside emissive materials.
    pub lights: Vec<Light>,
    /// Radiance of the surroundings in cd/m2, the same in all directions, not negative; a factor where there is an image.
    pub sky: Vec3,
    /// What the surroundings look like; nothing: the same in all directions. The bake takes it in
    /// [`SKY_PATCHES`](crate::light::SKY_PATCHES) patches: [`SkyImage::take_suns`] makes a lamp of what is smaller.
    pub sky_image: Option<SkyImage>,
    /// Which of the meshes are triangles of curved surfaces.
    pub curved: Vec<CurvedMesh>,
}

impl Scene {
    /// Radiance in cd/m2 that arrives from the surroundings in a direction that leads there.
    pub fn sky_radiance(&self, direction: Vec3) -> Vec3 {
        self.sky_image.as_ref().map_or(self.sky, |image| self.sky * image.radiance(direction))
    }

    /// Radiance of each patch of the sky, over [`Scene::sky`].
    pub(crate) fn sky_of_patches(&self) -> Vec<Vec3> {
        self.sky_image.as_ref().map_or_else(|| alloc::vec![Vec3::ONE], SkyImage::of_patches)
    }
}

/// A mesh that stands for a surface of splines: texels have its normals rather than interpolated ones.
///
/// [`Tessellation::mesh`](crate::spline::Tessellation::mesh) makes such meshes: their `uv_0` are the parameters of the
/// surface, scaled so that its domain is `0..1`.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvedMesh {
    /// Index into `Scene::meshes`; one that the scene does not have means nothing.
    pub mesh: usize,
    /// The surface, in the space of the mesh.
    pub surface: OwnedSurface<Homogeneous<Vec3>>,
}

/// A mesh at its place, with its material.
#[derive(Clone, Debug)]
pub struct Surface {
    /// For messages.
    pub name: String,
    /// Index into `Scene::meshes`.
    pub mesh: usize,
    /// Index into `Scene::materials`.
    pub material: usize,
    /// From the mesh to the world. A negative determinant turns the winding around.
    pub transform: Affine3A,
    /// Whether the surface gets a lightmap.
    pub receiver: Receiver,
    /// Whether it blocks, reflects and emits light. A surface that does not can still get a lightmap.
    pub casts: bool,
}

/// Whether a surface gets a lightmap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Receiver {
    /// It does, at the density of the bake times this factor, which is positive; 1 is usual.
    Lightmap {
        /// Factor on the texels per meter.
        density: f32,
    },
    /// It does not.
    Nothing,
}
