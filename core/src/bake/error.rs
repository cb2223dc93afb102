//! Why a bake could not be made, and what to do about it.

use alloc::string::String;
use core::fmt;

use crate::lightmap::LayoutError;
use crate::progress::Cancelled;

/// Why a bake could not be made. Its text says what to do.
#[derive(Clone, Debug, PartialEq)]
pub enum BakeError {
    /// No surface of the scene can get a lightmap.
    NothingToBake,
    /// No light, no emissive material and no sky: every texel would be black.
    NoLight,
    /// Something that the scene or the settings say cannot be; the text says what.
    Invalid(String),
    /// `UvMode::Keep`, and a mesh has no usable lightmap coordinates.
    UnusableUv {
        /// Of the mesh.
        mesh: String,
        /// What is wrong with its coordinates.
        reason: String,
    },
    /// The charts do not fit.
    DoesNotFit(String),
    /// The bake would need more memory than it may use.
    OutOfMemory {
        /// What the bake would need, in bytes.
        needed: u64,
        /// What it may use, in bytes.
        allowed: u64,
    },
    /// `Progress::cancel` was called.
    Cancelled,
}

impl fmt::Display for BakeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NothingToBake => {
                write!(f, "the scene has no surface that can get a lightmap; add a triangle mesh with a lit material")
            }
            Self::NoLight => write!(
                f,
                "the scene has no light; add a point, spot, directional or rectangular light or an emissive material"
            ),
            Self::Invalid(what) => write!(f, "{what}"),
            Self::UnusableUv { mesh, reason } => write!(
                f,
                "mesh \"{mesh}\" has no usable lightmap coordinates: {reason}; mend its second UV set, or let it be unwrapped"
            ),
            Self::DoesNotFit(what) => write!(f, "{what}"),
            Self::OutOfMemory { needed, allowed } => write!(
                f,
                "the bake would need {} MiB of memory and may use {} MiB; allow more, or ask for fewer texels per meter",
                needed >> 20,
                allowed >> 20
            ),
            Self::Cancelled => write!(f, "the bake was cancelled"),
        }
    }
}

impl core::error::Error for BakeError {}

impl From<LayoutError> for BakeError {
    fn from(error: LayoutError) -> Self {
        match error {
            LayoutError::Invalid(what) => Self::Invalid(what),
            LayoutError::UnusableUv { mesh, reason } => Self::UnusableUv { mesh, reason },
            LayoutError::DoesNotFit(what) => Self::DoesNotFit(what),
            LayoutError::Cancelled => Self::Cancelled,
        }
    }
}

impl From<Cancelled> for BakeError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}
