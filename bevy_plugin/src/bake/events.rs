//! What an app says to the baker, and what it hears from it.
//!
//! ```
//! # use bevy::prelude::*;
//! # use bevy_radiosity::prelude::*;
//! fn start(mut commands: Commands) {
//!     commands.trigger(StartBake { settings: BakeSettings { quality: Quality::Draft, ..default() } });
//! }
//! # let mut app = App::new();
//! app.add_systems(Startup, start)
//!     .add_observer(|progress: On<BakeProgress>| info!("{} {:.0} %", progress.stage, 100.0 * progress.done))
//!     .add_observer(|done: On<BakeDone>| info!("{} texels", done.report.texels))
//!     .add_observer(|failed: On<BakeFailed>| error!("{}", failed.error));
//! ```

use std::sync::Arc;

use bevy::prelude::*;
use radiosity::bake::{BakeError, Report};

use super::{BakeSettings, Collected};

/// Bakes everything that is `Baked`, as soon as it is loaded. A bake that is under way is cancelled.
///
/// The result replaces that of the bake before.
#[derive(Event, Reflect, Clone, Debug, Default)]
pub struct StartBake {
    /// How the bake is to be made.
    pub settings: BakeSettings,
}

/// Stops the bake that is under way; a finished one stays.
#[derive(Event, Reflect, Clone, Copy, Debug, Default)]
pub struct CancelBake;

/// Takes the finished bake off: meshes, lights and ambient light are as they were before.
#[derive(Event, Reflect, Clone, Copy, Debug, Default)]
pub struct RemoveBake;

/// Everything is loaded and collected, and the threads begin to bake.
#[derive(Event, Reflect, Clone, Debug)]
#[reflect(from_reflect = false)]
pub struct BakeStarted {
    /// What is baked, and the entities that it comes from.
    #[reflect(ignore)]
    pub collected: Arc<Collected>,
}

/// What a running bake is doing; sent in every frame in which that changed.
#[derive(Event, Reflect, Clone, Copy, Debug, PartialEq)]
pub struct BakeProgress {
    /// The name of the stage, in lower case.
    pub stage: &'static str,
    /// Share of this stage that is done, in `[0, 1]`.
    pub stage_done: f32,
    /// Share of the whole bake that is done, in `[0, 1]`; an estimate.
    pub done: f32,
    /// Seconds until the end; an estimate, infinite at the start.
    pub remaining_seconds: f32,
}

/// A bake is finished, and its lightmaps show.
#[derive(Event, Reflect, Clone, Debug)]
#[reflect(from_reflect = false)]
pub struct BakeDone {
    /// What the bake did and how good it is.
    #[reflect(ignore)]
    pub report: Report,
}

/// A bake could not be made; nothing changed.
#[derive(Event, Reflect, Clone, Debug)]
#[reflect(from_reflect = false)]
pub struct BakeFailed {
    /// Why, and what to do about it.
    #[reflect(ignore)]
    pub error: BakeError,
}

/// A bake was cancelled; nothing changed.
#[derive(Event, Reflect, Clone, Copy, Debug, Default)]
pub struct BakeCancelled;
