//! Curves and surfaces from control points: Bezier curves of any degree and their tensor products.

mod bezier;
mod surface;

pub use bezier::*;
pub use surface::*;
