//! Transparent things within the limits of WebGL 2: without compute shaders the renderer keeps transforms elsewhere. A test
//! of its own, since Bevy 0.19 remembers the limits of the first renderer of a process.

use bevy::prelude::*;
use bevy::render::render_resource::WgpuLimits;
use bevy::render::settings::{Backends, WgpuSettings, WgpuSettingsPriority};
use bevy_radiosity::transparency::TransparencyPlugin;
use radiosity_tests::panes::{self, swap_two_panes};

#[test]
fn moving_pane_changes_places() {
    let settings = WgpuSettings {
        backends: Some(Backends::PRIMARY),
        priority: WgpuSettingsPriority::WebGL2,
        limits: WgpuLimits::downlevel_webgl2_defaults(),
        ..default()
    };
    let Some(mut studio) = panes::studio(settings, Msaa::Off) else { return };
    studio.app.add_plugins(TransparencyPlugin);
    assert_eq!(swap_two_panes(&mut studio), [0, 0]);
}
