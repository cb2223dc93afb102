//! Everything at once.

use bevy::app::plugin_group;

use crate::bake::BakePlugin;
use crate::baked::BakedScenePlugin;
use crate::gltf::GltfSourcePlugin;
use crate::lightmap_guard::LightmapGuardPlugin;

plugin_group! {
    /// Bakes, saves, loads and shows lightmaps. Add it after `DefaultPlugins`.
    pub struct RadiosityPlugins {
        :GltfSourcePlugin,
        :LightmapGuardPlugin,
        :BakePlugin,
        :BakedScenePlugin,
    }
}
