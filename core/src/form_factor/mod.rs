//! Which share of the light that leaves one place reaches another, by geometry alone.

mod boundary;
mod contour;
mod critical;
mod cubature;
mod double_integral;
mod edge_pair;
mod point;
mod polygon;
mod quadrature;
mod shadow;
mod shaft;
mod triangle_rule;
mod visible;
mod visible_discs;
mod visible_rays;

pub use contour::*;
pub use double_integral::*;
pub use point::*;
pub use polygon::*;
pub use shadow::visible_point_to_polygon;
pub use visible::visible_polygon_to_polygon;
pub use visible_discs::visible_coaxial_discs;
pub use visible_rays::visible_polygon_to_polygon_by_rays;

/// A number and how far it may be from the true one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate<R> {
    /// What was found.
    pub value: R,
    /// An estimate of `|value - true value|`, not negative.
    pub error: R,
}
