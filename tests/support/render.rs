//! Apps without a window: one that renders into an image whose pixels are read back, and one without a GPU.

use std::any::Any;
use std::env;
use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::Path;

use bevy::app::{PluginGroupBuilder, Plugins, PluginsState};
use bevy::camera::{Exposure, Hdr, RenderTarget};
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::log::LogPlugin;
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::gpu_readback::{Readback, ReadbackComplete};
use bevy::render::pipelined_rendering::PipelinedRenderingPlugin;
use bevy::render::render_resource::{TextureFormat, TextureUsages};
use bevy::render::settings::{Backends, WgpuSettings};
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;

/// Pixels in a row and in a column of what a [`Studio`] renders.
pub const SIDE: u32 = 64;
/// Frames after which a change is seen in the pixels that were read back.
const FRAMES_TO_SETTLE: usize = 8;

/// An app that renders what is around the origin.
pub struct Studio {
    /// Without lights; entities may be spawned, changed and despawned between pictures.
    pub app: App,
    /// Sees the origin from `z` = 2.
    pub camera: Entity,
}

/// The last pixels that were read back of the picture of a camera.
#[derive(Component)]
struct Pixels {
    camera: Entity,
    rgb: Vec<Vec3>,
}

impl Studio {
    /// None, with a word about it, where the machine has no GPU, not even a software renderer.
    ///
    /// # Panics
    ///
    /// So it does with `RADIOSITY_REQUIRE_GPU=1` in the environment.
    pub fn new() -> Option<Self> {
        Self::with_settings(WgpuSettings { backends: Some(Backends::PRIMARY), ..default() }, Msaa::Off)
    }

    /// So too with other settings of the renderer.
    ///
    /// # Panics
    ///
    /// As [`Studio::new`] does.
    pub fn with_settings(settings: WgpuSettings, msaa: Msaa) -> Option<Self> {
        let app = catch_unwind(AssertUnwindSafe(|| app(settings)));
        let app = app.or_else(|panic| if is_about_gpu(&*panic) { Err(()) } else { resume_unwind(panic) });
        let Ok(mut app) = app else {
            let is_required = env::var("RADIOSITY_REQUIRE_GPU").is_ok_and(|value| value == "1");
            assert!(!is_required, "RADIOSITY_REQUIRE_GPU=1, and there is no GPU; install mesa-vulkan-drivers");
            // Not captured, so that the summary of a run shows what it left out.
            let _ = writeln!(
                std::io::stderr(),
                "SKIPPED: no GPU here; mesa-vulkan-drivers and libvulkan1 render on the CPU"
            );
            return None;
        };
        app.insert_resource(GlobalAmbientLight::NONE);
        let mut studio = Self { app, camera: Entity::PLACEHOLDER };
        studio.camera = studio.add_camera(Transform::from_xyz(0.0, 0.0, 2.0), msaa);
        Some(studio)
    }

    /// One more camera with a picture of its own, and what else it carries.
    pub fn add_camera(&mut self, transform: Transform, more: impl Bundle) -> Entity {
        let mut picture = Image::new_target_texture(SIDE, SIDE, TextureFormat::Rgba32Float, None);
        picture.texture_descriptor.usage |= TextureUsages::COPY_SRC;
        let world = self.app.world_mut();
        let picture = world.resource_mut::<Assets<Image>>().add(picture);
        let target = RenderTarget::Image(picture.clone().into());
        let lens = (Exposure::INDOOR, Hdr, Tonemapping::None);
        let camera = world.spawn((Camera3d::default(), target, transform, lens, more)).id();
        world.spawn((Readback::texture(picture), Pixels { camera, rgb: Vec::new() })).observe(keep_pixels);
        camera
    }

    /// What a camera sees, row by row from the top, when everything that changed shows: radiance in cd/m2 times the
    /// exposure.
    ///
    /// # Panics
    ///
    /// Where the renderer has stopped with an error.
    pub fn picture(&mut self, camera: Entity) -> Vec<Vec3> {
        finish_plugins(&mut self.app);
        for _ in 0..FRAMES_TO_SETTLE {
            self.app.update();
            assert!(self.app.should_exit().is_none(), "the renderer has stopped with an error");
        }
        let world = self.app.world_mut();
        let mut all = world.query::<&Pixels>();
        let pixels = all.iter(world).find(|pixels| pixels.camera == camera);
        pixels.map(|pixels| pixels.rgb.clone()).expect("only cameras of the studio have pictures")
    }

    /// What a camera sees in the very next frame, before anything has settled. The camera is off afterwards.
    ///
    /// # Panics
    ///
    /// Where the renderer has stopped with an error.
    pub fn next_picture(&mut self, camera: Entity) -> Vec<Vec3> {
        finish_plugins(&mut self.app);
        self.app.update();
        self.app.world_mut().get_mut::<Camera>(camera).expect("a camera").is_active = false;
        self.picture(camera)
    }

    /// The mean of four pixels in the middle of the picture.
    ///
    /// # Panics
    ///
    /// Where the renderer has stopped with an error.
    pub fn center(&mut self) -> Vec3 {
        let pixels = self.picture(self.camera);
        let middle = (SIDE / 2 - 1) as usize;
        let rows = [middle, middle + 1];
        rows.into_iter().flat_map(|row| rows.map(|column| pixels[row * SIDE as usize + column])).sum::<Vec3>() / 4.0
    }

    /// The exposure that pictures are multiplied with.
    pub fn exposure() -> f32 {
        Exposure::INDOOR.exposure()
    }
}

/// An app without a renderer, with the folder of its assets and what is added to the default plugins.
pub fn app_without_gpu<M>(assets: &Path, more: impl Plugins<M>) -> App {
    let defaults = plugins(WgpuSettings { backends: None, ..default() })
        .set(AssetPlugin { file_path: assets.display().to_string(), ..default() });
    let mut app = App::new();
    app.add_plugins(defaults).add_plugins(more);
    finish_plugins(&mut app);
    app
}

fn app(settings: WgpuSettings) -> App {
    let mut app = App::new();
    app.add_plugins(plugins(settings));
    app
}

/// Bevy has no other way to tell that there is none.
fn is_about_gpu(panic: &(dyn Any + Send)) -> bool {
    let text = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
    text.is_some_and(|text| text.contains("Unable to find a GPU"))
}

fn plugins(settings: WgpuSettings) -> PluginGroupBuilder {
    let render_creation = settings.into();
    DefaultPlugins
        .set(WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() })
        .set(RenderPlugin { render_creation, synchronous_pipeline_compilation: true, ..default() })
        .disable::<PipelinedRenderingPlugin>()
        // It wants a window and the main thread.
        .disable::<WinitPlugin>()
        // There is one log for a process, and one process runs many tests.
        .disable::<LogPlugin>()
}

fn finish_plugins(app: &mut App) {
    while app.plugins_state() == PluginsState::Adding {
        bevy::tasks::tick_global_task_pools_on_main_thread();
    }
    if app.plugins_state() == PluginsState::Ready {
        app.finish();
        app.cleanup();
    }
}

fn keep_pixels(read: On<ReadbackComplete>, mut all: Query<&mut Pixels>) {
    let Ok(mut pixels) = all.get_mut(read.entity) else { return };
    let floats = read.data.as_chunks::<4>().0.iter().map(|&bytes| f32::from_le_bytes(bytes));
    let floats: Vec<f32> = floats.collect();
    pixels.rgb = floats.as_chunks::<4>().0.iter().map(|&[red, green, blue, _]| Vec3::new(red, green, blue)).collect();
}
