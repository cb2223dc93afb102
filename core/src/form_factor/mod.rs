//! Which share of the light that leaves one place reaches another, by geometry alone.

mod boundary;
mod contour;
mod cubature;
mod double_integral;
mod edge_pair;
mod point;
mod polygon;
mod quadrature;

pub use contour::*;
pub use double_integral::*;
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
