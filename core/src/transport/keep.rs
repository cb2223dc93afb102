//! What is left of a bake beside its lightmaps.

use super::Row;

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
    /// The row of a texel whose rays see these columns, where that is kept.
    #[inline]
    pub(crate) fn row(self, columns: &mut [u32]) -> Row {
        match self {
            Self::Lightmaps => Row::default(),
            Self::Transport => Row::count(columns),
        }
    }
}
