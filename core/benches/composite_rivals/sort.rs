//! Orders of drawing: from scratch and from the frame before, beside radsort and the standard library.
//!
//! All sort the same entries of 16 bytes. radsort gets the depth alone, as Bevy gives it.
//!
//! `cargo bench --manifest-path core/benches/composite_rivals/Cargo.toml --bench sort`

mod rounds;

use radiosity::composite::{Draw, DrawKey, Tolerance, resort, sort};
use rounds::best;

const COUNTS: [u32; 4] = [1_000, 10_000, 100_000, 1_000_000];

fn main() {
    let names = ["sort", "in place", "resort", "calm", "radsort", "std", "unstable"];
    println!("ns for each entry  {}", names.map(|name| format!("{name:>9}")).concat());
    for (kind, make) in [("random", random as fn(u32) -> Vec<Draw>), ("coherent", coherent)] {
        for count in COUNTS {
            let draws = make(count);
            let mut scratch = draws.clone();
            let mut other = draws.clone();
            let mut another = draws.clone();
            let seconds = best(
                || draws.clone(),
                [
                    &mut |draws: &mut Vec<Draw>| sort(draws, &mut scratch),
                    &mut |draws: &mut Vec<Draw>| sort(draws, &mut []),
                    &mut |draws: &mut Vec<Draw>| resort(draws, &mut other, Tolerance::NONE),
                    &mut |draws: &mut Vec<Draw>| resort(draws, &mut another, Tolerance { least: 1e-4, share: 0.0 }),
                    &mut |draws: &mut Vec<Draw>| radsort::sort_by_key(draws, |draw| draw.key.depth()),
                    &mut |draws: &mut Vec<Draw>| draws.sort_by_key(|draw| draw.key),
                    &mut |draws: &mut Vec<Draw>| draws.sort_unstable_by_key(|draw| draw.key),
                ],
            );
            let each = seconds.map(|seconds| format!("{:9.1}", seconds * 1e9 / f64::from(count)));
            println!("{kind:>9} {count:8}  {}", each.concat());
        }
    }
}

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

/// In the order of the frame before; since then each has moved by as much as its neighbors are away in the mean.
fn coherent(count: u32) -> Vec<Draw> {
    let mut draws = random(count);
    sort(&mut draws, &mut []);
    for draw in &mut draws {
        let moved = draw.key.depth() + 200.0 / count as f32 * (chance(draw.index + count) - 0.5);
        draw.key = DrawKey::new(0, 0, moved);
    }
    draws
}
