//! What is in the phase of transparent things without being a mesh: gizmos, particles, custom materials. No GPU is needed:
//! the render world's schedule runs alone.

use bevy::core_pipeline::core_3d::{Transparent3d, TransparentSortingInfo3d};
use bevy::material::descriptor::CachedRenderPipelineId;
use bevy::material::labels::DrawFunctionId;
use bevy::pbr::Transmissive3d;
use bevy::prelude::*;
use bevy::render::mesh::RenderMesh;
use bevy::render::render_asset::RenderAssets;
use bevy::render::render_phase::{PhaseItemExtraIndex, ViewSortedRenderPhases, sort_phase_system};
use bevy::render::render_resource::TextureFormat;
use bevy::render::sync_world::MainEntity;
use bevy::render::view::{ExtractedView, RetainedViewEntity};
use bevy::render::{Render, RenderApp, RenderSystems};
use bevy_radiosity::transparency::TransparencyPlugin;

/// A camera at the origin that looks along -Z, and a phase without a renderer.
struct Phase {
    app: App,
    view: RetainedViewEntity,
}

impl Phase {
    fn new() -> Self {
        let mut app = App::new();
        let mut render_app = SubApp::new();
        render_app
            .init_resource::<ViewSortedRenderPhases<Transparent3d>>()
            .init_resource::<ViewSortedRenderPhases<Transmissive3d>>()
            .init_resource::<RenderAssets<RenderMesh>>()
            .add_schedule(Render::base_schedule())
            .add_systems(Render, sort_phase_system::<Transparent3d>.in_set(RenderSystems::PhaseSort));
        let camera = render_app.world_mut().spawn_empty().id();
        let view = RetainedViewEntity::new(camera.into(), None, 0);
        render_app.world_mut().entity_mut(camera).insert(ExtractedView {
            retained_view_entity: view,
            clip_from_view: Mat4::IDENTITY,
            world_from_view: GlobalTransform::IDENTITY,
            clip_from_world: None,
            target_format: TextureFormat::Rgba8UnormSrgb,
            viewport: UVec4::ZERO,
            color_grading: default(),
            invert_culling: false,
        });
        app.insert_sub_app(RenderApp, render_app);
        app.add_plugins(TransparencyPlugin);
        Self { app, view }
    }

    fn phases(&mut self) -> Mut<'_, ViewSortedRenderPhases<Transparent3d>> {
        self.app.sub_app_mut(RenderApp).world_mut().resource_mut()
    }

    fn add(&mut self, number: u32, sorting_info: TransparentSortingInfo3d) {
        let entity = Entity::from_raw_u32(number).expect("a small number");
        let item = Transparent3d {
            sorting_info,
            distance: 0.0,
            pipeline: CachedRenderPipelineId::INVALID,
            entity: (Entity::PLACEHOLDER, MainEntity::from(entity)),
            draw_function: DrawFunctionId(0),
            batch_range: 0..1,
            extra_index: PhaseItemExtraIndex::None,
            indexed: false,
        };
        let view = self.view;
        self.phases().entry(view).or_default().add_retained(item);
    }

    fn add_at(&mut self, number: u32, z: f32) {
        let mesh_center = Vec3::new(0.0, 0.0, z);
        self.add(number, TransparentSortingInfo3d::Sorted { mesh_center, depth_bias: 0.0 });
    }

    fn remove(&mut self, number: u32) {
        let entity = Entity::from_raw_u32(number).expect("a small number");
        let view = self.view;
        self.phases().get_mut(&view).expect("it has items").remove(Entity::PLACEHOLDER, entity.into());
    }

    /// The numbers of the items in the order in which they are drawn.
    fn order(&mut self) -> Vec<u32> {
        self.app.sub_app_mut(RenderApp).world_mut().run_schedule(Render);
        let view = self.view;
        self.phases()[&view].items.keys().map(|(_, main)| main.id().index_u32()).collect()
    }
}

#[test]
fn what_has_no_mesh_keeps_its_own_depth() {
    let mut phase = Phase::new();
    [-3.0, -9.0, -1.0, -5.0].into_iter().zip(1..).for_each(|(z, number)| phase.add_at(number, z));
    assert_eq!(phase.order(), [2, 4, 1, 3]);
    phase.add_at(5, -4.0);
    phase.add(6, TransparentSortingInfo3d::AlwaysOnTop);
    assert_eq!(phase.order(), [6, 2, 4, 5, 1, 3]);
    // Queued anew, as plugins of particles do in each frame.
    phase.remove(2);
    phase.add_at(2, -2.0);
    assert_eq!(phase.order(), [6, 4, 5, 1, 2, 3]);
}

