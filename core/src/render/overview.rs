//! A pose from which a whole scene is to be seen.

use glam::{Vec2, Vec3};

use super::Camera;
use super::view::View;
use crate::geometry::{Occluders, Ray, Sobol, cosine_direction};
use crate::math;
use crate::scene::Scene;

/// Vertical field of view in radians: 40 degrees from outside, 75 degrees in a room.
const OUTSIDE_FOV: f32 = 0.698;
const INSIDE_FOV: f32 = 1.309;

/// From the middle of the scene to the eye: in front, to the right, above.
const THREE_QUARTERS: Vec3 = Vec3::new(0.5, 0.5, 1.0);

/// A camera that sees the whole scene, obliquely from above.
///
/// One-sided walls let it look in from outside. Where walls all around would show their outer sides instead, it stands
/// inside, at a place from which it sees far. The picture is at least as wide as it is high.
pub fn overview(scene: &Scene) -> Camera {
    let view = View::new(scene);
    if view.corners.is_empty() {
        return Camera::perspective(Default::default(), OUTSIDE_FOV);
    }
    let (low, high) = view.bounds();
    let outside = from_outside(low, high);
    if is_enclosed(&view, low.midpoint(high)) && !looks_in(&view, &outside) {
        from_inside(&view, low, high)
    } else {
        outside
    }
}

/// As near as all corners of the box allow.
fn from_outside(low: Vec3, high: Vec3) -> Camera {
    let center = low.midpoint(high);
    let direction = THREE_QUARTERS.normalize();
    let to_camera = Camera::looking_at(center + direction, center, OUTSIDE_FOV).transform.inverse();
    let slope = math::tan(0.5 * OUTSIDE_FOV);
    let distance = (0..8).map(|corner| {
        let [x, y, z] = [0, 1, 2].map(|axis| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] });
        let offset = to_camera.transform_vector3(Vec3::new(x, y, z) - center);
        offset.x.abs().max(offset.y.abs()) / slope + offset.z
    });
    let distance = distance.fold(1e-3, f32::max);
    Camera::looking_at(center + 1.05 * distance * direction, center, OUTSIDE_FOV)
}

/// Whether hardly any ray from a point leaves the scene.
fn is_enclosed(view: &View, point: Vec3) -> bool {
    const RAYS: u32 = 128;
    let sequence = Sobol::new(0);
    let blocked = (0..RAYS).filter(|&index| {
        let axis = if index % 2 == 0 { Vec3::Y } else { Vec3::NEG_Y };
        let direction = cosine_direction(sequence.square(index), axis);
        view.tree.any(&Ray { origin: point, direction, end: f32::INFINITY }, |_| true)
    });
    blocked.count() as u32 * 100 >= RAYS * 97
}

/// Whether the camera looks through the backs of one-sided walls at half of what it meets first.
fn looks_in(view: &View, camera: &Camera) -> bool {
    let first = rays(camera).filter_map(|ray| view.tree.nearest(&ray));
    let (met, culled) = first.fold((0, 0), |(met, culled), hit| (met + 1, culled + u32::from(!view.shows_side(&hit))));
    2 * culled >= met
}

/// The best of some places and directions: the one from which things are farthest away on average.
fn from_inside(view: &View, low: Vec3, high: Vec3) -> Camera {
    let poses = (0..25).flat_map(|place| (0..8).map(move |yaw| (place, yaw)));
    let cameras = poses.map(|(place, yaw)| {
        let share = Vec3::new((place % 5) as f32, 2.5, (place / 5) as f32) * 0.2 + 0.1;
        let (sin, cos) = math::sin_cos(yaw as f32 * core::f32::consts::FRAC_PI_4);
        let eye = low + (high - low) * share;
        Camera::looking_at(eye, eye + Vec3::new(sin, -0.15, cos), INSIDE_FOV)
    });
    let best = cameras.map(|camera| (visible_depth(view, &camera), camera)).max_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or_else(|| from_outside(low, high), |(_, camera)| camera)
}

/// How far things are on average; what has no visible side does not count.
fn visible_depth(view: &View, camera: &Camera) -> f32 {
    let hits = rays(camera).filter_map(|ray| view.tree.nearest(&ray));
    hits.filter(|hit| view.shows_side(hit)).map(|hit| hit.distance).sum()
}

/// A grid of rays through a square picture.
fn rays(camera: &Camera) -> impl Iterator<Item = Ray> {
    const SIDE: usize = 12;
    (0..SIDE * SIDE).map(|i| {
        let point = (Vec2::new((i % SIDE) as f32, (i / SIDE) as f32) + 0.5) / SIDE as f32;
        camera.ray(point, 1.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::cornell_box;
    use alloc::vec;
    use alloc::vec::Vec;

    /// Where a point stands in a square picture, both coordinates in `[-1, 1]` inside.
    fn project(camera: &Camera, point: Vec3) -> Vec2 {
        let seen = camera.transform.inverse().transform_point3(point);
        seen.truncate() / (-seen.z * math::tan(0.5 * camera.fov_y))
    }

    #[test]
    fn all_vertices_are_in_the_picture_and_fill_it() {
        let scene = cornell_box();
        let camera = overview(&scene);
        let projected: Vec<Vec2> =
            scene.meshes.iter().flat_map(|mesh| &mesh.positions).map(|&vertex| project(&camera, vertex)).collect();
        let widest = projected.iter().map(|point| point.abs().max_element()).fold(0.0, f32::max);
        assert!(widest < 1.0 && widest > 0.8, "{widest}");
    }

    /// With its front shut and all walls double-sided, the box shows nothing to an eye outside.
    #[test]
    fn a_shut_box_is_seen_from_inside() {
        let mut scene = cornell_box();
        let lid = [[0.0, 0.0], [0.5528, 0.0], [0.556, 0.5488], [0.0, 0.5488]].map(|[x, y]| Vec3::new(x, y, 0.0));
        scene.meshes[0].triangles.extend([[4, 5, 6], [4, 6, 7]]);
        scene.meshes[0].positions.extend(lid);
        assert!(!is_in_box(overview(&scene).transform.translation.into()), "one-sided: from outside");
        scene.materials.iter_mut().for_each(|material| material.double_sided = true);
        assert!(is_in_box(overview(&scene).transform.translation.into()), "double-sided: from inside");
    }

    fn is_in_box(eye: Vec3) -> bool {
        eye.cmpgt(Vec3::ZERO).all() && eye.cmplt(Vec3::splat(0.5488)).all()
    }

    #[test]
    fn nothing_to_see() {
        let mut scene = Scene::default();
        assert!(overview(&scene).transform.is_finite());
        let (materials, surfaces) = (cornell_box().materials, cornell_box().surfaces);
        scene = Scene { materials, surfaces: vec![surfaces[0].clone()], meshes: vec![Default::default()], ..scene };
        scene.meshes[0].positions = vec![Vec3::ONE, Vec3::NAN];
        scene.meshes[0].triangles = vec![[0, 0, 0], [0, 0, 1], [0, 1, 7]];
        assert!(overview(&scene).transform.is_finite());
    }
}
