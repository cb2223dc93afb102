//! The true error, found in the background as soon as it is looked at.

use std::thread::{JoinHandle, spawn};

use bevy::prelude::*;
use bevy_radiosity::bake::AppliedBake;
use radiosity::progress::{Cancelled, Progress};
use radiosity::render::{FalseColor, true_errors};

use crate::views::{Source, View};

/// Texels that paths of light are followed to, or some more.
const TEXELS: usize = 500;

/// Follows paths of light once the view needs them.
pub fn plugin(app: &mut App) {
    app.add_systems(Update, (start.run_if(is_wanted), finish).chain());
}

/// Whether the view shows what there is: the true errors come later than the bake.
pub fn is_ready(view: Res<View>, applied: Option<Res<AppliedBake>>) -> bool {
    applied.is_some_and(|applied| *view != View::Quality(FalseColor::Truth) || !applied.bake.true_errors.is_empty())
}

#[derive(Resource)]
struct Following(Option<JoinHandle<Result<Vec<Vec<f32>>, Cancelled>>>);

fn is_wanted(view: Res<View>, applied: Option<Res<AppliedBake>>, following: Option<Res<Following>>) -> bool {
    *view == View::Quality(FalseColor::Truth) && applied.is_some() && following.is_none()
}

fn start(mut commands: Commands, applied: Res<AppliedBake>, source: Res<Source>) {
    info!("following paths of light to {TEXELS} texels");
    let (bake, collected) = (applied.bake.clone(), source.0.clone());
    let follow = move || true_errors(&collected.scene, &bake, TEXELS, &Progress::default());
    commands.insert_resource(Following(Some(spawn(follow))));
}

/// That the bake has changed makes the view show it.
fn finish(following: Option<ResMut<Following>>, applied: Option<ResMut<AppliedBake>>) {
    let (Some(mut following), Some(mut applied)) = (following, applied) else { return };
    let Some(thread) = following.0.take_if(|thread| thread.is_finished()) else { return };
    match thread.join() {
        Ok(Ok(errors)) => applied.bake.true_errors = errors,
        Ok(Err(Cancelled)) => {}
        Err(_) => error!("paths of light were lost; please report it"),
    }
}
