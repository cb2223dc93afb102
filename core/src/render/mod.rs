//! The rendering equation by paths of light ([`PathTracer`]), and the baked scene as a camera sees it, on the CPU.

mod camera;
mod path;
mod tone;

#[cfg(feature = "bvh")]
mod difference;
#[cfg(feature = "bvh")]
mod false_color;
#[cfg(feature = "bvh")]
mod legend;
#[cfg(feature = "bvh")]
mod overview;
#[cfg(feature = "bvh")]
mod preview;
#[cfg(feature = "bvh")]
mod view;

pub use camera::*;
#[cfg(feature = "bvh")]
pub use difference::*;
#[cfg(feature = "bvh")]
pub use false_color::*;
#[cfg(feature = "bvh")]
pub use overview::*;
pub use path::*;
#[cfg(feature = "bvh")]
pub use preview::*;
pub use tone::*;
