//! Triangles, rays, and what a ray meets.

mod mesh;

pub use mesh::*;
