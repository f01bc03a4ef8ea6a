//! Why all equilibria of a structure cannot be had.

use tg_homotopy::HomotopyError;
use tg_tangent::TangentError;
use thiserror::Error;

/// Why all equilibria of a structure cannot be had.
#[derive(Debug, Error)]
pub enum EquilibriaError {
    /// The structure has no polynomial form of the kind that is built here.
    #[error("no polynomial form: {what}; leave that out, or look for single equilibria by forward statics")]
    NotAlgebraic {
        /// What stands in the way.
        what: String,
    },
    /// The equilibria are not isolated.
    #[error("{count} rigid motions of the whole without work leave equilibria in families: add supports")]
    NotIsolated {
        /// Number of such motions.
        count: usize,
    },
    /// The polynomial solver refused; for too many paths the error says how many it would need.
    #[error(transparent)]
    Homotopy(#[from] HomotopyError),
    /// An equilibrium cannot be judged.
    #[error(transparent)]
    Tangent(#[from] TangentError),
    /// Rest lengths of the wrong number.
    #[error("{found} inputs for a structure that has {expected}")]
    Inputs {
        /// Inputs given.
        found: usize,
        /// Inputs of the structure.
        expected: usize,
    },
    /// An input is zero where the family has it in its polynomials, or the other way round.
    #[error(
        "the {input} is {value}: a family is for inputs that stay other than zero, or stay zero; make a family with this one"
    )]
    OtherFamily {
        /// What the input is.
        input: String,
        /// The value asked for \[m, N\].
        value: f64,
    },
}
