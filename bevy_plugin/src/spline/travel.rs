//! Entities on their way along a curve.

use bevy::prelude::*;

use super::SplinePath;

/// Moves this entity along a [`SplineCurve`](super::SplineCurve) at constant speed: a camera looks ahead, and its up
/// turns about the curve no more than it must.
#[derive(Component, Reflect, Clone, Copy, Debug, PartialEq)]
#[reflect(Component)]
#[require(Transform)]
pub struct TravelAlong {
    /// The entity with the curve.
    pub curve: Entity,
    /// In meters per second in the space of the curve; below 0 it goes backwards, looking ahead.
    pub speed: f32,
    /// How far from the beginning it is, in meters. Set it to jump.
    pub distance: f32,
    /// What comes after the end. A closed curve has none.
    pub end: PathEnd,
}

/// What comes after the end of a way.
#[derive(Reflect, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PathEnd {
    /// Nothing.
    #[default]
    Stop,
    /// The beginning.
    Repeat,
    /// The way back.
    Return,
}

impl TravelAlong {
    /// From the beginning to the end.
    pub fn new(curve: Entity, speed: f32) -> Self {
        Self { curve, speed, distance: 0.0, end: PathEnd::Stop }
    }

    /// Goes on for a time in seconds on a way of this length.
    fn advance(&mut self, seconds: f32, path: &SplinePath) {
        let (length, distance) = (path.length(), self.distance + self.speed * seconds);
        self.distance = match self.end {
            _ if path.is_closed() => distance.rem_euclid(length),
            PathEnd::Stop => distance.clamp(0.0, length),
            PathEnd::Repeat => distance.rem_euclid(length),
            PathEnd::Return => {
                let turns = (distance / length).floor();
                let past = distance - turns * length;
                match turns.rem_euclid(2.0) {
                    0.0 => past,
                    _ => {
                        self.speed = -self.speed;
                        length - past
                    }
                }
            }
        };
    }
}

/// Moves all that travel, to where they are at the end of this frame.
pub(super) fn travel(
    time: Res<Time>,
    curves: Query<&SplinePath>,
    mut travellers: Query<(Entity, &mut TravelAlong, Option<&ChildOf>)>,
    mut transforms: ParamSet<(TransformHelper, Query<&mut Transform>)>,
) {
    let mut poses = Vec::new();
    for (entity, mut travel, parent) in &mut travellers {
        let Ok(path) = curves.get(travel.curve) else { continue };
        if path.length() == 0.0 {
            continue;
        }
        let mut next = *travel;
        next.advance(time.delta_secs(), path);
        travel.set_if_neq(next);
        let helper = transforms.p0();
        let global = |entity| helper.compute_global_transform(entity).unwrap_or_default();
        let into_parent = parent.map_or(GlobalTransform::IDENTITY, |parent| global(parent.parent())).affine().inverse();
        let to_parent = into_parent * global(travel.curve).affine();
        let Some(frame) = path.at(travel.distance) else { continue };
        let [ahead, up] = [frame.tangent, frame.normal].map(|direction| to_parent.transform_vector3(direction));
        let pose = Transform::from_translation(to_parent.transform_point3(frame.point)).looking_to(ahead, up);
        poses.push((entity, pose));
    }
    let mut all = transforms.p1();
    for (entity, pose) in poses {
        if let Ok(mut transform) = all.get_mut(entity) {
            transform.set_if_neq(pose.with_scale(transform.scale));
        }
    }
}
