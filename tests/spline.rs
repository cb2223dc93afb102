//! Splines on entities: what shows them follows their control points, and a bake takes them as they are.

use std::f32::consts::{FRAC_1_SQRT_2, PI};
use std::time::Duration;

use bevy::mesh::VertexAttributeValues;
use bevy::pbr::Lightmap;
use bevy::prelude::*;
use bevy::render::sync_world::SyncWorldPlugin;
use bevy::time::TimeUpdateStrategy;
use bevy_radiosity::RadiosityPlugins;
use bevy_radiosity::bake::{apply_bake, collect_unlit, remove_bake};
use bevy_radiosity::prelude::*;
use bevy_radiosity::spline::{LightOnCurve, ShapeError};
use radiosity::bake::Quality as CoreQuality;
use radiosity::bake::bake;
use radiosity::lightmap::{LayoutSettings, Resolution as CoreResolution, UvMode as CoreUvMode, UvOrigin};
use radiosity::progress::Progress;
use radiosity::spline::SplineError;
use radiosity_tests::TestFolder;
use radiosity_tests::render::app_without_gpu;

fn app() -> App {
    let folder = TestFolder::new("spline");
    // Without a renderer Bevy 0.19.1 cannot despawn lights, but for this plugin.
    let mut app = app_without_gpu(folder.path(), (RadiosityPlugins, SyncWorldPlugin));
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(100)));
    app
}

/// A quarter of a cylinder of radius 1.
fn arc() -> SplineCurve {
    SplineCurve::bezier(vec![Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y]).with_weights(vec![1.0, FRAC_1_SQRT_2, 1.0])
}

fn barrel() -> SplineSurface {
    SplineSurface::Extrusion { curve: arc(), along: Vec3::Z }
}

fn positions(app: &App, entity: Entity) -> Vec<Vec3> {
    let handle = &app.world().get::<Mesh3d>(entity).expect("it has a mesh").0;
    let mesh = app.world().resource::<Assets<Mesh>>().get(handle).unwrap();
    let Some(VertexAttributeValues::Float32x3(all)) = mesh.attribute(Mesh::ATTRIBUTE_POSITION) else { panic!() };
    all.iter().map(|&position| position.into()).collect()
}

fn mesh_id(app: &App, entity: Entity) -> AssetId<Mesh> {
    app.world().get::<Mesh3d>(entity).unwrap().0.id()
}

#[test]
fn meshes_follow_control_points() {
    let mut app = app();
    let surface = app.world_mut().spawn(barrel()).id();
    let tube = app.world_mut().spawn((arc(), SplineSweep::Tube { radius: 0.1 })).id();
    app.update();
    assert!(positions(&app, surface).iter().all(|p| (p.truncate().length() - 1.0).abs() < 1e-6));
    let to_curve = |p: &Vec3| Vec2::new(p.truncate().length() - 1.0, p.z).length();
    assert!(positions(&app, tube).iter().all(|p| (to_curve(p) - 0.1).abs() < 2e-3), "it lies around the arc");

    let before = [mesh_id(&app, surface), mesh_id(&app, tube)];
    app.update();
    assert_eq!([mesh_id(&app, surface), mesh_id(&app, tube)], before, "nothing changed");

    if let SplineSurface::Extrusion { along, .. } = &mut *app.world_mut().get_mut::<SplineSurface>(surface).unwrap() {
        *along = 3.0 * Vec3::Z;
    }
    app.world_mut().get_mut::<SplineCurve>(tube).unwrap().points[1] = Vec3::new(0.5, 0.5, 0.0);
    app.update();
    assert!((positions(&app, surface).iter().map(|p| p.z).fold(0.0, f32::max) - 3.0).abs() < 1e-6);
    let beside = |p: &Vec3| Vec2::new((p.x + p.y - 1.0) * FRAC_1_SQRT_2, p.z).length();
    assert!(positions(&app, tube).iter().all(|p| (beside(p) - 0.1).abs() < 1e-5), "it is straight now");
    assert!((app.world().get::<SplinePath>(tube).unwrap().length() - 2.0_f32.sqrt()).abs() < 1e-5);

    let coarse = positions(&app, surface).len();
    app.world_mut().get_mut::<SplineTolerance>(surface).unwrap().chord = 1e-5;
    app.update();
    assert!(positions(&app, surface).len() > 2 * coarse);
}

