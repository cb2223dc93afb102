//! The order of cut panes, exact for every camera.

use bevy::prelude::*;
use bevy::render::sync_world::MainEntityHashMap;
use bevy::render::view::ExtractedView;
use radiosity::composite::{BspTree, Draw, Viewpoint};

/// So many pieces there can be.
pub const PIECES: usize = 512;

/// Panes that were cut, and who draws their pieces.
pub struct CutPanes {
    pub tree: Box<BspTree<PIECES>>,
    /// The numbers of the pieces in the tree.
    pub pieces: MainEntityHashMap<usize>,
}

impl CutPanes {
    /// Deals the depths of the pieces among `draws` out anew, the farthest to the piece at the back; so everything else
    /// stays before and behind as many of them as it was. From one piece to the next they then differ by `gap` at least.
    pub fn deal(&self, draws: &mut [Draw], piece: impl Fn(u32) -> Option<usize>, viewpoint: Viewpoint, gap: f32) {
        let mut places = vec![0; self.tree.len()];
        self.tree.order(viewpoint).enumerate().for_each(|(place, number)| places[number] = place);
        let mut members: Vec<(u64, usize, usize)> = draws
            .iter()
            .enumerate()
            .filter_map(|(at, draw)| Some((draw.key.group(), *places.get(piece(draw.index)?)?, at)))
            .collect();
        members.sort_unstable();
        let mut keys: Vec<_> = members.iter().map(|&(.., at)| draws[at].key).collect();
        keys.sort_unstable();
        let mut last = None;
        for (&(group, _, at), key) in members.iter().zip(keys) {
            let depth = match last {
                Some((before, depth)) if before == group => key.depth().max(depth + gap),
                _ => key.depth(),
            };
            draws[at].key = key.at(depth);
            last = Some((group, depth));
        }
    }
}

/// From where a camera looks at panes.
pub fn viewpoint(view: &ExtractedView) -> Viewpoint {
    // The last row of a projection without perspective.
    match view.clip_from_view.w_axis.w {
        1.0 => Viewpoint::Direction(*view.world_from_view.forward()),
        _ => Viewpoint::Eye(view.world_from_view.translation()),
    }
}
