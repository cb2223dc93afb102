use bevy::asset::{AssetApp, AssetPlugin};
use bevy::gltf::GltfMaterial;
use bevy::mesh::MeshBuilder;

use super::*;
use crate::gltf::GltfMaterial3d;
use crate::stand_in::StandIn;

/// An app with the assets of a scene, no renderer, and transforms that are propagated.
fn app() -> App {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, TransformPlugin, AssetPlugin::default()));
    app.init_asset::<Mesh>().init_asset::<Image>().init_asset::<GltfMaterial>();
    app
}

fn cube(app: &mut App) -> (Mesh3d, Handle<Mesh>) {
    let mesh = app.world_mut().resource_mut::<Assets<Mesh>>().add(Cuboid::default().mesh().build());
    (Mesh3d(mesh.clone()), mesh)
}

fn paint(app: &mut App, material: GltfMaterial) -> GltfMaterial3d {
    GltfMaterial3d(app.world_mut().resource_mut::<Assets<GltfMaterial>>().add(material))
}

fn collected(app: &mut App) -> Collected {
    app.update();
    collect(app.world_mut())
}

fn names(collected: &Collected) -> Vec<&str> {
    collected.scene.surfaces.iter().map(|surface| surface.name.as_str()).collect()
}

/// Below a `Baked`, in the order of the hierarchy, without what is left out on request.
#[test]
fn what_is_baked_and_what_is_not() {
    let mut app = app();
    let (mesh, _) = cube(&mut app);
    let material = paint(&mut app, GltfMaterial::default());
    let object = |name: &'static str| (Name::new(name), mesh.clone(), material.clone(), Transform::default());
    app.world_mut().spawn((object("stranger"), Visibility::Visible));
    app.world_mut().spawn((object("root"), Visibility::Visible, Baked::default())).with_children(|root| {
        root.spawn((object("first"), Visibility::Inherited)).with_children(|first| {
            first.spawn((object("dense"), Visibility::Inherited, Baked { density: 4.0 }));
        });
        root.spawn((object("dynamic"), Visibility::Inherited, NotBaked)).with_children(|dynamic| {
            dynamic.spawn((object("below dynamic"), Visibility::Inherited));
        });
        root.spawn((object("hidden"), Visibility::Hidden)).with_children(|hidden| {
            hidden.spawn((object("below hidden"), Visibility::Inherited));
            hidden.spawn((object("shown"), Visibility::Visible));
        });
        root.spawn((object("elsewhere"), Visibility::Inherited, RenderLayers::layer(3)));
        root.spawn((object("last"), Visibility::Inherited, NotShadowCaster));
    });
    let collected = collected(&mut app);
    assert_eq!(names(&collected), ["root", "first", "dense", "shown", "last"]);
    let densities = collected.scene.surfaces.iter().map(|surface| surface.receiver);
    let expected = [1.0, 1.0, 4.0, 1.0, 1.0].map(|density| Receiver::Lightmap { density });
    assert_eq!(densities.collect::<Vec<_>>(), expected);
    assert_eq!(collected.scene.surfaces.iter().map(|s| s.casts).collect::<Vec<_>>(), [true, true, true, true, false]);
    // All share one mesh and one material.
    assert_eq!((collected.scene.meshes.len(), collected.scene.materials.len()), (1, 1));
    assert_eq!((collected.surfaces.len(), collected.mesh_handles.len()), (5, 1));
    assert_eq!(collected.warnings, Vec::<String>::new());
}

/// Nothing is lost without a word.
/// Whatever is drawn in its place; but what the app has given it since counts.
#[test]
fn the_mesh_that_was_given_is_baked() {
    let mut app = app();
    let ((_, given), (drawn, _), (newer, _)) = (cube(&mut app), cube(&mut app), cube(&mut app));
    let stand_in = StandIn { given: given.clone(), drawn: drawn.0.clone() };
    let material = paint(&mut app, GltfMaterial::default());
    let object = (Baked::default(), material, Transform::default(), Visibility::Visible, drawn, stand_in);
    let object = app.world_mut().spawn(object).id();
    assert_eq!(collected(&mut app).mesh_handles, [given]);
    app.world_mut().entity_mut(object).insert(newer.clone());
    assert_eq!(collected(&mut app).mesh_handles, [newer.0]);
}

