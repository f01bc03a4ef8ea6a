//! What can go wrong, with the unknown or the constraint that it concerns.

use std::fmt;

/// An equation of the saddle-point system, by the caller's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Row {
    /// Row of `H`: the balance of this unknown (a free coordinate), `0 ≤ i < n`.
    Unknown(usize),
    /// Row of `A`: this constraint and its multiplier, `0 ≤ j < m`.
    Multiplier(usize),
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(i) => write!(f, "unknown {i}"),
            Self::Multiplier(j) => write!(f, "multiplier {j}"),
        }
    }
}

/// The entry list that an index stands in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum EntryList {
    /// Entries of the leading block `H`, by group.
    Leading(usize),
    /// Entries of the constraint Jacobian `A`.
    Jacobian,
}

impl fmt::Display for EntryList {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Leading(group) => write!(f, "leading group {group}"),
            Self::Jacobian => write!(f, "the Jacobian"),
        }
    }
}

/// Errors of this crate. [`SparseError::row`] gives the equation where there is one, so that the caller can name the
/// member or the constraint.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SparseError {
    /// An entry's row or column lies outside of its block.
    #[error(
        "entry {entry} of {list} is ({row}, {column}), but the block is {rows} by {columns}; use None for an entry outside the system"
    )]
    EntryOutside {
        /// The list.
        list: EntryList,
        /// Index in the list.
        entry: usize,
        /// Row given.
        row: usize,
        /// Column given.
        column: usize,
        /// Rows of the block.
        rows: usize,
        /// Columns of the block.
        columns: usize,
    },
    /// A constraint has no entry at a free unknown, so that its multiplier is arbitrary.
    #[error("constraint {multiplier} touches no unknown; drop it or free one of its coordinates")]
    FreeMultiplier {
        /// Index of the constraint.
        multiplier: usize,
    },
    /// More unknowns or entries than 32-bit indices can number.
    #[error("the system has {count} {what}, more than 32-bit indices can number")]
    TooLarge {
        /// What there is too much of.
        what: &'static str,
        /// How many.
        count: usize,
    },
    /// The ordering of the unknowns failed.
    #[error("the fill-reducing ordering rejected the graph of the {unknowns} unknowns")]
    Ordering {
        /// Number of unknowns.
        unknowns: usize,
    },
    /// A value of the matrix is infinite or not a number.
    #[error(
        "the matrix has a value that is not finite in the row of {row}; look for an overflow or a division by zero in its force or constraint"
    )]
    NonFiniteMatrix {
        /// The equation.
        row: Row,
    },
    /// A value of the right-hand side is infinite or not a number.
    #[error(
        "the right-hand side is not finite in the row of {row}; look for an overflow or a division by zero in its force or constraint"
    )]
    NonFiniteVector {
        /// The equation.
        row: Row,
    },
    /// Static-order elimination lost a pivot, and the pivoting fallback is not compiled in.
    #[error(
        "the pivot of {row} vanishes: {pivot:e} remains of terms that sum up to {scale:e}; a multiplier: its constraint depends on others; an unknown: the leading block is not definite there"
    )]
    Pivot {
        /// The equation.
        row: Row,
        /// What is left of the pivot.
        pivot: f64,
        /// Sum of the magnitudes that cancelled.
        scale: f64,
    },
    /// The matrix is singular to working precision.
    #[error(
        "the matrix is singular at {row}; a multiplier: its constraint depends on others; an unknown: the structure can move there without inertia or stiffness"
    )]
    Singular {
        /// The equation that the null vector is largest in, or whose pivot vanished.
        row: Row,
    },
    /// The solution's residual stays too large.
    #[error(
        "the residual in the row of {row} stays at {residual:e} (scaled) after refinement; the matrix is close to singular or badly scaled"
    )]
    Residual {
        /// The equation with the largest scaled residual.
        row: Row,
        /// Scaled residual, see [`SolveReport::residual`](crate::SolveReport::residual).
        residual: f64,
    },
    /// `solve` was called before `factor`, or values changed since.
    #[error("the present values have not been factored; call factor() before solve()")]
    NotFactored,
}

impl SparseError {
    /// The equation that the error names, if it names one.
    #[must_use]
    pub fn row(&self) -> Option<Row> {
        match self {
            Self::FreeMultiplier { multiplier } => Some(Row::Multiplier(*multiplier)),
            Self::NonFiniteMatrix { row }
            | Self::NonFiniteVector { row }
            | Self::Pivot { row, .. }
            | Self::Singular { row }
            | Self::Residual { row, .. } => Some(*row),
            _ => None,
        }
    }
}
