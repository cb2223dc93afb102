//! The teapot, 32 bicubic patches, baked on a table: each patch is a chart of its own, with the true normals of the
//! surface. Writes what its camera sees to `teapot.ppm`.

mod patches;

use std::error::Error;
use std::fs;

use glam::{Affine3A, Vec3};
use radiosity::bake::{BakeSettings, bake};
use radiosity::geometry::Mesh;
use radiosity::light::{DirectionalLight, Light, LightSource};
use radiosity::lightmap::{LayoutSettings, Resolution};
use radiosity::material::Material;
use radiosity::progress::Progress;
use radiosity::render::{Camera, preview};
use radiosity::scene::{CurvedMesh, Receiver, Scene, Surface};
use radiosity::spline::{BSplineSurface, ChartScale, Homogeneous, OwnedSurface, Tolerance, tessellate};

const FILE: &str = "teapot.ppm";
const SIZE: [u32; 2] = [640, 480];
/// Meters in a unit of the original.
const SCALE: f32 = 0.06;

fn main() -> Result<(), Box<dyn Error>> {
    let scene = scene()?;
    let layout = LayoutSettings { resolution: Resolution::TexelsPerMeter(600.0), ..Default::default() };
    let progress = Progress::default();
    let bake = bake(&scene, &BakeSettings { layout, ..Default::default() }, &progress)?;
    let report = &bake.report;
    println!(
        "{} triangles of {} surfaces, energy balance {:+.4}",
        report.triangles, report.surfaces, report.energy_balance
    );

    let camera = Camera::looking_at(Vec3::new(0.1, 0.26, 0.58), Vec3::new(0.01, 0.075, 0.0), 38_f32.to_radians());
    let picture = preview(&scene, &bake, &camera, SIZE, None, &progress)?;
    let header = format!("P6 {} {} 255\n", SIZE[0], SIZE[1]);
    fs::write(FILE, [header.as_bytes(), picture.rgb.as_flattened()].concat())?;
    println!("{FILE} shows it at EV100 {:.1}", picture.ev100);
    Ok(())
}

fn scene() -> Result<Scene, Box<dyn Error>> {
    let sun = DirectionalLight {
        direction: Vec3::new(-0.55, -0.7, -0.35).normalize(),
        illuminance: Vec3::new(40_000.0, 37_000.0, 32_000.0),
        angular_diameter: 3_f32.to_radians(),
    };
    let lights = vec![Light { name: "sun".into(), source: LightSource::Directional(sun) }];
    let colors = [Vec3::new(0.55, 0.5, 0.42), Vec3::new(0.75, 0.32, 0.2)];
    let material = |base_color: Vec3| Material { base_color: base_color.extend(1.0), ..Default::default() };
    // Between lid and rim one looks, and light falls, on the back of the body.
    let pot = Material { double_sided: true, ..material(colors[1]) };
    let mut scene = Scene {
        lights,
        materials: vec![material(colors[0]), pot],
        sky: Vec3::new(3000.0, 3600.0, 4600.0),
        ..Default::default()
    };
    add(&mut scene, 0, table());
    let tolerance = Tolerance::new(0.0003, 0.15)?;
    for (number, patch) in patches::teapot().into_iter().enumerate() {
        let points = patch.map(|point| Homogeneous::new(point * SCALE, 1.0));
        let surface = BSplineSurface::bezier(&points, 4)?;
        let mesh = tessellate(&surface, &tolerance, ChartScale::Area).mesh(format!("patch {number}"));
        scene.curved.push(CurvedMesh { mesh: scene.meshes.len(), surface: OwnedSurface::copy_of(&surface) });
        add(&mut scene, 1, mesh);
    }
    Ok(scene)
}

fn table() -> Mesh {
    let positions = [[-0.6, 0.6], [0.6, 0.6], [0.6, -0.6], [-0.6, -0.6]].map(|[x, z]| Vec3::new(x, 0.0, z));
    Mesh { positions: positions.into(), triangles: vec![[0, 1, 2], [0, 2, 3]], ..Default::default() }
}

fn add(scene: &mut Scene, material: usize, mesh: Mesh) {
    scene.surfaces.push(Surface {
        name: format!("surface {}", scene.surfaces.len()),
        mesh: scene.meshes.len(),
        material,
        transform: Affine3A::IDENTITY,
        receiver: Receiver::Lightmap { density: 1.0 },
        casts: true,
    });
    scene.meshes.push(mesh);
}