#[test]
fn what_cannot_be_baked_is_named() {
    let mut app = app();
    let (mesh, _) = cube(&mut app);
    let material = paint(&mut app, GltfMaterial::default());
    let unlit = paint(&mut app, GltfMaterial { unlit: true, ..default() });
    app.world_mut().spawn((Baked::default(), Transform::default())).with_children(|root| {
        root.spawn((Name::new("hero"), mesh.clone(), material.clone(), SkinnedMesh::default()));
        root.spawn((Name::new("late"), Mesh3d(Handle::default()), material.clone()));
        root.spawn((Name::new("plain"), mesh.clone()));
        root.spawn((Name::new("sign"), mesh.clone(), unlit));
        root.spawn((Name::new("lost"), mesh.clone(), material, Transform::from_xyz(f32::NAN, 0.0, 0.0)));
    });
    let collected = collected(&mut app);
    assert_eq!(names(&collected), ["plain", "sign"]);
    assert!(collected.scene.surfaces.iter().all(|surface| surface.receiver == Receiver::Nothing && surface.casts));
    for (name, reason) in
        [("hero", "skinned"), ("late", "not loaded"), ("plain", "StandardMaterial"), ("lost", "finite")]
    {
        let found = collected.warnings.iter().any(|warning| warning.contains(name) && warning.contains(reason));
        assert!(found, "{name}: {:?}", collected.warnings);
    }
}

/// A texture that is looked up by the second coordinates keeps them from being replaced.
#[test]
fn coordinates_in_use_are_marked() {
    let mut app = app();
    let (mesh, _) = cube(&mut app);
    let occlusion_texture = Some(Handle::default());
    let material =
        paint(&mut app, GltfMaterial { occlusion_texture, occlusion_channel: bevy::mesh::UvChannel::Uv1, ..default() });
    app.world_mut().spawn((Baked::default(), mesh, material, Transform::default()));
    assert!(collected(&mut app).scene.meshes[0].uv_1_in_use);
}

/// Mirrors and clear glass are what they are; matt glass is taken for clear, and that is said.
#[test]
fn mirrors_and_glass_are_collected() {
    let mut app = app();
    let (mesh, _) = cube(&mut app);
    let mirror = paint(&mut app, GltfMaterial { metallic: 1.0, perceptual_roughness: 0.0, ..default() });
    let pane = GltfMaterial {
        base_color: Color::linear_rgb(0.9, 0.1, 0.1),
        specular_transmission: 1.0,
        perceptual_roughness: 0.1,
        ..default()
    };
    let matt = paint(&mut app, GltfMaterial { perceptual_roughness: 0.8, ..pane.clone() });
    let pane = paint(&mut app, pane);
    app.world_mut().spawn((Baked::default(), Transform::default())).with_children(|root| {
        root.spawn((Name::new("mirror"), mesh.clone(), mirror));
        root.spawn((Name::new("pane"), mesh.clone(), pane));
        root.spawn((Name::new("matt pane"), mesh.clone(), matt));
    });
    let Collected { scene, warnings, .. } = collected(&mut app);
    let of = |surface: usize| &scene.materials[scene.surfaces[surface].material];
    assert!(of(0).may_be_mirror() && of(0).is_opaque() && !of(0).is_glass());
    assert!(of(1).is_glass() && of(1).may_filter(false) && !of(1).is_opaque());
    assert!(of(2).is_glass() && warnings.len() == 1, "{warnings:?}");
    assert!(warnings[0].contains("matt pane") && warnings[0].contains("clear"), "{warnings:?}");
}

#[test]
fn lights_have_their_angles_and_warn_of_their_range() {
    let mut app = app();
    let (mesh, _) = cube(&mut app);
    let material = paint(&mut app, GltfMaterial::default());
    app.world_mut().spawn((Baked::default(), Transform::default())).with_children(|root| {
        root.spawn((mesh, material, Transform::from_scale(Vec3::splat(60.0))));
        root.spawn((Name::new("sun"), DirectionalLight::default()));
        root.spawn((Name::new("disk"), DirectionalLight::default(), SunDisk { angular_size: 0.1, intensity: 1.0 }));
        root.spawn((Name::new("soft"), DirectionalLight::default(), AngularDiameter(0.2)));
        root.spawn((Name::new("short"), PointLight { intensity: 1e5, range: 20.0, ..default() }));
        root.spawn((Name::new("long"), PointLight { intensity: 1e5, range: 500.0, ..default() }));
        root.spawn((Name::new("static"), PointLight::default(), NotBaked));
    });
    let collected = collected(&mut app);
    let angles = collected.scene.lights.iter().filter_map(|light| match light.source {
        LightSource::Directional(sun) => Some(sun.angular_diameter),
        _ => None,
    });
    assert_eq!(angles.collect::<Vec<_>>(), [SUN_DIAMETER, 0.1, 0.2]);
    assert_eq!((collected.scene.lights.len(), collected.lights.len()), (5, 5));
    assert!(collected.warnings.len() == 1 && collected.warnings[0].starts_with("\"short\" is a light whose range"));
}

