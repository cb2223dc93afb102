//! The best of several rounds, in each of which all rivals run once: what else the machine does hits them alike.

use std::time::{Duration, Instant};

/// Rounds go on for so long, but at least [`LEAST`] of them.
const PATIENCE: Duration = Duration::from_millis(1500);
const LEAST: usize = 10;

/// Seconds of the fastest run of each rival; what `prepare` does is not counted.
pub fn best<T, const N: usize>(mut prepare: impl FnMut() -> T, mut rivals: [&mut dyn FnMut(&mut T); N]) -> [f64; N] {
    let mut best = [f64::INFINITY; N];
    let start = Instant::now();
    let mut rounds = 0;
    while rounds < LEAST || start.elapsed() < PATIENCE {
        for (best, rival) in best.iter_mut().zip(&mut rivals) {
            let mut input = prepare();
            let start = Instant::now();
            rival(&mut input);
            *best = best.min(start.elapsed().as_secs_f64());
        }
        rounds += 1;
    }
    best
}
