//! What most apps use.

#[cfg(feature = "render")]
pub use crate::RadiosityPlugins;
pub use crate::bake::{AngularDiameter, BakeId, BakeOnLoad, Baked, NotBaked, SkyLight};
#[cfg(feature = "render")]
pub use crate::bake::{
    BakeCancelled, BakeDone, BakeFailed, BakeProgress, BakeSettings, BakeStarted, CancelBake, Quality, RemoveBake,
    Resolution, StartBake, UvMode,
};
#[cfg(feature = "render")]
pub use crate::baked::{BakeSaved, BakedScene, BakedSceneRoot, SaveBake, SaveFailed};
#[cfg(feature = "gizmos")]
pub use crate::spline::SplineGizmo;
pub use crate::spline::{
    ControlNet, LightAlong, LightsAlong, PathEnd, SplineCurve, SplinePath, SplineSurface, SplineSweep, SplineTolerance,
    TravelAlong,
};
#[cfg(feature = "render")]
pub use crate::transparency::{SortedTriangles, SplitPane, TransparentDepth, TransparentKey, TransparentOrder};
