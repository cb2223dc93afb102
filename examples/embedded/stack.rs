//! How much of the stack was used at most: it is painted at the start, and at the end some paint is left.

const PAINT: u32 = 0x5041_494e;
/// Below this function the stack belongs to whoever paints.
const MARGIN: usize = 512;

/// The memory between the statics and the top of the stack.
pub struct Painted {
    low: *mut u32,
    top: usize,
}

impl Painted {
    /// Paints from `low` up to where the stack is now.
    #[inline(never)]
    pub fn new(low: *mut u32) -> Self {
        let here = 0_u32;
        let top = &raw const here as usize;
        let mut place = low;
        while (place as usize) < top - MARGIN {
            // SAFETY: nothing lives between the end of the statics and the stack, which ends above.
            unsafe {
                place.write_volatile(PAINT);
                place = place.add(1);
            }
        }
        Self { low, top }
    }

    /// Bytes of the stack that were used at some time.
    pub fn peak(&self) -> u32 {
        let mut place = self.low;
        // SAFETY: as above; the words up to `top` exist.
        while (place as usize) < self.top && unsafe { place.read_volatile() } == PAINT {
            place = unsafe { place.add(1) };
        }
        (self.top - place as usize) as u32
    }
}
