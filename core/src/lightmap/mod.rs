//! From charts to the finished lightmaps.

mod atlas;
mod blend;
mod cells;
mod chart;
mod clip;
mod dilate;
mod direct;
mod filter;
mod gather;
mod image;
mod layout;
mod overlap;
mod patches;
mod plan;
mod refine;
mod texel;
mod tile;
#[cfg(feature = "unwrap")]
mod unwrap;
#[cfg(not(feature = "unwrap"))]
#[path = "unwrap_off.rs"]
mod unwrap;
mod validity;

pub use blend::*;
pub use dilate::*;
pub use direct::*;
pub use filter::*;
pub use gather::*;
pub use image::*;
pub use layout::*;
pub use patches::*;
pub use texel::*;
pub use validity::*;
