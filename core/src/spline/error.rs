//! What is wrong with control points, weights and knots.

use core::fmt;

use super::MAX_DEGREE;

/// Why there is no such curve or surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SplineError {
    /// There is no control point.
    Empty,
    /// The degree is above [`MAX_DEGREE`].
    Degree {
        /// The degree asked for.
        degree: usize,
    },
    /// A point has a coordinate that is infinite or no number.
    NotFinite {
        /// Of the point.
        index: usize,
    },
    /// A weight is not positive.
    Weight {
        /// Of the point.
        index: usize,
        /// The weight.
        weight: f64,
    },
    /// The points of a surface do not fill its rows.
    Ragged {
        /// Number of points.
        points: usize,
        /// Number of points in a row.
        columns: usize,
    },
    /// There are not as many points as there should be.
    PointCount {
        /// Number of points.
        points: usize,
        /// How many there should be.
        wanted: usize,
    },
    /// There are not enough knots for the degree.
    KnotCount {
        /// Number of knots.
        knots: usize,
        /// How many there must be at least.
        least: usize,
    },
    /// A knot is infinite or no number.
    KnotNotFinite {
        /// Of the knot.
        index: usize,
    },
    /// A knot is smaller than the one before it.
    Decreasing {
        /// Of the smaller one.
        index: usize,
        /// The knot before it, and the knot.
        knots: [f64; 2],
    },
    /// A knot is repeated more often than there are points that it could act on.
    Multiplicity {
        /// Of the first one that is too much.
        index: usize,
        /// How many equal ones are allowed.
        most: usize,
    },
    /// The curve has no length in its parameter: the first and the last knot of its domain are equal.
    EmptyDomain,
    /// The knots of a closed curve do not repeat themselves.
    NotPeriodic {
        /// Of the knot that differs from the one that stands a period before it.
        index: usize,
    },
    /// Finer knots lack a knot.
    MissingKnot {
        /// Of the knot that they lack.
        index: usize,
    },
    /// A parameter lies outside of what it may be.
    Parameter {
        /// The parameter.
        parameter: f64,
        /// The smallest and the largest one allowed.
        domain: [f64; 2],
    },
    /// A buffer is not as long as the result.
    Buffer {
        /// Its length.
        length: usize,
        /// The length of the result.
        wanted: usize,
    },
    /// The equations for the control points have no unique solution.
    Singular {
        /// Of the point that they do not determine.
        index: usize,
    },
    /// The axis of a revolution has no direction.
    NoAxis,
    /// A revolution turns by nothing or by more than a full turn.
    Turn {
        /// In radians.
        angle: f64,
    },
    /// Curves that shall be the edges of a surface do not meet.
    Corner {
        /// Of the corner: 1 is added at the end of `u`, 2 at the end of `v`.
        index: usize,
        /// How far they lie apart, in meters and weight.
        distance: f64,
    },
}

impl fmt::Display for SplineError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "there are no control points; give at least one"),
            Self::Degree { degree } => {
                write!(f, "the degree is {degree}, the highest is {MAX_DEGREE}; cut the curve into pieces")
            }
            Self::NotFinite { index } => write!(f, "control point {index} is not finite; give finite coordinates"),
            Self::Weight { index, weight } => {
                write!(f, "the weight of control point {index} is {weight}; give a positive one")
            }
            Self::Ragged { points, columns } => {
                write!(f, "{points} control points are no rows of {columns}; give whole rows")
            }
            Self::PointCount { points, wanted } => write!(f, "there are {points} points; give {wanted}"),
            Self::KnotCount { knots, least } => write!(f, "there are {knots} knots; give at least {least}"),
            Self::KnotNotFinite { index } => write!(f, "knot {index} is not finite; give finite knots"),
            Self::Decreasing { index, knots: [before, knot] } => {
                write!(f, "knot {index} is {knot}, the one before it {before}; sort the knots")
            }
            Self::Multiplicity { index, most } => {
                write!(f, "knot {index} equals the {most} before it; leave it out, {most} equal knots part the curve")
            }
            Self::EmptyDomain => write!(f, "the domain is empty; give it a larger last knot"),
            Self::NotPeriodic { index } => {
                write!(f, "knot {index} breaks the period; repeat the distances of the first knots at the end")
            }
            Self::MissingKnot { index } => {
                write!(f, "the finer knots lack knot {index}; give them all knots of the curve")
            }
            Self::Parameter { parameter, domain: [low, high] } => {
                write!(f, "the parameter is {parameter}; give one in [{low}, {high}]")
            }
            Self::Buffer { length, wanted } => write!(f, "the buffer has length {length}; give one of {wanted}"),
            Self::Singular { index } => {
                write!(f, "nothing determines control point {index}; give more points near it, or fewer control points")
            }
            Self::NoAxis => write!(f, "the axis has no direction; give a finite one that is not zero"),
            Self::Turn { angle } => write!(f, "the turn is {angle} rad; give one up to a full turn that is not zero"),
            Self::Corner { index, distance } => {
                write!(f, "the curves at corner {index} lie {distance} apart; let them meet, with the same weight")
            }
        }
    }
}

impl core::error::Error for SplineError {}
