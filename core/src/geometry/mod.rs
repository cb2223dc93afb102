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

#[cfg(feature = "alloc")]
mod median_tree;
#[cfg(feature = "alloc")]
mod wide;

#[cfg(feature = "bvh")]
mod bvh;

#[cfg(feature = "bvh")]
pub use bvh::*;
pub use hemisphere::*;
#[cfg(feature = "alloc")]
pub use median_tree::*;
#[cfg(feature = "alloc")]
pub use mesh::*;
pub use occluders::{BruteForce, Occluders};
pub use polygon_occluders::PolygonOccluders;
pub use ray::*;
pub use ray_log::*;
pub use sobol::*;
pub use triangle::*;
#[cfg(feature = "bvh")]
pub(crate) use wide::{Lanes, Level, Task};
