//! From charts to the finished lightmaps.

mod image;

pub use image::*;
