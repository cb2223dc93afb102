//! From charts to the finished lightmaps.

mod clip;
mod dilate;
mod direct;
mod filter;
mod gather;
mod image;
mod layout;
mod texel;
mod validity;

pub use dilate::*;
pub use direct::*;
pub use filter::*;
pub use gather::*;
pub use image::*;
pub use layout::*;
pub use texel::*;
pub use validity::*;
