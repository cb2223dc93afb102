//! What Bevy 0.19.1 does wrong with lightmaps that come, change or sit on the wrong mesh, and the plugin puts right.
//! Each test fails without `LightmapGuardPlugin`.

use bevy::asset::RenderAssetUsages;
use bevy::mesh::VertexAttributeValues;
use bevy::mesh::morph::{MeshMorphWeights, MorphAttributes};
use bevy::mesh::skinning::{SkinnedMesh, SkinnedMeshInverseBindposes};
use bevy::pbr::Lightmap;
use bevy::prelude::*;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};
use bevy_radiosity::lightmap_guard::LightmapGuardPlugin;
use radiosity_tests::render::Studio;

/// Emitted by the walls, so that one sees whether they are drawn.
const GLOW: f32 = 0.25;

fn studio() -> Option<Studio> {
    let mut studio = Studio::new()?;
    studio.app.add_plugins(LightmapGuardPlugin);
    Some(studio)
}

fn wall() -> Mesh {
    Rectangle::new(2.0, 2.0).into()
}

fn wall_with_uv_1() -> Mesh {
    let wall = wall();
    let uv = wall.attribute(Mesh::ATTRIBUTE_UV_0).unwrap().clone();
    wall.with_inserted_attribute(Mesh::ATTRIBUTE_UV_1, uv)
}

/// White, matt and glowing.
fn spawn_wall(studio: &mut Studio, mesh: Mesh) -> Entity {
    let world = studio.app.world_mut();
    let mesh = world.resource_mut::<Assets<Mesh>>().add(mesh);
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial {
        base_color: Color::WHITE,
        emissive: LinearRgba::rgb(GLOW, GLOW, GLOW),
        perceptual_roughness: 1.0,
        reflectance: 0.0,
        ..default()
    });
    world.spawn((Mesh3d(mesh), MeshMaterial3d(material))).id()
}

/// A lightmap of this radiance everywhere, in cd/m2.
fn lightmap(studio: &mut Studio, radiance: f32) -> Lightmap {
    let size = Extent3d { width: 4, height: 4, depth_or_array_layers: 1 };
    let texel: Vec<u8> = [radiance, radiance, radiance, 1.0].into_iter().flat_map(f32::to_le_bytes).collect();
    let usages = RenderAssetUsages::default();
    let image = Image::new_fill(size, TextureDimension::D2, &texel, TextureFormat::Rgba32Float, usages);
    let image = studio.app.world_mut().resource_mut::<Assets<Image>>().add(image);
    Lightmap { image, ..default() }
}

fn assert_shows(studio: &mut Studio, radiance: f32) {
    let seen = studio.center();
    let expected = Vec3::splat(GLOW + radiance * Studio::exposure());
    assert!(seen.abs_diff_eq(expected, 0.005 * expected.x), "{seen} is seen, and should be {expected}");
}

#[test]
fn lightmaps_come_and_go_after_the_first_frame() {
    let Some(mut studio) = studio() else { return };
    let wall = spawn_wall(&mut studio, wall_with_uv_1());
    assert_shows(&mut studio, 0.0);
    let lightmap = lightmap(&mut studio, 500.0);
    studio.app.world_mut().entity_mut(wall).insert(lightmap);
    assert_shows(&mut studio, 500.0);
    studio.app.world_mut().entity_mut(wall).remove::<Lightmap>();
    assert_shows(&mut studio, 0.0);
}

#[test]
fn another_image_shows() {
    let Some(mut studio) = studio() else { return };
    let wall = spawn_wall(&mut studio, wall_with_uv_1());
    let dark = lightmap(&mut studio, 100.0);
    studio.app.world_mut().entity_mut(wall).insert(dark);
    assert_shows(&mut studio, 100.0);
    let bright = lightmap(&mut studio, 700.0);
    studio.app.world_mut().get_mut::<Lightmap>(wall).unwrap().image = bright.image;
    assert_shows(&mut studio, 700.0);
    let taken_and_put = lightmap(&mut studio, 300.0);
    studio.app.world_mut().entity_mut(wall).remove::<Lightmap>().insert(taken_and_put);
    assert_shows(&mut studio, 300.0);
}

#[test]
fn mesh_without_uv_1_is_drawn() {
    let Some(mut studio) = studio() else { return };
    let lightmap = lightmap(&mut studio, 500.0);
    let wall = spawn_wall(&mut studio, wall());
    studio.app.world_mut().entity_mut(wall).insert(lightmap);
    assert_shows(&mut studio, 0.0);
}

#[test]
fn skinned_mesh_is_drawn() {
    let Some(mut studio) = studio() else { return };
    let mesh = wall_with_uv_1()
        .with_inserted_attribute(Mesh::ATTRIBUTE_JOINT_INDEX, VertexAttributeValues::Uint16x4(vec![[0; 4]; 4]))
        .with_inserted_attribute(Mesh::ATTRIBUTE_JOINT_WEIGHT, vec![[1.0, 0.0, 0.0, 0.0]; 4]);
    let lightmap = lightmap(&mut studio, 500.0);
    let wall = spawn_wall(&mut studio, mesh);
    let world = studio.app.world_mut();
    let mut poses = world.resource_mut::<Assets<SkinnedMeshInverseBindposes>>();
    let inverse_bindposes = poses.add(vec![Mat4::IDENTITY]);
    let joints = vec![world.spawn(Transform::default()).id()];
    world.entity_mut(wall).insert((lightmap, SkinnedMesh { inverse_bindposes, joints }));
    assert_shows(&mut studio, 0.0);
}

#[test]
fn morphed_mesh_is_drawn() {
    let Some(mut studio) = studio() else { return };
    let mut mesh = wall_with_uv_1();
    mesh.set_morph_targets(vec![MorphAttributes::default(); 4]);
    let lightmap = lightmap(&mut studio, 500.0);
    let wall = spawn_wall(&mut studio, mesh);
    let weights = MeshMorphWeights::Value { weights: vec![1.0] };
    studio.app.world_mut().entity_mut(wall).insert((lightmap, weights));
    assert_shows(&mut studio, 0.0);
}
