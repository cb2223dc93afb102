//! A colonnade in fog with a glass pane and smoke, drawn without any GPU: K layers a pixel, and media between them.

use std::error::Error;
use std::f32::consts::TAU;
use std::fs::File;
use std::io::BufWriter;

use glam::{Mat4, Vec3, Vec4, vec3};
use radiosity::composite::*;
use radiosity::geometry::Ray;
use radiosity::render::khronos_pbr_neutral;
use radiosity::spectrum::linear_to_srgb;

const FILE: &str = "fog_and_glass.png";
const SIZE: [u32; 2] = [960, 540];
/// Layers that a sample remembers.
const K: usize = 6;
const SAMPLES: usize = 4;
const NEAR: f32 = 0.1;
const FIELD_OF_VIEW: f32 = 0.8;
const EYE: Vec3 = Vec3::new(0.6, 1.7, 6.5);
const TARGET: Vec3 = Vec3::new(0.0, 1.35, 0.0);
/// Towards the lamp, which lights everything from the side.
const LIGHT: Vec3 = Vec3::new(0.48, 0.64, 0.6);
const SKY: Vec3 = Vec3::new(0.2, 0.32, 0.55);

/// A triangle in space with its color at each corner.
struct Triangle {
    corners: [Vec3; 3],
    colors: [PremultipliedRgba; 3],
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut triangles = floor();
    (0..14).for_each(|k| add_column(&mut triangles, vec3([-1.8, 1.8][k % 2], 0.0, 3.0 - 3.0 * (k / 2) as f32)));
    add_glass(&mut triangles);
    let count = (SIZE[0] * SIZE[1]) as usize;
    let mut pixels = vec![Layers::<K>::EMPTY; count * SAMPLES];
    let mut picture = Framebuffer::new(SIZE, Samples::Four, &mut pixels)?;
    let clip = Mat4::perspective_infinite_reverse_rh(FIELD_OF_VIEW, SIZE[0] as f32 / SIZE[1] as f32, NEAR)
        * Mat4::look_at_rh(EYE, TARGET, Vec3::Y);
    for Triangle { corners, colors } in &triangles {
        let mixed = |weights: Vec3| {
            let [a, b, c] = colors.map(|color| Vec4::from_array(color.to_array()));
            PremultipliedRgba::new((a * weights.x + b * weights.y + c * weights.z).to_array())
        };
        picture.draw(&corners.map(|corner| clip * corner.extend(1.0)), |fragment| mixed(fragment.weights));
    }
    let densities = smoke_densities();
    let smoke = Smoke::new([vec3(-1.3, 0.0, -4.6), vec3(1.7, 4.2, -1.6)], GRID, &densities, Vec3::splat(0.05))?;
    let fog = HeightFog { color: vec3(0.6, 0.62, 0.64), extinction: 0.2, base: Vec3::ZERO, up: Vec3::Y, scale: 0.8 };
    let glass = stained_glass();
    let pane = GlassPane {
        corner: vec3(-1.75, 2.45, 2.2),
        across: vec3(1.6, 0.0, -0.7),
        down: vec3(0.0, -2.1, 0.0),
        picture: Sprite::new(GLASS[0], &glass)?,
    };
    let colors: Vec<Vec3> = (0..count)
        .map(|k| {
            let samples = &pixels[k * SAMPLES..(k + 1) * SAMPLES];
            let seen = samples.iter().map(|pixel| shown(&ray(k), pixel, &pane, &[&fog, &smoke]));
            seen.sum::<Vec3>() / SAMPLES as f32
        })
        .collect();
    write_png(&colors)?;
    let merged = pixels.iter().filter(|pixel| pixel.error() > 0.0).count();
    println!("{FILE} shows {} triangles; {merged} of {} samples had to guess an order", triangles.len(), pixels.len());
    Ok(())
}

/// Through the center of a pixel. Its direction ends one unit of depth ahead, so that places along it are depths.
fn ray(pixel: usize) -> Ray {
    let [width, height] = SIZE.map(|side| side as f32);
    let column = (pixel % SIZE[0] as usize) as f32 + 0.5;
    let row = (pixel / SIZE[0] as usize) as f32 + 0.5;
    let forward = (TARGET - EYE).normalize();
    let right = forward.cross(Vec3::Y).normalize();
    let scale = (0.5 * FIELD_OF_VIEW).tan();
    let [x, y] = [(2.0 * column / width - 1.0) * scale * width / height, (1.0 - 2.0 * row / height) * scale];
    Ray { origin: EYE, direction: forward + right * x + right.cross(forward) * y, end: f32::INFINITY }
}

/// Surfaces and the pane at their places, media between them, the sky behind.
fn shown(ray: &Ray, pixel: &Layers<K>, pane: &GlassPane, media: &[&dyn Medium]) -> Vec3 {
    let surfaces = pixel.iter().map(|layer| (NEAR / layer.depth, layer.color));
    let mut all: Vec<_> = surfaces.chain(pane.hit(ray)).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let seen = through(ray, media, all);
    khronos_pbr_neutral(seen.over(PremultipliedRgba::adding(SKY, 1.0)).rgb() * 1.2)
}

fn lit(albedo: Vec3, normal: Vec3) -> PremultipliedRgba {
    PremultipliedRgba::adding(albedo * (0.14 + 0.75 * normal.dot(LIGHT).max(0.0)), 1.0)
}

