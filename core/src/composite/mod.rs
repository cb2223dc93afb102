//! Pictures from triangles and layers: who is seen where, and what shines through.
//!
//! Fragment, sort, composite: [`PremultipliedRgba::over`] lays one layer over another, in linear light. Where the order
//! of the layers is not known, a [`Framebuffer`] puts each at its depth, in pixels that remember one layer
//! ([`DepthPixel`]) or several ([`Layers`]).
//!
//! Depth is larger where something is nearer, everywhere in this module: that is so for the reversed depth of
//! [`rasterize`] as for the coordinate `z` of a camera that looks along `-z`.

mod color;
mod depth_pixel;
mod framebuffer;
mod layers;
mod media;
mod over;
mod pane;
mod porter_duff;
mod raster;
mod sort;
mod span;
mod split;
mod sprite;
#[cfg(feature = "alloc")]
mod tiles;

pub use color::*;
pub use depth_pixel::*;
pub use framebuffer::*;
pub use layers::*;
pub use media::*;
pub use over::*;
pub use pane::*;
pub use porter_duff::*;
pub use raster::*;
pub use sort::*;
pub use span::*;
pub use split::*;
pub use sprite::*;
