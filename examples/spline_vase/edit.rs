//! Control points that the mouse drags.

use bevy::prelude::*;
use bevy::window::PrimaryWindow;
use bevy_radiosity::prelude::*;

/// Within so many pixels of the mouse a control point is taken.
const REACH: f32 = 25.0;

/// Drags control points of surfaces of revolution, bakes again, shows control points.
pub fn plugin(app: &mut App) {
    app.init_resource::<Taken>().add_systems(Update, (take, drag, keys).chain());
}

/// The control point that is being dragged: of which vase, and which one.
#[derive(Resource, Default)]
struct Taken(Option<(Entity, usize)>);

type Eye = (&'static Camera, &'static GlobalTransform);

/// The points of profiles as the mouse sees them: on the side of the vase to the right of the camera.
fn take(
    buttons: Res<ButtonInput<MouseButton>>,
    window: Single<&Window, With<PrimaryWindow>>,
    eye: Single<Eye>,
    vases: Query<(Entity, &SplineSurface, &GlobalTransform)>,
    mut taken: ResMut<Taken>,
) {
    if !buttons.pressed(MouseButton::Left) {
        taken.0 = None;
    }
    let (Some(mouse), true) = (window.cursor_position(), buttons.just_pressed(MouseButton::Left)) else { return };
    let (camera, pose) = *eye;
    let mut nearest = REACH;
    for (entity, surface, place) in &vases {
        let SplineSurface::Revolution { profile, .. } = surface else { continue };
        for (index, point) in profile.points.iter().enumerate() {
            let Ok(seen) = camera.world_to_viewport(pose, place.transform_point(*point)) else { continue };
            if seen.distance(mouse) < nearest {
                nearest = seen.distance(mouse);
                taken.0 = Some((entity, index));
            }
        }
    }
}

/// Where the ray through the mouse meets the plane of the profile.
fn drag(
    window: Single<&Window, With<PrimaryWindow>>,
    eye: Single<Eye>,
    mut vases: Query<(&mut SplineSurface, &GlobalTransform)>,
    taken: Res<Taken>,
) {
    let Some((entity, index)) = taken.0 else { return };
    let (Some(mouse), Ok((mut surface, place))) = (window.cursor_position(), vases.get_mut(entity)) else { return };
    let (camera, pose) = *eye;
    let Ok(ray) = camera.viewport_to_world(pose, mouse) else { return };
    let Some(at) = ray.plane_intersection_point(place.translation(), InfinitePlane3d::new(place.back())) else {
        return;
    };
    let local = place.affine().inverse().transform_point3(at);
    if let SplineSurface::Revolution { profile, .. } = &mut *surface {
        profile.points[index] = Vec3::new(local.x.max(0.0), local.y, 0.0);
    }
}

fn keys(
    keys: Res<ButtonInput<KeyCode>>,
    settings: Res<BakeSettings>,
    vases: Query<(Entity, &SplineSurface, Has<SplineGizmo>)>,
    mut commands: Commands,
    mut exit: MessageWriter<AppExit>,
) {
    if keys.just_pressed(KeyCode::KeyB) {
        commands.trigger(StartBake { settings: settings.clone() });
    }
    if keys.just_pressed(KeyCode::KeyG) {
        for (vase, surface, shown) in &vases {
            match surface {
                SplineSurface::Revolution { .. } if shown => commands.entity(vase).remove::<SplineGizmo>(),
                SplineSurface::Revolution { .. } => commands.entity(vase).insert(SplineGizmo::default()),
                _ => continue,
            };
        }
    }
    if keys.just_pressed(KeyCode::Escape) {
        exit.write(AppExit::Success);
    }
}
