//! How light travels: rays through a scene, and what they count, kept so that other light needs no ray.
//!
//! A [`Transport`] is what a bake with `Keep::Transport` leaves behind. A [`Relighter`] makes its lightmaps for any other
//! [`Lighting`]: other lamps, other colors of walls, another sky. [`Layers`] keep the lightmaps of groups of lights, so
//! that switching one is a weighted sum. [`Transport::write`] and [`Transport::read`] put it into a file.
//!
//! # What it costs
//!
//! A level of 70 691 triangles with 24 lamps, 483 163 texels, on two cores
//! (`cargo bench --profile bake -p bevy_radiosity --no-default-features --features cli --bench relight -- LEVEL.glb 8`):
//!
//! | | |
//! |---|---|
//! | bake | 41.6 s; in another run, without keeping, 35.8 s |
//! | kept | 223 MB: 40 million entries of what 328 469 nodes see, 4.10 bytes each; 1.5 million form factors between patches |
//! | relit, from the dark | 100 ms, 416 times as fast as the bake: direct 2, solve 47 (16 sweeps), radiance 8, gather 28, images 14 |
//! | relit, one lamp changed | 90 ms, 461 times as fast |
//! | the product with what the nodes see | 28 ms: 5.8 GB/s of rows, 28.6 GB/s with the radiances that they load; the same memory streams at 53 GB/s |
//! | half of the lamps off, against a bake anew | 0.006 % root mean square, where the light changes by 44 % |
//! | one lamp red and stronger | 0.005 %, of 11 % |
//! | another color of a wall | 0.005 %, of 9 % |
//!
//! The product takes 0.9 ns an entry on a core where all radiances lie in its first cache, and 1.4 ns as it is: the rest
//! is waiting for the last one.

mod codes;
mod contacts;
mod fills;
mod follow;
mod format;
mod keep;
mod lamp_light;
mod layers;
mod lighting;
mod relight;
mod rows;
mod seam_solve;
mod seams;
mod solution;
mod stored;
mod surfaces;
mod tracer;

pub use codes::*;
pub use contacts::*;
pub use fills::*;
pub use follow::*;
pub use format::*;
pub use keep::*;
pub use lamp_light::*;
pub use layers::*;
pub use lighting::*;
pub use relight::*;
pub use rows::*;
pub use seam_solve::*;
pub use seams::*;
pub use solution::*;
pub use stored::*;
pub use surfaces::*;
pub use tracer::*;
