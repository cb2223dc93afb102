//! What shines and what colors surfaces have: all of a scene that can change without a ray.

use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use glam::Vec3;

use crate::scene::Scene;

/// What shines, and what colors surfaces have. Of a baked scene, this can change without a ray.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lighting {
    /// For each light of the scene its strength, not negative: intensity in cd of points and spots, illuminance in lx
    /// of directional lights, radiance in cd/m2 of rectangles.
    pub lamps: Vec<Vec3>,
    /// For each material of the scene its colors.
    pub materials: Vec<MaterialColors>,
    /// Radiance of the surroundings in cd/m2, not negative; a factor where they have an image.
    pub sky: Vec3,
}

/// The colors of a material: factors on its textures.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MaterialColors {
    /// Reflectance, not negative; at most 0.98 of the light is reflected. Mirrors and glass keep the color of the bake.
    pub base_color: Vec3,
    /// Emitted radiance in cd/m2, not negative.
    pub emissive: Vec3,
}

/// A source of light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A light of the scene.
    Lamp(u32),
    /// A material of the scene that emits.
    Material(u32),
    /// The surroundings.
    Sky,
}

/// Light that a transport cannot carry. Its text names the culprit.
#[derive(Clone, Debug, PartialEq)]
pub struct LightingError(pub String);

impl fmt::Display for LightingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl core::error::Error for LightingError {}

impl From<&Scene> for Lighting {
    fn from(scene: &Scene) -> Self {
        let colors = |material: &crate::material::Material| MaterialColors {
            base_color: material.base_color.truncate(),
            emissive: material.emissive,
        };
        Self {
            lamps: scene.lights.iter().map(|light| light.source.strength()).collect(),
            materials: scene.materials.iter().map(colors).collect(),
            sky: scene.sky,
        }
    }
}

impl Lighting {
    /// The same colors, lit by a group of these lights alone. What does not exist is left out.
    pub fn only(&self, group: &[Origin]) -> Self {
        let mut lighting = self.dark();
        for &origin in group {
            match origin {
                Origin::Lamp(lamp) => copy(lamp, &self.lamps, &mut lighting.lamps),
                Origin::Material(material) => copy(material, &self.materials, &mut lighting.materials),
                Origin::Sky => lighting.sky = self.sky,
            }
        }
        lighting
    }

    /// The same colors in the dark.
    pub fn dark(&self) -> Self {
        let dark = |material: &MaterialColors| MaterialColors { emissive: Vec3::ZERO, ..*material };
        Self {
            lamps: alloc::vec![Vec3::ZERO; self.lamps.len()],
            materials: self.materials.iter().map(dark).collect(),
            sky: Vec3::ZERO,
        }
    }

    /// The strength of a source; zero of one that does not exist.
    pub fn strength(&self, origin: Origin) -> Vec3 {
        match origin {
            Origin::Lamp(lamp) => self.lamps.get(lamp as usize).copied().unwrap_or_default(),
            Origin::Material(material) => self.materials.get(material as usize).map_or(Vec3::ZERO, |m| m.emissive),
            Origin::Sky => self.sky,
        }
    }

    /// Whether it is one for a scene with so many lamps and materials.
    ///
    /// # Errors
    ///
    /// It has another number of them, or something is negative or not finite.
    pub fn check(&self, lamps: usize, materials: usize) -> Result<(), LightingError> {
        if (self.lamps.len(), self.materials.len()) != (lamps, materials) {
            return Err(LightingError(alloc::format!(
                "{} lamps and {} materials for a scene of {lamps} and {materials}; start from the lighting of the transport",
                self.lamps.len(),
                self.materials.len()
            )));
        }
        let is_wrong = |color: &Vec3| !(color.is_finite() && color.min_element() >= 0.0);
        let wrong = |what: String| Err(LightingError(what + " is negative or not finite"));
        if let Some(index) = self.lamps.iter().position(is_wrong) {
            return wrong(alloc::format!("the strength of lamp {index}"));
        }
        let is_off = |material: &MaterialColors| is_wrong(&material.base_color) || is_wrong(&material.emissive);
        match self.materials.iter().position(is_off) {
            Some(index) => wrong(alloc::format!("a color of material {index}")),
            None if is_wrong(&self.sky) => wrong(String::from("the sky")),
            None => Ok(()),
        }
    }
}

fn copy<T: Copy>(index: u32, from: &[T], to: &mut [T]) {
    if let (Some(from), Some(to)) = (from.get(index as usize), to.get_mut(index as usize)) {
        *to = *from;
    }
}
