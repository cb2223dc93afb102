//! What is measured, as each crate offers it.

mod curves;
mod surfaces;

use std::hint::black_box;

/// One task and what it is done with.
pub struct Case {
    pub title: String,
    /// Ours first.
    pub calls: Vec<(String, Box<dyn FnMut()>)>,
}

impl Case {
    fn new(title: &str) -> Self {
        Self { title: title.to_string(), calls: Vec::new() }
    }

    /// Once for all arguments.
    fn call<T: Copy + 'static, R>(
        mut self,
        name: &str,
        arguments: &[T],
        mut call: impl FnMut(T) -> R + 'static,
    ) -> Self {
        let arguments = arguments.to_vec();
        let all = move || arguments.iter().for_each(|&argument| _ = black_box(call(black_box(argument))));
        self.calls.push((name.to_string(), Box::new(all)));
        self
    }
}

pub fn cases() -> Vec<Case> {
    curves::cases().into_iter().chain(surfaces::cases()).collect()
}

/// What closures borrow for as long as the program runs.
fn forever<T>(x: T) -> &'static T {
    Box::leak(Box::new(x))
}

/// Numbers in `[0, 1)` that look random: the golden ratio's multiples.
fn numbers(count: usize) -> Vec<f64> {
    (1..=count).map(|i| (i as f64 * 0.618_033_988_749_894_8).fract()).collect()
}
