//! Diffuse light transport: form factors, the radiosity equation and lightmaps.
//!
//! [`bake::bake`] turns a [`scene::Scene`] into lightmaps; start reading there. With the built-in scene:
//!
//! ```
//! # #[cfg(feature = "bake")]
//! # {
//! use radiosity::bake::{BakeSettings, Quality, bake};
//! use radiosity::lightmap::{LayoutSettings, Resolution};
//! use radiosity::progress::Progress;
//! use radiosity::scene::cornell_box;
//!
//! let layout = LayoutSettings { resolution: Resolution::TexelsPerMeter(16.0), ..Default::default() };
//! let settings = BakeSettings { layout, quality: Quality::Draft, ..Default::default() };
//! let bake = bake(&cornell_box(), &settings, &Progress::default())?;
//! assert_eq!(bake.report.surfaces, 8);
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The map
//!
//! geometry -> patches -> form factors -> solve -> gather -> lightmap. A module uses only modules above it:
//!
//! | module | what it holds |
//! |---|---|
//! | [`math`], [`spectrum`] | float functions; gray, RGB and bands |
//! | `progress`, `parallel` | a running bake, seen and stopped; work cut into chunks |
//! | `material` | reflectance, exitance, alpha, textures; what mirrors and glass do with light that goes on |
//! | [`geometry`] | triangles, rays, directions, Sobol points, the tree |
//! | [`scatter`] | what a surface does with light: Lambert, mirror, Phong, GGX, glass, mixtures |
//! | [`spline`] | Bezier, B-spline, NURBS and Hermite curves, conics; surfaces and their tessellation |
//! | [`composite`] | transparent layers: over, pixels with depth, fog, triangles to pixels, the order of drawing |
//! | [`form_factor`] | the share of the light of one surface that reaches another |
//! | `light` | the irradiance that a lamp gives at a point, and its image in a mirror |
//! | [`solve`] | the radiosity equation `b = e + rho F b` |
//! | [`patch`] | surfaces in pieces: uniform, by proximity, adaptive; the classical method from end to end |
//! | `scene` | surfaces, materials and lights; the measured Cornell box |
//! | `transport` | what rays count, by way of mirrors and glass too, and lightmaps for other light from it |
//! | `lightmap` | charts, atlases, texels, patches of them: direct light, gathered light, repairs |
//! | `bake` | the whole pipeline, its settings and its report |
//! | `render` | the rendering equation by paths of light, the true error of a bake, and a baked scene as a camera sees it |
//!
//! # Quantities
//!
//! | quantity | unit | in the code |
//! |---|---|---|
//! | length | m | positions, distances, radii |
//! | radiance, luminance | cd/m2 | emission, texels, the sky |
//! | irradiance, illuminance | lx | what arrives at a point; a texel holds irradiance / pi |
//! | intensity | cd | point and spot lights |
//! | reflectance, alpha, form factor | 1 | shares in `[0, 1]` |
//! | angle | rad | |
//!
//! All quantities of light are per linear RGB channel, or per band of a [`spectrum`] where code is generic over bands.
//!
//! # Features
//!
//! | feature | what it adds |
//! |---|---|
//! | none | `math`, `spectrum`, `geometry`, `scatter`, `spline`, `composite`, `form_factor`, `solve`, uniform `patch`es, on slices: neither heap nor operating system |
//! | `alloc` | all other modules |
//! | `std` | the clock and the float functions of the system |
//! | `bvh`, `parallel`, `unwrap` | the tree that obvhs builds, the threads of rayon, coordinates for meshes that have none |
//! | `bake` (default) | the three above |
//! | `libm` | the same bits on every target |
#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

pub mod math;
pub mod spectrum;
#[cfg(feature = "alloc")]
pub mod progress;
#[cfg(feature = "alloc")]
pub mod parallel;
#[cfg(feature = "alloc")]
pub mod material;
pub mod geometry;
pub mod scatter;
pub mod spline;
pub mod composite;
pub mod form_factor;
#[cfg(feature = "alloc")]
pub mod light;
pub mod solve;
pub mod patch;
#[cfg(feature = "alloc")]
pub mod scene;
#[cfg(feature = "alloc")]
pub mod transport;
#[cfg(feature = "alloc")]
pub mod lightmap;
#[cfg(feature = "alloc")]
pub mod bake;
#[cfg(feature = "alloc")]
pub mod render;
