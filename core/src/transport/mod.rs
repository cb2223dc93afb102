//! How light travels: rays through a scene, and what they count, kept so that other light needs no ray.

mod codes;
mod fills;
mod format;
mod keep;
mod lamp_light;
mod layers;
mod lighting;
mod relight;
mod rows;
mod solution;
mod stored;
mod surfaces;
mod tracer;

pub use codes::*;
pub use fills::*;
pub use format::*;
pub use keep::*;
pub use lamp_light::*;
pub use layers::*;
pub use lighting::*;
pub use relight::*;
pub use rows::*;
pub use solution::*;
pub use stored::*;
pub use surfaces::*;
pub use tracer::*;
