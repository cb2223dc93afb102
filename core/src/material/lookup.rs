//! What a material is at one point of a surface.

use alloc::string::String;

use glam::{Vec2, Vec3, Vec4};

use super::{AlphaMode, Material, Texture, TextureRef, UvSet};

impl Material {
    /// Diffuse reflectance per linear RGB channel, in `[0, 1]`; of a mirror 0.
    ///
    /// `uv_0` and `uv_1` are the coordinates of the mesh there, NaN where it has none; `color` is its vertex color, white where it has none.
    pub fn reflectance_at(&self, textures: &[Texture], uv_0: Vec2, uv_1: Vec2, color: Vec4) -> Vec3 {
        let base = self.base_color_at(textures, uv_0, uv_1, color).truncate();
        let [metallic, roughness] = self.metal_at(textures, uv_0, uv_1);
        if self.is_mirror_of(metallic, roughness) {
            return Vec3::ZERO;
        }
        base.map(saturate) * (1.0 - metallic)
    }

    /// Reflectance there if the base color were white, in `[0, 1]`: what textures and vertex colors make of it.
    pub fn reflectance_of_white_at(&self, textures: &[Texture], uv_0: Vec2, uv_1: Vec2, color: Vec4) -> Vec3 {
        let white = Self { base_color: Vec4::ONE, name: String::new(), ..*self };
        white.reflectance_at(textures, uv_0, uv_1, color)
    }

    /// What the texture makes of `emissive` there, not negative.
    pub fn emission_of_white_at(&self, textures: &[Texture], uv_0: Vec2, uv_1: Vec2) -> Vec3 {
        lookup(&self.emissive_texture, textures, uv_0, uv_1).truncate().map(|channel| channel.max(0.0))
    }

    /// Share of the light that is blocked there, in `[0, 1]`.
    pub fn alpha_at(&self, textures: &[Texture], uv_0: Vec2, uv_1: Vec2, color: Vec4) -> f32 {
        let alpha = || self.base_color_at(textures, uv_0, uv_1, color).w;
        match self.alpha {
            AlphaMode::Opaque => 1.0,
            AlphaMode::Mask(cutoff) if alpha() < cutoff => 0.0,
            AlphaMode::Mask(_) => 1.0,
            AlphaMode::Blend => saturate(alpha()),
        }
    }

    /// Emitted radiance in cd/m2 per linear RGB channel, not negative.
    pub fn emission_at(&self, textures: &[Texture], uv_0: Vec2, uv_1: Vec2) -> Vec3 {
        self.emissive.max(Vec3::ZERO) * self.emission_of_white_at(textures, uv_0, uv_1)
    }

    /// Whether no light passes anywhere.
    pub fn is_opaque(&self) -> bool {
        self.alpha == AlphaMode::Opaque && !self.is_glass()
    }

    /// Whether it shines, at least where its texture is not black.
    pub fn is_emissive(&self) -> bool {
        self.emissive.max_element() > 0.0
    }

    /// Whether it differs from point to point by its own textures.
    pub fn has_textures(&self) -> bool {
        [&self.base_color_texture, &self.metallic_texture, &self.emissive_texture].into_iter().any(Option::is_some)
    }

    /// Metallic and roughness there, each in `[0, 1]`.
    pub(super) fn metal_at(&self, textures: &[Texture], uv_0: Vec2, uv_1: Vec2) -> [f32; 2] {
        let texture = lookup(&self.metallic_texture, textures, uv_0, uv_1);
        [saturate(self.metallic * texture.z), saturate(self.roughness * texture.y)]
    }

    pub(super) fn base_color_at(&self, textures: &[Texture], uv_0: Vec2, uv_1: Vec2, color: Vec4) -> Vec4 {
        self.base_color * lookup(&self.base_color_texture, textures, uv_0, uv_1) * color
    }
}

/// Linear RGBA of a texture, white where there is none, and where a mesh has no coordinates for it: those are NaN.
fn lookup(texture: &Option<TextureRef>, textures: &[Texture], uv_0: Vec2, uv_1: Vec2) -> Vec4 {
    let Some(reference) = texture else { return Vec4::ONE };
    let Some(texture) = textures.get(reference.texture) else { return Vec4::ONE };
    let uv = match reference.uv_set {
        UvSet::Uv0 => uv_0,
        UvSet::Uv1 => uv_1,
    };
    if uv.is_nan() {
        return Vec4::ONE;
    }
    texture.sample(reference.transform.transform_point2(uv))
}

