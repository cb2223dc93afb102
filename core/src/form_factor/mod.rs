//! Which share of the light that leaves one place reaches another, by geometry alone.

mod critical;
mod polygon;
mod shadow;
mod shaft;
mod triangle_rule;
mod visible;
mod visible_discs;
mod visible_rays;

pub use polygon::*;
pub use shadow::visible_point_to_polygon;
pub use visible::visible_polygon_to_polygon;
pub use visible_discs::visible_coaxial_discs;
pub use visible_rays::*;

/// A value and a bound or an estimate of its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate<R> {
    /// What was computed.
    pub value: R,
    /// How far it is from the truth, at least 0.
    pub error: R,
}
