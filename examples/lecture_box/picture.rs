//! Pictures of patches by a depth buffer on the CPU.

use std::fs::File;
use std::io::{BufWriter, Error};

use glam::{DVec3, Mat4, Vec3};
use radiosity::composite::{DepthBuffer, RasterError};
use radiosity::material::linear_to_srgb;
use radiosity::patch::{Element, Field};
use radiosity::render::khronos_pbr_neutral;

const SIZE: [u32; 2] = [640, 480];
/// Samples for each pixel in each direction.
const SAMPLES: u32 = 3;
/// Of black on the lines between patches.
const LINE: f32 = 0.3;
/// What a radiosity is multiplied by before tone mapping.
const EXPOSURE: f32 = 1.7;

/// The patches as the camera sees them: samples row by row, each of a patch and its radiosity.
pub struct Picture {
    samples: Vec<(usize, Vec3)>,
    has_lines: bool,
}

impl Picture {
    /// Each patch in its own radiosity, with lines between.
    pub fn flat(elements: &[Element<DVec3>], field: &Field<DVec3, DVec3>) -> Result<Self, RasterError> {
        let colors = |i: usize, _| [field.at_centers[i]; 3];
        Ok(Self { has_lines: true, ..Self::draw(elements, field, colors)? })
    }

    /// The continuous function through the radiosities.
    pub fn interpolated(elements: &[Element<DVec3>], field: &Field<DVec3, DVec3>) -> Result<Self, RasterError> {
        let colors = |i: usize, [a, b]: [usize; 2]| [field.at_centers[i], field.at_vertices[a], field.at_vertices[b]];
        Self::draw(elements, field, colors)
    }

    /// Draws the fans of all patches that show their front, with the radiosities of the center and two vertices.
    fn draw(
        elements: &[Element<DVec3>],
        field: &Field<DVec3, DVec3>,
        colors: impl Fn(usize, [usize; 2]) -> [DVec3; 3],
    ) -> Result<Self, RasterError> {
        let size = SIZE.map(|side| side * SAMPLES);
        let count = (size[0] * size[1]) as usize;
        let (mut samples, mut depths) = (vec![(usize::MAX, Vec3::ZERO); count], vec![0.0; count]);
        let mut buffer = DepthBuffer::new(size, &mut depths)?;
        let eye = DVec3::new(0.0, 1.6, 3.9);
        let clip = camera(eye.as_vec3(), Vec3::Y * 0.92);
        for (i, element) in elements.iter().enumerate() {
            if element.normal.dot(eye - element.center) <= 0.0 {
                continue;
            }
            for [a, b] in field.fan(i) {
                let corners = [element.center, field.topology.vertices[a], field.topology.vertices[b]];
                let colors = colors(i, [a, b]).map(|color| color.as_vec3());
                let corners = corners.map(|corner| clip * corner.as_vec3().extend(1.0));
                buffer.draw(&corners, |fragment| {
                    let [u, v, w] = fragment.weights.to_array();
                    samples[fragment.pixel] = (i, colors[0] * u + colors[1] * v + colors[2] * w);
                });
            }
        }
        Ok(Self { samples, has_lines: false })
    }

    /// The mean of the samples of a pixel in sRGB, each exposed and tone mapped on its own.
    fn pixel(&self, x: u32, y: u32) -> [u8; 3] {
        let mut sum = Vec3::ZERO;
        for sample in 0..SAMPLES * SAMPLES {
            let (column, row) = (x * SAMPLES + sample % SAMPLES, y * SAMPLES + sample / SAMPLES);
            let index = (row * SIZE[0] * SAMPLES + column) as usize;
            let (patch, radiosity) = self.samples[index];
            let after = [index + 1, index + (SIZE[0] * SAMPLES) as usize];
            let is_line = after.iter().any(|&other| self.samples.get(other).is_some_and(|&(next, _)| next != patch));
            let shade = if self.has_lines && is_line { LINE } else { 1.0 };
            sum += khronos_pbr_neutral(radiosity.max(Vec3::ZERO) * EXPOSURE) * shade;
        }
        (sum / (SAMPLES * SAMPLES) as f32).to_array().map(linear_to_srgb)
    }

    /// Writes 8-bit RGB.
    pub fn write_png(&self, file: &str) -> Result<(), Error> {
        let pixels: Vec<u8> = (0..SIZE[0] * SIZE[1]).flat_map(|k| self.pixel(k % SIZE[0], k / SIZE[0])).collect();
        let mut encoder = png::Encoder::new(BufWriter::new(File::create(file)?), SIZE[0], SIZE[1]);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header()?.write_image_data(&pixels)?;
        Ok(())
    }
}

/// From the world to clip space with reversed depth.
fn camera(eye: Vec3, target: Vec3) -> Mat4 {
    let aspect = SIZE[0] as f32 / SIZE[1] as f32;
    Mat4::perspective_infinite_reverse_rh(0.645, aspect, 0.1) * Mat4::look_at_rh(eye, target, Vec3::Y)
}
