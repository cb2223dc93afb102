//! As many patches as leave room for a stack in 64 KiB.

use radiosity::form_factor::pairs;

use crate::r#box::Fineness;
use crate::checksum::Checksum;

/// How finely the box is cut.
pub const FINENESS: Fineness =
    Fineness { wall: [5, 5], ceiling: [3, 2], lamp: [1, 1], sides: [[2, 2], [2, 3]], top: [2, 2] };
/// Room for patches: as many as there are.
pub const PATCHES: usize = 4 * 25 + 4 * 6 + 1 + 4 * 4 + 4 * 6 + 2 * 4;
/// Room for what pairs exchange.
pub const PAIRS: usize = pairs(PATCHES);
/// What the host computes: the checksum of the form factors, and of the radiosities.
pub const CHECKSUMS: [Checksum; 2] = [Checksum(0x0c93_1717), Checksum(0x08dc_a9dd)];
