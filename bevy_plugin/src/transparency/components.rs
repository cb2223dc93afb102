//! What is put on entities and cameras.

use bevy::prelude::*;

/// When a transparent entity is drawn: lower layers first, then lower priorities, then from far to near.
///
/// Without it an entity has the default, and the place of its center.
#[derive(Component, Reflect, Clone, Copy, Debug, Default, PartialEq)]
#[reflect(Component, Default, Clone, PartialEq)]
pub struct TransparentOrder {
    /// Layers are drawn one after the other, whatever their depth.
    pub layer: i16,
    /// Within a layer, priorities are drawn one after the other, whatever their depth.
    pub priority: i16,
    /// So much nearer than it is the entity counts, in world units; added to the material's `depth_bias`, which moves
    /// the depth that is tested, too.
    pub bias: f32,
    /// Which of its points stands for the entity.
    pub key: TransparentKey,
}

/// Which point of an entity stands for it.
#[derive(Reflect, Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[reflect(Default, Clone, PartialEq, Hash)]
pub enum TransparentKey {
    /// The center of its bounding box.
    #[default]
    Center,
    /// The origin of its transform.
    Origin,
    /// The point of its bounding box that is nearest to the camera: it is drawn after all that it contains.
    Nearest,
    /// The point of its bounding box that is farthest from the camera: it is drawn before all that stands in front of
    /// any of it, such as a sheet of water.
    Farthest,
}

/// What a camera takes for the depth of transparent things.
#[derive(Component, Reflect, Clone, Copy, Debug, Default, PartialEq)]
#[reflect(Component, Default, Clone, PartialEq)]
pub enum TransparentDepth {
    /// The distance from the plane through the camera, as Bevy has it. Turning the camera changes the order.
    #[default]
    Planar,
    /// The distance from the camera. Turning the camera changes nothing.
    Radial,
    /// What Bevy 0.19 does alone, for comparison: the distance from the plane through the camera to where each thing was
    /// when it came into view. [`TransparentOrder`] does not count.
    AsQueued,
    /// The position along this direction of the world; the farthest along it is drawn last. For scenes of layers.
    Along(Dir3),
}
