//! Which share of the light that leaves one place reaches another, by geometry alone.

mod polygon;

pub use polygon::*;
