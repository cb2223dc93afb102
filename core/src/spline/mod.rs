//! Curves and surfaces from control points.
//!
//! [`Bezier`] curves have one polynomial, [`BSpline`] curves have pieces of polynomials that join at knots. Their control
//! points are numbers, vectors of any dimension, or [`Homogeneous`] points, which make a curve rational: a
//! [`RationalBezier`] or a [`Nurbs`] curve. [`Hermite`] splines go through points, with tangents of all kinds. All are a
//! [`Curve`], and what is measured along a curve works for each. They borrow their points and need no heap.

mod arc_length;
mod basis;
mod bernstein;
mod bezier;
mod blossom;
mod bspline;
mod conic;
mod control_point;
mod cubic;
mod curve;
mod elevation;
mod error;
mod frame;
mod hermite;
mod homogeneous;
mod implicit;
mod insertion;
mod interpolation;
mod knots;
mod nearest;
#[cfg(feature = "alloc")]
mod owned;
mod roots;
mod split;
mod surface;
#[cfg(feature = "alloc")]
mod tessellate;

pub use arc_length::*;
pub use bernstein::*;
pub use bezier::*;
pub use bspline::*;
pub use conic::*;
pub use control_point::*;
pub use cubic::*;
pub use curve::*;
pub use error::*;
pub use frame::*;
pub use hermite::*;
pub use homogeneous::*;
pub use insertion::*;
pub use interpolation::*;
pub use knots::*;
pub use nearest::*;
#[cfg(feature = "alloc")]
pub use owned::*;
pub use roots::*;
pub use surface::*;
#[cfg(feature = "alloc")]
pub use tessellate::*;
