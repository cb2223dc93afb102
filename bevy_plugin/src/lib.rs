//! Bakes lightmaps for Bevy: inside the running app or from the command line.
//!
//! ```no_run
//! use bevy::prelude::*;
//! use bevy_radiosity::prelude::*;
//!
//! fn main() {
//!     App::new().add_plugins((DefaultPlugins, RadiosityPlugins)).add_systems(Startup, spawn).run();
//! }
//!
//! fn spawn(mut commands: Commands, assets: Res<AssetServer>) {
//!     commands.spawn((WorldAssetRoot(assets.load("level.glb#Scene0")), BakeOnLoad));
//!     commands.spawn((Camera3d::default(), Transform::from_xyz(0.0, 1.5, 4.0)));
//! }
//! ```
//!
//! # What to put on an entity
//!
//! | component | effect |
//! |---|---|
//! | [`Baked`](bake::Baked) | this entity and all below it get lightmaps; the lights among them are baked |
//! | [`BakeOnLoad`](bake::BakeOnLoad) | so too, and the bake starts by itself when everything is loaded |
//! | [`NotBaked`](bake::NotBaked) | this entity and all below it are left out |
//! | [`AngularDiameter`](bake::AngularDiameter) | how large a directional light looks |
//! | [`BakeId`](bake::BakeId) | finds the entity again when a saved bake is loaded |
//! | `BakedSceneRoot` | attaches a saved bake; nothing is baked |
//! | [`SplineSurface`](spline::SplineSurface) | its mesh follows its control points |
//! | [`SplineCurve`](spline::SplineCurve) | a way, with [`SplineSweep`](spline::SplineSweep) a tube, a ribbon or a line |
//! | [`TravelAlong`](spline::TravelAlong) | moves along a curve at constant speed |
//! | [`LightsAlong`](spline::LightsAlong) | lights at equal distances on a curve |
//! | `TransparentOrder` | when a transparent entity is drawn: layer, priority, bias, which of its points counts |
//! | `TransparentDepth` | on a camera: what counts as far |
//! | `SortedTriangles` | the triangles of its transparent mesh are drawn from far to near |
//! | `SplitPane` | its mesh is cut where it runs through that of another |
//!
//! # What to say and hear
//!
//! `StartBake`, `CancelBake`, `RemoveBake` and `SaveBake` are events to trigger; `BakeStarted`,
//! `BakeProgress`, `BakeDone`, `BakeFailed`, `BakeCancelled`, `BakeSaved` and `SaveFailed` are events to observe.
//!
//! # What a bake changes
//!
//! Meshes get a `Lightmap`, and where they have no usable `UV_1` a copy of their mesh that has it. Baked lights get
//! `affects_lightmapped_mesh_diffuse = false` and so keep their highlights; a baked `RectLight` has no such flag and is
//! hidden. Ambient light, which is not baked, gets `affects_lightmapped_meshes = false`. `RemoveBake` undoes all of it.
//!
//! Bevy 0.19 binds lightmaps for each entity, in groups of four where textures can be bound without limit and else one
//! by one: entities that share a lightmap are not drawn together.
//!
//! # Modules
//!
//! | module | what it holds |
//! |---|---|
//! | [`gltf`] | indices of glTF scenes on their entities |
//! | [`convert`] | Bevy's meshes, materials, lights <-> those of the core |
//! | `lightmap_mesh` | meshes with the coordinates of a bake |
//! | `lightmap_guard` | `Lightmap` components that are safe to add, change and remove |
//! | `attach` | baked light onto entities and off again |
//! | [`spline`] | curves and surfaces whose meshes follow their control points |
//! | `transparency` | transparent things in the right order |
//! | [`bake`] | the bake inside an app |
//! | [`baked`] | the saved bake |
//! | `cli` | the command line |

pub mod gltf;

pub mod convert;

mod stand_in;

#[cfg(feature = "render")]
mod lightmap_mesh;

#[cfg(feature = "render")]
pub mod lightmap_guard;

#[cfg(feature = "render")]
pub mod attach;

pub mod spline;

#[cfg(feature = "render")]
pub mod transparency;

pub mod bake;
pub mod baked;

#[cfg(feature = "cli")]
pub mod cli;

#[cfg(feature = "render")]
mod plugins;
pub mod prelude;

#[cfg(feature = "render")]
pub use plugins::RadiosityPlugins;
