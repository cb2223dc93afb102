//! What can be wrong with a matrix of form factors.

use core::fmt;

/// Why a matrix of form factors cannot be made or repaired.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MatrixError {
    /// A slice does not have the length that the others ask for.
    Length {
        /// Which one.
        what: &'static str,
        /// Its length.
        length: usize,
        /// What it should be.
        expected: usize,
    },
    /// An area is not positive or not finite.
    Area {
        /// Of which patch.
        index: usize,
    },
    /// A form factor is negative or not finite.
    Factor {
        /// From this patch.
        row: usize,
        /// To this one.
        column: usize,
    },
    /// The share of the sky or the void is negative or not finite.
    Bin {
        /// Of which patch.
        row: usize,
    },
    /// The memory of a sparse matrix ends before its entries do.
    Full {
        /// The row that did not fit.
        row: usize,
        /// How many entries there is room for.
        capacity: usize,
    },
    /// The starts of sparse rows decrease or lead out of the entries, or columns do not increase within a row.
    Order {
        /// The first row that is wrong.
        row: usize,
    },
    /// A sparse row has an entry whose partner is not stored.
    NoPartner {
        /// From this patch.
        row: usize,
        /// To this one.
        column: usize,
    },
    /// No scaling of the rows makes them sum to one: the worst is this far off.
    NotClosed {
        /// Which row.
        row: usize,
        /// `|1 - sum|`
        error: f64,
    },
}

impl fmt::Display for MatrixError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Length { what, length, expected } => write!(f, "{length} {what} where {expected} are needed"),
            Self::Area { index } => {
                write!(f, "the area of patch {index} is not positive; leave out patches without area")
            }
            Self::Factor { row, column } => {
                write!(f, "the form factor from patch {row} to {column} is negative or not finite")
            }
            Self::Bin { row } => write!(f, "the sky or the void that patch {row} sees is negative or not finite"),
            Self::Full { row, capacity } => {
                write!(f, "row {row} does not fit into {capacity} entries; give the matrix more memory")
            }
            Self::Order { row } => {
                write!(f, "row {row} is out of order; starts must not decrease, columns must increase within a row")
            }
            Self::NoPartner { row, column } => {
                write!(f, "patch {row} sees {column}, but row {column} stores nothing for {row}; store a zero there")
            }
            Self::NotClosed { row, error } => write!(
                f,
                "row {row} still misses one by {error:e}: nothing that patch {row} sees can give it the rest; put that into its sky or void"
            ),
        }
    }
}

impl core::error::Error for MatrixError {}
