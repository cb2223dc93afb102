//! Diffuse light transport: form factors, the radiosity equation and lightmaps.
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

pub mod math;
pub mod spectrum;

#[cfg(feature = "alloc")]
pub mod bake;
pub mod form_factor;
pub mod geometry;
#[cfg(feature = "alloc")]
pub mod light;
#[cfg(feature = "alloc")]
pub mod lightmap;
#[cfg(feature = "alloc")]
pub mod material;
#[cfg(feature = "alloc")]
pub mod parallel;
#[cfg(feature = "alloc")]
pub mod patch;
#[cfg(feature = "alloc")]
pub mod progress;
#[cfg(feature = "alloc")]
pub mod scene;
pub mod solve;
#[cfg(feature = "alloc")]
pub mod transport;
