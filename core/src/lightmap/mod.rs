//! From charts to the finished lightmaps.

mod atlas;
mod blend;
mod blocks;
mod cells;
mod chart;
mod clip;
mod dilate;
mod direct;
mod filter;
mod footprint;
mod gather;
mod image;
mod importance;
mod layout;
mod links;
mod overlap;
mod patch_map;
mod patches;
mod penumbra;
mod plan;
mod refine;
mod reflectors;
mod samples;
mod seam;
mod texel;
mod tile;
mod torn;
#[cfg(feature = "unwrap")]
mod unwrap;
#[cfg(not(feature = "unwrap"))]
#[path = "unwrap_off.rs"]
mod unwrap;
mod validity;

pub use blend::*;
pub use blocks::Blocks;
pub use dilate::*;
pub use direct::*;
pub use filter::*;
pub use gather::*;
pub use image::*;
pub use layout::*;
pub use links::*;
pub use patch_map::*;
pub use patches::*;
pub use reflectors::*;
pub use seam::*;
pub use texel::*;
pub use torn::*;
pub use validity::*;