/// When an item is removed, the last one takes its place in the list; among equals it must not be drawn earlier for that.
#[test]
fn equals_stay_in_order_when_others_go() {
    let mut phase = Phase::new();
    (1..=6).for_each(|number| phase.add_at(number, -2.0));
    let before = phase.order();
    assert_eq!(before, [1, 2, 3, 4, 5, 6]);
    phase.remove(2);
    assert_eq!(phase.order(), [1, 3, 4, 5, 6]);
    phase.remove(1);
    phase.add_at(7, -2.0);
    assert_eq!(phase.order(), [3, 4, 5, 6, 7]);
}

#[test]
fn depths_that_are_no_numbers_do_no_harm() {
    let mut phase = Phase::new();
    phase.add_at(1, -1.0);
    phase.add_at(2, f32::NAN);
    phase.add_at(3, f32::INFINITY);
    phase.add_at(4, -2.0);
    let order = phase.order();
    assert_eq!(order.len(), 4);
    let place = |number| order.iter().position(|&other| other == number);
    assert!(place(4) < place(1), "{order:?}");
}

#[test]
fn nothing_is_sorted_where_nothing_is_transparent() {
    let mut phase = Phase::new();
    phase.add_at(1, -2.0);
    assert_eq!(phase.order(), [1]);
    phase.remove(1);
    assert!(phase.order().is_empty());
    phase.add_at(2, -2.0);
    phase.add_at(3, -5.0);
    assert_eq!(phase.order(), [3, 2]);
}

/// What is moved far away by a bias, or is as far away, leaves the order of what is near alone.
#[test]
fn far_and_biased_things_freeze_nothing() {
    let mut phase = Phase::new();
    let at =
        |z: f32, depth_bias: f32| TransparentSortingInfo3d::Sorted { mesh_center: Vec3::new(0.0, 0.0, z), depth_bias };
    phase.add(1, at(-1.0, 1e8));
    phase.add_at(2, -1e5);
    phase.add_at(3, -2.0);
    phase.add_at(4, -2.01);
    assert_eq!(phase.order(), [2, 4, 3, 1]);
    phase.remove(4);
    phase.add_at(4, -1.99);
    assert_eq!(phase.order(), [2, 3, 4, 1]);
}

/// Apps that do without materials that transmit have no such phase.
#[test]
fn phases_that_do_not_exist_are_left_out() {
    let mut phase = Phase::new();
    [-3.0, -9.0].into_iter().zip(1..).for_each(|(z, number)| phase.add_at(number, z));
    phase.app.sub_app_mut(RenderApp).world_mut().remove_resource::<ViewSortedRenderPhases<Transmissive3d>>();
    assert_eq!(phase.order(), [2, 1]);
}

/// Glass that bends light is drawn from far to near, too.
#[test]
fn transmissive_things() {
    let mut phase = Phase::new();
    let view = phase.view;
    for (z, number) in [-3.0, -9.0, -1.0, -5.0].into_iter().zip(1..) {
        let entity = Entity::from_raw_u32(number).expect("a small number");
        let item = Transmissive3d {
            sorting_info: TransparentSortingInfo3d::Sorted { mesh_center: Vec3::new(0.0, 0.0, z), depth_bias: 0.0 },
            distance: 0.0,
            pipeline: CachedRenderPipelineId::INVALID,
            entity: (Entity::PLACEHOLDER, MainEntity::from(entity)),
            draw_function: DrawFunctionId(0),
            batch_range: 0..1,
            extra_index: PhaseItemExtraIndex::None,
            indexed: false,
        };
        let world = phase.app.sub_app_mut(RenderApp).world_mut();
        let mut phases = world.resource_mut::<ViewSortedRenderPhases<Transmissive3d>>();
        phases.entry(view).or_default().add_retained(item);
    }
    let world = phase.app.sub_app_mut(RenderApp).world_mut();
    world.run_schedule(Render);
    let phases = world.resource::<ViewSortedRenderPhases<Transmissive3d>>();
    let order: Vec<u32> = phases[&view].items.keys().map(|(_, main)| main.id().index_u32()).collect();
    assert_eq!(order, [2, 4, 1, 3]);
}
