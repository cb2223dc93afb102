//! A chapel whose windows throw colors on the floor, with a mirror on its wall: bakes it and writes what its camera sees
//! to `stained_glass.ppm`.

use std::error::Error;
use std::fs;

use glam::{Affine3A, Vec3};
use radiosity::bake::{BakeSettings, bake};
use radiosity::geometry::{Mesh, hash};
use radiosity::light::{DirectionalLight, Light, LightSource};
use radiosity::lightmap::{LayoutSettings, Resolution};
use radiosity::material::Material;
use radiosity::progress::Progress;
use radiosity::render::{Camera, preview};
use radiosity::scene::{Receiver, Scene, Surface};

const FILE: &str = "stained_glass.ppm";
const SIZE: [u32; 2] = [960, 640];
/// Width, height and depth in meters.
const ROOM: Vec3 = Vec3::new(5.0, 4.0, 8.0);
/// Where along the depth windows begin.
const WINDOWS: [f32; 3] = [1.0, 3.4, 5.8];
const WINDOW_WIDTH: f32 = 1.2;
/// Where windows begin and end above the floor.
const WINDOW_HEIGHTS: [f32; 2] = [0.8, 3.2];
/// Panes in a row, and rows.
const PANES: [u32; 2] = [3, 6];
const COLORS: [[f32; 3]; 6] =
    [[0.9, 0.05, 0.04], [0.05, 0.12, 0.85], [0.95, 0.65, 0.05], [0.04, 0.5, 0.12], [0.45, 0.06, 0.6], [0.95, 0.9, 0.8]];

fn main() -> Result<(), Box<dyn Error>> {
    let scene = chapel();
    let layout = LayoutSettings { resolution: Resolution::TexelsPerMeter(48.0), ..Default::default() };
    let progress = Progress::default();
    let bake = bake(&scene, &BakeSettings { layout, ..Default::default() }, &progress)?;
    println!("energy balance {:+.4}", bake.report.energy_balance);

    let camera = Camera::looking_at(Vec3::new(4.5, 1.9, 7.7), Vec3::new(1.7, 1.1, 2.0), 60_f32.to_radians());
    let picture = preview(&scene, &bake, &camera, SIZE, None, &progress)?;
    let header = format!("P6 {} {} 255\n", SIZE[0], SIZE[1]);
    fs::write(FILE, [header.as_bytes(), picture.rgb.as_flattened()].concat())?;
    println!("{FILE} shows it at EV100 {:.1}", picture.ev100);
    Ok(())
}

fn chapel() -> Scene {
    let sun = DirectionalLight {
        direction: Vec3::new(0.72, -0.62, -0.3).normalize(),
        illuminance: Vec3::new(80_000.0, 74_000.0, 62_000.0),
        angular_diameter: 0.53_f32.to_radians(),
    };
    let lights = vec![Light { name: "sun".into(), source: LightSource::Directional(sun) }];
    let mut scene = Scene { lights, sky: Vec3::new(2500.0, 3200.0, 4500.0), ..Default::default() };
    let plaster = paint(&mut scene, Vec3::new(0.72, 0.7, 0.66));
    let stone = paint(&mut scene, Vec3::new(0.5, 0.47, 0.42));
    let lead = paint(&mut scene, Vec3::splat(0.05));
    let gold = paint(&mut scene, Vec3::new(0.6, 0.42, 0.12));
    let (x, y, z) = (Vec3::X * ROOM.x, Vec3::Y * ROOM.y, Vec3::Z * ROOM.z);
    quad(&mut scene, stone, [Vec3::ZERO, z, x]);
    quad(&mut scene, plaster, [y, x, z]);
    quad(&mut scene, plaster, [x, z, y]);
    quad(&mut scene, plaster, [Vec3::ZERO, x, y]);
    quad(&mut scene, plaster, [z, y, x]);
    wall_of_windows(&mut scene, plaster);
    for start in WINDOWS {
        window(&mut scene, lead, Vec3::new(0.0, WINDOW_HEIGHTS[0], start));
    }
    cuboid(&mut scene, gold, Vec3::new(1.0, 0.4, 0.0), Vec3::new(4.0, 3.4, 0.04));
    let silver = Material { metallic: 1.0, roughness: 0.0, ..colored(Vec3::new(0.94, 0.94, 0.92)) };
    scene.materials.push(silver);
    let silver = scene.materials.len() - 1;
    quad(&mut scene, silver, [Vec3::new(1.12, 0.52, 0.05), Vec3::X * 2.76, Vec3::Y * 2.76]);
    cuboid(&mut scene, plaster, Vec3::new(3.6, 0.0, 3.6), Vec3::new(4.0, 1.0, 4.0));
    cuboid(&mut scene, stone, Vec3::new(1.6, 0.0, 4.6), Vec3::new(2.2, 0.5, 5.8));
    scene
}

