//! `over` on rows of pixels: beside the bandwidth of memory, and beside tiny-skia.
//!
//! Each pass reads a front and reads and writes a back. The stream does the same with as many bytes and nothing to compute
//! but a sum: what memory allows. `small` fits the second-level cache, `large` does not fit any.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use radiosity::composite::{Channel, PremultipliedRgba, over_span};
use std::hint::black_box;
use tiny_skia::{BlendMode, FilterQuality, Pixmap, PixmapPaint, Transform};

/// Width and height of the pictures.
const SIZES: [(&str, u32, u32); 2] = [("small", 256, 64), ("large", 4096, 2048)];

/// Half-transparent pixels of all colors, premultiplied, one in eight clear and one in eight opaque.
fn pixels<C: Channel>(count: usize) -> Vec<PremultipliedRgba<C>> {
    let pixel = |k: usize| {
        let alpha = [0.0, 0.2, 0.9, 0.4, 1.0, 0.7, 0.5, 0.3][k % 8];
        PremultipliedRgba::<f32>::new([alpha, alpha * (k % 17) as f32 / 17.0, 0.0, alpha]).stored_as()
    };
    (0..count).map(pixel).collect()
}

fn stream(criterion: &mut Criterion) {
    for (size, width, height) in SIZES {
        let mut group = criterion.benchmark_group(format!("{size}, f32"));
        let count = (width * height) as usize;
        group.throughput(Throughput::Bytes(48 * count as u64));
        let front = vec![1e-9_f32; 4 * count];
        let mut back = vec![1.0_f32; 4 * count];
        group.bench_function("stream", |bencher| {
            bencher.iter(|| black_box(&front).iter().zip(&mut back).for_each(|(front, back)| *back += front));
        });
    }
    for (size, width, height) in SIZES {
        let count = (width * height) as usize;
        let mut group = criterion.benchmark_group(format!("{size}, 8 bit"));
        group.throughput(Throughput::Bytes(12 * count as u64));
        let front = vec![1_u32; count];
        let mut back = vec![1_u32; count];
        group.bench_function("stream", |bencher| {
            let add = |(front, back): (&u32, &mut u32)| *back = back.wrapping_add(*front);
            bencher.iter(|| black_box(&front).iter().zip(&mut back).for_each(add));
        });
    }
}

fn over<C: Channel>(criterion: &mut Criterion, stored: &str) {
    for (size, width, height) in SIZES {
        let count = (width * height) as usize;
        let mut group = criterion.benchmark_group(format!("{size}, {stored}"));
        group.throughput(Throughput::Bytes(12 * size_of::<C>() as u64 * count as u64));
        let (front, mut back) = (pixels::<C>(count), pixels::<C>(count));
        group.bench_function(BenchmarkId::from_parameter("radiosity"), |bencher| {
            bencher.iter(|| over_span(black_box(&front), &mut back));
        });
    }
}

fn tiny_skia(criterion: &mut Criterion) {
    for (size, width, height) in SIZES {
        let mut group = criterion.benchmark_group(format!("{size}, 8 bit"));
        group.throughput(Throughput::Bytes(12 * u64::from(width * height)));
        let filled = || {
            let mut pixmap = Pixmap::new(width, height).expect("neither side is zero");
            let bytes = pixels::<u8>((width * height) as usize);
            pixmap.data_mut().as_chunks_mut::<4>().0.iter_mut().zip(&bytes).for_each(|(to, from)| *to = from.to_array());
            pixmap
        };
        let (front, mut back) = (filled(), filled());
        let paint = PixmapPaint { opacity: 1.0, blend_mode: BlendMode::SourceOver, quality: FilterQuality::Nearest };
        group.bench_function("tiny-skia", |bencher| {
            bencher.iter(|| back.draw_pixmap(0, 0, black_box(&front).as_ref(), &paint, Transform::identity(), None));
        });
    }
}

fn all(criterion: &mut Criterion) {
    stream(criterion);
    over::<f32>(criterion, "f32");
    over::<u16>(criterion, "16 bit");
    over::<u8>(criterion, "8 bit");
    tiny_skia(criterion);
}

criterion_group!(benches, all);
criterion_main!(benches);
