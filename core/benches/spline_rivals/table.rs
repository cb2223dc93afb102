//! Prints the table of the README: the best of many short runs, taken in turn, so that a busy machine changes no ratio.
//!
//! A word after `--` leaves only the cases that have it in their titles.

mod cases;

use std::time::Instant;

use cases::Case;

/// Runs of each, and seconds that all runs of a case may take.
const MOST: usize = 400;
const SECONDS: f64 = 1.5;

fn main() {
    println!("| what | with | time | of ours |");
    println!("|---|---|---|---|");
    let word = std::env::args().skip(1).find(|word| !word.starts_with('-')).unwrap_or_default();
    cases::cases().into_iter().filter(|case| case.title.contains(&word)).for_each(print);
}

fn print(mut case: Case) {
    let mut best = vec![f64::INFINITY; case.calls.len()];
    let start = Instant::now();
    for _ in 0..MOST {
        for ((_, call), best) in case.calls.iter_mut().zip(&mut best) {
            let start = Instant::now();
            call();
            *best = best.min(start.elapsed().as_secs_f64());
        }
        if start.elapsed().as_secs_f64() > SECONDS {
            break;
        }
    }
    for (k, ((name, _), time)) in case.calls.iter().zip(&best).enumerate() {
        let title = if k == 0 { case.title.as_str() } else { "" };
        println!("| {title} | {name} | {:.1} us | {:.2} |", time * 1e6, time / best[0]);
    }
}
