//! Panes that run through each other, or overlap in a cycle: no order of whole meshes is right, so they are cut.

mod carried;
mod fragment;
mod order;
mod outline;

use std::sync::Arc;

use bevy::asset::AssetEventSystems;
use bevy::camera::visibility::VisibilitySystems;
use bevy::ecs::component::ComponentId;
use bevy::ecs::system::SystemState;
use bevy::math::Affine3A;
use bevy::platform::collections::HashSet;
use bevy::prelude::*;
use bevy::render::Extract;
use bevy::render::sync_world::MainEntity;
use bevy::transform::TransformSystems;
use radiosity::composite::{BspTree, SplitError};

use super::triangle_list::TriangleList;
use crate::bake::NotBaked;
use crate::stand_in::{StandIn, given_mesh};
use carried::{carried, carry, carry_changes};
use fragment::{Source, can_be_cut, fragment};

pub use carried::PieceComponents;
pub use order::{CutPanes, PIECES};

/// Cuts the triangles of this entity's mesh where they run through those of others that have this component, and draws
/// the pieces in an order that is right for every camera.
///
/// For panes, a few hundred triangles in all: it is done anew whenever one of them moves. The entity draws the first of
/// its pieces, children of it the others, with its [`PieceComponents`]: material, lightmap and so on. Within one
/// layer and priority the order is exact among the panes; others are drawn between them by depth. A bake sees the mesh
/// as it was given. Without this component the entity gets its mesh back.
#[derive(Component, Reflect, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[reflect(Component, Default, Clone, PartialEq)]
pub struct SplitPane;

/// Cuts panes; part of [`TransparencyPlugin`](super::TransparencyPlugin).
pub(super) fn plugin(app: &mut App) {
    app.init_resource::<Panes>()
        .init_resource::<PieceComponents>()
        .add_systems(
            PostUpdate,
            update_panes
                .after(TransformSystems::Propagate)
                .before(VisibilitySystems::VisibilityPropagate)
                .before(AssetEventSystems)
                .run_if(are_there_panes),
        )
        .add_observer(give_back);
}

/// In the render world: the panes as they are cut in this frame.
#[derive(Resource, Default)]
pub struct ExtractedPanes(pub Option<Arc<CutPanes>>);

pub(super) fn extract_panes(mut extracted: ResMut<ExtractedPanes>, panes: Extract<Res<Panes>>) {
    extracted.0.clone_from(&panes.cut);
}

/// All panes and what became of them.
#[derive(Resource, Default)]
pub(super) struct Panes {
    known: Vec<Pane>,
    cut: Option<Arc<CutPanes>>,
    /// Why some stay whole. What does not change is said once.
    reasons: Vec<String>,
}

/// A pane as it was when it was cut.
#[derive(Clone, PartialEq)]
struct Pane {
    entity: Entity,
    mesh: Handle<Mesh>,
    is_loaded: bool,
    /// It and all of its children draw its pieces.
    is_cut: bool,
    /// Zero where it is not finite.
    place: Affine3A,
    carried: Vec<ComponentId>,
}

/// On a pane: who draws its other pieces. A clone of the pane gets its own.
#[derive(Component, Default)]
#[component(clone_behavior = Ignore)]
struct Pieces(Vec<Entity>);

/// On what draws a piece: the mesh that it draws is its own. A clone of it draws the same one, and must not write to it.
#[derive(Component)]
#[component(clone_behavior = Ignore)]
struct OwnsMesh;

/// A piece of a pane: its number, the number of its pane, and its mesh.
type Part = (usize, usize, Mesh);

fn are_there_panes(panes: Res<Panes>, split: Query<(), With<SplitPane>>) -> bool {
    !panes.known.is_empty() || !split.is_empty()
}

