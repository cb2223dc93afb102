//! The example that measures growth runs.

#[path = "../../examples/growth/main.rs"]
#[expect(dead_code, reason = "the test draws no files")]
mod growth;

/// Every series has its points; how long they take is not for a test to say.
#[test]
fn quick_series() {
    for series in growth::run(growth::series::Extent::Quick).expect("it can be baked") {
        assert!(series.points.len() >= 2 && series.points.iter().flatten().all(|number| *number > 0.0));
        assert!(growth::picture::draw(&series).expect("room for it").contains("polyline"));
    }
}