#[test]
fn wrong_input_leaves_the_mesh_as_it_was() {
    let mut app = app();
    let net = ControlNet::bezier(2, vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE]);
    let surface = app.world_mut().spawn(SplineSurface::from(net.clone())).id();
    let curve = app.world_mut().spawn((arc(), SplineSweep::Ribbon { width: 0.2 })).id();
    app.update();
    let before = [mesh_id(&app, surface), mesh_id(&app, curve)];
    let length = app.world().get::<SplinePath>(curve).unwrap().length();
    let wrong: [(ControlNet, ShapeError); 4] = [
        (net.clone().with_weights(vec![1.0]), ShapeError::Weights { weights: 1, points: 4 }),
        (
            net.clone().with_weights(vec![1.0, 1.0, -2.0, 1.0]),
            ShapeError::Spline(SplineError::Weight { index: 2, weight: -2.0 }),
        ),
        (
            ControlNet { points: vec![Vec3::NAN; 4], ..net.clone() },
            ShapeError::Spline(SplineError::NotFinite { index: 0 }),
        ),
        (ControlNet { points: vec![Vec3::X; 4], ..net.clone() }, ShapeError::Nothing),
    ];
    for (net, expected) in wrong {
        let wrong = SplineSurface::from(net);
        if expected != ShapeError::Nothing {
            assert_eq!(wrong.surface().unwrap_err(), expected);
        }
        assert!(expected.to_string().contains("; "), "a remedy: {expected}");
        *app.world_mut().get_mut::<SplineSurface>(surface).unwrap() = wrong;
        app.update();
        assert_eq!(mesh_id(&app, surface), before[0], "{expected}");
    }
    *app.world_mut().get_mut::<SplineSweep>(curve).unwrap() = SplineSweep::Tube { radius: f32::NAN };
    app.world_mut().get_mut::<SplineCurve>(curve).unwrap().points.clear();
    app.update();
    assert_eq!(mesh_id(&app, curve), before[1]);
    assert_eq!(app.world().get::<SplinePath>(curve).unwrap().length(), length);
    assert_eq!(SplineSurface::Coons { edges: vec![] }.surface().unwrap_err(), ShapeError::Edges { edges: 0 });
}

/// The chart of a surface is its lightmap, and its texels have its normals.
#[test]
fn surfaces_are_baked_without_unwrapping() {
    let mut app = app();
    let material = app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(Color::BLACK);
    let coarse = SplineTolerance { chord: 0.1, angle: 1.0 };
    let material = MeshMaterial3d(material);
    app.world_mut().spawn((
        Baked::default(),
        Transform::default(),
        Visibility::default(),
        children![
            (Name::new("barrel"), barrel(), coarse, material.clone()),
            (Name::new("tube"), arc(), SplineSweep::Tube { radius: 0.1 }, material, Transform::from_xyz(9.0, 0.0, 0.0)),
            (
                DirectionalLight { illuminance: 1000.0, ..default() },
                Transform::default().looking_to(Vec3::new(-1.0, -1.0, 0.0), Vec3::Z),
            ),
        ],
    ));
    app.update();
    let collected = collect_unlit(app.world_mut());
    assert_eq!((collected.surfaces.len(), collected.scene.curved.len()), (2, 1), "{:?}", collected.warnings);
    assert_eq!(collected.scene.curved[0].mesh, 0);
    let resolution = CoreResolution::TexelsPerMeter(32.0);
    let layout = LayoutSettings { resolution, uv: CoreUvMode::Keep, ..Default::default() };
    let settings = radiosity::bake::BakeSettings { layout, quality: CoreQuality::Draft, ..Default::default() };
    let bake = bake(&collected.scene, &settings, &Progress::default()).expect("all coordinates can be kept");
    assert!(bake.uvs.iter().flatten().all(|uv| uv.origin == UvOrigin::Kept));
    assert!(bake.report.warnings.is_empty(), "{:?}", bake.report.warnings);

    let (image, placement) = (&bake.images[0], bake.placements[0].unwrap());
    let size = Vec2::new(image.width as f32, image.height as f32);
    let (low, high) = (placement.min * size, placement.max * size);
    let row = ((low.y + high.y) / 2.0) as usize * image.width as usize;
    for column in low.x.ceil() as usize + 2..high.x.floor() as usize - 2 {
        let share = (column as f32 + 0.5 - low.x) / (high.x - low.x);
        let expected = 1000.0 / PI * (share * PI / 2.0 - PI / 4.0).cos();
        let found = image.texels[row + column].x;
        // Along the coarse chart angles are off by less than this.
        assert!((found - expected).abs() < 0.01 * 1000.0 / PI, "{found} for {expected} at {share}");
    }

    let entity = collected.surfaces[0];
    let own = mesh_id(&app, entity);
    apply_bake(app.world_mut(), &collected, bake, &BakeSettings::default());
    app.update();
    assert_eq!(mesh_id(&app, entity), own, "no copy of the mesh for other coordinates");
    assert!(app.world().get::<Lightmap>(entity).is_some());

    // Edited after the bake, it shows its light until the next one, and the bake can be taken off.
    *app.world_mut().get_mut::<SplineSurface>(entity).unwrap() =
        SplineSurface::Extrusion { curve: arc(), along: 2.0 * Vec3::Z };
    app.update();
    let edited = mesh_id(&app, entity);
    assert!(edited != own && app.world().get::<Lightmap>(entity).is_some());
    assert_eq!(collect_unlit(app.world_mut()).scene.curved.len(), 1, "the next bake sees the new surface");
    remove_bake(app.world_mut());
    app.update();
    assert!(mesh_id(&app, entity) == edited && app.world().get::<Lightmap>(entity).is_none());
}

