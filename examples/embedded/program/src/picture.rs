//! The sphere behind panes of glass, in fog: triangles in any order, three layers a pixel.

use glam::Vec3;
use radiosity::composite::{
    Fog, Framebuffer, Layers, Pixel, PremultipliedRgba, RasterError, Samples, StraightRgba, through,
};
use radiosity::geometry::Ray;

use crate::checksum::Checksum;
use crate::report::Report;
use crate::{Board, surface};

/// Width and height.
pub const SIZE: [u32; 2] = [24, 16];
const PIXELS: usize = (SIZE[0] * SIZE[1]) as usize;
/// Layers that a pixel remembers.
const LAYERS: usize = 3;
const NEAR: f32 = 0.1;
/// Half the height of the picture at distance 1.
const HALF_HEIGHT: f32 = 0.5;
const EYE: Vec3 = Vec3::new(0.0, 0.0, 4.0);
const LIGHT: Vec3 = Vec3::new(0.48, 0.64, 0.6);
const FOG: Fog = Fog { color: Vec3::new(0.6, 0.62, 0.64), extinction: 0.12 };
const SKY: Vec3 = Vec3::new(0.2, 0.32, 0.55);
/// Corner, width, height, color and alpha of each pane.
const PANES: [(Vec3, f32, f32, [f32; 3]); 2] = [
    (Vec3::new(-1.4, -1.0, 1.6), 1.6, 1.4, [0.02, 0.35, 0.3]),
    (Vec3::new(-0.4, -0.4, 2.0), 1.2, 1.2, [0.6, 0.3, 0.02]),
];
/// From the darkest to the brightest.
const SHADES: [&str; 10] = [" ", ".", ":", "-", "=", "+", "*", "#", "%", "@"];

/// The checksum of the picture; that of nothing where there is none.
#[inline(never)]
pub fn draw(report: &mut Report<impl Board>) -> Checksum {
    let mut pixels = [const { Layers::<LAYERS>::EMPTY }; PIXELS];
    let mut fragments = 0;
    let mut drawn = Ok(());
    let spent = report.measure(|| drawn = rasterize(&mut pixels, &mut fragments));
    if drawn.is_err() {
        report.text("there is no picture\n");
    }
    report.count("fragments", fragments);
    report.count("instructions per fragment", spent / fragments.max(1));
    let mut checksum = Checksum::default();
    let mut sum = Vec3::ZERO;
    let spent = report.measure(|| sum = pixels.iter().zip(0..).map(|(layers, k)| composite(layers, k)).sum());
    report.count("instructions per composited pixel", spent / PIXELS as u32);
    checksum.add_all(sum.to_array());
    for (layers, k) in pixels.iter().zip(0..) {
        let color = composite(layers, k);
        checksum.add_all(color.to_array());
        let shade = (color.dot(Vec3::new(0.2126, 0.7152, 0.0722)) * SHADES.len() as f32) as usize;
        report.text(SHADES.get(shade).copied().unwrap_or("@"));
        report.text(if k % SIZE[0] == SIZE[0] - 1 { "\n" } else { "" });
    }
    report.checksum("picture", checksum);
    checksum
}

/// Draws the panes, then the sphere behind them.
fn rasterize(pixels: &mut [Layers<LAYERS>], fragments: &mut u32) -> Result<(), RasterError> {
    let mut picture = Framebuffer::new(SIZE, Samples::One, pixels)?;
    let aspect = SIZE[0] as f32 / SIZE[1] as f32;
    let scale = Vec3::new(1.0 / (aspect * HALF_HEIGHT), 1.0 / HALF_HEIGHT, 1.0);
    let clip = |corner: Vec3| {
        // Reversed depth without a far plane: near / distance.
        let seen = corner - EYE;
        (seen * scale).truncate().extend(NEAR).extend(-seen.z)
    };
    let mut triangle = |corners: [Vec3; 3], color: PremultipliedRgba| {
        picture.draw(&corners.map(clip), |_| {
            *fragments += 1;
            color
        });
    };
    for (corner, width, height, rgb) in PANES {
        let (right, up) = (Vec3::X * width, Vec3::Y * height);
        let glass = StraightRgba { rgb, alpha: 0.5 }.premultiplied();
        triangle([corner, corner + right, corner + right + up], glass);
        triangle([corner, corner + right + up, corner + up], glass);
    }
    if let Ok(points) = surface::points() {
        for corners in surface::triangles(&points) {
            let [a, b, c] = corners;
            let shade = 0.14 + 0.75 * ((a + b + c) / 3.0).dot(LIGHT).max(0.0);
            triangle(corners, PremultipliedRgba::adding(Vec3::new(0.8, 0.75, 0.68) * shade, 1.0));
        }
    }
    Ok(())
}

/// What a pixel shows: its layers, the fog between them and the sky behind.
fn composite(layers: &Layers<LAYERS>, pixel: u32) -> Vec3 {
    let [width, height] = SIZE.map(|side| side as f32);
    let (column, row) = ((pixel % SIZE[0]) as f32 + 0.5, (pixel / SIZE[0]) as f32 + 0.5);
    let x = (2.0 * column / width - 1.0) * HALF_HEIGHT * width / height;
    let y = (1.0 - 2.0 * row / height) * HALF_HEIGHT;
    let ray = Ray { origin: EYE, direction: Vec3::new(x, y, -1.0), end: f32::INFINITY };
    let surfaces = layers.iter().map(|layer| (NEAR / layer.depth, layer.color));
    through(&Ray { end: 8.0, ..ray }, &[&FOG], surfaces).over(PremultipliedRgba::adding(SKY, 1.0)).rgb()
}
