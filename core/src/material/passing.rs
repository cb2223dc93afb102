//! Light that goes on from a surface in one direction: mirrors, and what lets light pass straight on.

use glam::{Vec2, Vec3, Vec4};

use super::lookup::saturate;
use super::{AlphaMode, Material, Texture};

/// Metal up to this perceptual roughness is a mirror. Bevy draws nothing smoother than 0.089.
pub const MIRROR_ROUGHNESS: f32 = 0.1;
/// What all but metal reflects along the normal.
const VARNISH: f32 = 0.04;
/// From this share of metal on.
pub const MIRROR_METALLIC: f32 = 0.9;

impl Material {
    /// What a perfect mirror there multiplies light by, in `[0, 1]`: the base color, where metal is smooth and does not
    /// emit. Arguments are those of [`Material::reflectance_at`].
    pub fn mirror_at(&self, textures: &[Texture], uv_0: Vec2, uv_1: Vec2, color: Vec4) -> Option<Vec3> {
        if !self.may_be_mirror() {
            return None;
        }
        let [metallic, roughness] = self.metal_at(textures, uv_0, uv_1);
        let tint = || self.base_color_at(textures, uv_0, uv_1, color).truncate().map(saturate);
        self.is_mirror_of(metallic, roughness).then(tint)
    }

    /// Reflectance along the normal there of the lobe that Bevy adds to what is diffuse, in `[0, 1]`: 4 %, of metal the base
    /// color; and its perceptual roughness. Arguments are those of [`Material::reflectance_at`].
    pub fn gloss_at(&self, textures: &[Texture], uv_0: Vec2, uv_1: Vec2, color: Vec4) -> (Vec3, f32) {
        let [metallic, roughness] = self.metal_at(textures, uv_0, uv_1);
        let base = self.base_color_at(textures, uv_0, uv_1, color).truncate().map(saturate);
        (Vec3::splat(VARNISH).lerp(base, metallic), roughness)
    }

    /// What the light that meets a surface there is multiplied by where it passes straight on, in `[0, 1]`, its thickness
    /// left out: `(1 - alpha) (1 - alpha + alpha hue) + alpha transmission (1 - metallic) color`.
    ///
    /// What is blended lets the share `1 - alpha` pass, the more colored the larger alpha is: `hue` is its color over the
    /// largest channel of it. Glass colors all that passes. Arguments are those of [`Material::reflectance_at`].
    pub fn filter_at(&self, textures: &[Texture], uv_0: Vec2, uv_1: Vec2, color: Vec4) -> Vec3 {
        let alpha = self.alpha_at(textures, uv_0, uv_1, color);
        let base = self.base_color_at(textures, uv_0, uv_1, color).truncate().map(saturate);
        let blended = match self.alpha {
            AlphaMode::Blend => (Vec3::ONE - (Vec3::ONE - hue(base)) * alpha) * (1.0 - alpha),
            AlphaMode::Opaque | AlphaMode::Mask(_) => Vec3::splat(1.0 - alpha),
        };
        blended + base * (alpha * self.transmission_at(textures, uv_0, uv_1))
    }

    /// Share of the light that does not pass straight on there, in `[0, 1]`: `alpha (1 - transmission (1 - metallic))`.
    pub fn opacity_at(&self, textures: &[Texture], uv_0: Vec2, uv_1: Vec2, color: Vec4) -> f32 {
        self.alpha_at(textures, uv_0, uv_1, color) * (1.0 - self.transmission_at(textures, uv_0, uv_1))
    }

    /// Whether it is a mirror, at least where its texture says so.
    pub fn may_be_mirror(&self) -> bool {
        self.is_mirror_of(self.metallic, if self.metallic_texture.is_none() { self.roughness } else { 0.0 })
    }

    /// Whether light passes as through glass.
    pub fn is_glass(&self) -> bool {
        self.transmission > 0.0
    }

    /// Whether light that passes may change its color; `has_colors` tells whether the mesh does by its vertices.
    pub fn may_filter(&self, has_colors: bool) -> bool {
        let color = self.base_color.truncate();
        let differs = self.base_color_texture.is_some() || has_colors;
        let glass_filters = differs || color != Vec3::ONE || self.absorption != Vec3::ZERO;
        let blended_filters = differs || hue(color) != Vec3::ONE;
        self.is_glass() && glass_filters || self.alpha == AlphaMode::Blend && blended_filters
    }

    /// What is left of light after a way through the glass in meters, in `[0, 1]`.
    pub fn transmittance(&self, distance: f32) -> Vec3 {
        (self.absorption * -distance).map(|depth| crate::math::exp(depth.min(0.0)))
    }

