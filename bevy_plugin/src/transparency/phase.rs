//! What the phases of transparent things have in common.

use bevy::core_pipeline::core_3d::{Transparent3d, TransparentSortingInfo3d};
use bevy::math::Vec3;
use bevy::pbr::Transmissive3d;
use bevy::render::render_phase::SortedPhaseItem;

/// An item that is sorted by its depth.
pub trait DepthSorted: SortedPhaseItem {
    /// Where it was when it was queued, or moved.
    fn sorting_info(&self) -> TransparentSortingInfo3d;
    /// It has moved; what is always on top stays there.
    fn move_to(&mut self, center: Vec3);
    /// What Bevy's sort would have gone by.
    fn distance(&self) -> f32;
    /// Tells what [`distance`](Self::distance) returns.
    fn set_distance(&mut self, distance: f32);
}

impl DepthSorted for Transparent3d {
    fn sorting_info(&self) -> TransparentSortingInfo3d {
        self.sorting_info
    }

    fn move_to(&mut self, center: Vec3) {
        move_center(&mut self.sorting_info, center);
    }

    fn distance(&self) -> f32 {
        self.distance
    }

    fn set_distance(&mut self, distance: f32) {
        self.distance = distance;
    }
}

impl DepthSorted for Transmissive3d {
    fn sorting_info(&self) -> TransparentSortingInfo3d {
        self.sorting_info
    }

    fn move_to(&mut self, center: Vec3) {
        move_center(&mut self.sorting_info, center);
    }

    fn distance(&self) -> f32 {
        self.distance
    }

    fn set_distance(&mut self, distance: f32) {
        self.distance = distance;
    }
}

fn move_center(info: &mut TransparentSortingInfo3d, center: Vec3) {
    if let TransparentSortingInfo3d::Sorted { mesh_center, .. } = info {
        *mesh_center = center;
    }
}
