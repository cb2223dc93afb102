//! The baked scene as a camera sees it, computed on the CPU.

mod camera;
mod tone;

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
pub use false_color::*;
#[cfg(feature = "bvh")]
pub use overview::*;
#[cfg(feature = "bvh")]
pub use preview::*;
pub use tone::*;
