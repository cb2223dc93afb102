//! The order of the triangles within a transparent mesh.
//!
//! A mesh is one draw, and its triangles are drawn in the order in which they stand: a large one, such as a torus of
//! glass or a tree of billboards, covers its own near side with its far side. [`SortedTriangles`] sorts them for the camera.

mod list;
mod view;

use bevy::asset::AssetEventSystems;
use bevy::camera::visibility::RenderLayers;
use bevy::ecs::entity::EntityHashMap;
use bevy::platform::collections::HashSet;
use bevy::prelude::*;
use bevy::tasks::futures::check_ready;
use bevy::tasks::{AsyncComputeTaskPool, Task, TaskPool};
use bevy::transform::TransformSystems;

use list::{Order, Triangles};
use view::{Cameras, LocalView};

use super::panes::SplitPane;
use crate::stand_in::{StandIn, given_mesh};

/// Meshes with more triangles are sorted in the background, and show the order of before until that is done.
const IN_BACKGROUND: usize = 10_000;

/// Sorts the triangles of this entity's mesh from far to near, by their centroids.
///
/// The camera that counts is the nearest one of those that are active and share a layer of `RenderLayers` with it, with
/// its `TransparentDepth`; others see the order that is right for this one. The entity gets a copy of its mesh, so that others that share it stay as they are; when the
/// app gives it another mesh, or changes the one it has, that one is copied anew. Without this component it gets its own
/// mesh back. Skinned and morphed meshes are sorted in the pose of the asset.
#[derive(Component, Reflect, Clone, Copy, Debug, PartialEq)]
#[reflect(Component, Default, Clone, PartialEq)]
pub struct SortedTriangles {
    /// By so much the camera may go round the mesh before its triangles are sorted anew, in radians, or come nearer, as a
    /// share of its distance. Each time the mesh is uploaded again. 0 sorts whenever anything moves.
    pub turn: f32,
}

impl Default for SortedTriangles {
    fn default() -> Self {
        Self { turn: 0.05 }
    }
}

/// Sorts the triangles within meshes; part of [`TransparencyPlugin`](super::TransparencyPlugin).
pub(super) fn plugin(app: &mut App) {
    app.add_systems(
        PostUpdate,
        (begin, sort)
            .chain()
            .after(TransformSystems::Propagate)
            .before(AssetEventSystems)
            .run_if(any_with_component::<SortedTriangles>),
    )
    .add_observer(give_back);
}

/// What is known of the triangles of an entity.
#[derive(Component)]
struct Sorting {
    triangles: Triangles,
    sorted_for: Option<LocalView>,
    work: Work,
}

enum Work {
    Done(Order),
    Running(Task<Order>),
}

type Given<'a> = (Entity, &'a mut Mesh3d, Option<&'a StandIn>, Has<Sorting>, Option<&'a Name>);
/// Panes that are cut have triangles of their own.
type ToSort = (With<SortedTriangles>, Without<SplitPane>);

/// Takes a copy of each mesh that is new here, or that has changed.
fn begin(
    mut commands: Commands,
    mut sorted: Query<Given, ToSort>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut events: MessageReader<AssetEvent<Mesh>>,
    mut refused: Local<EntityHashMap<AssetId<Mesh>>>,
) {
    let modified: HashSet<AssetId<Mesh>> = events.read().filter_map(modified_id).collect();
    refused.retain(|entity, mesh| sorted.contains(*entity) && !modified.contains(mesh));
    for (entity, mut mesh3d, stand_in, is_sorted, name) in &mut sorted {
        let given = given_mesh(&mesh3d, stand_in).clone();
        let is_known = is_sorted && given != mesh3d.0;
        if is_known && !modified.contains(&given.id()) {
            continue;
        }
        if refused.get(&entity) == Some(&given.id()) {
            continue;
        }
        let Some(mesh) = meshes.get(&given) else { continue };
        match Triangles::of(mesh).map(|triangles| (triangles.copy_of(mesh), triangles)) {
            Ok((copy, triangles)) => {
                let drawn = meshes.add(copy);
                mesh3d.0 = drawn.clone();
                let work = Work::Done(Order::of(&triangles));
                let sorting = Sorting { triangles, sorted_for: None, work };
                commands.entity(entity).try_insert((sorting, StandIn { given, drawn }));
            }
            Err(reason) => {
                let name = name.map_or_else(|| entity.to_string(), Name::to_string);
                warn!("the triangles of \"{name}\" stay in their order: {reason}");
                refused.insert(entity, given.id());
            }
        }
    }
}

pub(super) fn modified_id(event: &AssetEvent<Mesh>) -> Option<AssetId<Mesh>> {
    match event {
        AssetEvent::Modified { id } => Some(*id),
        _ => None,
    }
}

type InView<'a> = (&'a SortedTriangles, &'a GlobalTransform, Option<&'a RenderLayers>, &'a StandIn, &'a mut Sorting);

fn sort(mut sorted: Query<InView, ToSort>, cameras: Cameras, mut meshes: ResMut<Assets<Mesh>>) {
    for (settings, place, layers, StandIn { drawn, .. }, mut sorting) in &mut sorted {
        let Sorting { triangles, sorted_for, work } = &mut *sorting;
        let before = match work {
            Work::Done(order) => std::mem::take(order),
            Work::Running(task) => match check_ready(task) {
                None => continue,
                Some(order) => {
                    order.write(triangles, drawn, &mut meshes);
                    order
                }
            },
        };
        let view = cameras.nearest(place, layers, triangles.center());
        let view = view.filter(|view| view.differs(sorted_for.as_ref(), settings.turn, triangles.center()));
        *work = match view {
            None => Work::Done(before),
            Some(view) if triangles.len() > IN_BACKGROUND => {
                let (triangles, depth, world) = (triangles.clone(), view.depth, place.affine());
                *sorted_for = Some(view);
                let pool = AsyncComputeTaskPool::get_or_init(TaskPool::default);
                Work::Running(pool.spawn(async move { before.sorted(&triangles, &depth, &world) }))
            }
            Some(view) => {
                let order = before.sorted(triangles, &view.depth, &place.affine());
                order.write(triangles, drawn, &mut meshes);
                *sorted_for = Some(view);
                Work::Done(order)
            }
        };
    }
}

/// Whoever has another mesh by now keeps it. What a pane draws instead of its mesh is none of this.
fn give_back(
    removed: On<Remove, SortedTriangles>,
    mut commands: Commands,
    mut sorted: Query<(&mut Mesh3d, &StandIn), Without<SplitPane>>,
) {
    commands.entity(removed.entity).try_remove::<Sorting>();
    if let Ok((mut mesh3d, stand_in)) = sorted.get_mut(removed.entity) {
        mesh3d.0 = given_mesh(&mesh3d, Some(stand_in)).clone();
        commands.entity(removed.entity).try_remove::<StandIn>();
    }
}
