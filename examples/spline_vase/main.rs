//! A vase turned from a profile, under a vault of NURBS patches: drag its control points, bake, see the light.

mod edit;
mod model;
mod screenshot;
#[path = "../viewer/windowless.rs"]
mod windowless;

use std::path::PathBuf;

use bevy::camera::{Exposure, Hdr};
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::prelude::*;
use bevy_radiosity::cli::write_glb;
use bevy_radiosity::prelude::*;
use radiosity::light::LightSource;
use radiosity::render::Camera as PathCamera;

use crate::model::{Paints, spawn_bay, spawn_plinth, vase};

const HELP: &str = "\
spline_vase [OPTIONS]

  drag a control point: the vase follows    B: bake    G: control points, knots    Escape: end

  --texels-per-meter N      density of the lightmaps, 48 by default
  --quality draft|medium    how many rays, draft by default
  --gizmos                  shows control points and knots from the start
  --screenshot FILE.png     without a window: bakes, writes a picture, and ends
  --scene FILE.glb          without a window: writes the scene for `bake`, and ends";

const EYE: Vec3 = Vec3::new(0.5, 1.35, 3.3);
const TARGET: Vec3 = Vec3::new(-0.12, 1.62, 0.0);
const FOV: f32 = 1.02;

/// What was said.
struct Args {
    density: f32,
    quality: Quality,
    gizmos: Vec<SplineGizmo>,
    show: Show,
}

/// Where the scene goes.
enum Show {
    Window,
    Picture(PathBuf),
    Scene(PathBuf),
}

fn main() -> AppExit {
    let Some(args) = read(std::env::args().skip(1)) else {
        eprintln!("{HELP}");
        return AppExit::from_code(2);
    };
    let mut app = App::new();
    match args.show {
        Show::Window => {
            println!("{HELP}");
            app.add_plugins((DefaultPlugins, edit::plugin));
        }
        Show::Picture(path) => {
            app.add_plugins((windowless::without_window(DefaultPlugins.build()), screenshot::plugin(path)));
        }
        Show::Scene(path) => {
            let write = move |started: On<BakeStarted>, mut exit: MessageWriter<AppExit>| {
                exit.write(write_scene(&started, &path));
            };
            app.add_plugins(windowless::without_window(DefaultPlugins.build())).add_observer(write);
        }
    }
    app.add_plugins(RadiosityPlugins)
        .insert_resource(BakeSettings {
            quality: args.quality,
            resolution: Resolution::TexelsPerMeter(args.density),
            // Every mesh is a chart by nature: that one had to be unwrapped would be an error.
            uv: UvMode::Keep,
            ..default()
        })
        .insert_resource(GlobalAmbientLight::NONE)
        .insert_resource(ClearColor(Color::BLACK))
        .insert_resource(Marks(args.gizmos))
        .add_systems(Startup, spawn)
        .add_observer(tell)
        .add_observer(fail)
        .run()
}

/// What is drawn over the vase.
#[derive(Resource)]
struct Marks(Vec<SplineGizmo>);

fn read(mut words: impl Iterator<Item = String>) -> Option<Args> {
    let mut args = Args { density: 48.0, quality: Quality::Draft, gizmos: Vec::new(), show: Show::Window };
    while let Some(word) = words.next() {
        let mut value = || words.next();
        match word.as_str() {
            "--texels-per-meter" => args.density = value()?.parse().ok().filter(|&n: &f32| n > 0.0 && n.is_finite())?,
            "--quality" => {
                args.quality = match value()?.as_str() {
                    "draft" => Quality::Draft,
                    "medium" => Quality::Medium,
                    _ => return None,
                }
            }
            "--gizmos" => args.gizmos = vec![SplineGizmo { size: 0.02, ..default() }],
            "--screenshot" => args.show = Show::Picture(value()?.into()),
            "--scene" => args.show = Show::Scene(value()?.into()),
            _ => return None,
        }
    }
    Some(args)
}

fn spawn(mut commands: Commands, mut materials: ResMut<Assets<StandardMaterial>>, marks: Res<Marks>) {
    let paints = Paints::new(&mut materials);
    let root = commands.spawn((BakeOnLoad, Transform::default(), Visibility::default())).id();
    spawn_bay(&mut commands, root, &paints);
    spawn_plinth(&mut commands, root, &paints, Vec3::ZERO);
    let mut vase = commands.spawn((
        Name::new("vase"),
        SplineSurface::revolution(vase()),
        SplineTolerance { chord: 0.0005, angle: 0.1 },
        Baked { density: 3.0 },
        MeshMaterial3d(paints.clay.clone()),
        Transform::from_xyz(0.0, 0.6, 0.0),
        ChildOf(root),
    ));
    for mark in &marks.0 {
        vase.insert(*mark);
    }
    let lamp = PointLight { color: Color::linear_rgb(1.0, 0.8, 0.55), intensity: 900.0, radius: 0.0, ..default() };
    commands.spawn((Name::new("lamp"), lamp, Transform::from_xyz(-0.55, 2.1, 0.55), ChildOf(root)));
    let sun = DirectionalLight { illuminance: 900.0, ..default() };
    let pose = Transform::default().looking_to(Vec3::new(-0.75, -0.62, -0.55), Vec3::Y);
    commands.spawn((Name::new("sun"), sun, pose, ChildOf(root)));
    commands.spawn((
        Camera3d::default(),
        Projection::from(PerspectiveProjection { fov: FOV, near: 0.01, ..default() }),
        Transform::from_translation(EYE).looking_at(TARGET, Vec3::Y),
        Exposure { ev100: 7.3 },
        Hdr,
        Tonemapping::KhronosPbrNeutral,
        Msaa::Off,
    ));
}

fn write_scene(started: &BakeStarted, path: &std::path::Path) -> AppExit {
    let mut scene = started.collected.scene.clone();
    // glTF has no radius.
    for light in &mut scene.lights {
        if let LightSource::Point(point) = &mut light.source {
            point.radius = 0.0;
        }
    }
    let bytes = write_glb(&scene, &PathCamera::looking_at(EYE, TARGET, FOV), 4.0 / 3.0);
    match bytes.map_err(|error| error.to_string()).and_then(|b| std::fs::write(path, b).map_err(|e| e.to_string())) {
        Ok(()) => AppExit::Success,
        Err(error) => {
            error!("{} cannot be written: {error}", path.display());
            AppExit::error()
        }
    }
}

fn tell(done: On<BakeDone>) {
    let (report, seams) = (&done.report, &done.report.seams);
    info!(
        "{} surfaces, {} valid texels, {} inside others",
        report.surfaces, report.valid_texels, report.invalid_texels
    );
    info!(
        "seams at {} pairs of points: steps {:.5} before, {:.5} after",
        seams.pairs, seams.step_before, seams.step_after
    );
}

fn fail(failed: On<BakeFailed>, mut exit: MessageWriter<AppExit>) {
    error!("{}", failed.error);
    exit.write(AppExit::error());
}
