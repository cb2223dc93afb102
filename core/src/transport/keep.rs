//! What is left of a bake beside its lightmaps.

use alloc::vec::Vec;

/// What is left of a bake beside its lightmaps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Keep {
    /// Nothing.
    #[default]
    Lightmaps,
    /// How light travels: other lamps and colors then need no rays. Takes more memory, about 460 bytes for each texel at medium quality.
    Transport,
}

impl Keep {
    /// Notes what a ray sees, where that is kept.
    #[inline]
    pub(crate) fn push(self, column: u32, seen: &mut Vec<u32>) {
        match self {
            Self::Lightmaps => {}
            Self::Transport => seen.push(column),
        }
    }
}
