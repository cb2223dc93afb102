//! From charts to the finished lightmaps.

mod image;
mod layout;

pub use image::*;
pub use layout::*;
