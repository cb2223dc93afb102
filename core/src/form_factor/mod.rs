//! Which share of the light that leaves one place reaches another, by geometry alone.
//!
//! [`polygon_to_polygon_among`] takes the method that fits. All of them on the form factors whose values are known
//! (`tests/reference`): 28 seen from points, 50 between surfaces with nothing between, 20 past blockers and without them.
//! The largest absolute error, in brackets as a share of the error that the method itself tells, and the mean time of a
//! call in microseconds, as `cargo bench -p radiosity --bench form_factors` prints them; times on one core:
//!
//! | method | | A: points | B: surfaces | C: occluded |
//! |---|---|---|---|---|
//! | [`point_to_point`], 16 x 16 pieces each | f64 | 6e-2, 9.4 | 7e-1, 3000 | |
//! | | f32 | 6e-2, 6.6 | 7e-1, 2100 | |
//! | [`point_to_polygon`], Lambert's form | f64 | 9e-13, 0.14 | | |
//! | | f32 | 3e-8, 0.14 | | |
//! | closed forms | f64 | 5e-14, 0.07 | 5e-14, 0.51 | 1e-14, 25 |
//! | | f32 | 5e-8, 0.07 | 6e-8, 0.50 | 6e-9, 25 |
//! | [`polygon_to_polygon`], contour integral | f64 | | 2e-12, 3.2 | |
//! | | f32 | | 1e-7, 2.9 | |
//! | [`double_integral`] to 1e-6 | f64 | | 2e-8 (0.04), 590 | |
//! | | f32 | | 3e-7 (0.06), 440 | |
//! | [`double_integral_of_points`] to 1e-2 | f64 | | 2e-1 (0.99), 23000 | |
//! | | f32 | | 2e-1 (0.99), 23000 | |
//! | [`visible_point_to_polygon`] | f64 | 9e-13, 1.0 | | |
//! | | f32 | 3e-8, 0.68 | | |
//! | [`visible_polygon_to_polygon`] to 1e-6 | f64 | | | 6e-8 (0.07), 420 |
//! | | f32 | | | 6e-8 (0.52), 260 |
//! | the same to 1e-8 | f64 | | | 2e-10 (0.06), 1300 |
//! | [`visible_polygon_to_polygon_by_rays`] to 1e-3 | f64 | | | 5e-4 (0.51), 14000 |
//! | | f32 | | | 5e-4 (0.51), 14000 |
//! | [`nusselt_area`] | f64 | 9e-13, 0.25 | | |
//! | | f32 | 3e-8, 0.28 | | |
//! | [`nusselt_rays`], 16384 rays | f32 | 1e-3 (0.48), 1300 | 3e-3 (0.76), 2300 | 4e-3 (0.89), 2400 |
//! | [`Hemicube`], 256 pixels, 64 places | f32 | 6e-4 (0.29), 3300 | 1e-2 (0.43), 27000 | 6e-3 (0.37), 21000 |
//!
//! Polygons alone but for the closed forms, and long rectangles for strips without end. The point formula and the
//! textbook integral are wrong where surfaces touch, and the latter says so.

mod among;
mod boundary;
mod contour;
mod critical;
mod cubature;
mod cylinder;
mod disc;
mod double_integral;
mod edge_pair;
mod facet;
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

pub use among::polygon_to_polygon_among;
pub use contour::*;
pub use cylinder::*;
pub use disc::*;
pub use double_integral::*;
pub use facet::*;
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
