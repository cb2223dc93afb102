//! The picture in the documentation of the solvers.

#[path = "../../examples/convergence.rs"]
#[expect(dead_code, reason = "the test looks at the picture only")]
mod convergence;

/// It is what the example draws.
#[test]
fn the_picture_is_drawn_by_the_solvers() {
    assert_eq!(convergence::picture().expect("room for it"), include_str!("../src/solve/convergence.svg"));
}
