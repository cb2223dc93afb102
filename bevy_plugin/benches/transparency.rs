//! What the order of transparent things costs: milliseconds per frame in which the renderer sorts its phases, with the plugin
//! and with Bevy alone, in one run.
//!
//!     cargo bench --profile bake -p bevy_radiosity --features viewer --bench transparency -- [ENTITIES ...]
//!
//! It renders into a picture of 16 x 16 pixels; without a GPU, mesa-vulkan-drivers does it on the CPU.

use std::time::{Duration, Instant};

use bevy::app::PluginsState;
use bevy::camera::RenderTarget;
use bevy::log::LogPlugin;
use bevy::prelude::*;
use bevy::render::pipelined_rendering::PipelinedRenderingPlugin;
use bevy::render::render_resource::TextureFormat;
use bevy::render::{Render, RenderApp, RenderPlugin, RenderSystems};
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;
use bevy_radiosity::transparency::TransparencyPlugin;

/// Frames before the first that is timed: pipelines are compiled, everything has come into view.
const WARM_UP: usize = 4;
const FRAMES: usize = 15;

/// What happens between two frames.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
enum Motion {
    Nothing,
    Camera,
    Everything,
}

/// Who sorts.
#[derive(Clone, Copy, Debug)]
enum Sorter {
    Bevy,
    Plugin,
}

#[derive(Resource, Default)]
struct Clock {
    started: Option<Instant>,
    sorting: Vec<Duration>,
}

fn main() {
    let counts: Vec<usize> = std::env::args().filter_map(|arg| arg.parse().ok()).collect();
    let counts = if counts.is_empty() { vec![0, 1_000, 100_000] } else { counts };
    println!("milliseconds of sorting per frame, least and median of {FRAMES} frames; then those of the whole frame");
    for count in counts {
        for motion in [Motion::Nothing, Motion::Camera, Motion::Everything] {
            for sorter in [Sorter::Bevy, Sorter::Plugin] {
                let (sorting, whole) = frames(count, motion, sorter);
                let [least, median] = [sorting[0], sorting[FRAMES / 2]];
                println!("{count:>7} {motion:<10?} {sorter:<7?} {least:8.3} {median:8.3} {:9.1}", whole[FRAMES / 2]);
            }
        }
    }
}

/// Sorted milliseconds of sorting, and of whole frames.
fn frames(count: usize, motion: Motion, sorter: Sorter) -> (Vec<f64>, Vec<f64>) {
    let mut app = app(sorter);
    app.insert_resource(motion).add_systems(Update, step).insert_resource(ClearColor(Color::BLACK));
    spawn(app.world_mut(), count);
    let whole: Vec<Duration> = (0..WARM_UP + FRAMES)
        .map(|_| {
            let start = Instant::now();
            app.update();
            start.elapsed()
        })
        .collect();
    let clock = app.sub_app(RenderApp).world().resource::<Clock>();
    [&clock.sorting, &whole].map(|times| sorted_milliseconds(&times[WARM_UP..])).into()
}

fn sorted_milliseconds(times: &[Duration]) -> Vec<f64> {
    let mut times: Vec<f64> = times.iter().map(|time| time.as_secs_f64() * 1e3).collect();
    times.sort_by(f64::total_cmp);
    times
}

fn app(sorter: Sorter) -> App {
    let mut app = App::new();
    app.add_plugins(
        DefaultPlugins
            .set(WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() })
            .set(RenderPlugin { synchronous_pipeline_compilation: true, ..default() })
            .disable::<PipelinedRenderingPlugin>()
            .disable::<WinitPlugin>()
            .disable::<LogPlugin>(),
    );
    if let Sorter::Plugin = sorter {
        app.add_plugins(TransparencyPlugin);
    }
    while app.plugins_state() == PluginsState::Adding {
        bevy::tasks::tick_global_task_pools_on_main_thread();
    }
    app.finish();
    app.cleanup();
    let render_app = app.sub_app_mut(RenderApp);
    render_app.init_resource::<Clock>().add_systems(
        Render,
        (
            start.after(RenderSystems::QueueSweep).before(RenderSystems::PhaseSort),
            stop.after(RenderSystems::PhaseSort).before(RenderSystems::Prepare),
        ),
    );
    app
}

fn start(mut clock: ResMut<Clock>) {
    clock.started = Some(Instant::now());
}

fn stop(mut clock: ResMut<Clock>) {
    if let Some(started) = clock.started.take() {
        clock.sorting.push(started.elapsed());
    }
}

/// Small squares in front of a camera, without a pattern.
fn spawn(world: &mut World, count: usize) {
    let picture = Image::new_target_texture(16, 16, TextureFormat::Rgba8UnormSrgb, None);
    let picture = world.resource_mut::<Assets<Image>>().add(picture);
    world.spawn((
        Camera3d::default(),
        RenderTarget::Image(picture.into()),
        Transform::from_xyz(0.0, 0.0, 2.0),
        Msaa::Off,
    ));
    let mesh = world.resource_mut::<Assets<Mesh>>().add(Rectangle::new(0.01, 0.01));
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial {
        base_color: Color::linear_rgba(1.0, 0.5, 0.2, 0.5),
        alpha_mode: AlphaMode::Blend,
        unlit: true,
        ..default()
    });
    let squares = (0..count).map(|k| {
        let place = Transform::from_translation(place(k));
        (Mesh3d(mesh.clone()), MeshMaterial3d(material.clone()), place)
    });
    world.spawn_batch(squares.collect::<Vec<_>>());
}

/// A low-discrepancy sequence in a cube that the camera sees.
fn place(k: usize) -> Vec3 {
    let steps = [0.819_172_513_4, 0.671_043_606_7, 0.549_700_477_9_f64];
    Vec3::from(steps.map(|step| ((0.5 + step * (k + 1) as f64).fract() - 0.5) as f32))
}

fn step(
    motion: Res<Motion>,
    mut frame: Local<usize>,
    mut cameras: Query<&mut Transform, With<Camera>>,
    mut squares: Query<&mut Transform, (With<Mesh3d>, Without<Camera>)>,
) {
    *frame += 1;
    match *motion {
        Motion::Nothing => {}
        Motion::Camera => {
            let angle = 0.01 * *frame as f32;
            let at = Vec3::new(2.0 * angle.sin(), 0.0, 2.0 * angle.cos());
            cameras
                .iter_mut()
                .for_each(|mut camera| *camera = Transform::from_translation(at).looking_at(Vec3::ZERO, Vec3::Y));
        }
        Motion::Everything => {
            for (k, mut square) in squares.iter_mut().enumerate() {
                square.translation = place(k + 7 * *frame);
            }
        }
    }
}
