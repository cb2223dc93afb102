//! Triangles, rays, and what a ray meets.

mod hemisphere;
mod mesh;
mod ray;
mod sobol;
mod triangle;

mod occluders;

#[cfg(feature = "bvh")]
mod bvh;

#[cfg(feature = "bvh")]
pub use bvh::*;
pub use hemisphere::*;
pub use mesh::*;
pub use occluders::{BruteForce, Occluders};
pub use ray::*;
pub use sobol::*;
pub use triangle::*;