/// The wall at `x = 0` in blocks around its windows, 25 cm thick.
fn wall_of_windows(scene: &mut Scene, paint: usize) {
    let mut block = |low: [f32; 2], high: [f32; 2]| {
        cuboid(scene, paint, Vec3::new(-0.25, low[0], low[1]), Vec3::new(0.0, high[0], high[1]));
    };
    let [bottom, top] = WINDOW_HEIGHTS;
    block([-0.1, -0.25], [bottom, ROOM.z + 0.25]);
    block([top, -0.25], [ROOM.y + 0.1, ROOM.z + 0.25]);
    let starts = [-0.25].into_iter().chain(WINDOWS.map(|start| start + WINDOW_WIDTH));
    for (from, to) in starts.zip(WINDOWS.into_iter().chain([ROOM.z + 0.25])) {
        block([bottom, from], [top, to]);
    }
}

/// Panes of glass in bars of lead.
fn window(scene: &mut Scene, lead: usize, corner: Vec3) {
    let [columns, rows] = PANES;
    let corner = corner - Vec3::X * 0.12;
    let across = Vec3::Z * (WINDOW_WIDTH / columns as f32);
    let up = Vec3::Y * ((WINDOW_HEIGHTS[1] - WINDOW_HEIGHTS[0]) / rows as f32);
    for pane in 0..columns * rows {
        let color = COLORS[hash(pane, scene.surfaces.len() as u32) as usize % COLORS.len()];
        scene.materials.push(Material { transmission: 1.0, double_sided: true, ..colored(color.into()) });
        let place = corner + across * (pane % columns) as f32 + up * (pane / columns) as f32;
        let glass = scene.materials.len() - 1;
        let surface = quad(scene, glass, [place, up, across]);
        scene.surfaces[surface].receiver = Receiver::Nothing;
    }
    let thick = Vec3::splat(0.015);
    for column in 0..=columns {
        let foot = corner + across * column as f32;
        cuboid(scene, lead, foot - thick, foot + up * rows as f32 + thick);
    }
    for row in 0..=rows {
        let end = corner + up * row as f32;
        cuboid(scene, lead, end - thick, end + across * columns as f32 + thick);
    }
}

fn colored(color: Vec3) -> Material {
    Material { base_color: color.extend(1.0), ..Default::default() }
}

fn paint(scene: &mut Scene, color: Vec3) -> usize {
    scene.materials.push(colored(color));
    scene.materials.len() - 1
}

/// Adds a rectangle from its corner and two sides, seen from the side from which the first turns to the second
/// counter-clockwise, and returns the index of its surface.
fn quad(scene: &mut Scene, material: usize, [corner, a, b]: [Vec3; 3]) -> usize {
    let positions = vec![corner, corner + a, corner + a + b, corner + b];
    add(scene, material, Mesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]], ..Default::default() })
}

fn cuboid(scene: &mut Scene, material: usize, low: Vec3, high: Vec3) -> usize {
    let positions = (0..8).map(|k| Vec3::select([k & 1, k & 2, k & 4].map(|bit| bit != 0).into(), high, low)).collect();
    let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    add(scene, material, Mesh { positions, triangles, ..Default::default() })
}

fn add(scene: &mut Scene, material: usize, mesh: Mesh) -> usize {
    scene.surfaces.push(Surface {
        name: format!("surface {}", scene.surfaces.len()),
        mesh: scene.meshes.len(),
        material,
        transform: Affine3A::IDENTITY,
        receiver: Receiver::Lightmap { density: 1.0 },
        casts: true,
    });
    scene.meshes.push(mesh);
    scene.surfaces.len() - 1
}
