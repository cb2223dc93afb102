//! What lightmaps leave out, by paths of light: a mirror, a ball of glass with its caustic, and rough gold.

use std::error::Error;
use std::f32::consts::{PI, TAU};
use std::fs::File;
use std::io::BufWriter;

use glam::{Vec3, vec3};
use radiosity::geometry::tree;
use radiosity::parallel::Workers;
use radiosity::progress::Progress;
use radiosity::render::{Camera, Facet, Facets, PATHS, PathPicture, PathTracer};
use radiosity::scatter::{Ggx, Glass, Lambert, Matter, Mirror};

const FILE: &str = "path_traced.png";
const SIDE: u32 = 320;
/// Each adds [`PATHS`] paths to each pixel.
const STEPS: u32 = 32;
const EV100: f32 = -0.6;
/// Triangles of a ball from pole to pole; twice as many around.
const RINGS: u32 = 96;

/// Triangles with their materials.
#[derive(Default)]
struct Room {
    corners: Vec<[Vec3; 3]>,
    of_triangle: Vec<u32>,
    materials: Vec<Facet<Vec3>>,
}

impl Room {
    /// Adds quadrilaterals of one material, counter-clockwise seen from their fronts.
    fn add(&mut self, quads: &[[Vec3; 4]], matter: Matter<Vec3>, emission: f32) {
        for [a, b, c, d] in quads {
            self.corners.extend([[*a, *b, *c], [*a, *c, *d]]);
        }
        self.of_triangle.resize(self.corners.len(), self.materials.len() as u32);
        self.materials.push(Facet { matter, emission: Vec3::splat(emission) });
    }

    fn add_ball(&mut self, center: Vec3, radius: f32, matter: Matter<Vec3>) {
        let point = |ring: u32, step: u32| {
            let (sin, cos) = (ring as f32 * PI / RINGS as f32).sin_cos();
            let (s, c) = (step as f32 * PI / RINGS as f32 % TAU).sin_cos();
            center + radius * vec3(sin * s, cos, sin * c)
        };
        let quad = |(i, k): (u32, u32)| [point(i, k), point(i + 1, k), point(i + 1, k + 1), point(i, k + 1)];
        let quads: Vec<[Vec3; 4]> = (0..RINGS).flat_map(|i| (0..2 * RINGS).map(move |k| (i, k))).map(quad).collect();
        self.add(&quads, matter, 0.0);
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let Room { corners, of_triangle, materials } = &room();
    let occluders = tree(corners.clone());
    let tracer =
        PathTracer::new(Facets { corners, of_triangle, materials, occluders, sky: |_| Vec3::ZERO }, Vec::new());
    let camera = Camera::looking_at(vec3(0.5, 0.5, 2.35), vec3(0.5, 0.47, 0.0), 0.72);
    let mut picture = PathPicture::new([SIDE, SIDE], 1);
    let (workers, progress) = (Workers::new(0), Progress::default());
    for step in 1..=STEPS {
        picture.step(&tracer, &camera, &workers, &progress)?;
        if step.is_power_of_two() && step > 1 {
            println!("{:4} paths a pixel: {:5.1} s, noise {:4.1} %", step * PATHS, progress.seconds(), noise(&picture));
        }
    }
    write_png(&picture.rgb(EV100))
}

/// The mean standard error over the mean, in percent.
fn noise(picture: &PathPicture<Vec3>) -> f32 {
    let sum = |of: fn(&radiosity::render::Estimate<Vec3>) -> Vec3| picture.pixels.iter().map(of).sum::<Vec3>();
    100.0 * sum(|pixel| pixel.standard_error()).element_sum() / sum(|pixel| pixel.mean).element_sum()
}

/// A box of 1 m without its front, a lamp below the ceiling, a mirror before the wall, two balls.
fn room() -> Room {
    let mut room = Room::default();
    let paint = |red, green, blue| Matter::Lambert(Lambert { reflectance: vec3(red, green, blue) });
    let [a, b, c, d] = [vec3(0., 0., 0.), vec3(1., 0., 0.), vec3(1., 0., 1.), vec3(0., 0., 1.)];
    let [e, f, g, h] = [a, b, c, d].map(|corner| corner + Vec3::Y);
    room.add(&[[d, c, b, a], [e, f, g, h], [a, b, f, e]], paint(0.73, 0.73, 0.7), 0.0);
    room.add(&[[d, a, e, h]], paint(0.62, 0.06, 0.05), 0.0);
    room.add(&[[b, c, g, f]], paint(0.12, 0.45, 0.1), 0.0);
    let lamp = [vec3(0.35, 0.995, 0.35), vec3(0.65, 0.995, 0.35), vec3(0.65, 0.995, 0.65), vec3(0.35, 0.995, 0.65)];
    room.add(&[lamp], paint(0.0, 0.0, 0.0), 14.0);
    let mirror = [vec3(0.08, 0.1, 0.4), vec3(0.5, 0.1, 0.05), vec3(0.5, 0.8, 0.05), vec3(0.08, 0.8, 0.4)];
    room.add(&[mirror], Matter::Mirror(Mirror { reflectance: vec3(0.92, 0.93, 0.95) }), 0.0);
    let gold = Ggx::new(vec3(1.0, 0.71, 0.29), 0.35);
    room.add_ball(vec3(0.28, 0.17, 0.42), 0.17, Matter::Ggx(gold));
    let glass = Glass { index: 1.5, absorption: vec3(1.6, 0.3, 0.5) };
    room.add_ball(vec3(0.68, 0.2, 0.62), 0.2, Matter::Glass(glass));
    room
}

fn write_png(rgb: &[[u8; 3]]) -> Result<(), Box<dyn Error>> {
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(FILE)?), SIDE, SIDE);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(rgb.as_flattened())?;
    println!("{FILE} shows it");
    Ok(())
}
