//! Which share of the light that leaves one place reaches another, by geometry alone.

mod point;
mod polygon;

pub use point::*;
pub use polygon::*;

/// A number and how far it may be from the true one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate<R> {
    /// What was found.
    pub value: R,
    /// An estimate of `|value - true value|`, not negative.
    pub error: R,
}
