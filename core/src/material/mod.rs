//! What a surface does with light: reflectance, exitance, alpha, each a factor and perhaps a texture.

mod lookup;
mod texture;

pub use crate::spectrum::{linear_to_srgb, srgb_to_linear};
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
    /// Its blue channel multiplies `metallic`.
    pub metallic_texture: Option<TextureRef>,
    /// Emitted radiance in cd/m2 per linear RGB channel, not negative.
    pub emissive: Vec3,
    /// Multiplies `emissive`.
    pub emissive_texture: Option<TextureRef>,
    /// What alpha means.
    pub alpha: AlphaMode,
    /// Whether the side that the winding turns away reflects and emits too. It blocks light in either case.
    pub double_sided: bool,
}

impl Default for Material {
    /// White, opaque, one-sided, dark.
    fn default() -> Self {
        Self {
            name: String::new(),
            base_color: Vec4::ONE,
            base_color_texture: None,
            metallic: 0.0,
            metallic_texture: None,
            emissive: Vec3::ZERO,
            emissive_texture: None,
            alpha: AlphaMode::Opaque,
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
    /// The share `1 - alpha` of the light passes.
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
