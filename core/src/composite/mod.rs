//! Pictures from triangles and layers: who is seen where, and what shines through.
//!
//! Fragment, sort, composite. [`PremultipliedRgba::over`] lays one layer over another, in linear light;
//! [`front_to_back`] and [`back_to_front`] many, [`over_span`] rows of pixels, a [`Sprite`] a small picture on a large one.
//!
//! Where the order of the layers is not known, there are two ways. A [`Framebuffer`] puts each fragment at its depth, in
//! pixels that remember one layer ([`DepthPixel`]) or several ([`Layers`]); [`through`] fills fog and smoke in between. Or
//! things are put in order before they are drawn: [`sort`] and [`resort`] by layer, priority and depth; and where no order
//! is right, [`BspTree`] and [`paint_order`] cut them.
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