fn update_panes(world: &mut World, events: &mut SystemState<MessageReader<AssetEvent<Mesh>>>) {
    let modified: HashSet<AssetId<Mesh>> = match events.get_mut(world) {
        Ok(mut events) => events.read().filter_map(super::triangles::modified_id).collect(),
        Err(_) => return,
    };
    let panes = panes(world);
    let is_modified = panes.iter().any(|pane| modified.contains(&pane.mesh.id()));
    if panes == world.resource::<Panes>().known && !is_modified {
        return carry_changes(world, panes.iter().map(|pane| (pane.entity, &pane.carried[..])));
    }
    let mut reasons = Vec::new();
    let cut = match cut(world, &panes, &mut reasons) {
        Ok((_, parts)) if parts.is_empty() => {
            panes.iter().for_each(|pane| make_whole(world, pane.entity));
            None
        }
        Ok((tree, parts)) => Some(show(world, &panes, tree, parts)),
        Err(error) => {
            reasons.push(format!("all panes stay whole: {error}"));
            panes.iter().for_each(|pane| make_whole(world, pane.entity));
            None
        }
    };
    let said = &world.resource::<Panes>().reasons;
    reasons.iter().filter(|reason| !said.contains(reason)).for_each(|reason| warn!("{reason}"));
    let known = self::panes(world);
    world.insert_resource(Panes { known, cut, reasons });
}

/// In the order of their entities, so that equal worlds are cut alike.
fn panes(world: &mut World) -> Vec<Pane> {
    type Given<'a> = (
        (Entity, &'a Mesh3d, Option<&'a StandIn>, Has<OwnsMesh>),
        (&'a GlobalTransform, Option<&'a Pieces>, Option<&'a Children>),
    );
    let mut all = world.query_filtered::<Given, With<SplitPane>>();
    let mut panes: Vec<Pane> = all
        .iter(world)
        .map(|((entity, drawn, stand_in, owns), (place, pieces, children))| {
            let mesh = given_mesh(drawn, stand_in).clone();
            let has_all = pieces
                .into_iter()
                .flat_map(|pieces| &pieces.0)
                .all(|&piece| children.is_some_and(|children| children.contains(&piece)));
            let is_cut = has_all && owns && mesh != drawn.0;
            let place = Some(place.affine()).filter(Affine3A::is_finite).unwrap_or(Affine3A::ZERO);
            Pane { entity, mesh, is_loaded: false, is_cut, place, carried: Vec::new() }
        })
        .collect();
    panes.sort_by_key(|pane| pane.entity);
    let meshes = world.resource::<Assets<Mesh>>();
    panes.iter_mut().for_each(|pane| pane.is_loaded = meshes.contains(&pane.mesh));
    panes.iter_mut().for_each(|pane| pane.carried = carried(world, pane.entity));
    panes
}

/// A tree of all triangles, and for each of its pieces the pane and the mesh.
fn cut(
    world: &World,
    panes: &[Pane],
    reasons: &mut Vec<String>,
) -> Result<(Box<BspTree<PIECES>>, Vec<Part>), SplitError> {
    let meshes = world.resource::<Assets<Mesh>>();
    let mut tree = Box::<BspTree<PIECES>>::default();
    let mut sources = Vec::new();
    for (number, pane) in panes.iter().enumerate() {
        let Some(mesh) = meshes.get(&pane.mesh) else { continue };
        let list = match TriangleList::of(mesh).and_then(|list| can_be_cut(mesh).map(|()| list)) {
            Ok(list) => list,
            Err(reason) => {
                reasons.push(format!("the pane {} stays whole: {reason}", label(world, pane.entity)));
                continue;
            }
        };
        for &vertices in &list.corners {
            let corners = list.points(vertices).map(|point| pane.place.transform_point3(point));
            match tree.insert(&corners, sources.len() as u32) {
                Ok(()) => sources.push((number, mesh, Source { vertices, corners })),
                // Nobody sees it.
                Err(SplitError::Degenerate) => {}
                Err(error) => return Err(error),
            }
        }
    }
    let mut parts = Vec::new();
    for (piece, part) in tree.pieces().enumerate() {
        let (number, mesh, source) = &sources[part.source as usize];
        parts.push((piece, *number, fragment(mesh, source, part.corners())));
    }
    Ok((tree, parts))
}

fn label(world: &World, entity: Entity) -> String {
    world.get::<Name>(entity).map_or_else(|| entity.to_string(), |name| format!("\"{name}\""))
}

