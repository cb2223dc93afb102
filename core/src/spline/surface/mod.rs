//! Surfaces: tensor products of Bezier and B-spline curves, rational ones too, and what is built from curves.
//!
//! `u` runs along the rows of control points and `v` from row to row. The front of a surface is the side from which `u`
//! to `v` is a turn to the left.
//!
//! Without a heap, [`BSplineSurface`] borrows its knots and control points: it is evaluated, sampled, hit by rays, gets a
//! knot more ([`BSplineSurface::insert`]) and gives the curves on it ([`BSplineSurface::isocurve`]); both write into slices.
//! With the feature `alloc`, `OwnedSurface` keeps its own: what changes many knots at once, removes one, splits, raises the
//! degree, closes a direction or builds a surface from curves or points is found there. What splits a surface without a
//! heap is a knot that is inserted until it stands `degree + 1` times.

mod bezier_surface;
mod bicubics;
mod bspline_surface;
#[cfg(feature = "alloc")]
mod compatible;
#[cfg(feature = "alloc")]
mod coons;
mod curvature;
mod edge;
#[cfg(feature = "alloc")]
mod extrusion;
#[cfg(feature = "alloc")]
mod fit;
mod hermite_patch;
mod insertion;
mod jet;
#[cfg(feature = "alloc")]
mod loft;
mod nearest;
#[cfg(feature = "alloc")]
mod owned_surface;
#[cfg(feature = "alloc")]
mod revolution;
mod ray;
mod surface_point;

pub use bezier_surface::*;
pub use bicubics::*;
pub use bspline_surface::*;
#[cfg(feature = "alloc")]
pub use coons::*;
pub use curvature::*;
pub use edge::*;
#[cfg(feature = "alloc")]
pub use extrusion::*;
pub use hermite_patch::*;
pub use jet::*;
#[cfg(feature = "alloc")]
pub use loft::*;
pub use nearest::*;
#[cfg(feature = "alloc")]
pub use owned_surface::*;
pub use ray::SurfaceHit;
#[cfg(feature = "alloc")]
pub use revolution::*;
pub use surface_point::*;
