//! The order of the triangles within a transparent mesh.
//!
//! A mesh is one draw, and its triangles are drawn in the order in which they stand: a large one, such as a torus of
//! glass or a tree of billboards, covers its own near side with its far side. [`SortedTriangles`] sorts them for the camera.

mod list;
mod view;

use bevy::asset::AssetEventSystems;
use bevy::ecs::entity::EntityHashMap;
use bevy::platform::collections::HashSet;
use bevy::prelude::*;
use bevy::tasks::futures::check_ready;
use bevy::tasks::{AsyncComputeTaskPool, Task, TaskPool};
use bevy::transform::TransformSystems;

use list::{Order, Triangles};
use view::{Cameras, LocalView};

/// Meshes with more triangles are sorted in the background, and show the order of before until that is done.
const IN_BACKGROUND: usize = 10_000;

/// Sorts the triangles of this entity's mesh from far to near, by their centroids.
///
/// The camera that counts is the nearest one of those that are active, with its `TransparentDepth`; others see the order
/// that is right for this one. The entity gets a copy of its mesh, so that others that share it stay as they are; when the
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
    source: Handle<Mesh>,
    copy: Handle<Mesh>,
    triangles: Triangles,
    sorted_for: Option<LocalView>,
    work: Work,
}

enum Work {
    Done(Order),
    Running(Task<Order>),
}

/// Takes a copy of each mesh that is new here, or that has changed.
fn begin(
    mut commands: Commands,
    mut sorted: Query<(Entity, &mut Mesh3d, Option<&Sorting>, Option<&Name>), With<SortedTriangles>>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut events: MessageReader<AssetEvent<Mesh>>,
    mut refused: Local<EntityHashMap<AssetId<Mesh>>>,
) {
    let modified: HashSet<AssetId<Mesh>> = events.read().filter_map(modified_id).collect();
    refused.retain(|entity, mesh| sorted.contains(*entity) && !modified.contains(mesh));
    for (entity, mut mesh3d, sorting, name) in &mut sorted {
        let source = match sorting {
            Some(sorting) if sorting.copy != mesh3d.0 => mesh3d.0.clone(),
            Some(sorting) if modified.contains(&sorting.source.id()) => sorting.source.clone(),
            Some(_) => continue,
            None => mesh3d.0.clone(),
        };
        if refused.get(&entity) == Some(&source.id()) {
            continue;
        }
        let Some(mesh) = meshes.get(&source) else { continue };
        match Triangles::of(mesh).map(|triangles| (triangles.copy_of(mesh), triangles)) {
            Ok((copy, triangles)) => {
                let copy = meshes.add(copy);
                mesh3d.0 = copy.clone();
                let work = Work::Done(Order::of(&triangles));
                commands.entity(entity).insert(Sorting { source, copy, triangles, sorted_for: None, work });
            }
            Err(reason) => {
                let name = name.map_or_else(|| entity.to_string(), Name::to_string);
                warn!("the triangles of \"{name}\" stay in their order: {reason}");
                refused.insert(entity, source.id());
            }
        }
    }
}

fn modified_id(event: &AssetEvent<Mesh>) -> Option<AssetId<Mesh>> {
    match event {
        AssetEvent::Modified { id } => Some(*id),
        _ => None,
    }
}

fn sort(
    mut sorted: Query<(&SortedTriangles, &GlobalTransform, &mut Sorting)>,
    cameras: Cameras,
    mut meshes: ResMut<Assets<Mesh>>,
) {
    for (settings, place, mut sorting) in &mut sorted {
        let Sorting { copy, triangles, sorted_for, work, .. } = &mut *sorting;
        let before = match work {
            Work::Done(order) => std::mem::take(order),
            Work::Running(task) => match check_ready(task) {
                None => continue,
                Some(order) => {
                    order.write(triangles, copy, &mut meshes);
                    order
                }
            },
        };
        let view = cameras.nearest(place, triangles.center());
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
                order.write(triangles, copy, &mut meshes);
                *sorted_for = Some(view);
                Work::Done(order)
            }
        };
    }
}

/// Whoever has another mesh by now keeps it.
fn give_back(removed: On<Remove, SortedTriangles>, mut commands: Commands, mut sorted: Query<(&mut Mesh3d, &Sorting)>) {
    let Ok((mut mesh3d, sorting)) = sorted.get_mut(removed.entity) else { return };
    if mesh3d.0 == sorting.copy {
        mesh3d.0 = sorting.source.clone();
    }
    commands.entity(removed.entity).try_remove::<Sorting>();
}
