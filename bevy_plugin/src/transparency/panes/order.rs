//! The order of cut panes, exact for every camera.

use bevy::prelude::*;
use bevy::render::sync_world::MainEntityHashMap;
use bevy::render::view::ExtractedView;
use radiosity::composite::{BspTree, Draw, DrawKey, Tolerance, Viewpoint};

use super::outline::Outline;

/// So many pieces there can be.
pub const PIECES: usize = 512;

/// Panes that were cut, and who draws their pieces.
pub struct CutPanes {
    pub tree: Box<BspTree<PIECES>>,
    /// The numbers of the pieces in the tree.
    pub pieces: MainEntityHashMap<usize>,
}

impl CutPanes {
    /// Puts the pieces among `draws` nearer that cover others which would come after them: nearer than what counts as equal.
    /// All else keeps its depth, so that what is no pane stays before and behind as much as it can.
    pub fn deal(
        &self,
        draws: &mut [Draw],
        piece: impl Fn(u32) -> Option<usize>,
        view: &ExtractedView,
        equal: Tolerance,
    ) {
        let mut draw_of = vec![None; self.tree.len()];
        for (at, draw) in draws.iter().enumerate() {
            let draw_of = piece(draw.index).and_then(|number| draw_of.get_mut(number));
            draw_of.into_iter().for_each(|draw_of| *draw_of = Some(at));
        }
        let clip_from_world = view.clip_from_view * view.world_from_view.to_matrix().inverse();
        let outlines: Vec<_> =
            self.tree.pieces().map(|piece| Outline::new(piece.corners(), &clip_from_world)).collect();
        let mut dealt: Vec<(DrawKey, usize)> = Vec::with_capacity(outlines.len());
        for number in self.tree.order(viewpoint(view)) {
            let Some(draw) = draw_of[number].and_then(|at| draws.get_mut(at)) else { continue };
            for (before, other) in &dealt {
                let nearer = equal.end(equal.end(before.depth()));
                let is_wrong = before.group() == draw.key.group() && nearer > draw.key.depth();
                if is_wrong && outlines[*other].overlaps(&outlines[number]) {
                    draw.key = draw.key.at(nearer);
                }
            }
            dealt.push((draw.key, number));
        }
    }
}

/// From where a camera looks at panes.
fn viewpoint(view: &ExtractedView) -> Viewpoint {
    // The last row of a projection without perspective.
    match view.clip_from_view.w_axis.w {
        1.0 => Viewpoint::Direction(*view.world_from_view.forward()),
        _ => Viewpoint::Eye(view.world_from_view.translation()),
    }
}
