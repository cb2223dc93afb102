//! Three panes in a cycle, and two that run through each other: sorted, which is wrong, and cut, which is right.

use std::error::Error;
use std::f32::consts::TAU;
use std::fs::File;
use std::io::BufWriter;

use glam::{Mat4, Vec3, Vec4, vec3};
use heapless::Vec as Few;
use radiosity::composite::*;
use radiosity::spectrum::linear_to_srgb;

const FILE: &str = "overlap.png";
/// Of each of the three pictures.
const SIZE: [u32; 2] = [320, 360];
const PIXELS: usize = 320 * 360;
const EYE: Vec3 = Vec3::new(0.0, 0.4, 4.4);

const COLORS: [[f32; 3]; 5] =
    [[0.9, 0.1, 0.05], [0.05, 0.6, 0.15], [0.1, 0.2, 0.9], [0.95, 0.65, 0.0], [0.5, 0.1, 0.6]];
const ALPHA: f32 = 0.9;

fn main() -> Result<(), Box<dyn Error>> {
    let panes = panes();
    let whole = || (0..).zip(&panes).map(|(source, corners)| Piece::new(corners, source));
    let mut cut: Few<Piece, 64> = whole().collect::<Result<_, _>>()?;
    paint_order(&mut cut, Viewpoint::Eye(EYE))?;
    let mut tree = BspTree::<64>::default();
    for (source, corners) in (0..).zip(&panes) {
        tree.insert(corners, source)?;
    }
    let from_tree: Vec<Piece> = tree.back_to_front(Viewpoint::Eye(EYE)).cloned().collect();

    let pictures = [painted(&sorted(whole().collect::<Result<_, _>>()?))?, painted(&cut)?, painted(&from_tree)?];
    let exact = exact(&panes)?;
    for (name, picture) in ["sorted", "cut for one view", "cut for all views"].into_iter().zip(&pictures) {
        let wrong = picture.iter().zip(&exact).filter(|(a, b)| (a.rgb() - b.rgb()).abs().max_element() > 0.01).count();
        println!("{name:>18}: {wrong:6} of {PIXELS} pixels differ from a pixel buffer with room for all layers");
    }
    println!("{} panes became {} pieces for one view, {} for all", panes.len(), cut.len(), from_tree.len());
    write_png(&[&pictures[0], &pictures[1], &exact])
}

/// Three bars, each over the next at one end and under the one before at the other, and a cross above.
fn panes() -> Vec<[Vec3; 4]> {
    let bar = |k: usize| {
        let (sin, cos) = (k as f32 * TAU / 3.0).sin_cos();
        let turn = |p: Vec3| vec3(p.x * cos - p.y * sin, p.x * sin + p.y * cos - 0.35, p.z);
        [(-1.0, -0.6, -0.3), (1.0, -0.6, 0.3), (1.0, -0.2, 0.3), (-1.0, -0.2, -0.3)]
            .map(|(x, y, z)| turn(vec3(x, y, z)))
    };
    let cross = |tilt: f32| {
        [(-0.9, 1.0), (0.9, 1.0), (0.9, 1.55), (-0.9, 1.55)].map(|(x, y)| vec3(x, y + 0.1 * tilt, tilt * x))
    };
    (0..3).map(bar).chain([0.5, -0.5].map(cross)).collect()
}

/// Whole panes by the depth of their centers: what engines do.
fn sorted(pieces: Vec<Piece>) -> Vec<Piece> {
    let depth = ViewDepth::Radial { eye: EYE };
    let center = |piece: &Piece| piece.corners().iter().sum::<Vec3>() / piece.corners().len() as f32;
    let draw = |(index, piece)| Draw { key: DrawKey::new(0, 0, depth.of_point(center(piece))), rank: 0, index };
    let mut draws: Vec<Draw> = (0..).zip(&pieces).map(draw).collect();
    sort(&mut draws, &mut []);
    draws.iter().map(|draw| pieces[draw.index as usize].clone()).collect()
}

fn clip() -> Mat4 {
    Mat4::perspective_infinite_reverse_rh(0.75, SIZE[0] as f32 / SIZE[1] as f32, 0.1)
        * Mat4::look_at_rh(EYE, vec3(0.0, 0.25, 0.0), Vec3::Y)
}

fn color(source: u32) -> PremultipliedRgba {
    StraightRgba { rgb: COLORS[source as usize], alpha: ALPHA }.premultiplied()
}

/// One after the other, each over what is there.
fn painted(pieces: &[Piece]) -> Result<Vec<PremultipliedRgba>, RasterError> {
    let drawn =
        pieces.iter().zip(1_u16..).map(|(piece, place)| (piece.corners(), piece.source, f32::from(place) / 1e3));
    drawn_by(drawn.collect::<Vec<_>>(), |z, place| Vec4::new(z.x, z.y, place * z.w, z.w))
}

/// Each fragment at its own depth, in pixels with room for all of them.
fn exact(panes: &[[Vec3; 4]]) -> Result<Vec<PremultipliedRgba>, RasterError> {
    let drawn = panes.iter().zip(0..).map(|(corners, source)| (corners.as_slice(), source, 0.0));
    drawn_by(drawn.collect::<Vec<_>>(), |corner, _| corner)
}

fn drawn_by(
    polygons: Vec<(&[Vec3], u32, f32)>,
    place: impl Fn(Vec4, f32) -> Vec4,
) -> Result<Vec<PremultipliedRgba>, RasterError> {
    let mut pixels = vec![Layers::<16>::EMPTY; 4 * PIXELS];
    let mut picture = Framebuffer::new(SIZE, Samples::Four, &mut pixels)?;
    let clip = clip();
    for (corners, source, order) in polygons {
        for pair in corners[1..].windows(2) {
            let corners = [corners[0], pair[0], pair[1]].map(|corner| place(clip * corner.extend(1.0), order));
            picture.draw(&corners, |_| color(source));
        }
    }
    let mut shown = vec![PremultipliedRgba::TRANSPARENT; PIXELS];
    picture.resolve(&mut shown)?;
    let wall = StraightRgba::opaque([0.85; 3]).premultiplied();
    Ok(shown.into_iter().map(|pixel| pixel.over(wall)).collect())
}

/// The pictures side by side.
fn write_png(pictures: &[&[PremultipliedRgba]]) -> Result<(), Box<dyn Error>> {
    let row = |y: usize| pictures.iter().flat_map(move |picture| &picture[y * SIZE[0] as usize..][..SIZE[0] as usize]);
    let pixels = (0..SIZE[1] as usize).flat_map(row);
    let bytes: Vec<u8> = pixels.flat_map(|pixel| pixel.rgb().to_array().map(linear_to_srgb)).collect();
    let file = BufWriter::new(File::create(FILE)?);
    let mut encoder = png::Encoder::new(file, SIZE[0] * pictures.len() as u32, SIZE[1]);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(&bytes)?;
    println!("{FILE}: sorted by their centers, cut, and pixel by pixel");
    Ok(())
}
