//! A bake from its request to its end, inside an app without a renderer.

use std::fs::File;
use std::path::Path;
use std::time::{Duration, Instant};

use bevy::pbr::Lightmap;
use bevy::prelude::*;
use bevy_radiosity::RadiosityPlugins;
use bevy_radiosity::prelude::*;
use radiosity::bake::{BakeError, Report};
use radiosity_tests::TestFolder;
use radiosity_tests::render::app_without_gpu;

/// What was heard so far.
#[derive(Resource, Default)]
struct Heard {
    started: Vec<usize>,
    progress: Vec<BakeProgress>,
    done: Vec<Report>,
    failed: Vec<BakeError>,
    cancelled: usize,
}

impl Heard {
    fn ends(&self) -> usize {
        self.done.len() + self.failed.len() + self.cancelled
    }
}

fn app(assets: &Path) -> App {
    let mut app = app_without_gpu(assets, RadiosityPlugins);
    app.init_resource::<Heard>()
        .add_observer(|started: On<BakeStarted>, mut heard: ResMut<Heard>| {
            heard.started.push(started.collected.surfaces.len());
        })
        .add_observer(|progress: On<BakeProgress>, mut heard: ResMut<Heard>| heard.progress.push(*progress))
        .add_observer(|done: On<BakeDone>, mut heard: ResMut<Heard>| heard.done.push(done.report.clone()))
        .add_observer(|failed: On<BakeFailed>, mut heard: ResMut<Heard>| heard.failed.push(failed.error.clone()))
        .add_observer(|_: On<BakeCancelled>, mut heard: ResMut<Heard>| heard.cancelled += 1);
    app
}

/// A cube on a floor under a lamp. What `extra` is goes onto the root.
fn spawn_scene(app: &mut App, material: StandardMaterial, extra: impl Bundle) {
    let world = app.world_mut();
    let material = MeshMaterial3d(world.resource_mut::<Assets<StandardMaterial>>().add(material));
    let mut meshes = world.resource_mut::<Assets<Mesh>>();
    let (cube, floor) = (Mesh3d(meshes.add(Cuboid::default())), Mesh3d(meshes.add(Rectangle::new(4.0, 4.0))));
    let lamp = PointLight { intensity: 10_000.0, ..default() };
    world.spawn((
        extra,
        Transform::default(),
        Visibility::default(),
        children![
            (cube, material.clone(), Transform::from_xyz(0.0, 0.0, 0.5)),
            (floor, material),
            (lamp, Transform::from_xyz(1.0, 1.0, 3.0)),
        ],
    ));
}

fn draft() -> BakeSettings {
    BakeSettings { quality: Quality::Draft, resolution: Resolution::TexelsPerMeter(8.0), ..default() }
}

fn wait_until(app: &mut App, is_reached: impl Fn(&Heard) -> bool) {
    let start = Instant::now();
    while !is_reached(app.world().resource::<Heard>()) {
        assert!(start.elapsed() < Duration::from_secs(120), "nothing happens");
        app.update();
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn lightmaps(app: &mut App) -> usize {
    app.world_mut().query::<&Lightmap>().iter(app.world()).count()
}

#[test]
fn bakes_on_load() {
    let folder = TestFolder::new("on_load");
    let mut app = app(folder.path());
    app.insert_resource(draft());
    spawn_scene(&mut app, StandardMaterial::default(), BakeOnLoad);
    wait_until(&mut app, |heard| heard.ends() > 0);
    let heard = app.world().resource::<Heard>();
    assert_eq!(heard.failed, []);
    assert_eq!(heard.started, [2]);
    assert_eq!((heard.done.len(), heard.done[0].surfaces), (1, 2));
    assert!(heard.progress.is_sorted_by(|a, b| a.done <= b.done), "{:?}", heard.progress);
    assert_eq!(lightmaps(&mut app), 2);
    app.world_mut().trigger(RemoveBake);
    app.update();
    assert_eq!(lightmaps(&mut app), 0);
}

#[test]
fn second_bake_changes_no_texel() {
    let folder = TestFolder::new("again");
    let mut app = app(folder.path());
    spawn_scene(&mut app, StandardMaterial::default(), Baked::default());
    let mut images = Vec::new();
    for bakes in 1..=2 {
        app.world_mut().trigger(StartBake { settings: draft() });
        wait_until(&mut app, |heard| heard.ends() == bakes);
        images.push(app.world().resource::<bevy_radiosity::bake::AppliedBake>().bake.images.clone());
    }
    assert!(images[0] == images[1], "the second bake sees what the first one has changed");
}

#[test]
fn cancelled_bake_changes_nothing() {
    let folder = TestFolder::new("cancelled");
    let mut app = app(folder.path());
    spawn_scene(&mut app, StandardMaterial::default(), Baked::default());
    let settings = BakeSettings { quality: Quality::High, resolution: Resolution::TexelsPerMeter(200.0), ..default() };
    app.world_mut().trigger(StartBake { settings });
    wait_until(&mut app, |heard| heard.progress.len() > 2 || heard.ends() > 0);
    app.world_mut().trigger(CancelBake);
    let start = Instant::now();
    wait_until(&mut app, |heard| heard.ends() > 0);
    assert!(start.elapsed() < Duration::from_secs(2), "{:?} to cancel", start.elapsed());
    let heard = app.world().resource::<Heard>();
    assert_eq!((heard.done.len(), heard.failed.len(), heard.cancelled), (0, 0, 1));
    assert_eq!(lightmaps(&mut app), 0);
}

#[test]
fn nothing_to_bake_is_said() {
    let folder = TestFolder::new("nothing");
    let mut app = app(folder.path());
    app.world_mut().trigger(StartBake::default());
    wait_until(&mut app, |heard| heard.ends() > 0);
    assert_eq!(app.world().resource::<Heard>().failed, [BakeError::NothingToBake]);
}

#[test]
fn waits_for_textures_and_not_for_missing_ones() {
    let folder = TestFolder::new("textures");
    let mut encoder = png::Encoder::new(File::create(folder.path().join("red.png")).unwrap(), 64, 64);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&[200, 10, 10].repeat(64 * 64)).unwrap();
    for (file, is_there) in [("red.png", true), ("missing.png", false)] {
        let mut app = app(folder.path());
        let texture = app.world().resource::<AssetServer>().load(file);
        app.insert_resource(draft());
        let material = StandardMaterial { base_color_texture: Some(texture), ..default() };
        spawn_scene(&mut app, material, BakeOnLoad);
        wait_until(&mut app, |heard| heard.ends() > 0);
        let heard = app.world().resource::<Heard>();
        assert_eq!(heard.failed, []);
        let is_named = heard.done[0].warnings.iter().any(|warning| warning.contains(file));
        assert_eq!(is_named, !is_there, "{:?}", heard.done[0].warnings);
    }
}
