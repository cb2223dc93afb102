//! The lightmaps of the Cornell box, coarse, on a heap but without operating system: what every target must find alike.
#![no_std]
#![forbid(unsafe_code)]

extern crate alloc;

mod scene;

pub use scene::scene;

use program::checksum::Checksum;
use radiosity::bake::{Bake, BakeError, BakeSettings, Quality, bake};
use radiosity::lightmap::{LayoutSettings, Resolution, UvMode};
use radiosity::progress::Progress;

/// What the host finds: `cargo test --release` compares.
pub const EXPECTED: Checksum = Checksum(0x38ad_9e07);

/// Texels per meter: the box is half a meter wide.
const DENSITY: f32 = 12.0;

/// Of all texels, how far they may be off, and where they lie.
///
/// # Errors
///
/// See [`bake`].
pub fn checksum() -> Result<Checksum, BakeError> {
    let layout =
        LayoutSettings { resolution: Resolution::TexelsPerMeter(DENSITY), uv: UvMode::Keep, ..Default::default() };
    let settings = BakeSettings { layout, quality: Quality::Draft, ..Default::default() };
    Ok(of(&bake(&scene(), &settings, &Progress::with_clock(|| 0.0))?))
}

fn of(bake: &Bake) -> Checksum {
    let mut checksum = Checksum::default();
    for image in &bake.images {
        image.texels.iter().for_each(|texel| checksum.add_all(texel.to_array()));
        checksum.add_all(image.errors.iter().copied());
    }
    for placement in bake.placements.iter().flatten() {
        checksum.add_all([placement.min, placement.max].iter().flat_map(|corner| corner.to_array()));
    }
    checksum
}
