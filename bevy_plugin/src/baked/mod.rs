//! A saved bake: its files, and how a game shows them.
//!
//! | step | file |
//! |---|---|
//! | lightmaps, manifest and coordinates in files | `ktx2`, `manifest`, `uv` |
//! | the bake of an app into files | `save` |
//! | files into an asset | `scene` |
//! | the asset onto entities | `attach` |

#[cfg(feature = "render")]
mod attach;
pub mod ktx2;
pub mod manifest;
#[cfg(feature = "render")]
mod plugin;
#[cfg(feature = "render")]
mod save;
#[cfg(feature = "render")]
mod scene;
#[cfg(feature = "render")]
pub mod uv;

#[cfg(feature = "render")]
pub use attach::BakedSceneRoot;
#[cfg(feature = "render")]
pub use plugin::*;
#[cfg(feature = "render")]
pub use save::{BakeSaved, SaveBake, SaveError, SaveFailed, save_bake};
#[cfg(feature = "render")]
pub use scene::*;