/// Tiles in two shades.
fn floor() -> Vec<Triangle> {
    let tile = |k: i32| {
        let (x, z) = ((k % 16 - 8) as f32, 6.0 - (k / 16) as f32);
        let albedo = if (k % 16 + k / 16) % 2 == 0 { vec3(0.6, 0.55, 0.5) } else { vec3(0.25, 0.22, 0.2) };
        quad(vec3(x, 0.0, z), Vec3::X, Vec3::NEG_Z, [lit(albedo, Vec3::Y); 2])
    };
    (0..16 * 40).flat_map(tile).collect()
}

/// A parallelogram; the colors are those at its two edges along `up`.
fn quad(corner: Vec3, across: Vec3, up: Vec3, [left, right]: [PremultipliedRgba; 2]) -> [Triangle; 2] {
    let [a, b, c, d] = [corner, corner + across, corner + across + up, corner + up];
    [
        Triangle { corners: [a, b, c], colors: [left, right, right] },
        Triangle { corners: [a, c, d], colors: [left, right, left] },
    ]
}

/// Panes of tinted glass that stand one behind the other, each turned a little more.
fn add_glass(triangles: &mut Vec<Triangle>) {
    const TINTS: [[f32; 3]; 4] = [[0.02, 0.35, 0.3], [0.6, 0.3, 0.02], [0.45, 0.05, 0.2], [0.05, 0.15, 0.5]];
    for (k, rgb) in TINTS.into_iter().enumerate() {
        let (sin, cos) = (0.35 * k as f32 - 0.5).sin_cos();
        let across = vec3(cos, 0.0, sin) * 1.5;
        let corner = vec3(0.1 + 0.3 * k as f32, 0.0, 2.2 - 1.5 * k as f32);
        let glass = StraightRgba { rgb, alpha: 0.5 }.premultiplied();
        triangles.extend(quad(corner, across, Vec3::Y * (1.0 + 0.5 * k as f32), [glass; 2]));
    }
}

/// A column of marble.
fn add_column(triangles: &mut Vec<Triangle>, foot: Vec3) {
    const SIDES: usize = 24;
    let out = |k: usize| {
        let (sin, cos) = (k as f32 * TAU / SIDES as f32).sin_cos();
        vec3(cos, 0.0, sin)
    };
    for k in 0..SIDES {
        let [from, to] = [out(k), out(k + 1)];
        let marble = vec3(0.8, 0.75, 0.68);
        triangles.extend(quad(
            foot + from * 0.28,
            (to - from) * 0.28,
            Vec3::Y * 3.2,
            [from, to].map(|n| lit(marble, n)),
        ));
    }
}

const GLASS: [usize; 2] = [240, 288];

/// Rings of colors between leads, in a frame.
fn stained_glass() -> Vec<PremultipliedRgba> {
    const PANES: [[f32; 3]; 5] =
        [[0.9, 0.75, 0.1], [0.8, 0.1, 0.08], [0.1, 0.25, 0.75], [0.05, 0.5, 0.2], [0.5, 0.1, 0.5]];
    let pixel = |k: usize| {
        let (x, y) = ((k % GLASS[0]) as f32 - 119.5, (k / GLASS[0]) as f32 - 143.5);
        let (radius, turn) = (x.hypot(y), y.atan2(x) / TAU * 12.0 + 12.0);
        let ring = (radius / 32.0) as usize;
        let is_lead = radius % 32.0 < 2.5 || (ring > 0 && (turn.fract() - 0.5).abs() * radius > 0.5 * radius - 2.2);
        let is_frame = x.abs() > 114.0 || y.abs() > 138.0;
        let (rgb, alpha) = match is_lead || is_frame {
            true => ([0.02; 3], 1.0),
            false => (PANES[(ring * 2 + if ring > 0 { turn as usize % 2 } else { 0 }) % 5], 0.55),
        };
        StraightRgba { rgb, alpha }.premultiplied()
    };
    (0..GLASS[0] * GLASS[1]).map(pixel).collect()
}

const GRID: [usize; 3] = [24, 32, 20];

/// A plume that turns as it rises.
fn smoke_densities() -> Vec<f32> {
    let density = |k: usize| {
        let share = |index: usize, axis: usize| index as f32 / (GRID[axis] - 1) as f32;
        let [x, y, z] = [share(k % GRID[0], 0), share(k / GRID[0] % GRID[1], 1), share(k / (GRID[0] * GRID[1]), 2)];
        let (sin, cos) = (y * 9.0).sin_cos();
        let distance = (x - 0.5 - 0.16 * y * sin).hypot(z - 0.5 - 0.16 * y * cos);
        let width = 0.06 + 0.16 * y;
        let puffs = 0.65 + 0.35 * (17.0 * y + 9.0 * x).sin();
        9.0 * puffs * (-(distance / width).powi(2)).exp() * (1.0 - y).max(0.0).sqrt()
    };
    (0..GRID.iter().product()).map(density).collect()
}

fn write_png(colors: &[Vec3]) -> Result<(), Box<dyn Error>> {
    let bytes: Vec<u8> = colors.iter().flat_map(|color| color.to_array().map(linear_to_srgb)).collect();
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(FILE)?), SIZE[0], SIZE[1]);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(&bytes)?;
    Ok(())
}
