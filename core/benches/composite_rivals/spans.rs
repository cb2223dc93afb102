//! `over` on rows of pixels: beside the bandwidth of memory, and beside tiny-skia.
//!
//! Each pass reads a front and reads and writes a back. The stream does the same with as many bytes and nothing to compute
//! but a sum: what memory allows. The small picture fits into the nearest caches, the large one into none.
//!
//! `cargo bench --manifest-path core/benches/composite_rivals/Cargo.toml --bench spans`

mod rounds;

use std::hint::black_box;

use radiosity::composite::{Channel, PremultipliedRgba, over_span};
use rounds::best;
use tiny_skia::{BlendMode, FilterQuality, Pixmap, PixmapPaint, Transform};

/// Width and height of the pictures, and how often a small one is drawn in a round.
const SIZES: [(u32, u32, usize); 2] = [(256, 32, 100), (4096, 2048, 1)];

fn main() {
    println!("{:>12}  {:>7}  {:>14}  {:>10}  {:>10}", "picture", "stored", "stream (GB/s)", "radiosity", "of stream");
    for (width, height, repeats) in SIZES {
        over::<f32>([width, height], repeats, "f32");
        over::<u16>([width, height], repeats, "16 bit");
        over::<u8>([width, height], repeats, "8 bit");
    }
    println!("{:>12}  {:>7}  {:>14}  {:>10}", "picture", "stored", "tiny-skia", "radiosity");
    SIZES.into_iter().for_each(|(width, height, repeats)| beside_tiny_skia([width, height], repeats));
}

/// Half-transparent pixels of all colors, premultiplied, one in eight clear and one in eight opaque.
fn pixels<C: Channel>(count: usize) -> Vec<PremultipliedRgba<C>> {
    let pixel = |k: usize| {
        let alpha = [0.0, 0.2, 0.9, 0.4, 1.0, 0.7, 0.5, 0.3][k % 8];
        PremultipliedRgba::<f32>::new([alpha, alpha * (k % 17) as f32 / 17.0, 0.0, alpha]).stored_as()
    };
    (0..count).map(pixel).collect()
}

fn over<C: Channel>([width, height]: [u32; 2], repeats: usize, stored: &str) {
    let count = (width * height) as usize;
    let words = count * size_of::<C>();
    let (from, mut to) = (vec![1_u32; words], vec![1_u32; words]);
    let (front, mut back) = (pixels::<C>(count), pixels::<C>(count));
    let mut stream = |_: &mut ()| {
        for _ in 0..repeats {
            let add = |(from, to): (&u32, &mut u32)| *to = to.wrapping_add(*from);
            black_box(&from).iter().zip(&mut to).for_each(add);
        }
    };
    let mut span = |_: &mut ()| (0..repeats).for_each(|_| over_span(black_box(&front), &mut back));
    let seconds = best(|| (), [&mut stream, &mut span]);
    let [stream, span] = seconds.map(|seconds| (12 * words * repeats) as f64 / seconds / 1e9);
    let picture = format!("{width} x {height}");
    println!("{picture:>12}  {stored:>7}  {stream:14.1}  {span:10.1}  {:9.0}%", 100.0 * span / stream);
}

fn beside_tiny_skia([width, height]: [u32; 2], repeats: usize) {
    let count = (width * height) as usize;
    let filled = || {
        let mut pixmap = Pixmap::new(width, height).expect("neither side is zero");
        let places = pixmap.data_mut().as_chunks_mut::<4>().0;
        places.iter_mut().zip(pixels::<u8>(count)).for_each(|(to, from)| *to = from.to_array());
        pixmap
    };
    let (map, mut under) = (filled(), filled());
    let (front, mut back) = (pixels::<u8>(count), pixels::<u8>(count));
    let paint = PixmapPaint { opacity: 1.0, blend_mode: BlendMode::SourceOver, quality: FilterQuality::Nearest };
    let mut rival = |_: &mut ()| {
        (0..repeats)
            .for_each(|_| under.draw_pixmap(0, 0, black_box(&map).as_ref(), &paint, Transform::identity(), None));
    };
    let mut span = |_: &mut ()| (0..repeats).for_each(|_| over_span(black_box(&front), &mut back));
    let seconds = best(|| (), [&mut rival, &mut span]);
    let [rival, span] = seconds.map(|seconds| (12 * count * repeats) as f64 / seconds / 1e9);
    println!("{:>12}  {:>7}  {rival:14.1}  {span:10.1}", format!("{width} x {height}"), "8 bit");
}
