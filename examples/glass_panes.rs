//! A carousel of glass: on the left drawn in the order in which Bevy 0.19 leaves it, on the right in the order of depth.

#[path = "viewer/windowless.rs"]
mod windowless;

use std::f32::consts::TAU;
use std::path::PathBuf;
use std::time::Duration;

use bevy::camera::{RenderTarget, Viewport};
use bevy::prelude::*;
use bevy::render::render_resource::TextureFormat;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};
use bevy::time::TimeUpdateStrategy;
use bevy_radiosity::transparency::{TransparencyPlugin, TransparentDepth};

const HELP: &str = "\
glass_panes [--screenshot FILE.png]

  Escape: end
  --screenshot: without a window, writes a picture after four seconds of the ride, and ends";

/// Of the picture.
const SIZE: UVec2 = UVec2::new(960, 400);
/// The frame of the picture, a tenth of a second each.
const FRAME: u32 = 40;
const PANES: usize = 14;

/// What turns, in radians per second.
#[derive(Component)]
struct Turns(f32);

#[derive(Component)]
struct Rider;

/// Where the cameras draw, if not in a window.
#[derive(Resource)]
struct Picture(Handle<Image>, PathBuf);

fn main() -> AppExit {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let mut app = App::new();
    match &words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => {
            println!("{HELP}");
            app.add_plugins(DefaultPlugins).add_systems(Update, end);
        }
        ["--screenshot", path] => {
            app.add_plugins(windowless::without_window(DefaultPlugins.build()));
            let image = Image::new_target_texture(SIZE.x, SIZE.y, TextureFormat::Rgba8UnormSrgb, None);
            let image = app.world_mut().resource_mut::<Assets<Image>>().add(image);
            app.insert_resource(Picture(image, path.into()))
                .insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(100)))
                .add_systems(Update, take)
                .add_observer(save);
        }
        _ => {
            eprintln!("{HELP}");
            return AppExit::from_code(2);
        }
    }
    app.add_plugins(TransparencyPlugin)
        .insert_resource(ClearColor(Color::linear_rgb(0.02, 0.025, 0.03)))
        .add_systems(Startup, (spawn_hall, spawn_panes, spawn_cameras))
        .add_systems(Update, (turn, split))
        .run()
}

/// A chequered floor and a few columns, so that one sees through what one looks.
fn spawn_hall(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>, mut paints: ResMut<Assets<StandardMaterial>>) {
    let tile = meshes.add(Plane3d::new(Vec3::Y, Vec2::splat(0.5)));
    let stones = [0.75, 0.2].map(|gray| paints.add(Color::linear_rgb(gray, gray, 0.9 * gray)));
    for (x, z) in (-6_i32..6).flat_map(|x| (-6..6).map(move |z| (x, z))) {
        let place = Transform::from_xyz(x as f32 + 0.5, 0.0, z as f32 + 0.5);
        let stone = stones[(x + z).rem_euclid(2) as usize].clone();
        commands.spawn((Mesh3d(tile.clone()), MeshMaterial3d(stone), place));
    }
    let column = meshes.add(Cylinder::new(0.18, 2.4));
    for (x, z) in [(0.0, 0.0), (-3.5, -3.5), (3.5, -3.5), (-3.5, 3.5), (3.5, 3.5)] {
        let place = Transform::from_xyz(x, 1.2, z);
        commands.spawn((Mesh3d(column.clone()), MeshMaterial3d(stones[0].clone()), place));
    }
    let sun = Transform::default().looking_to(Vec3::new(0.4, -1.0, -0.6), Vec3::Y);
    commands.spawn((DirectionalLight { illuminance: 4000.0, ..default() }, sun));
}

/// In two rings that turn against each other.
fn spawn_panes(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>, mut paints: ResMut<Assets<StandardMaterial>>) {
    let pane = meshes.add(Rectangle::new(0.9, 1.6));
    let rings =
        [0.5, -0.35].map(|speed| commands.spawn((Transform::default(), Visibility::default(), Turns(speed))).id());
    for number in 0..PANES {
        let angle = TAU * number as f32 / PANES as f32;
        let radius = [1.4, 2.3][number % 2];
        let place = Quat::from_rotation_y(angle) * (radius * Vec3::Z);
        let glass = StandardMaterial {
            base_color: Color::hsla(360.0 * (5 * number % PANES) as f32 / PANES as f32, 0.9, 0.5, 0.8),
            alpha_mode: AlphaMode::Blend,
            cull_mode: None,
            double_sided: true,
            ..default()
        };
        commands.spawn((
            Mesh3d(pane.clone()),
            MeshMaterial3d(paints.add(glass)),
            Transform::from_translation(place + 0.9 * Vec3::Y).with_rotation(Quat::from_rotation_y(angle + 0.4)),
            ChildOf(rings[number % 2]),
        ));
    }
}

fn spawn_cameras(mut commands: Commands, picture: Option<Res<Picture>>) {
    let head = commands.spawn((Transform::default(), Visibility::default(), Turns(0.1))).id();
    let place = Transform::from_xyz(0.0, 2.3, 5.4).looking_at(Vec3::new(0.0, 0.8, 0.0), Vec3::Y);
    let ambient = AmbientLight { brightness: 300.0, ..default() };
    for (order, depth) in [(0, TransparentDepth::AsQueued), (1, TransparentDepth::Radial)] {
        // The first one has cleared all of the picture.
        let clear_color = [ClearColorConfig::Default, ClearColorConfig::None][order];
        let camera = Camera { order: order as isize, clear_color, ..default() };
        let mut camera =
            commands.spawn((Camera3d::default(), camera, depth, place, ambient.clone(), Rider, ChildOf(head)));
        if let Some(picture) = &picture {
            camera.insert(RenderTarget::Image(picture.0.clone().into()));
        }
    }
}

fn turn(time: Res<Time>, mut all: Query<(&mut Transform, &Turns)>) {
    for (mut transform, Turns(speed)) in &mut all {
        transform.rotate_y(speed * time.delta_secs());
    }
}

/// Each camera has its half, whatever the size of the window.
fn split(mut cameras: Query<&mut Camera, With<Rider>>) {
    for mut camera in &mut cameras {
        let Some(size) = camera.physical_target_size() else { continue };
        let half = UVec2::new((size.x / 2).saturating_sub(2).max(1), size.y.max(1));
        let left = camera.order as u32 * (size.x - half.x);
        camera.viewport = Some(Viewport { physical_position: UVec2::new(left, 0), physical_size: half, ..default() });
    }
}

fn take(mut commands: Commands, picture: Res<Picture>, mut frame: Local<u32>) {
    *frame += 1;
    if *frame == FRAME {
        commands.spawn(Screenshot::image(picture.0.clone()));
    }
}

fn save(captured: On<ScreenshotCaptured>, picture: Res<Picture>, mut exit: MessageWriter<AppExit>) {
    exit.write(match windowless::write(&captured.image, 1, &picture.1) {
        Ok(()) => AppExit::Success,
        Err(error) => {
            error!("{} cannot be written: {error}", picture.1.display());
            AppExit::error()
        }
    });
}

fn end(keys: Res<ButtonInput<KeyCode>>, mut exit: MessageWriter<AppExit>) {
    if keys.just_pressed(KeyCode::Escape) {
        exit.write(AppExit::Success);
    }
}
