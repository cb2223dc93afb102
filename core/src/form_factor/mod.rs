//! Which share of the light that leaves one place reaches another, by geometry alone.

mod hemicube;
mod matrix;
mod nusselt;
mod polygon;
mod samples;

pub use hemicube::*;
pub use matrix::*;
pub use nusselt::*;
pub use polygon::*;
pub use samples::*;

/// A number and how far it may be from the true one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate<R> {
    /// What was found.
    pub value: R,
    /// An estimate of `|value - true value|`, not negative.
    pub error: R,
}

/// What of a row of form factors does not land on a patch. With these a row sums to one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bins<R> {
    /// The share that leaves the scene.
    pub sky: R,
    /// The share that lands on what reflects nothing, such as the backs of patches.
    pub void: R,
}
