//! Bakes lightmaps for Bevy: inside the running app or from the command line.

pub mod bake;
pub mod baked;
#[cfg(feature = "cli")]
pub mod cli;
pub mod convert;
pub mod gltf;
