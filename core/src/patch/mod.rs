//! Surfaces in pieces: the classical radiosity method on polygons and spline patches, without any texel.
//!
//! A [`Patch`] is what can be cut: a triangle, a quad, a spline surface. An [`Element`] is a flat piece of it that has
//! one radiosity. [`uniform`] cuts all alike; [`by_proximity`] cuts finer where much light is expected to be exchanged,
//! before anything is solved; [`Enclosure::refine`] cuts where the solution varies. A [`Field`] puts a continuous
//! function through the result, for pictures.
//!
//! The form factors come from outside, pair by pair, so subdivision does not care how they are found: without blockers
//! [`polygon_to_polygon`](crate::form_factor::polygon_to_polygon), past a few convex ones
//! [`visible_polygon_to_polygon`](crate::form_factor::visible_polygon_to_polygon), past anything else
//! [`visible_polygon_to_polygon_by_rays`](crate::form_factor::visible_polygon_to_polygon_by_rays). Methods that find
//! whole rows, as the [`Hemicube`](crate::form_factor::Hemicube), go through `Exchange::from_rows`.
//!
//! ```
//! # #[cfg(feature = "alloc")]
//! # {
//! use glam::DVec3;
//! use radiosity::form_factor::polygon_to_polygon;
//! use radiosity::patch::{Enclosure, Patch, Refined, Refinement, Shape, uniform};
//! use radiosity::solve::Stop;
//!
//! // A lamp of half a meter hangs over a floor of two meters, one meter above it.
//! let square = |corner: DVec3, u, v| [Patch::Quad([corner, corner + u, corner + u + v, corner + v])];
//! let floor = square(DVec3::ZERO, DVec3::X * 2.0, DVec3::Y * 2.0);
//! let lamp = square(DVec3::new(0.75, 0.75, 1.0), DVec3::Y * 0.5, DVec3::X * 0.5);
//! let shapes = [
//!     Shape { patches: &floor, reflectance: 0.6, exitance: 0.0 },
//!     Shape { patches: &lamp, reflectance: 0.0, exitance: 100.0 },
//! ];
//!
//! let elements = uniform(0, &floor, [4, 4]).chain(uniform(1, &lamp, [1, 1])).collect();
//! let stop = Stop { tolerance: 1e-6, most_steps: 100 };
//! let mut form_factor = |a: &_, b: &_| {
//!     let [a, b]: [&radiosity::patch::Element<DVec3>; 2] = [a, b];
//!     polygon_to_polygon(a.corners(), b.corners())
//! };
//! let mut enclosure = Enclosure::new(&shapes, elements, &stop, &mut form_factor);
//! let settings = Refinement { tolerance: 0.02, smallest_area: 1e-4, most_elements: 1000, stop };
//! let (end, _) = enclosure.refine(&shapes, &settings, &mut form_factor);
//! assert_eq!(end, Refined::Tolerance);
//! # }
//! ```
//!
//! # Adaptive against uniform
//!
//! At equal error, by `cargo bench -p radiosity --bench subdivision`. The error is that of the interpolated radiosity, as
//! a root mean square over all surfaces and a share of that of the reflected radiosity, against a fine grid with a
//! gather at each point. An adaptive run is the coarsest one that is not worse than the uniform grid. Times are those
//! of one thread of a shared machine, the better one of two runs.
//!
//! | scene | error | elements, uniform | adaptive | ratio | form factors, uniform | adaptive | time, uniform | adaptive |
//! |---|---|---|---|---|---|---|---|---|
//! | unit cube | 1.54 % | 384 | 390 | 1.0 | 61440 | 78156 | 0.44 s | 0.75 s |
//! | unit cube | 1.02 % | 1014 | 561 | 1.8 | 428415 | 164788 | 1.77 s | 1.48 s |
//! | unit cube | 0.65 % | 2400 | 738 | 3.3 | 2400000 | 286172 | 14.46 s | 3.69 s |
//! | plates | 7.84 % | 360 | 203 | 1.8 | 14024 | 3343 | 0.14 s | 0.12 s |
//! | plates | 7.28 % | 874 | 203 | 4.3 | 84705 | 3343 | 0.59 s | 0.13 s |
//! | plates | 4.68 % | 2192 | 476 | 4.6 | 491008 | 9167 | 3.44 s | 0.30 s |
//! | room | 8.41 % | 420 | 239 | 1.8 | 49728 | 16288 | 2.15 s | 0.94 s |
//! | room | 5.87 % | 1004 | 446 | 2.3 | 293243 | 48996 | 9.57 s | 1.81 s |
//! | room | 5.27 % | 1757 | 446 | 3.9 | 889923 | 48996 | 25.18 s | 0.89 s |
//!
//! What is gained grows with the accuracy asked for, because only few elements at edges and shadows have to be cut again.
//! Where the light is smooth everywhere and a coarse picture is enough, as in the first row, nothing is gained: the
//! uniform grid is as good, and the adaptive one computes some form factors that it throws away.
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
mod enclosure;
#[cfg(feature = "alloc")]
mod probe;
#[cfg(feature = "alloc")]
mod topology;

#[cfg(feature = "alloc")]
pub use adaptive::*;
pub use element::*;
#[cfg(feature = "alloc")]
pub use enclosure::*;
#[cfg(feature = "alloc")]
pub use exchange::*;
pub use proximity::*;
#[cfg(feature = "alloc")]
pub use reconstruct::*;
pub use shape::*;
#[cfg(feature = "alloc")]
pub use topology::Topology;
pub use uniform::*;
