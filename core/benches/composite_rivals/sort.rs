//! Orders of drawing: from scratch and from the frame before, beside radsort and the standard library.
//!
//! All sort the same entries of 16 bytes. radsort gets the depth alone, as Bevy gives it.

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use radiosity::composite::{Draw, DrawKey, resort, sort};

const COUNTS: [u32; 4] = [1_000, 10_000, 100_000, 1_000_000];

/// A number in `[0, 1)`.
fn chance(k: u32) -> f32 {
    let mut bits = k.wrapping_mul(0x9e37_79b9);
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x2c1b_3c6d);
    bits = (bits ^ (bits >> 12)).wrapping_mul(0x297a_2d39);
    ((bits ^ (bits >> 15)) >> 8) as f32 / (1 << 24) as f32
}

fn random(count: u32) -> Vec<Draw> {
    (0..count).map(|k| Draw { key: DrawKey::new(0, 0, -0.1 - 100.0 * chance(k)), rank: k, index: k }).collect()
}

/// In the order of the frame before; since then each has moved by as much as a few places.
fn coherent(count: u32) -> Vec<Draw> {
    let mut draws = random(count);
    sort(&mut draws, &mut []);
    for draw in &mut draws {
        let moved = draw.key.depth() + 200.0 / count as f32 * (chance(draw.index + count) - 0.5);
        draw.key = DrawKey::new(0, 0, moved);
    }
    draws
}

/// A way of sorting.
type Way = (&'static str, fn(&mut [Draw], &mut [Draw]));

const WAYS: [Way; 7] = [
    ("sort", sort),
    ("sort in place", |draws, _| sort(draws, &mut [])),
    ("resort", |draws, scratch| resort(draws, scratch, 0.0)),
    ("resort, calm", |draws, scratch| resort(draws, scratch, 1e-4)),
    ("radsort by depth", |draws, _| radsort::sort_by_key(draws, |draw| draw.key.depth())),
    ("std, stable", |draws, _| draws.sort_by_key(|draw| draw.key)),
    ("std, unstable", |draws, _| draws.sort_unstable_by_key(|draw| draw.key)),
];

fn all(criterion: &mut Criterion) {
    for (name, make) in [("random", random as fn(u32) -> Vec<Draw>), ("coherent", coherent)] {
        for count in COUNTS {
            let mut group = criterion.benchmark_group(format!("{name} {count}"));
            group.throughput(Throughput::Elements(count.into()));
            let draws = make(count);
            let mut scratch = draws.clone();
            for (way, sort) in WAYS {
                group.bench_function(BenchmarkId::from_parameter(way), |bencher| {
                    bencher.iter_batched_ref(|| draws.clone(), |draws| sort(draws, &mut scratch), BatchSize::LargeInput);
                });
            }
        }
    }
}

criterion_group!(benches, all);
criterion_main!(benches);
