//! What is left of a bake beside its lightmaps.

/// What is left of a bake beside its lightmaps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Keep {
    /// Nothing.
    #[default]
    Lightmaps,
    /// How light travels: other lamps and colors then need no rays. Takes more memory, about 460 bytes for each texel at medium quality.
    Transport,
}
