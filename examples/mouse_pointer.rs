//! A mouse pointer on a picture: an antialiased sprite, laid over in linear light.

use std::error::Error;
use std::fs::File;
use std::io::BufWriter;

use radiosity::composite::{Channel, PremultipliedRgba, Sprite, StraightRgba};

const FILE: &str = "mouse_pointer.png";
const WIDTH: usize = 640;
const HEIGHT: usize = 360;

/// Corners of the pointer, in units of its width.
const ARROW: [[f32; 2]; 7] =
    [[0.0, 0.0], [0.0, 1.42], [0.32, 1.12], [0.54, 1.62], [0.76, 1.52], [0.55, 1.04], [1.0, 1.0]];
/// Pixels of the width, and of the black line around it.
const SIZE: f32 = 64.0;
const LINE: f32 = 5.0;
/// Points in a pixel, in each direction, of which each lies inside or outside.
const POINTS: usize = 16;
const SPRITE: [usize; 2] = [80, 120];

fn main() -> Result<(), Box<dyn Error>> {
    let mut picture: Vec<PremultipliedRgba> = (0..WIDTH * HEIGHT).map(|k| desktop(k % WIDTH, k / WIDTH)).collect();
    let pixels: Vec<PremultipliedRgba> = (0..SPRITE[0] * SPRITE[1]).map(pointer).collect();
    let sprite = Sprite::new(SPRITE[0], &pixels)?;
    for (k, corner) in [[60, 40], [240, 90], [420, 150], [590, 210], [150, 290], [-20, 180]].into_iter().enumerate() {
        // From the first to the last the pointer fades.
        let share = 1.0 - 0.15 * k as f32;
        let faded: Vec<_> = pixels.iter().map(|pixel| pixel.covering(share)).collect();
        Sprite::new(sprite.size()[0], &faded)?.draw(WIDTH, &mut picture, corner)?;
    }
    write_png(&picture)?;
    println!("{FILE} shows it on bright and dark ground, fading, and cut off at the edges");
    Ok(())
}

/// Stripes and a gradient: an edge that is blended wrongly shows on them.
fn desktop(x: usize, y: usize) -> PremultipliedRgba {
    let share = y as f32 / HEIGHT as f32;
    let stripe = if (x / 80).is_multiple_of(2) { 0.75 } else { 0.05 };
    StraightRgba::opaque([stripe * (1.0 - share), stripe * (0.5 + 0.5 * share), stripe]).premultiplied()
}

/// White with a black line around it; at its edges both are covered in part.
fn pointer(k: usize) -> PremultipliedRgba {
    let corner = [(k % SPRITE[0]) as f32 - LINE, (k / SPRITE[0]) as f32 - LINE];
    let place = |k: usize| (k as f32 + 0.5) / POINTS as f32;
    let points = (0..POINTS * POINTS).map(|k| [corner[0] + place(k % POINTS), corner[1] + place(k / POINTS)]);
    let (mut inside, mut line) = (0.0, 0.0);
    for point in points {
        let distance = distance_to_arrow(point);
        inside += f32::from(u8::from(distance <= 0.0));
        line += f32::from(u8::from(distance > 0.0 && distance < LINE));
    }
    let [inside, line] = [inside, line].map(|count| count / (POINTS * POINTS) as f32);
    PremultipliedRgba::new([inside, inside, inside, inside + line])
}

/// In pixels, negative inside.
fn distance_to_arrow([x, y]: [f32; 2]) -> f32 {
    let mut is_inside = false;
    let mut distance = f32::INFINITY;
    for (k, from) in ARROW.iter().enumerate() {
        let to = ARROW[(k + 1) % ARROW.len()];
        let [[ax, ay], [bx, by]] = [from, &to].map(|corner| corner.map(|c| c * SIZE));
        if (ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax) {
            is_inside = !is_inside;
        }
        let length = (bx - ax).powi(2) + (by - ay).powi(2);
        let along = (((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length).clamp(0.0, 1.0);
        distance = distance.min((x - ax - along * (bx - ax)).hypot(y - ay - along * (by - ay)));
    }
    if is_inside { -distance } else { distance }
}

/// sRGB enters here, and nowhere before.
fn write_png(picture: &[PremultipliedRgba]) -> Result<(), Box<dyn Error>> {
    let bytes: Vec<u8> = picture.iter().flat_map(|pixel| pixel.straight().to_srgb().into_iter().take(3)).collect();
    assert!(picture.iter().all(|pixel| pixel.alpha() == f32::ONE), "a desktop is opaque");
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(FILE)?), WIDTH as u32, HEIGHT as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(&bytes)?;
    Ok(())
}
