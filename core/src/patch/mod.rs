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
//! | unit cube | 1.54 % | 384 | 312 | 1.2 | 61440 | 75792 | 0.07 s | 0.13 s |
//! | unit cube | 1.02 % | 1014 | 447 | 2.3 | 428415 | 139752 | 0.42 s | 0.22 s |
//! | unit cube | 0.65 % | 2400 | 585 | 4.1 | 2400000 | 229588 | 2.29 s | 0.36 s |
//! | plates | 7.84 % | 360 | 203 | 1.8 | 14024 | 7341 | 0.03 s | 0.04 s |
//! | plates | 7.28 % | 874 | 203 | 4.3 | 84705 | 7341 | 0.18 s | 0.05 s |
//! | plates | 4.68 % | 2192 | 476 | 4.6 | 491008 | 13165 | 1.05 s | 0.07 s |
//! | room | 8.41 % | 420 | 230 | 1.8 | 49728 | 52500 | 0.32 s | 0.36 s |
//! | room | 5.87 % | 1004 | 338 | 3.0 | 293243 | 71988 | 1.75 s | 0.51 s |
//! | room | 5.27 % | 1757 | 455 | 3.9 | 889923 | 95024 | 5.48 s | 0.71 s |
//!
//! What is gained grows with the accuracy asked for, because only few elements at edges and shadows have to be cut again.
//! Where a coarse picture is enough, as in the first row of each scene, only elements are gained and no
//! time: the uniform grid asks for fewer form factors than it takes to probe the first elements and to throw some away.
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
