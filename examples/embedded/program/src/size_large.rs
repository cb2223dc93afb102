//! As many patches as leave room for a stack in 256 KiB.

use radiosity::form_factor::pairs;

use crate::r#box::Fineness;
use crate::checksum::Checksum;

/// How finely the box is cut.
pub const FINENESS: Fineness =
    Fineness { wall: [8, 8], ceiling: [5, 4], lamp: [4, 2], sides: [[3, 2], [3, 4]], top: [3, 4] };
/// Room for patches: as many as there are.
pub const PATCHES: usize = 4 * 64 + 4 * 20 + 8 + 4 * 6 + 4 * 12 + 2 * 12;
/// Room for what pairs exchange.
pub const PAIRS: usize = pairs(PATCHES);
/// What the host computes: the checksum of the form factors, and of the radiosities.
pub const CHECKSUMS: [Checksum; 2] = [Checksum(0x3301_b373), Checksum(0xc5e3_7171)];
