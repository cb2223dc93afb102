//! A picture of a view without a window.

use bevy::camera::RenderTarget;
use bevy::prelude::*;
use bevy::render::render_resource::TextureFormat;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};

use crate::args::Args;
use crate::camera::Orbit;
use crate::truth::is_ready;
use crate::windowless::write;

const SIZE: [u32; 2] = [640, 480];
/// After which the bake is seen.
const FRAMES: usize = 8;

/// Waits for the bake, takes the picture and ends the app.
pub fn plugin(app: &mut App) {
    app.add_systems(PostStartup, draw_into_image).add_systems(Update, take.run_if(is_ready)).add_observer(save);
}

#[derive(Resource)]
struct Picture(Handle<Image>);

/// The camera rests until there is something to see.
fn draw_into_image(
    mut commands: Commands,
    camera: Single<(Entity, &mut Camera), With<Orbit>>,
    mut images: ResMut<Assets<Image>>,
) {
    let (entity, mut camera) = camera.into_inner();
    camera.is_active = false;
    let picture = images.add(Image::new_target_texture(SIZE[0], SIZE[1], TextureFormat::Rgba8UnormSrgb, None));
    commands.entity(entity).insert(RenderTarget::Image(picture.clone().into()));
    commands.insert_resource(Picture(picture));
}

fn take(
    mut commands: Commands,
    mut camera: Single<&mut Camera, With<Orbit>>,
    picture: Res<Picture>,
    mut frame: Local<usize>,
) {
    camera.is_active = true;
    *frame += 1;
    if *frame == FRAMES {
        commands.spawn(Screenshot::image(picture.0.clone()));
    }
}

fn save(captured: On<ScreenshotCaptured>, args: Res<Args>, mut exit: MessageWriter<AppExit>) {
    let path = args.screenshot.clone().unwrap_or_default();
    exit.write(match write(&captured.image, 1, &path) {
        Ok(()) => AppExit::Success,
        Err(error) => {
            error!("{} cannot be written: {error}", path.display());
            AppExit::error()
        }
    });
}
