//! Transparent things, drawn in the right order.
//!
//! | what happens | Bevy 0.19 alone | with [`TransparencyPlugin`] |
//! |---|---|---|
//! | a transparent mesh moves | it is drawn where it stood in the order when it came into view (bevyengine/bevy#24826) | where it stands now |
//! | the camera turns | depth is the distance from the camera's plane: things change places | so too, or [`TransparentDepth::Radial`]: they do not |
//! | two things are equally far | they flicker when rounding favors now one and now the other (bevyengine/bevy#10243) | they stay as they were |
//! | a large mesh covers itself | its triangles are drawn as they stand | [`SortedTriangles`] sorts them |
//! | flat things run through each other, or overlap in a cycle | no order is right | [`SplitPane`] cuts them |
//! | one must be drawn before the other, wherever they are | nothing but `depth_bias` | [`TransparentOrder`] |
//!
//! It holds for everything in the phases `Transparent3d` and `Transmissive3d`: standard and custom materials, particles,
//! gizmos. What has no mesh keeps the depth that its own plugin gives it, and what is always on top is drawn first, as in
//! Bevy. Cameras with order independent transparency need no order; for what Bevy 0.19 draws without it there (additive,
//! multiplied and premultiplied materials) the order counts.
//!
//! What no order of whole meshes can cure: meshes that pass through each other, that overlap in a cycle, or that surround
//! each other. The example `overlap` shows it (`examples/pictures/overlap.png`: sorted, cut, exact). [`SplitPane`] and [`SortedTriangles`] cure it for panes and within a mesh;
//! large curved meshes that pass through each other need order independent transparency.
//!
//! What it costs: milliseconds in which the render world sorts, least of 15 frames, in one run
//! (`bevy_plugin/benches/transparency.rs`). Where everything moves Bevy alone sorts nothing: its order is that of the start.
//!
//! | transparent meshes | what moves | Bevy 0.19 alone | with the plugin |
//! |---|---|---|---|
//! | 0 | | 0.016 | 0.024 |
//! | 1 000 | nothing | 0.036 | 0.046 |
//! | 1 000 | the camera | 0.076 | 0.086 |
//! | 1 000 | everything | 0.031 | 0.110 |
//! | 100 000 | nothing | 1.4 | 2.4 |
//! | 100 000 | the camera | 10.2 | 9.0 |
//! | 100 000 | everything | 1.5 | 10.2 |

mod components;
mod extract;
mod order;
mod panes;
mod phase;
mod place;
mod triangle_list;
mod triangles;

use bevy::core_pipeline::core_3d::Transparent3d;
use bevy::pbr::Transmissive3d;
use bevy::prelude::*;
use bevy::render::render_phase::{ViewSortedRenderPhases, sort_phase_system};
use bevy::render::{ExtractSchedule, Render, RenderApp, RenderSystems};

pub use components::{TransparentDepth, TransparentKey, TransparentOrder};

pub use panes::{PieceComponents, SplitPane};
pub use triangles::SortedTriangles;

use order::{Held, LastOrder, hold, order};
use phase::DepthSorted;

/// Draws transparent things in the right order. Add it after `DefaultPlugins`; without a renderer it does nothing, and
/// phases that the app goes without, such as that of materials that transmit, are left out.
#[derive(Default)]
pub struct TransparencyPlugin;

/// What the plugin does in the render world's `Render` schedule, within `RenderSystems::PhaseSort`.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TransparencySystems {
    /// The phases are put aside, so that Bevy's own sort finds nothing to do.
    Hold,
    /// They come back in order. What looks at the order, or changes it, comes after.
    Order,
}

impl Plugin for TransparencyPlugin {
    fn build(&self, app: &mut App) {
        app.add_plugins((triangles::plugin, panes::plugin));
        let Some(render_app) = app.get_sub_app_mut(RenderApp) else { return };
        render_app
            .init_resource::<extract::Moved>()
            .init_resource::<extract::Orders>()
            .init_resource::<panes::ExtractedPanes>()
            .add_systems(
                ExtractSchedule,
                (extract::extract_moved, extract::extract_orders, extract::extract_depths, panes::extract_panes),
            )
            .configure_sets(
                Render,
                (TransparencySystems::Hold, TransparencySystems::Order).in_set(RenderSystems::PhaseSort),
            );
        add_phase::<Transparent3d>(render_app);
        add_phase::<Transmissive3d>(render_app);
    }
}

fn add_phase<I: DepthSorted>(render_app: &mut SubApp) {
    render_app.init_resource::<Held<I>>().init_resource::<LastOrder<I>>().add_systems(
        Render,
        (
            hold::<I>.in_set(TransparencySystems::Hold).before(sort_phase_system::<I>),
            order::<I>.in_set(TransparencySystems::Order).after(sort_phase_system::<I>),
        )
            .distributive_run_if(resource_exists::<ViewSortedRenderPhases<I>>),
    );
}
