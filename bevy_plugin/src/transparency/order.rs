//! The order of the draws of each view.

use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use bevy::render::render_phase::{SortedRenderPhase, ViewSortedRenderPhases};
use bevy::render::sync_world::MainEntity;
use bevy::render::view::{ExtractedView, RetainedViewEntity};
use radiosity::composite::{Draw, Tolerance, ViewDepth, resort};

use super::TransparentDepth;
use super::extract::Moved;
use super::phase::DepthSorted;
use super::place::Places;

/// Depths count as equal that differ by less than this share of them and of the place of the camera: what rounding of
/// single-precision transforms can do.
const EQUAL: f32 = 4.0 * f32::EPSILON;

/// The phases while Bevy's sort looks for them. It would go by places of old, and undo each frame what is in order.
#[derive(Resource)]
pub struct Held<I: DepthSorted>(ViewSortedRenderPhases<I>);

impl<I: DepthSorted> Default for Held<I> {
    fn default() -> Self {
        Self(ViewSortedRenderPhases::default())
    }
}

/// In which order the items of each view were drawn last.
#[derive(Resource)]
pub struct LastOrder<I> {
    views: HashMap<RetainedViewEntity, Vec<ItemKey>>,
    draws: Vec<Draw>,
    scratch: Vec<Draw>,
    phase: std::marker::PhantomData<fn(I)>,
}

impl<I> Default for LastOrder<I> {
    fn default() -> Self {
        Self { views: default(), draws: default(), scratch: default(), phase: default() }
    }
}

type ItemKey = (Entity, MainEntity);

/// In the key of an item: it is a mesh.
const MESH: Entity = Entity::PLACEHOLDER;

pub fn hold<I: DepthSorted>(mut phases: ResMut<ViewSortedRenderPhases<I>>, mut held: ResMut<Held<I>>) {
    std::mem::swap(&mut *phases, &mut held.0);
}

pub fn order<I: DepthSorted>(
    views: Query<&ExtractedView>,
    places: Places,
    moved: Res<Moved>,
    mut phases: ResMut<ViewSortedRenderPhases<I>>,
    mut held: ResMut<Held<I>>,
    mut last: ResMut<LastOrder<I>>,
) {
    std::mem::swap(&mut *phases, &mut held.0);
    last.views.retain(|view, _| phases.contains_key(view));
    for view in &views {
        let Some(phase) = phases.get_mut(&view.retained_view_entity) else { continue };
        if phase.items.is_empty() {
            continue;
        }
        match view_depth(view, &places) {
            Some(depth) => {
                last.follow(phase, view.retained_view_entity, &moved, &places);
                last.order(phase, view, &depth, &places);
            }
            None => {
                last.views.remove(&view.retained_view_entity);
                phase.recalculate_sort_keys(view);
                phase.sort();
            }
        }
    }
}

impl<I: DepthSorted> LastOrder<I> {
    /// Tells the items of a view where they are now.
    fn follow(&self, phase: &mut SortedRenderPhase<I>, view: RetainedViewEntity, moved: &Moved, places: &Places) {
        if !self.views.contains_key(&view) {
            // What has moved until now nobody has followed.
            phase.items.iter_mut().filter(|(key, _)| key.0 == MESH).for_each(|((_, entity), item)| {
                places.center(*entity).into_iter().for_each(|center| item.move_to(center));
            });
            return;
        }
        for &(entity, center) in &moved.0 {
            let Some(item) = phase.items.get_mut(&(MESH, entity)) else { continue };
            center.or_else(|| places.center(entity)).into_iter().for_each(|center| item.move_to(center));
        }
    }

    fn order(&mut self, phase: &mut SortedRenderPhase<I>, view: &ExtractedView, depth: &ViewDepth, places: &Places) {
        let before = self.views.entry(view.retained_view_entity).or_default();
        self.draws.clear();
        let ranks = Ranks::new(before, phase);
        let keyed = phase.items.iter().enumerate().map(|(index, (item_key, item))| {
            let key = places.key(item_key.1, item.sorting_info(), depth);
            Draw { key, rank: ranks.of(index, item_key), index: index as u32 }
        });
        self.draws.extend(keyed);
        self.scratch.resize(self.draws.len(), self.draws[0]);
        let least = EQUAL * view.world_from_view.translation().abs().max_element();
        let tolerance = Tolerance { least, share: EQUAL };
        if let Some(panes) = &places.panes.0 {
            let piece = |index| panes.pieces.get(&phase.items.get_index(index as usize)?.0.1).copied();
            panes.deal(&mut self.draws, piece, view, tolerance);
        }
        resort(&mut self.draws, &mut self.scratch, tolerance);
        rearrange(phase, &self.draws);
        before.clear();
        before.extend(phase.items.keys());
    }
}

/// Where the items of a phase stood in the order before. Most of them stand there still: when others are removed, the
/// last ones take their places.
struct Ranks<'a> {
    before: &'a [ItemKey],
    strays: HashMap<ItemKey, u32>,
}

impl<'a> Ranks<'a> {
    fn new<I: DepthSorted>(before: &'a [ItemKey], phase: &SortedRenderPhase<I>) -> Self {
        let now = phase.items.keys().map(Some).chain(std::iter::repeat(None));
        let strays = before.iter().zip(now).enumerate().filter(|(_, (then, now))| Some(*then) != *now);
        Self { before, strays: strays.map(|(rank, (&then, _))| (then, rank as u32)).collect() }
    }

    fn of(&self, index: usize, key: &ItemKey) -> u32 {
        if self.before.get(index) == Some(key) {
            return index as u32;
        }
        self.strays.get(key).copied().unwrap_or(u32::MAX)
    }
}

/// None where all is to stay as Bevy has it.
fn view_depth(view: &ExtractedView, places: &Places) -> Option<ViewDepth> {
    let (eye, forward) = (view.world_from_view.translation(), *view.world_from_view.forward());
    match places.orders.cameras.get(&view.retained_view_entity.main_entity).copied().unwrap_or_default() {
        TransparentDepth::Planar => Some(ViewDepth::Planar { eye, forward }),
        TransparentDepth::Radial => Some(ViewDepth::Radial { eye }),
        TransparentDepth::Along(direction) => Some(ViewDepth::Axis { axis: *direction }),
        TransparentDepth::AsQueued => None,
    }
}

/// Moves each item to the place of its draw, and tells it the depth that took it there.
fn rearrange<I: DepthSorted>(phase: &mut SortedRenderPhase<I>, draws: &[Draw]) {
    let is_in_place = |(place, draw): (usize, &Draw)| place == draw.index as usize;
    if !draws.iter().enumerate().all(is_in_place) {
        // The map moves its entries with their hashes, where taking them out and in again would hash each.
        let mut places = vec![0_u32; draws.len()];
        draws.iter().for_each(|draw| places[draw.index as usize] = draw.rank);
        phase.items.values_mut().zip(places).for_each(|(item, place)| item.set_distance(f32::from_bits(place)));
        phase.items.sort_by_cached_key(|_, item| item.distance().to_bits());
    }
    phase.items.values_mut().zip(draws).for_each(|(item, draw)| item.set_distance(draw.key.depth()));
}
