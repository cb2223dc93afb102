//! A saved bake: its files.

pub mod ktx2;
pub mod manifest;
