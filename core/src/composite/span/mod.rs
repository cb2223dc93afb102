//! Rows of pixels.

#[cfg(not(feature = "bvh"))]
mod plain;
#[cfg(feature = "bvh")]
mod wide;

#[cfg(not(feature = "bvh"))]
use plain::lay;
#[cfg(feature = "bvh")]
use wide::lay;

use super::{Channel, PremultipliedRgba};

/// Lays a row of pixels over another, as far as both reach.
///
/// As fast as memory, whether stored in 8, 16 or 32 bits: without branches or divisions the loop becomes vector
/// instructions; with the feature `bvh` the widest that the processor has.
#[inline]
pub fn over_span<C: Channel>(front: &[PremultipliedRgba<C>], back: &mut [PremultipliedRgba<C>]) {
    lay(front, back);
}

#[inline(always)]
fn each<C: Channel>(front: &[PremultipliedRgba<C>], back: &mut [PremultipliedRgba<C>]) {
    for (&front, back) in front.iter().zip(back) {
        *back = front.over(*back);
    }
}
