//! Saved bakes in an app.

use bevy::camera::visibility::VisibilitySystems;
use bevy::prelude::*;

use super::attach::{attach_baked_scenes, on_discard, something_is_new};
use super::save::on_save;
use super::{BakedScene, BakedSceneLoader};
use crate::lightmap_guard::LightmapSystems;

/// Loads, attaches and saves bakes. Needs `LightmapGuardPlugin` and `GltfSourcePlugin`.
#[derive(Clone, Copy, Debug, Default)]
pub struct BakedScenePlugin;

/// What happens to saved bakes, in `PostUpdate`.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BakedSceneSystems {
    /// What was spawned or loaded meanwhile gets its lightmaps.
    Attach,
}

impl Plugin for BakedScenePlugin {
    fn build(&self, app: &mut App) {
        app.init_asset::<BakedScene>()
            .init_asset_loader::<BakedSceneLoader>()
            .add_observer(on_discard)
            .add_observer(on_save)
            .configure_sets(
                PostUpdate,
                BakedSceneSystems::Attach.before(LightmapSystems::Check).before(VisibilitySystems::VisibilityPropagate),
            )
            .add_systems(PostUpdate, attach_baked_scenes.run_if(something_is_new).in_set(BakedSceneSystems::Attach));
    }
}
