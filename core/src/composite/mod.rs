//! Pictures from triangles and layers: who is seen where.

mod raster;

pub use raster::*;
