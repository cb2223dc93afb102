//! What is looked at: a glTF file or the Cornell box.

use bevy::asset::RenderAssetUsages;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use bevy_radiosity::prelude::*;
use radiosity::scene::{cornell_box, cornell_camera};

use crate::args::Args;

/// Spawns the scene, and ends the app where it cannot be baked.
pub fn plugin(app: &mut App) {
    app.insert_resource(GlobalAmbientLight::NONE)
        .insert_resource(ClearColor(Color::BLACK))
        .add_systems(Startup, (spawn_cornell_box.run_if(has_no_file), spawn_file.run_if(not(has_no_file))))
        .add_observer(stop);
}

fn has_no_file(args: Res<Args>) -> bool {
    args.scene.is_none()
}

/// Baked as soon as it is there.
fn spawn_file(mut commands: Commands, args: Res<Args>, assets: Res<AssetServer>) {
    let name = args.scene.as_ref().and_then(|path| path.file_name()).unwrap_or_default();
    let scene = GltfAssetLabel::Scene(0).from_asset(name.to_string_lossy().into_owned());
    commands.spawn((WorldAssetRoot(assets.load(scene)), BakeOnLoad));
}

fn spawn_cornell_box(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    let scene = cornell_box();
    let paints: Vec<_> = scene.materials.iter().map(|paint| materials.add(material(paint))).collect();
    let root = commands.spawn((BakeOnLoad, Transform::default(), Visibility::default())).id();
    for surface in &scene.surfaces {
        commands.spawn((
            ChildOf(root),
            Name::new(surface.name.clone()),
            Mesh3d(meshes.add(mesh(&scene.meshes[surface.mesh]))),
            MeshMaterial3d(paints[surface.material].clone()),
        ));
    }
    let (pose, fov) = cornell_camera();
    let lens = Projection::from(PerspectiveProjection { fov, ..default() });
    commands.spawn((ChildOf(root), Camera3d::default(), lens, Transform::from_matrix(pose.into())));
}

fn mesh(shape: &radiosity::geometry::Mesh) -> Mesh {
    let positions: Vec<[f32; 3]> = shape.positions.iter().map(|position| position.to_array()).collect();
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_indices(Indices::U32(shape.triangles.as_flattened().to_vec()))
        .with_duplicated_vertices()
        .with_computed_flat_normals()
}

fn material(paint: &radiosity::material::Material) -> StandardMaterial {
    let [red, green, blue, alpha] = paint.base_color.to_array();
    let emissive = paint.emissive;
    StandardMaterial {
        base_color: Color::linear_rgba(red, green, blue, alpha),
        emissive: LinearRgba::rgb(emissive.x, emissive.y, emissive.z),
        reflectance: 0.0,
        ..default()
    }
}

fn stop(failed: On<BakeFailed>, mut exit: MessageWriter<AppExit>) {
    error!("{}", failed.error);
    exit.write(AppExit::error());
}
