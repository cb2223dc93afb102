//! Apps without a window, and the files of their pictures.

use std::error::Error;
use std::path::Path;

use bevy::app::{PluginGroupBuilder, ScheduleRunnerPlugin};
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::pipelined_rendering::PipelinedRenderingPlugin;
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;

/// The default plugins for an app that runs as fast as it can and draws into an image.
pub fn without_window(defaults: PluginGroupBuilder) -> PluginGroupBuilder {
    defaults
        .set(WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() })
        .set(RenderPlugin { synchronous_pipeline_compilation: true, ..default() })
        .disable::<PipelinedRenderingPlugin>()
        .disable::<WinitPlugin>()
        .add(ScheduleRunnerPlugin::default())
}

/// Writes a picture in the format that the name of its file tells, smaller by this factor.
pub fn write(picture: &Image, smaller: u32, path: &Path) -> Result<(), Box<dyn Error>> {
    let size = picture.size() / smaller;
    Ok(picture.clone().try_into_dynamic()?.thumbnail_exact(size.x, size.y).to_rgb8().save(path)?)
}
