//! What can go wrong with a tangent.

use tg_model::{Layout, Mechanics};
use tg_sparse::SparseError;
use thiserror::Error;

/// Why a tangent, its null space or its eigenpairs cannot be had.
#[derive(Clone, Debug, Error)]
pub enum TangentError {
    /// A sparse system cannot be analysed, factored or solved.
    #[error(
        "{doing}: trouble at {culprit} ({source}); remove redundant constraints, or leave the singular pose"
    )]
    Sparse {
        /// What was being computed.
        doing: &'static str,
        /// Name of the coordinate or constraint.
        culprit: String,
        /// The solver's reason.
        source: SparseError,
    },
    /// Coordinates or inputs of the wrong number.
    #[error(
        "{found} {what} for a structure that has {expected}; take them from its own `initial_coordinates` and `inputs_at`"
    )]
    Length {
        /// What was given.
        what: &'static str,
        /// How many were given.
        found: usize,
        /// How many the structure has.
        expected: usize,
    },
    /// A coordinate, input or force is not finite.
    #[error(
        "{what} is not finite at {culprit}; check coordinates and inputs, and that no cable has length zero"
    )]
    NotFinite {
        /// What is not finite.
        what: &'static str,
        /// Name of the coordinate.
        culprit: String,
    },
    /// A motion that the constraints allow moves no mass.
    #[error(
        "a motion that the constraints allow moves no mass (the {culprit} takes part); give it mass, or ask for stability instead of frequencies"
    )]
    MasslessMotion {
        /// Name of a coordinate in that motion.
        culprit: String,
    },
    /// A dense decomposition did not converge.
    #[error("the dense {what} did not converge; the matrix is likely badly scaled")]
    Dense {
        /// Which decomposition.
        what: &'static str,
    },
    /// The sparse eigensolver stopped early.
    #[error(
        "only {found} of {wanted} eigenpairs converged in a Krylov space of dimension {dimension}; ask for fewer, or use the dense method"
    )]
    NotConverged {
        /// Pairs that were asked for.
        wanted: usize,
        /// Pairs that converged.
        found: usize,
        /// Dimension of the Krylov space.
        dimension: usize,
    },
    /// No factorisation near this shift tells the signs.
    #[error(
        "no factorisation near the shift {shift:.6e} without pivoting succeeds, so eigenvalues below it cannot be counted; use the dense method"
    )]
    NoInertia {
        /// The shift σ.
        shift: f64,
    },
}

impl TangentError {
    /// A sparse solver's error under the user's name of the equation it is about.
    pub fn sparse(
        doing: &'static str,
        layout: &Layout,
        mechanics: &dyn Mechanics,
        source: SparseError,
    ) -> Self {
        Self::Sparse { doing, culprit: layout.name(mechanics, &source), source }
    }
}