/// Gives the pieces to the panes and their children.
fn show(world: &mut World, panes: &[Pane], tree: Box<BspTree<PIECES>>, parts: Vec<Part>) -> Arc<CutPanes> {
    let mut drawn_by = vec![Vec::new(); panes.len()];
    let mut pieces = Vec::with_capacity(parts.len());
    for (piece, number, mesh) in parts {
        let pane = &panes[number];
        let count: usize = drawn_by[number].len();
        let entity = match count {
            0 => pane.entity,
            _ => child(world, pane, count - 1),
        };
        drawn_by[number].push(entity);
        draw(world, entity, &pane.mesh, mesh);
        pieces.push((MainEntity::from(entity), piece));
    }
    for (pane, drawn_by) in panes.iter().zip(drawn_by) {
        match drawn_by.len() {
            0 => make_whole(world, pane.entity),
            count => keep_children(world, pane.entity, count - 1),
        }
    }
    Arc::new(CutPanes { tree, pieces: pieces.into_iter().collect() })
}

/// The child that draws a piece; those that are there already are used again.
fn child(world: &mut World, pane: &Pane, number: usize) -> Entity {
    let known = world.get::<Pieces>(pane.entity).and_then(|pieces| pieces.0.get(number)).copied();
    let place = GlobalTransform::from(pane.place);
    let is_child = |child: &Entity| world.get::<ChildOf>(*child).map(ChildOf::parent) == Some(pane.entity);
    let child = known.filter(is_child).unwrap_or_else(|| new_child(world, pane.entity, number));
    // Transforms were propagated before.
    world.entity_mut(child).insert(place);
    carry(world, pane.entity, child, &pane.carried);
    child
}

/// In the place of the one of this number, if there was one.
fn new_child(world: &mut World, pane: Entity, number: usize) -> Entity {
    let child = world.spawn((Transform::default(), Visibility::default(), NotBaked, ChildOf(pane))).id();
    let mut pieces = world.entity_mut(pane).take::<Pieces>().unwrap_or_default();
    match pieces.0.get_mut(number) {
        Some(place) => {
            // The app may have given it another parent.
            world.try_despawn(std::mem::replace(place, child)).unwrap_or_default();
        }
        None => pieces.0.push(child),
    }
    world.entity_mut(pane).insert(pieces);
    child
}

/// Draws a mesh in place of the one that the pane was given, in the asset of the last time if there is one.
fn draw(world: &mut World, entity: Entity, given: &Handle<Mesh>, mesh: Mesh) {
    let owner = world.get_entity(entity).ok().filter(|entity| entity.contains::<OwnsMesh>());
    let before = owner.and_then(|owner| owner.get::<StandIn>()).map(|stand_in| stand_in.drawn.clone());
    let mut meshes = world.resource_mut::<Assets<Mesh>>();
    let drawn = match before {
        Some(drawn) if meshes.contains(&drawn) => {
            if let Some(mut before) = meshes.get_mut(&drawn) {
                *before = mesh;
            }
            drawn
        }
        _ => meshes.add(mesh),
    };
    let given = given.clone();
    world.entity_mut(entity).insert((Mesh3d(drawn.clone()), StandIn { given, drawn }, OwnsMesh));
}

/// Lets those children of a pane go that have nothing more to draw.
fn keep_children(world: &mut World, pane: Entity, count: usize) {
    let Some(mut pieces) = world.get_mut::<Pieces>(pane) else { return };
    let count = count.min(pieces.0.len());
    let surplus = pieces.0.split_off(count);
    // Those that are gone already need nothing more.
    surplus.into_iter().for_each(|child| world.try_despawn(child).unwrap_or_default());
}

fn make_whole(world: &mut World, pane: Entity) {
    keep_children(world, pane, 0);
    let Ok(mut pane) = world.get_entity_mut(pane) else { return };
    if let (Some(mesh), Some(stand_in)) = (pane.get::<Mesh3d>(), pane.get::<StandIn>()) {
        let mesh = Mesh3d(given_mesh(mesh, Some(stand_in)).clone());
        pane.insert(mesh).remove::<(StandIn, OwnsMesh, Pieces)>();
    }
}

fn give_back(removed: On<Remove, SplitPane>, mut commands: Commands) {
    let pane = removed.entity;
    commands.queue(move |world: &mut World| make_whole(world, pane));
}