/// Into `[0, 1]`, NaN to 0.
pub(super) fn saturate(x: f32) -> f32 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::super::{Filter, Texels, Wrap};
    use super::*;
    use alloc::vec;
    use glam::Affine2;

    /// Left half `left`, right half `right`.
    fn halves(left: [f32; 4], right: [f32; 4]) -> Texture {
        Texture {
            name: String::new(),
            width: 2,
            height: 1,
            texels: Texels::Linear32(vec![left, right]),
            wrap_u: Wrap::Clamp,
            wrap_v: Wrap::Clamp,
            filter: Filter::Linear,
        }
    }

    fn reference(texture: usize, uv_set: UvSet) -> Option<TextureRef> {
        Some(TextureRef { texture, uv_set, transform: Affine2::IDENTITY })
    }

    const LEFT: Vec2 = Vec2::new(0.1, 0.5);
    const RIGHT: Vec2 = Vec2::new(0.9, 0.5);

    #[test]
    fn reflectance_is_the_product_of_its_factors() {
        let textures = [halves([0.5, 0.25, 1.0, 1.0], [1.0; 4]), halves([9.0, 9.0, 0.5, 9.0], [0.0; 4])];
        let material = Material {
            base_color: Vec4::new(0.8, 0.4, 1.0, 1.0),
            base_color_texture: reference(0, UvSet::Uv0),
            metallic: 0.5,
            metallic_texture: reference(1, UvSet::Uv1),
            ..Default::default()
        };
        let color = Vec4::new(1.0, 1.0, 0.5, 1.0);
        let left = material.reflectance_at(&textures, LEFT, LEFT, color);
        assert!(left.abs_diff_eq(Vec3::new(0.4, 0.1, 0.5) * 0.75, 1e-6), "{left}");
        let right = material.reflectance_at(&textures, RIGHT, RIGHT, color);
        assert!(right.abs_diff_eq(Vec3::new(0.8, 0.4, 0.5), 1e-6), "{right}");
    }

    #[test]
    fn reflectance_stays_in_its_range() {
        for base_color in [Vec4::splat(7.0), Vec4::splat(-1.0), Vec4::NAN] {
            let material = Material { base_color, metallic: f32::NAN, ..Default::default() };
            let reflectance = material.reflectance_at(&[], LEFT, LEFT, Vec4::ONE);
            assert!(reflectance.cmpge(Vec3::ZERO).all() && reflectance.cmple(Vec3::ONE).all(), "{reflectance}");
        }
    }

    /// A transform of half a turn swaps the halves.
    #[test]
    fn transforms_move_the_coordinates() {
        let textures = [halves([0.0, 0.0, 0.0, 1.0], [1.0; 4])];
        let turn = Affine2::from_cols(Vec2::NEG_X, Vec2::NEG_Y, Vec2::ONE);
        let turned = TextureRef { texture: 0, uv_set: UvSet::Uv0, transform: turn };
        let material = Material { base_color_texture: Some(turned), ..Default::default() };
        assert_eq!(material.reflectance_at(&textures, LEFT, LEFT, Vec4::ONE), Vec3::ONE);
        assert_eq!(material.reflectance_at(&textures, RIGHT, LEFT, Vec4::ONE), Vec3::ZERO);
    }

    #[test]
    fn alpha_means_what_its_mode_says() {
        let textures = [halves([1.0, 1.0, 1.0, 0.25], [1.0, 1.0, 1.0, 0.75])];
        let blocked = |alpha, uv| {
            let material = Material { alpha, base_color_texture: reference(0, UvSet::Uv0), ..Default::default() };
            material.alpha_at(&textures, uv, uv, Vec4::ONE)
        };
        assert_eq!(blocked(AlphaMode::Opaque, LEFT), 1.0);
        assert_eq!(blocked(AlphaMode::Mask(0.5), LEFT), 0.0);
        assert_eq!(blocked(AlphaMode::Mask(0.5), RIGHT), 1.0);
        assert_eq!(blocked(AlphaMode::Mask(0.75), RIGHT), 1.0);
        assert_eq!(blocked(AlphaMode::Blend, LEFT), 0.25);
        assert_eq!(blocked(AlphaMode::Blend, RIGHT), 0.75);
    }

    #[test]
    fn emission_is_factor_times_texture() {
        let textures = [halves([0.5, 1.0, 0.0, 1.0], [-1.0; 4])];
        let material =
            Material { emissive: Vec3::splat(100.0), emissive_texture: reference(0, UvSet::Uv0), ..Default::default() };
        assert_eq!(material.emission_at(&textures, LEFT, LEFT), Vec3::new(50.0, 100.0, 0.0));
        assert_eq!(material.emission_at(&textures, RIGHT, LEFT), Vec3::ZERO);
        assert!(material.is_emissive() && material.has_textures() && material.is_opaque());
        let plain = Material { alpha: AlphaMode::Blend, ..Default::default() };
        assert!(!plain.is_emissive() && !plain.has_textures() && !plain.is_opaque());
    }

    #[test]
    fn a_missing_texture_is_white() {
        let material = Material { base_color_texture: reference(3, UvSet::Uv1), ..Default::default() };
        assert_eq!(material.reflectance_at(&[], Vec2::NAN, Vec2::NAN, Vec4::ONE), Vec3::ONE);
    }
}
