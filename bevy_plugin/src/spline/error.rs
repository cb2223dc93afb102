//! What is wrong with a shape.

use std::fmt;

use radiosity::spline::{SplineError, TessellationError};

/// Why a component gives no shape. Its text says what to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShapeError {
    /// The control points, knots or weights make no curve or surface.
    Spline(SplineError),
    /// The tolerance is no positive number.
    Tolerance(TessellationError),
    /// There are weights, but not one for each control point.
    Weights {
        /// Number of weights.
        weights: usize,
        /// Number of control points.
        points: usize,
    },
    /// A tube or a ribbon without a width.
    Width {
        /// Its radius or width in meters.
        width: f32,
    },
    /// A surface shall fill other than four curves.
    Edges {
        /// Number of curves.
        edges: usize,
    },
    /// The surface or the curve has no area or no length.
    Nothing,
}

impl fmt::Display for ShapeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Spline(error) => error.fmt(f),
            Self::Tolerance(error) => error.fmt(f),
            Self::Weights { weights, points } => {
                write!(f, "there are {weights} weights for {points} control points; give each one, or none at all")
            }
            Self::Width { width } => write!(f, "the radius or width is {width} m; give a positive one"),
            Self::Edges { edges } => write!(f, "there are {edges} edges; give four: bottom, right, top and left"),
            Self::Nothing => write!(f, "all of its control points lie on one place or line; move them apart"),
        }
    }
}

impl std::error::Error for ShapeError {}

impl From<SplineError> for ShapeError {
    fn from(error: SplineError) -> Self {
        Self::Spline(error)
    }
}

impl From<TessellationError> for ShapeError {
    fn from(error: TessellationError) -> Self {
        Self::Tolerance(error)
    }
}
