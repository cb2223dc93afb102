//! What a surface does with light: reflectance, exitance, alpha, each a factor and perhaps a texture; mirrors and glass.

mod lookup;
mod passing;
mod texture;

pub use crate::spectrum::{linear_to_srgb, srgb_to_linear};
pub use passing::*;
pub use texture::*;

use alloc::string::String;

use glam::{Affine2, Vec3, Vec4};

/// How a surface reflects, emits and lets light through.
///
/// Reflectance is `base color x texture x vertex color x (1 - metallic)`, per linear RGB channel.
#[derive(Clone, Debug)]
pub struct Material {
    /// For messages.
    pub name: String,
    /// Linear RGB reflectance in `[0, 1]` and alpha in `[0, 1]`.
    pub base_color: Vec4,
    /// Multiplies `base_color`, alpha included.
    pub base_color_texture: Option<TextureRef>,
    /// Share of the reflection that is not diffuse, in `[0, 1]`.
    pub metallic: f32,
    /// Perceptual roughness, in `[0, 1]`. Smooth metal is a mirror: see [`Material::mirror_at`].
    pub roughness: f32,
    /// Its blue channel multiplies `metallic`, its green channel `roughness`.
    pub metallic_texture: Option<TextureRef>,
    /// Emitted radiance in cd/m2 per linear RGB channel, not negative.
    pub emissive: Vec3,
    /// Multiplies `emissive`.
    pub emissive_texture: Option<TextureRef>,
    /// What alpha means.
    pub alpha: AlphaMode,
    /// Share of the light that is not blocked by alpha nor by metal and passes as through clear glass, colored by the base
    /// color, in `[0, 1]`.
    pub transmission: f32,
    /// What glass takes from light on its way, in 1/m, not negative: `exp(-absorption distance)` is left.
    pub absorption: Vec3,
    /// The way through a sheet of glass that is modeled without thickness, in meters, whatever the angle: light that meets
    /// the sheet aslant is absorbed no more. Closed bodies have their own, and there the angle counts.
    pub thickness: f32,
    /// Whether the side that the winding turns away reflects and emits too. It blocks light in either case.
    pub double_sided: bool,
}

impl Default for Material {
    /// White, matt, opaque, one-sided, dark.
    fn default() -> Self {
        Self {
            name: String::new(),
            base_color: Vec4::ONE,
            base_color_texture: None,
            metallic: 0.0,
            roughness: 0.5,
            metallic_texture: None,
            emissive: Vec3::ZERO,
            emissive_texture: None,
            alpha: AlphaMode::Opaque,
            transmission: 0.0,
            absorption: Vec3::ZERO,
            thickness: 0.0,
            double_sided: false,
        }
    }
}

/// What alpha does to light that meets a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum AlphaMode {
    /// Alpha is ignored.
    #[default]
    Opaque,
    /// Light passes where alpha is below this cutoff in `[0, 1]`.
    Mask(f32),
    /// The share `1 - alpha` of the light passes, colored by the hue of the base color the more the larger alpha is.
    Blend,
}

/// A texture as a material uses it.
#[derive(Clone, Copy, Debug)]
pub struct TextureRef {
    /// Index into the textures of the scene.
    pub texture: usize,
    /// Which coordinates of the mesh are looked up.
    pub uv_set: UvSet,
    /// Applied to the coordinates first.
    pub transform: Affine2,
}

/// One of the two sets of texture coordinates of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UvSet {
    /// `Mesh::uv_0`.
    #[default]
    Uv0,
    /// `Mesh::uv_1`, as it was before the bake.
    Uv1,
}
