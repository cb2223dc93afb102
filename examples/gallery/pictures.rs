//! What Bevy shows of baked scenes, one after the other.

use std::collections::VecDeque;
use std::error::Error;
use std::path::{Path, PathBuf};

use bevy::camera::{Exposure, Hdr, RenderTarget};
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::pbr::Lightmap;
use bevy::prelude::*;
use bevy::render::render_resource::TextureFormat;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};
use bevy_radiosity::RadiosityPlugins;
use bevy_radiosity::baked::{BakedScene, BakedSceneRoot};

use crate::model::Exhibit;
use crate::windowless::{without_window, write};

const HEIGHT: f32 = 540.0;
/// Pixels that are drawn for one of the picture, in each direction. Samples within a pixel, as `Msaa` has them, would look
/// lightmaps up outside of the triangle that they show, and so beside its chart.
const SAMPLES: u32 = 2;
/// After which everything is seen.
const FRAMES: usize = 10;

/// Takes a picture of each scene that was baked into a folder of its name in `folder`, which is absolute.
pub fn take(exhibits: Vec<Exhibit>, folder: &Path) -> Result<(), Box<dyn Error>> {
    let defaults = DefaultPlugins.set(AssetPlugin { file_path: folder.display().to_string(), ..default() });
    let exit = App::new()
        .add_plugins((without_window(defaults), RadiosityPlugins))
        .insert_resource(GlobalAmbientLight::NONE)
        .insert_resource(ClearColor(Color::BLACK))
        .insert_resource(Tour { waiting: exhibits.into(), folder: folder.to_owned() })
        .add_systems(Startup, go_on)
        .add_systems(Update, (look, shoot).chain())
        .add_observer(save)
        .run();
    if exit.is_success() { Ok(()) } else { Err("Bevy could not show the scenes".into()) }
}

/// The scenes that are still to be seen, that on show first.
#[derive(Resource)]
struct Tour {
    waiting: VecDeque<Exhibit>,
    folder: PathBuf,
}

/// The scene on show, and for how many frames it has been complete.
#[derive(Component)]
struct OnShow {
    baked: Handle<BakedScene>,
    picture: Handle<Image>,
    frames: usize,
}

/// Spawns the next scene or ends the app.
fn go_on(
    mut commands: Commands,
    tour: Res<Tour>,
    assets: Res<AssetServer>,
    mut images: ResMut<Assets<Image>>,
    mut exit: MessageWriter<AppExit>,
) {
    let Some(Exhibit { name, aspect, .. }) = tour.waiting.front() else {
        exit.write(AppExit::Success);
        return;
    };
    let size = [HEIGHT * aspect, HEIGHT].map(|side| SAMPLES * side.round() as u32);
    let picture = images.add(Image::new_target_texture(size[0], size[1], TextureFormat::Rgba8UnormSrgb, None));
    let baked = assets.load(format!("{name}/manifest.json"));
    let scene = GltfAssetLabel::Scene(0).from_asset(format!("{name}/scene.glb"));
    commands.spawn((
        WorldAssetRoot(assets.load(scene)),
        BakedSceneRoot(baked.clone()),
        OnShow { baked, picture, frames: 0 },
    ));
}

/// Looks through the camera of the scene as soon as it is there.
fn look(
    mut commands: Commands,
    mut cameras: Query<(Entity, &mut Projection), Added<Camera>>,
    show: Single<&OnShow>,
    tour: Res<Tour>,
) {
    let Some(Exhibit { ev100, .. }) = tour.waiting.front() else { return };
    for (camera, mut lens) in &mut cameras {
        // So that it fits the new target.
        lens.set_changed();
        let exposure = Exposure { ev100: *ev100 };
        let target = RenderTarget::Image(show.picture.clone().into());
        commands.entity(camera).insert((target, exposure, Hdr, Msaa::Off, Tonemapping::KhronosPbrNeutral));
    }
}

/// Takes the picture when all surfaces have their light.
fn shoot(
    mut commands: Commands,
    mut show: Single<&mut OnShow>,
    scenes: Res<Assets<BakedScene>>,
    lit: Query<(), With<Lightmap>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    let Some(scene) = scenes.get(&show.baked) else { return };
    if lit.iter().count() < scene.manifest.surfaces.len() {
        return;
    }
    if show.frames == 0 {
        let ids: Vec<_> = materials.ids().collect();
        for id in ids {
            // Diffuse alone, as a bake has it, and emission in cd/m2.
            if let Some(mut material) = materials.get_mut(id) {
                (material.reflectance, material.emissive_exposure_weight) = (0.0, 1.0);
            }
        }
    }
    show.frames += 1;
    if show.frames == FRAMES {
        commands.spawn(Screenshot::image(show.picture.clone()));
    }
}

fn save(
    captured: On<ScreenshotCaptured>,
    mut commands: Commands,
    show: Single<Entity, With<OnShow>>,
    mut tour: ResMut<Tour>,
    mut exit: MessageWriter<AppExit>,
) {
    let Some(Exhibit { name, ev100, .. }) = tour.waiting.pop_front() else { return };
    let path = tour.folder.join(name).with_extension("png");
    if let Err(error) = write(&captured.image, SAMPLES, &path) {
        error!("{} cannot be written: {error}", path.display());
        exit.write(AppExit::error());
        return;
    }
    println!("{}: EV100 {ev100}", path.display());
    commands.entity(*show).despawn();
    commands.run_system_cached(go_on);
}
