//! From entities to lightmaps.

mod collect;
mod components;

pub use collect::*;
pub use components::*;
