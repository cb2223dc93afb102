//! What a user puts on entities to say what is baked, and how.

use bevy::prelude::*;

/// Bakes this entity and everything below it, so on the root of a scene the whole scene.
///
/// Meshes get lightmaps, and the lights below are baked into them.
#[derive(Component, Reflect, Clone, Copy, Debug, PartialEq)]
#[reflect(Component, Default)]
pub struct Baked {
    /// Factor on the texels per meter of the bake, positive; 1 is usual. The nearest one above a mesh counts.
    pub density: f32,
}

impl Default for Baked {
    fn default() -> Self {
        Self { density: 1.0 }
    }
}

/// Leaves this entity and everything below it out of bakes: meshes neither get lightmaps nor block light,
/// lights stay as they are.
#[derive(Component, Reflect, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[reflect(Component, Default)]
pub struct NotBaked;

/// A name that finds this entity again when a saved bake is loaded; needed where no glTF index does.
#[derive(Component, Reflect, Clone, Debug, Default, PartialEq, Eq, Hash)]
#[reflect(Component, Default)]
pub struct BakeId(pub String);

/// How large a directional light looks, as an angle in radians, which softens its baked shadows.
///
/// Without it `SunDisk` counts, and without that 0.53 degrees, the sun as seen from Earth.
#[derive(Component, Reflect, Clone, Copy, Debug, PartialEq)]
#[reflect(Component)]
pub struct AngularDiameter(pub f32);

/// The sky over all that is baked: the bake of the world has its light, wherever it is.
///
/// One entity has it; of several one counts, and a warning names the others. Bevy shows no sky for it: `Skybox` does.
#[derive(Component, Reflect, Clone, Debug, PartialEq)]
#[reflect(Component, Default)]
pub struct SkyLight {
    /// Of all directions, or a factor on the image.
    pub color: Color,
    /// Radiance in cd/m2 of white, as that of `Skybox`.
    pub brightness: f32,
    /// A panorama (`.hdr`, `.exr`) or a cube as a `Skybox` has it. Its suns become baked directional lights.
    pub image: Option<Handle<Image>>,
    /// How the image is turned, as that of `Skybox`.
    pub rotation: Quat,
}

impl Default for SkyLight {
    fn default() -> Self {
        Self { color: Color::WHITE, brightness: 1000.0, image: None, rotation: Quat::IDENTITY }
    }
}

/// Bakes as soon as this entity is there and everything that is `Baked` is loaded, with the resource `BakeSettings`.
///
/// For apps that bake once, at their start.
#[derive(Component, Reflect, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[reflect(Component, Default)]
#[require(Baked)]
pub struct BakeOnLoad;
