//! Triangles, rays, and what a ray meets.

mod hemisphere;
#[cfg(feature = "alloc")]
mod mesh;
mod ray;
mod sobol;
mod triangle;

mod occluders;
mod polygon_occluders;
mod ray_log;

#[cfg(all(feature = "alloc", not(feature = "bvh")))]
mod no_bvh;

#[cfg(feature = "bvh")]
mod bvh;
#[cfg(feature = "bvh")]
mod wide;

#[cfg(feature = "bvh")]
pub use bvh::*;
pub use hemisphere::*;
#[cfg(feature = "alloc")]
pub use mesh::*;
#[cfg(all(feature = "alloc", not(feature = "bvh")))]
pub use no_bvh::tree;
pub use occluders::{BruteForce, Occluders};
pub use polygon_occluders::PolygonOccluders;
pub use ray::*;
pub use ray_log::*;
pub use sobol::*;
pub use triangle::*;
#[cfg(feature = "bvh")]
pub(crate) use wide::{Lanes, Level, Task};
