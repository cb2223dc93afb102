//! Baking inside a running app: entity -> surfaces -> bake task -> image, `UV_1`, `Lightmap` -> entity.
//!
//! | step | file |
//! |---|---|
//! | what users put on entities | `components` |
//! | what an app says and hears | `events`, `settings` |
//! | the order of all steps | `plugin` |
//! | wait for scenes, meshes, textures | `loading` |
//! | entities to surfaces and lights | `collect` |
//! | the bake on its own threads | `task` |
//! | the result onto entities, and off again | `apply` |

#[cfg(feature = "render")]
mod apply;
mod collect;
mod components;
#[cfg(feature = "render")]
mod events;
#[cfg(feature = "render")]
mod loading;
#[cfg(feature = "render")]
mod plugin;
#[cfg(feature = "render")]
mod settings;
#[cfg(feature = "render")]
mod task;

#[cfg(feature = "render")]
pub use apply::*;
pub use collect::*;
pub use components::*;
#[cfg(feature = "render")]
pub use events::*;
#[cfg(feature = "render")]
pub use plugin::*;
#[cfg(feature = "render")]
pub use settings::*;
