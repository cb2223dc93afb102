//! The rendering equation without bias: paths of light, followed from the eye or from a point of a surface.
//!
//! A path goes from surface to surface in directions that the surfaces choose ([`Scatter::sample`]); at each of them a
//! lamp and a point of what emits are asked for light too. Where both ways lead to the same light they are weighed by their
//! densities: the balance heuristic of Veach and Guibas, "Optimally Combining Sampling Techniques", SIGGRAPH 1995. Paths
//! end by Russian roulette, so that none is cut and none goes on for ever.
//!
//! Lamps ([`PathLamp`]) are asked and never met, whatever their extent; emissive surfaces are both. So bent glass and curved
//! mirrors give no light of lamps. Plane mirrors do where the images behind them are lamps too, as in
//! [`PathTracer::diffuse`].
//!
//! [`Scatter::sample`]: crate::scatter::Scatter::sample

mod diffuse;
mod emitters;
mod estimate;
mod facets;
mod numbers;
mod optics;
mod picture;
mod tracer;

#[cfg(feature = "bvh")]
mod grid;
#[cfg(feature = "bvh")]
mod truth;

pub use diffuse::*;
pub use estimate::*;
pub use facets::*;
#[cfg(feature = "bvh")]
pub use grid::*;
pub use optics::*;
pub use picture::*;
pub use tracer::*;
#[cfg(feature = "bvh")]
pub use truth::*;
