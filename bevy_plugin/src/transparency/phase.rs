//! What the phases of transparent things have in common.

use bevy::core_pipeline::core_3d::{Transparent3d, TransparentSortingInfo3d};
use bevy::pbr::Transmissive3d;
use bevy::render::render_phase::SortedPhaseItem;

/// An item that is sorted by its depth.
pub trait DepthSorted: SortedPhaseItem {
    /// Where it was when it was queued.
    fn sorting_info(&self) -> TransparentSortingInfo3d;
    /// What Bevy's sort would have gone by.
    fn set_distance(&mut self, distance: f32);
}

impl DepthSorted for Transparent3d {
    fn sorting_info(&self) -> TransparentSortingInfo3d {
        self.sorting_info
    }

    fn set_distance(&mut self, distance: f32) {
        self.distance = distance;
    }
}

impl DepthSorted for Transmissive3d {
    fn sorting_info(&self) -> TransparentSortingInfo3d {
        self.sorting_info
    }

    fn set_distance(&mut self, distance: f32) {
        self.distance = distance;
    }
}
