//! What is wrong with a tolerance.

use core::fmt;

/// Why there is no such tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TessellationError {
    /// The distance from the surface is not a positive number.
    Chord {
        /// In meters.
        chord: f64,
    },
    /// The angle between normals is not a positive number.
    Angle {
        /// In radians.
        angle: f64,
    },
}

impl fmt::Display for TessellationError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Chord { chord } => write!(f, "{chord} m from the surface: give a positive number, 0.001 is usual"),
            Self::Angle { angle } => write!(f, "{angle} rad between normals: give a positive number, 0.2 is usual"),
        }
    }
}

impl core::error::Error for TessellationError {}
