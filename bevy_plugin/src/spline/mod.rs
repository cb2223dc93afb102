//! Curves and surfaces of splines as components: what shows them follows their control points.
//!
//! | file | what it holds |
//! |---|---|
//! | `curve` | [`SplineCurve`]: the control points of a curve |
//! | `surface` | [`SplineSurface`]: those of a surface, or the curves that it is made of |
//! | `sweep` | [`SplineSweep`]: a curve as a tube, a ribbon or a line |
//! | `mesh` | their meshes, made anew when they change |
//! | `path` | [`SplinePath`]: a curve by the distance along it, with frames |
//! | `travel` | [`TravelAlong`]: entities on their way along a curve |
//! | `lights` | [`LightsAlong`]: lights along a curve |
//! | `gizmos` | [`SplineGizmo`]: control points, knots and frames as lines |
//! | `plugin` | the order of all steps |
//!
//! All of it runs without a renderer, but for the gizmos, which need the feature `gizmos`. A surface of splines brings
//! its own lightmap coordinates, and a bake gives its texels the true normals.

mod curve;
mod error;
#[cfg(feature = "gizmos")]
mod gizmos;
mod lights;
mod mesh;
mod path;
mod plugin;
mod surface;
mod sweep;
mod travel;

pub use curve::*;
pub use error::*;
#[cfg(feature = "gizmos")]
pub use gizmos::*;
pub use lights::*;
pub use mesh::*;
pub use path::*;
pub use plugin::*;
pub use surface::*;
pub use sweep::*;
pub use travel::*;