/// One such light would make every texel NaN.
#[test]
fn lights_that_are_not_finite_are_left_out_and_named() {
    let mut app = app();
    let flat = Transform::from_scale(Vec3::ZERO);
    app.world_mut().spawn((Baked::default(), Transform::default())).with_children(|root| {
        root.spawn((Name::new("crushed spot"), SpotLight::default(), flat));
        root.spawn((Name::new("crushed sun"), DirectionalLight::default(), flat));
        root.spawn((Name::new("crushed panel"), RectLight::default(), flat));
        root.spawn((Name::new("empty panel"), RectLight { width: 0.0, ..default() }));
        root.spawn((Name::new("bright"), PointLight { intensity: f32::INFINITY, ..default() }));
        root.spawn((Name::new("dark"), PointLight { intensity: -1.0, ..default() }));
        root.spawn((Name::new("lost"), PointLight::default(), Transform::from_xyz(f32::NAN, 0.0, 0.0)));
        root.spawn((Name::new("small"), PointLight::default(), flat));
        root.spawn((Name::new("panel"), RectLight::default()));
    });
    let collected = collected(&mut app);
    let names: Vec<&str> = collected.scene.lights.iter().map(|light| light.name.as_str()).collect();
    assert_eq!((names, collected.lights.len()), (vec!["small", "panel"], 2));
    let told = &collected.warnings[0];
    assert!(told.starts_with("\"crushed spot\"") && told.contains("6 more") && told.contains("scale"), "{told}");
}

/// One sky counts, as a color or as an image, whose sun becomes a light without an entity.
#[test]
fn skies() {
    use wgpu_types::{Extent3d, TextureDimension, TextureFormat};

    let mut app = app();
    let panorama = |index: u32| [if index == 40 { 1e5 } else { 1.0_f32 }, 1.0, 1.0, 1.0];
    let data = (0..64 * 32).flat_map(panorama).flat_map(f32::to_le_bytes).collect();
    let size = Extent3d { width: 64, height: 32, depth_or_array_layers: 1 };
    let usage = bevy::asset::RenderAssetUsages::MAIN_WORLD;
    let image = Image::new(size, TextureDimension::D2, data, TextureFormat::Rgba32Float, usage);
    let image = app.world_mut().resource_mut::<Assets<Image>>().add(image);
    app.world_mut().spawn((NotBaked, SkyLight { brightness: 7.0, ..default() }));
    let sky = SkyLight { brightness: 2.0, color: Color::linear_rgb(1.0, 0.5, 0.25), ..default() };
    let even = app.world_mut().spawn((Name::new("even"), sky.clone())).id();
    let scene = collected(&mut app);
    assert!(scene.scene.sky == Vec3::new(2.0, 1.0, 0.5) && scene.scene.sky_image.is_none());
    app.world_mut().spawn((Name::new("panorama"), SkyLight { image: Some(image), ..sky.clone() }));
    let warnings = collected(&mut app).warnings;
    assert!(warnings.len() == 1 && warnings[0].contains("is a second sky"), "{warnings:?}");
    app.world_mut().despawn(even);
    let scene = collected(&mut app);
    let image = scene.scene.sky_image.as_ref().unwrap();
    assert_eq!((scene.scene.sky_radiance(Vec3::NEG_Y), image.radiance(Vec3::Y)), (Vec3::new(2.0, 1.0, 0.5), Vec3::ONE));
    let [Light { name, source: LightSource::Directional(sun) }] = &scene.scene.lights[..] else { panic!("no sun") };
    assert!(name == "panorama" && sun.illuminance.x > 10.0 && sun.illuminance.y == 0.0, "{sun:?}");
    assert!(scene.lights.is_empty() && scene.warnings.is_empty());
}

/// A sky that is no light is named and left out.
#[test]
fn a_negative_sky_is_left_out() {
    let mut app = app();
    app.world_mut().spawn((Name::new("night"), SkyLight { brightness: -1.0, ..default() }));
    let scene = collected(&mut app);
    assert!(scene.scene.sky == Vec3::ZERO && scene.warnings[0].contains("\"night\" is a sky"), "{:?}", scene.warnings);
}
