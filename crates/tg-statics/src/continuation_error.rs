//! Why a branch cannot be followed.

use tg_model::BuildError;
use tg_tangent::TangentError;
use thiserror::Error;

/// Why a branch cannot be followed.
#[derive(Debug, Error)]
pub enum ContinuationError {
    /// A tangent, factorisation or decomposition failed.
    #[error(transparent)]
    Tangent(#[from] TangentError),
    /// The family has no structure at a value of the parameter.
    #[error(transparent)]
    Family(#[from] BuildError),
    /// Newton's method finds no equilibrium at the start.
    #[error(
        "there is no equilibrium near the start at the parameter {parameter}: a residual force of {residual:.2e} of the largest force is left; find one by forward statics first"
    )]
    NoStart {
        /// The parameter.
        parameter: f64,
        /// Residual force per largest force at the coordinates given.
        residual: f64,
    },
    /// The range of the parameter is empty or not finite.
    #[error("the parameter cannot go from {from} to {to}")]
    Range {
        /// Start.
        from: f64,
        /// End.
        to: f64,
    },
}
