//! Which share of the light that leaves one place reaches another, by geometry alone.

mod boundary;
mod contour;
mod critical;
mod cubature;
mod cylinder;
mod disc;
mod double_integral;
mod edge_pair;
mod hemicube;
mod matrix;
mod nusselt;
mod point;
mod polygon;
mod quadrature;
mod rectangles;
mod samples;
mod shadow;
mod shaft;
mod triangle_rule;
mod sphere;
mod strips;
mod visible;
mod visible_discs;
mod visible_rays;

pub use contour::*;
pub use cylinder::*;
pub use disc::*;
pub use double_integral::*;
pub use hemicube::*;
pub use matrix::*;
pub use nusselt::*;
pub use point::*;
pub use polygon::*;
pub use rectangles::*;
pub use samples::*;
pub use shadow::visible_point_to_polygon;
pub use sphere::*;
pub use strips::*;
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

/// What of a row of form factors does not land on a patch. With these a row sums to one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bins<R> {
    /// The share that leaves the scene.
    pub sky: R,
    /// The share that lands on what reflects nothing, such as the backs of patches.
    pub void: R,
}