    pub(super) fn is_mirror_of(&self, metallic: f32, roughness: f32) -> bool {
        metallic >= MIRROR_METALLIC && roughness <= MIRROR_ROUGHNESS && !self.is_emissive()
    }

    fn transmission_at(&self, textures: &[Texture], uv_0: Vec2, uv_1: Vec2) -> f32 {
        match self.is_glass() {
            true => saturate(self.transmission) * (1.0 - self.metal_at(textures, uv_0, uv_1)[0]),
            false => 0.0,
        }
    }
}

/// A color over its largest channel; of black white.
fn hue(color: Vec3) -> Vec3 {
    let largest = color.max_element();
    if largest > 0.0 { color / largest } else { Vec3::ONE }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOWHERE: Vec2 = Vec2::NAN;

    fn filter(material: &Material) -> Vec3 {
        material.filter_at(&[], NOWHERE, NOWHERE, Vec4::ONE)
    }

    fn opacity(material: &Material) -> f32 {
        material.opacity_at(&[], NOWHERE, NOWHERE, Vec4::ONE)
    }

    /// Glass has its color and blocks what it does not transmit; metal transmits nothing.
    #[test]
    fn glass() {
        let color = Vec3::new(0.9, 0.2, 0.0);
        let pane = Material { base_color: color.extend(1.0), transmission: 1.0, ..Default::default() };
        assert_eq!((filter(&pane), opacity(&pane)), (color, 0.0));
        assert!(!pane.is_opaque() && pane.may_filter(false));
        let half = Material { transmission: 0.5, ..pane.clone() };
        assert_eq!((filter(&half), opacity(&half)), (color * 0.5, 0.5));
        let metal = Material { metallic: 1.0, ..pane };
        assert_eq!((filter(&metal), opacity(&metal)), (Vec3::ZERO, 1.0));
    }

    /// What is blended is clear without alpha, whatever color it has, and opaque with all of it; no light is made.
    #[test]
    fn blended() {
        let color = Vec3::new(0.9, 0.2, 0.0);
        let of =
            |alpha: f32| Material { base_color: color.extend(alpha), alpha: AlphaMode::Blend, ..Default::default() };
        assert_eq!(filter(&of(0.0)), Vec3::ONE);
        assert_eq!(filter(&of(1.0)), Vec3::ZERO);
        assert!(filter(&of(0.5)).abs_diff_eq((Vec3::ONE + color / 0.9) * 0.25, 1e-6));
        for alpha in [0.0, 0.1, 0.5, 0.9, 1.0] {
            assert!(filter(&of(alpha)).max_element() <= 1.0 - opacity(&of(alpha)));
        }
        assert!(of(0.5).may_filter(false));
        for level in [0.0, 0.4, 1.0] {
            let gray = Material { base_color: Vec4::new(level, level, level, 0.5), ..of(0.5) };
            assert_eq!(filter(&gray), Vec3::splat(0.5));
            assert!(!gray.may_filter(false) && gray.may_filter(true));
        }
    }

    /// Smooth metal that does not emit is a mirror of its color and reflects nothing diffusely.
    #[test]
    fn mirrors() {
        let gold = Vec3::new(1.0, 0.8, 0.4);
        let mirror = Material { base_color: gold.extend(1.0), metallic: 1.0, roughness: 0.05, ..Default::default() };
        let at = |material: &Material| material.mirror_at(&[], NOWHERE, NOWHERE, Vec4::ONE);
        let reflectance = |material: &Material| material.reflectance_at(&[], NOWHERE, NOWHERE, Vec4::ONE);
        assert_eq!((at(&mirror), reflectance(&mirror)), (Some(gold), Vec3::ZERO));
        for other in [
            Material { metallic: 0.5, ..mirror.clone() },
            Material { roughness: 0.3, ..mirror.clone() },
            Material { emissive: Vec3::ONE, ..mirror.clone() },
        ] {
            assert_eq!(at(&other), None);
            assert!(!other.may_be_mirror());
        }
        let slightly_matt = Material { metallic: 0.95, ..mirror };
        assert_eq!((at(&slightly_matt), reflectance(&slightly_matt)), (Some(gold), Vec3::ZERO));
    }

    /// Beer's law.
    #[test]
    fn absorption() {
        let glass = Material { absorption: Vec3::new(2.0, 0.0, 1.0), ..Default::default() };
        let two = glass.transmittance(0.5) * glass.transmittance(0.25);
        assert!(two.abs_diff_eq(glass.transmittance(0.75), 1e-6));
        assert_eq!(glass.transmittance(0.0), Vec3::ONE);
    }
}
