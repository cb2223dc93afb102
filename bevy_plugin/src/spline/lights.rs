//! Lights along a curve.

use bevy::light::{PointLight, SpotLight};
use bevy::prelude::*;

use super::SplinePath;

/// Puts lights on a [`SplineCurve`](super::SplineCurve), in the middles of equal parts of its length.
///
/// They are children of the curve, so that they are baked with it, and go when this component is removed.
#[derive(Component, Reflect, Clone, Debug)]
#[reflect(Component)]
#[require(Visibility)]
pub struct LightsAlong {
    /// How many.
    pub count: usize,
    /// What each is.
    pub light: LightAlong,
}

/// A light of many.
#[derive(Reflect, Clone, Debug)]
pub enum LightAlong {
    /// It shines to all sides.
    Point(PointLight),
    /// It shines away from the side that [`SplineCurve::up`](super::SplineCurve::up) says.
    Spot(SpotLight),
}

/// On a light that [`LightsAlong`] put there: its number.
#[derive(Component, Reflect, Clone, Copy, Debug, PartialEq, Eq)]
#[reflect(Component)]
pub struct LightOnCurve(pub usize);

type Curve<'w> = (Entity, Ref<'w, LightsAlong>, &'w SplinePath, Option<&'w Children>);
type ChangedLights = Or<(Changed<LightsAlong>, Changed<SplinePath>)>;

/// As many lights as there shall be, where they shall be.
pub(super) fn update_lights(
    mut commands: Commands,
    curves: Query<Curve<'static>, ChangedLights>,
    mut lights: Query<(&LightOnCurve, &mut Transform)>,
) {
    for (curve, along, path, children) in &curves {
        let poses: Vec<Transform> = path
            .evenly(along.count)
            .map(|frame| Transform::from_translation(frame.point).looking_to(-frame.normal, frame.tangent))
            .collect();
        let mut is_there = vec![false; poses.len()];
        for &child in children.into_iter().flatten() {
            let Ok((&LightOnCurve(index), mut transform)) = lights.get_mut(child) else { continue };
            match poses.get(index) {
                Some(pose) => {
                    *transform = *pose;
                    is_there[index] = true;
                    if along.is_changed() {
                        light(&mut commands.entity(child), &along.light);
                    }
                }
                None => commands.entity(child).despawn(),
            }
        }
        for (index, pose) in poses.into_iter().enumerate().filter(|(index, _)| !is_there[*index]) {
            light(&mut commands.spawn((LightOnCurve(index), pose, ChildOf(curve))), &along.light);
        }
    }
}

/// The lights go with what put them there.
pub(super) fn remove_lights(
    removed: On<Remove, LightsAlong>,
    curves: Query<&Children>,
    lights: Query<(), With<LightOnCurve>>,
    mut commands: Commands,
) {
    for &child in curves.get(removed.entity).into_iter().flatten() {
        if lights.contains(child) {
            // They may go with their curve, too.
            commands.entity(child).try_despawn();
        }
    }
}

fn light(entity: &mut EntityCommands, light: &LightAlong) {
    match light {
        LightAlong::Point(light) => entity.remove::<SpotLight>().insert(*light),
        LightAlong::Spot(light) => entity.remove::<PointLight>().insert(*light),
    };
}
