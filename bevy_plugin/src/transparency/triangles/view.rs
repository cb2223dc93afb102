//! The camera for which triangles are sorted.

use bevy::camera::visibility::RenderLayers;
use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use radiosity::composite::ViewDepth;

use super::super::TransparentDepth;

type Seeing =
    (&'static Camera, &'static GlobalTransform, Option<&'static TransparentDepth>, Option<&'static RenderLayers>);

/// All cameras that draw.
#[derive(SystemParam)]
pub struct Cameras<'w, 's> {
    all: Query<'w, 's, Seeing, With<Camera3d>>,
}

/// A camera as a mesh sees it.
#[derive(Clone, Copy, Debug)]
pub struct LocalView {
    /// In the world.
    pub depth: ViewDepth,
    /// In the space of the mesh.
    eye: Vec3,
    /// In the space of the mesh; zero where only the eye counts.
    forward: Vec3,
}

impl Cameras<'_, '_> {
    /// The nearest active camera that sees one of these layers; none where a transform is not finite or cannot be inverted.
    pub fn nearest(&self, mesh: &GlobalTransform, layers: Option<&RenderLayers>, center: Vec3) -> Option<LocalView> {
        let center = mesh.transform_point(center);
        let layers = layers.unwrap_or_default();
        let is_seen = |seen: Option<&RenderLayers>| seen.unwrap_or_default().intersects(layers);
        let active = self.all.iter().filter(|&(camera, .., seen)| camera.is_active && is_seen(seen));
        let distance = |place: &GlobalTransform| place.translation().distance_squared(center);
        let nearest = active.min_by(|(_, a, ..), (_, b, ..)| distance(a).total_cmp(&distance(b)));
        let view = nearest.map(|(_, place, depth, _)| LocalView::new(mesh, place, depth.copied().unwrap_or_default()));
        view.filter(|view| view.eye.is_finite() && view.forward.is_finite())
    }
}

impl LocalView {
    fn new(mesh: &GlobalTransform, camera: &GlobalTransform, depth: TransparentDepth) -> Self {
        let local_from_world = mesh.affine().inverse();
        let (eye, forward) = (camera.translation(), *camera.forward());
        let (depth, forward) = match depth {
            TransparentDepth::Planar | TransparentDepth::AsQueued => (ViewDepth::Planar { eye, forward }, forward),
            TransparentDepth::Radial => (ViewDepth::Radial { eye }, Vec3::ZERO),
            TransparentDepth::Along(axis) => (ViewDepth::Axis { axis: *axis }, *axis),
        };
        let forward = local_from_world.transform_vector3(forward).normalize_or_zero();
        Self { depth, eye: local_from_world.transform_point3(eye), forward }
    }

    /// Whether the triangles are to be sorted anew.
    pub fn differs(&self, before: Option<&Self>, turn: f32, center: Vec3) -> bool {
        let Some(before) = before else { return true };
        let moved = self.eye.distance(before.eye) > turn * self.eye.distance(center);
        // Not by its cosine, which is 1 for all small angles.
        let turned = self.forward.distance(before.forward) > turn;
        moved || turned
    }
}
