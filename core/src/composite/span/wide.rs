//! With the widest instructions that the processor has.

use super::{Channel, PremultipliedRgba, each};
use crate::geometry::{Lanes, Level, Task};

/// Two rows of pixels.
struct Over<'a, C> {
    front: &'a [PremultipliedRgba<C>],
    back: &'a mut [PremultipliedRgba<C>],
}

impl<C: Channel> Task for Over<'_, C> {
    type Output = ();

    #[inline(always)]
    fn run<L: Lanes>(self, _lanes: L) {
        each(self.front, self.back);
    }
}

pub fn lay<C: Channel>(front: &[PremultipliedRgba<C>], back: &mut [PremultipliedRgba<C>]) {
    Level::new().run(Over { front, back });
}
