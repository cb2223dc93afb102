//! The Cornell box on a page, first solved in patches, then baked, in slices of a few milliseconds: what `page.js` calls.
#![cfg_attr(target_arch = "wasm32", no_std)]

extern crate alloc;

pub mod baked;
pub mod room;
pub mod view;

#[cfg(target_arch = "wasm32")]
mod exports;
