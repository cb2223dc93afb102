//! A picture of the baked scene without a window.

use std::path::PathBuf;

use bevy::camera::RenderTarget;
use bevy::prelude::*;
use bevy::render::render_resource::TextureFormat;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};
use bevy_radiosity::bake::AppliedBake;

use crate::windowless::write;

/// Of the picture; twice as many pixels are drawn in each direction.
const SIZE: [u32; 2] = [960, 720];
/// After which the bake is seen.
const FRAMES: usize = 8;

#[derive(Resource)]
struct Picture {
    image: Handle<Image>,
    path: PathBuf,
}

/// Waits for the bake, takes the picture and ends the app.
pub fn plugin(path: PathBuf) -> impl Fn(&mut App) + Send + Sync + 'static {
    move |app| {
        let path = path.clone();
        let draw_into_image =
            move |mut commands: Commands, camera: Single<(Entity, &mut Camera)>, mut images: ResMut<Assets<Image>>| {
                let (entity, mut camera) = camera.into_inner();
                // It rests until there is something to see.
                camera.is_active = false;
                let [width, height] = SIZE.map(|side| 2 * side);
                let image = images.add(Image::new_target_texture(width, height, TextureFormat::Rgba8UnormSrgb, None));
                commands.entity(entity).insert(RenderTarget::Image(image.clone().into()));
                commands.insert_resource(Picture { image, path: path.clone() });
            };
        app.add_systems(PostStartup, draw_into_image)
            .add_systems(Update, take.run_if(resource_exists::<AppliedBake>))
            .add_observer(save);
    }
}

fn take(mut commands: Commands, mut camera: Single<&mut Camera>, picture: Res<Picture>, mut frame: Local<usize>) {
    camera.is_active = true;
    *frame += 1;
    if *frame == FRAMES {
        commands.spawn(Screenshot::image(picture.image.clone()));
    }
}

fn save(captured: On<ScreenshotCaptured>, picture: Res<Picture>, mut exit: MessageWriter<AppExit>) {
    exit.write(match write(&captured.image, 2, &picture.path) {
        Ok(()) => AppExit::Success,
        Err(error) => {
            error!("{} cannot be written: {error}", picture.path.display());
            AppExit::error()
        }
    });
}
