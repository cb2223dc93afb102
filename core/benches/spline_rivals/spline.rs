//! Splines beside those of `bevy_math`, `kurbo`, `uniform-cubic-splines`, `curvo` and `truck-geometry`, by criterion.

mod cases;

use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};

fn all(c: &mut Criterion) {
    for case in cases::cases() {
        let mut group = c.benchmark_group(&case.title);
        for (name, mut call) in case.calls {
            group.bench_function(name, |bench| bench.iter(&mut call));
        }
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(500));
    targets = all
}
criterion_main!(benches);
