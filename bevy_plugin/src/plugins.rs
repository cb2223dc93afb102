//! Everything at once.

use bevy::app::plugin_group;

use crate::bake::BakePlugin;
use crate::baked::BakedScenePlugin;
use crate::gltf::GltfSourcePlugin;
use crate::lightmap_guard::LightmapGuardPlugin;
#[cfg(feature = "gizmos")]
use crate::spline::SplineGizmoPlugin;
use crate::spline::SplinePlugin;
use crate::transparency::TransparencyPlugin;

plugin_group! {
    /// Bakes, saves, loads and shows lightmaps, draws splines, and transparent things in the right order. Add it after `DefaultPlugins`.
    pub struct RadiosityPlugins {
        :GltfSourcePlugin,
        :LightmapGuardPlugin,
        :SplinePlugin,
        #[cfg(feature = "gizmos")]
        :SplineGizmoPlugin,
        :TransparencyPlugin,
        :BakePlugin,
        :BakedScenePlugin,
    }
}
