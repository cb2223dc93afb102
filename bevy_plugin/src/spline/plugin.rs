//! The order of all steps.

use bevy::asset::AssetEventSystems;
use bevy::camera::visibility::VisibilitySystems;
use bevy::prelude::*;

use super::lights::{remove_lights, update_lights};
use super::mesh::{update_surfaces, update_sweeps};
use super::path::update_paths;
use super::travel::travel;

/// Keeps up with the control points of splines. Needs `MeshPlugin` and `TransformPlugin`.
#[derive(Clone, Copy, Debug, Default)]
pub struct SplinePlugin;

/// The steps, all in `PostUpdate`, before transforms and visibility are propagated.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SplineSystems {
    /// Meshes and lengths follow control points.
    Shape,
    /// What is on curves goes to its place.
    Place,
}

impl Plugin for SplinePlugin {
    fn build(&self, app: &mut App) {
        app.add_observer(remove_lights);
        app.configure_sets(
            PostUpdate,
            (SplineSystems::Shape, SplineSystems::Place)
                .chain()
                .before(TransformSystems::Propagate)
                .before(VisibilitySystems::VisibilityPropagate)
                .before(VisibilitySystems::CalculateBounds)
                .before(AssetEventSystems),
        )
        .add_systems(
            PostUpdate,
            (
                (update_paths, update_surfaces, update_sweeps).in_set(SplineSystems::Shape),
                (update_lights, travel).chain().in_set(SplineSystems::Place),
            ),
        );
    }
}
