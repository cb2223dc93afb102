//! A bake of all that is marked in an app.

use std::time::{Duration, Instant};

use bevy::prelude::*;
use bevy_radiosity::prelude::*;

#[derive(Resource, Default)]
struct Outcome(Option<Result<(), String>>);

/// Bakes everything with 16 texels per meter and waits for the end.
///
/// # Panics
///
/// Where the bake fails, or takes more than five minutes.
pub fn bake(app: &mut App) {
    app.init_resource::<Outcome>()
        .add_observer(|_: On<BakeDone>, mut outcome: ResMut<Outcome>| outcome.0 = Some(Ok(())))
        .add_observer(|failed: On<BakeFailed>, mut outcome: ResMut<Outcome>| {
            outcome.0 = Some(Err(failed.error.to_string()));
        });
    let settings = BakeSettings { resolution: Resolution::TexelsPerMeter(16.0), ..default() };
    app.world_mut().trigger(StartBake { settings });
    let start = Instant::now();
    let outcome = loop {
        app.update();
        if let Some(outcome) = app.world_mut().resource_mut::<Outcome>().0.take() {
            break outcome;
        }
        assert!(start.elapsed() < Duration::from_secs(300), "the bake does not end");
        std::thread::sleep(Duration::from_millis(5));
    };
    outcome.unwrap_or_else(|error| panic!("the bake failed: {error}"));
}
