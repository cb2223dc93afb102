//! Surfaces in pieces: the classical radiosity method on polygons and spline patches, without any texel.
//!
//! A [`Patch`] is what can be cut: a triangle, a quad, a spline surface. An [`Element`] is a flat piece of it that has
//! one radiosity. [`uniform`] cuts all alike; [`by_proximity`] cuts finer where much light is expected to be exchanged,
//! before anything is solved; [`Solution::refine`] cuts where the solution varies. A [`Field`] puts a continuous
//! function through the result, for pictures.
//!
//! The patches of texels that a bake solves on are others: `lightmap::Patches`.

mod element;
mod shape;
mod uniform;

mod proximity;

#[cfg(feature = "alloc")]
mod adaptive;
#[cfg(feature = "alloc")]
mod exchange;
#[cfg(feature = "alloc")]
mod reconstruct;
#[cfg(feature = "alloc")]
mod solution;
#[cfg(feature = "alloc")]
mod topology;

#[cfg(feature = "alloc")]
pub use adaptive::*;
pub use element::*;
#[cfg(feature = "alloc")]
pub use exchange::*;
pub use proximity::*;
#[cfg(feature = "alloc")]
pub use reconstruct::*;
pub use shape::*;
#[cfg(feature = "alloc")]
pub use solution::*;
#[cfg(feature = "alloc")]
pub use topology::Topology;
pub use uniform::*;
