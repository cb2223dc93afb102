//! How light travels: rays through a scene, and the form factors that they count.

mod rows;
mod tracer;

pub use rows::*;
pub use tracer::*;
