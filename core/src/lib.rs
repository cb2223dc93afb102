//! Diffuse light transport: form factors, the radiosity equation and lightmaps.
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

pub mod math;
pub mod spectrum;
#[cfg(feature = "alloc")]
pub mod progress;
#[cfg(feature = "alloc")]
pub mod parallel;
#[cfg(feature = "alloc")]
pub mod material;
pub mod geometry;
pub mod form_factor;
#[cfg(feature = "alloc")]
pub mod light;
pub mod solve;
#[cfg(feature = "alloc")]
pub mod scene;
#[cfg(feature = "alloc")]
pub mod transport;
#[cfg(feature = "alloc")]
pub mod lightmap;
#[cfg(feature = "alloc")]
pub mod patch;
#[cfg(feature = "alloc")]
pub mod bake;
#[cfg(feature = "alloc")]
pub mod render;