#[test]
fn travel_is_at_constant_speed() {
    let mut app = app();
    let points = [[0.0, 0.0, 0.0], [1.0, 0.2, 0.0], [1.2, 3.0, 0.5], [0.0, 1.0, 2.0], [4.0, 1.0, 2.0]];
    let place = Transform::from_xyz(5.0, -2.0, 1.0).with_rotation(Quat::from_rotation_y(0.7));
    let curve = app.world_mut().spawn((SplineCurve::open(3, points.map(Vec3::from).to_vec()), place)).id();
    let parent = app.world_mut().spawn((Transform::from_xyz(0.0, 7.0, 0.0).with_scale(Vec3::splat(2.0)),)).id();
    let travel = TravelAlong { end: PathEnd::Return, ..TravelAlong::new(curve, 0.5) };
    let camera = app.world_mut().spawn((Camera3d::default(), travel, ChildOf(parent))).id();
    app.update();
    let length = app.world().get::<SplinePath>(curve).unwrap().length();
    let pose = |app: &App| app.world().get::<GlobalTransform>(camera).unwrap().compute_transform();
    let mut before = pose(&app);
    let mut turned: f32 = 0.0;
    for step in 0..(length / 0.05) as usize - 4 {
        app.update();
        let now = pose(&app);
        let way = now.translation - before.translation;
        // The chord is a little shorter than the way.
        assert!((0.0495..0.05002).contains(&way.length()), "{} m in step {step}", way.length());
        assert!(now.forward().dot(way.normalize()) > 0.995, "it looks ahead");
        let roll = before.up().reject_from(*now.forward()).angle_between(*now.up());
        turned = turned.max(roll);
        before = now;
    }
    assert!(turned < 0.01, "it turns about the curve by {turned} rad in a step");
    for _ in 0..10 {
        app.update();
    }
    let travel = app.world().get::<TravelAlong>(camera).unwrap();
    assert!(travel.speed == -0.5 && travel.distance < length, "it is on its way back");
    let whole = app.world().get::<SplinePath>(curve).unwrap();
    assert!(whole.at(f32::NAN).is_some(), "nothing panics");
}

#[test]
fn lights_stand_at_equal_distances() {
    let mut app = app();
    let ring: Vec<Vec3> = (0..8).map(|k| Quat::from_rotation_y(PI / 4.0 * k as f32) * Vec3::X * 2.0).collect();
    let light = LightAlong::Point(PointLight { intensity: 700.0, ..default() });
    let curve = app.world_mut().spawn((SplineCurve::closed(3, ring), LightsAlong { count: 12, light })).id();
    app.update();
    let places = |app: &mut App| -> Vec<Vec3> {
        let mut lights = app.world_mut().query::<(&LightOnCurve, &PointLight, &GlobalTransform)>();
        let mut all: Vec<_> = lights.iter(app.world()).map(|(n, _, at)| (n.0, at.translation())).collect();
        all.sort_by_key(|(n, _)| *n);
        all.into_iter().map(|(_, at)| at).collect()
    };
    let is_even = |places: &[Vec3]| {
        let gaps = (0..places.len()).map(|k| places[k].distance(places[(k + 1) % places.len()]));
        let (low, high) = gaps.fold((f32::MAX, 0.0_f32), |(low, high), gap| (low.min(gap), high.max(gap)));
        assert!(high - low < 0.01 * high, "gaps from {low} to {high}");
    };
    let twelve = places(&mut app);
    assert_eq!(twelve.len(), 12);
    is_even(&twelve);
    app.world_mut().get_mut::<LightsAlong>(curve).unwrap().count = 5;
    app.world_mut().get_mut::<SplineCurve>(curve).unwrap().points.iter_mut().for_each(|point| *point *= 2.0);
    app.update();
    let five = places(&mut app);
    assert_eq!(five.len(), 5);
    is_even(&five);
    assert!(five.iter().all(|at| at.length() > 3.5), "they followed the curve");
    let other = app.world_mut().spawn((Transform::default(), ChildOf(curve))).id();
    app.world_mut().entity_mut(curve).remove::<LightsAlong>();
    app.update();
    assert!(places(&mut app).is_empty(), "lights go with what put them there");
    assert!(app.world().get_entity(other).is_ok(), "other children stay");
}
