//! Meshes that are drawn in the place of those that an entity was given.

use bevy::prelude::*;

/// On an entity that draws another mesh than the one it was given: the same triangles in another order, or a part of them.
#[derive(Component, Clone, Debug)]
pub(crate) struct StandIn {
    /// What the app gave it.
    pub given: Handle<Mesh>,
    /// What its `Mesh3d` holds, unless the app has changed it since.
    pub drawn: Handle<Mesh>,
}

/// The mesh that an entity was given, whatever it draws.
pub(crate) fn given_mesh<'a>(mesh: &'a Mesh3d, stand_in: Option<&'a StandIn>) -> &'a Handle<Mesh> {
    match stand_in {
        Some(stand_in) if stand_in.drawn == mesh.0 => &stand_in.given,
        _ => &mesh.0,
    }
}
