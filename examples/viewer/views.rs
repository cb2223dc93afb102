//! What the surfaces show: their light, their color, how their lightmaps are cut, or how good these are.

use std::sync::Arc;

use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::math::Affine2;
use bevy::mesh::UvChannel;
use bevy::pbr::Lightmap;
use bevy::prelude::*;
use bevy_radiosity::bake::{AppliedBake, Collected};
use bevy_radiosity::prelude::*;
use radiosity::render::FalseColor;

use crate::camera::Orbit;
use crate::false_color::{self, densities};

/// Shows the view that is chosen, as soon as there is a bake.
pub fn plugin(app: &mut App) {
    let has_news = resource_changed::<View>.or_else(resource_exists_and_changed::<AppliedBake>);
    app.add_observer(remember).add_systems(Update, (choose, show.run_if(has_news.or_else(any_added))).chain());
}

/// What the surfaces show.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// The scene as a game shows it.
    Lit,
    /// The light alone, on white surfaces.
    Lightmap,
    /// The color of the surfaces alone. So while there is no bake.
    Albedo,
    /// Each chart in a color of its own.
    Charts,
    /// Each patch in a color of its own.
    Patches,
    /// How good the lightmaps are.
    Quality(FalseColor),
}

const VIEWS: [(KeyCode, &str, View); 10] = [
    (KeyCode::Digit1, "lit", View::Lit),
    (KeyCode::Digit2, "lightmap", View::Lightmap),
    (KeyCode::Digit3, "albedo", View::Albedo),
    (KeyCode::Digit4, "invalid", View::Quality(FalseColor::Invalid)),
    (KeyCode::Digit5, "charts", View::Charts),
    (KeyCode::Digit6, "patches", View::Patches),
    (KeyCode::Digit7, "density", View::Quality(FalseColor::Density)),
    (KeyCode::Digit8, "error", View::Quality(FalseColor::Error)),
    (KeyCode::Digit9, "seams", View::Quality(FalseColor::Seams)),
    (KeyCode::Digit0, "truth", View::Quality(FalseColor::Truth)),
];

impl View {
    /// By the name on the command line.
    pub fn named(name: &str) -> Result<Self, String> {
        let found = VIEWS.iter().find(|(_, other, _)| *other == name);
        found.map(|&(_, _, view)| view).ok_or_else(|| format!("there is no view {name}"))
    }
}

/// The material that a surface came with, and which surface of the bake it is.
#[derive(Component)]
struct Own(Handle<StandardMaterial>, usize);

/// What is baked.
#[derive(Resource)]
pub struct Source(pub Arc<Collected>);

fn any_added(surfaces: Query<(), Added<Own>>) -> bool {
    !surfaces.is_empty()
}

/// From now on the bake does not look at materials any more, and views may change them.
fn remember(
    started: On<BakeStarted>,
    mut commands: Commands,
    surfaces: Query<&MeshMaterial3d<StandardMaterial>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    commands.insert_resource(Source(started.collected.clone()));
    for (index, &entity) in started.collected.surfaces.iter().enumerate() {
        let Ok(MeshMaterial3d(own)) = surfaces.get(entity) else { continue };
        if let Some(mut material) = materials.get_mut(own) {
            // Emission is in cd/m2, as the bake takes it.
            material.emissive_exposure_weight = 1.0;
        }
        commands.entity(entity).insert(Own(own.clone(), index));
    }
}

fn choose(keys: Res<ButtonInput<KeyCode>>, mut view: ResMut<View>) {
    for (key, name, chosen) in VIEWS {
        if keys.just_pressed(key) {
            info!("{name}");
            *view = chosen;
        }
    }
}

fn show(
    mut surfaces: Query<(&Own, Option<&Lightmap>, &mut MeshMaterial3d<StandardMaterial>)>,
    view: Res<View>,
    applied: Option<Res<AppliedBake>>,
    source: Option<Res<Source>>,
    mut tonemapping: Single<&mut Tonemapping, With<Orbit>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut images: ResMut<Assets<Image>>,
) {
    let view = if applied.is_some() { *view } else { View::Albedo };
    **tonemapping = match view {
        View::Lit | View::Lightmap => Tonemapping::KhronosPbrNeutral,
        _ => Tonemapping::None,
    };
    let tints = match (view, &applied, &source) {
        (View::Quality(FalseColor::Density), Some(applied), Some(source)) => densities(&source.0.scene, &applied.bake),
        _ => Vec::new(),
    };
    let pictures = applied.map_or_else(Vec::new, |applied| pictures(view, &applied, &mut images));
    let picture_of = |lightmap: &Lightmap| {
        let (_, picture) = pictures.iter().find(|(shown, _)| *shown == lightmap.image.id())?;
        Some((picture.clone(), lightmap.uv_rect))
    };
    for (Own(own, index), lightmap, mut shown) in &mut surfaces {
        let Some(before) = materials.get(own).cloned() else { continue };
        shown.0 = match view {
            View::Lit => own.clone(),
            View::Lightmap => materials.add(white(&before)),
            View::Albedo => materials.add(StandardMaterial { unlit: true, ..before }),
            _ => {
                let tint = tints.get(*index).copied().flatten().unwrap_or(Color::WHITE);
                materials.add(flat(&before, lightmap.and_then(picture_of), tint))
            }
        };
    }
}

/// For each lightmap what the view shows instead, if it does.
fn pictures(view: View, applied: &AppliedBake, images: &mut Assets<Image>) -> Vec<(AssetId<Image>, Handle<Image>)> {
    let picture = |(index, shown): (usize, &Handle<Image>)| {
        Some((shown.id(), images.add(false_color::image(view, &applied.bake, index)?)))
    };
    applied.images.iter().enumerate().filter_map(picture).collect()
}

/// Reflects all light of the lightmap and nothing else.
fn white(before: &StandardMaterial) -> StandardMaterial {
    StandardMaterial { reflectance: 0.0, ..sides_of(before) }
}

/// Shows a picture, times a color, where the lightmap would be; dark where there is none.
fn flat(before: &StandardMaterial, picture: Option<(Handle<Image>, Rect)>, tint: Color) -> StandardMaterial {
    let Some((picture, rect)) = picture else {
        return StandardMaterial { unlit: true, base_color: Color::srgb(0.05, 0.05, 0.05), ..sides_of(before) };
    };
    StandardMaterial {
        unlit: true,
        base_color: tint,
        base_color_texture: Some(picture),
        base_color_channel: UvChannel::Uv1,
        uv_transform: Affine2::from_scale_angle_translation(rect.size(), 0.0, rect.min),
        ..sides_of(before)
    }
}

fn sides_of(before: &StandardMaterial) -> StandardMaterial {
    StandardMaterial { cull_mode: before.cull_mode, double_sided: before.double_sided, ..default() }
}
