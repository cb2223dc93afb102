//! Curves and surfaces from control points.
//!
//! [`Bezier`] curves have one polynomial, [`BSpline`] curves have pieces of polynomials that join at knots. Their control
//! points are numbers, vectors of any dimension, or [`Homogeneous`] points, which make a curve rational: a
//! [`RationalBezier`] or a [`Nurbs`] curve. [`Hermite`] splines go through points, with tangents of all kinds. All are a
//! [`Curve`], and what is measured along a curve works for each. They borrow their points and need no heap.
//!
//! | to do | with |
//! |---|---|
//! | evaluate | [`Bezier::point`], [`Bezier::at`], [`Bezier::derivatives`], the same of [`BSpline`], [`Cubic`], [`Hermite`]; [`de_casteljau`], [`bernstein()`]; `sample` for many points |
//! | cut, raise and lower the degree | [`Bezier::split`], [`Bezier::segment`], [`Bezier::hodograph`], [`Bezier::elevate`], [`Bezier::reduce`], [`Bezier::bounds`], [`Bezier::implicit`] |
//! | change knots | [`BSpline::insert`] (Boehm), [`BSpline::refine`] (Oslo), [`BSpline::remove`], [`BSpline::elevate`], [`BSpline::bezier`] |
//! | go through points | [`cardinal_tangents`], [`catmull_rom_tangents`], [`kochanek_bartels_tangents`], [`c2_tangents`], [`interpolate`], [`fit`] |
//! | conics | [`Circle`] in four forms, [`conic`], [`Conic`] |
//! | measure | [`arc_length`], [`parameter_at`], [`Travel`], `nearest`, [`Jet::curvature`], [`rotation_minimizing_frames`] |
//! | surfaces | [`BSplineSurface`], [`NurbsSurface`], [`BezierSurface`]; with a heap `OwnedSurface::closed`, `revolution`, `extrusion`, `ruled`, `loft`, `coons`, `OwnedSurface::through` and `near` points, and `tessellate`; [`hermite_patch`], [`Bicubics`] for single points at speed |
//!
//! How fast it is beside `bevy_math`, `kurbo`, `uniform-cubic-splines`, `curvo` and `truck-geometry` stands in
//! `core/benches/spline_rivals/README.md`: on a grid, points of a NURBS surface come 13 times as fast as from `curvo`, at
//! single places 5 times (as [`Bicubics`]), its normals 6.7 times; points of NURBS curves about twice, lengths of cubics 1.2 times and nearest
//! points of cubics 2.6 times as fast as from `kurbo`.

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
mod nearest_cubic;
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
