//! On the host: the checksum that targets compare with.

use small_bake::{EXPECTED, checksum};

#[test]
fn the_bits_are_those_that_targets_compare_with() {
    assert_eq!(checksum(), Ok(EXPECTED));
}
