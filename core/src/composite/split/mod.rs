//! Flat polygons that no order can draw: those that overlap in a cycle or run through each other are cut.
//!
//! [`BspTree`] cuts once for all viewpoints, which suits a camera that moves past things that stand still;
//! [`paint_order`] cuts for one viewpoint, and only where it must.

mod bsp;
mod painter;
mod piece;

pub use bsp::*;
pub use painter::*;
pub use piece::*;
