//! Runs bakes: waits until everything is loaded, collects, bakes on other threads, shows the result.

use std::mem;
use std::sync::Arc;

use bevy::asset::AssetEventSystems;
use bevy::camera::visibility::VisibilitySystems;
use bevy::prelude::*;
use radiosity::bake::{Bake, BakeError, BakeSettings as CoreBakeSettings};

use super::loading::still_loading;
use super::task::BakeTask;
use super::{
    BakeCancelled, BakeDone, BakeFailed, BakeOnLoad, BakeProgress, BakeSettings, BakeStarted, CancelBake, Collected,
    RemoveBake, StartBake, apply_bake, collect_unlit, remove_bake,
};
use crate::lightmap_guard::LightmapSystems;

/// Bakes inside the app: see `StartBake` and `BakeOnLoad`. Needs `LightmapGuardPlugin`.
#[derive(Clone, Copy, Debug, Default)]
pub struct BakePlugin;

/// The steps of a bake, all in `PostUpdate`.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BakeSystems {
    /// A finished bake goes onto the entities. Before transforms and visibility are propagated.
    Apply,
    /// Entities are read and the bake starts. After transforms and visibility are propagated.
    Collect,
}

impl Plugin for BakePlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<BakeSettings>()
            .init_resource::<BakeState>()
            .add_observer(on_start)
            .add_observer(on_cancel)
            .add_observer(on_remove)
            .add_observer(on_bake_on_load)
            .configure_sets(
                PostUpdate,
                (
                    BakeSystems::Apply.before(TransformSystems::Propagate).before(LightmapSystems::Check),
                    BakeSystems::Collect
                        .after(BakeSystems::Apply)
                        .after(TransformSystems::Propagate)
                        .after(VisibilitySystems::VisibilityPropagate)
                        .before(AssetEventSystems),
                ),
            )
            .add_systems(
                PostUpdate,
                (
                    (tell_progress, finish_bake).chain().run_if(is_running).in_set(BakeSystems::Apply),
                    start_bake.run_if(is_waiting.and_then(not(still_loading))).in_set(BakeSystems::Collect),
                ),
            );
    }
}

/// How far the bake is.
#[derive(Resource, Default)]
enum BakeState {
    #[default]
    Idle,
    /// Until everything is loaded.
    Waiting(BakeSettings),
    Running {
        task: BakeTask,
        collected: Arc<Collected>,
        settings: BakeSettings,
    },
}

fn is_waiting(state: Res<BakeState>) -> bool {
    matches!(*state, BakeState::Waiting(_))
}

fn is_running(state: Res<BakeState>) -> bool {
    matches!(*state, BakeState::Running { .. })
}

fn on_start(start: On<StartBake>, mut state: ResMut<BakeState>, mut commands: Commands) {
    let before = mem::replace(&mut *state, BakeState::Waiting(start.settings.clone()));
    if !matches!(before, BakeState::Idle) {
        commands.trigger(BakeCancelled);
    }
}

fn on_cancel(_: On<CancelBake>, mut state: ResMut<BakeState>, mut commands: Commands) {
    match &*state {
        BakeState::Idle => {}
        BakeState::Waiting(_) => {
            *state = BakeState::Idle;
            commands.trigger(BakeCancelled);
        }
        // The event follows when the threads have ended.
        BakeState::Running { task, .. } => task.cancel(),
    }
}

fn on_remove(_: On<RemoveBake>, mut commands: Commands) {
    commands.queue(remove_bake);
}

fn on_bake_on_load(_: On<Add, BakeOnLoad>, state: Res<BakeState>, settings: Res<BakeSettings>, mut commands: Commands) {
    // One bake is for all that come together.
    if !is_waiting(state) {
        commands.trigger(StartBake { settings: settings.clone() });
    }
}

fn start_bake(world: &mut World) {
    let BakeState::Waiting(settings) = mem::take(&mut *world.resource_mut::<BakeState>()) else { return };
    let collected = Arc::new(collect_unlit(world));
    for warning in &collected.warnings {
        warn!("{warning}");
    }
    match BakeTask::start(collected.clone(), CoreBakeSettings::from(&settings)) {
        Ok(task) => {
            world.insert_resource(BakeState::Running { task, collected: collected.clone(), settings });
            world.trigger(BakeStarted { collected });
        }
        Err(error) => world.trigger(BakeFailed { error }),
    }
}

fn tell_progress(state: Res<BakeState>, mut told: Local<Option<BakeProgress>>, mut commands: Commands) {
    let BakeState::Running { task, .. } = &*state else { return };
    let now = task.snapshot();
    let progress = BakeProgress {
        stage: now.stage.name(),
        stage_done: now.stage_done,
        done: now.done,
        remaining_seconds: now.remaining_seconds,
    };
    let is_news = told.is_none_or(|told| (told.stage, told.stage_done) != (progress.stage, progress.stage_done));
    if is_news {
        *told = Some(progress);
        commands.trigger(progress);
    }
}

fn finish_bake(world: &mut World) {
    let BakeState::Running { task, .. } = &mut *world.resource_mut::<BakeState>() else { return };
    let Some(result) = task.take_result() else { return };
    let finished = mem::take(&mut *world.resource_mut::<BakeState>());
    let BakeState::Running { collected, settings, .. } = finished else { return };
    match result {
        Ok(bake) => show(world, &collected, bake, &settings),
        Err(BakeError::Cancelled) => world.trigger(BakeCancelled),
        Err(error) => world.trigger(BakeFailed { error }),
    }
}

fn show(world: &mut World, collected: &Collected, mut bake: Bake, settings: &BakeSettings) {
    bake.report.warnings.extend_from_slice(&collected.warnings);
    let report = bake.report.clone();
    apply_bake(world, collected, bake, settings);
    world.trigger(BakeDone { report });
}
