//! Why inverse statics has no answer.

use tg_tangent::TangentError;
use thiserror::Error;

use crate::program::ProgramError;

/// Why inverse statics has no answer.
#[derive(Clone, Debug, Error)]
pub enum InverseError {
    /// A tangent or decomposition failed.
    #[error(transparent)]
    Tangent(#[from] TangentError),
    /// The quadratic or linear programme failed.
    #[error(transparent)]
    Program(#[from] ProgramError),
    /// No tensions hold the configuration.
    #[error(
        "no tensions hold this configuration: a residual force of {residual:.2e} of the largest force is left, most of it at the {coordinate}; add a cable that resists that motion, give fewer values, or change the configuration"
    )]
    NotHeld {
        /// Residual force per largest force.
        residual: f64,
        /// Where it is largest.
        coordinate: String,
    },
    /// Bounds that cannot be met together.
    #[error("the bounds on tension cannot be met: {}", list(violated))]
    Infeasible {
        /// Name, nearest tension and bound \[N\] of the cables that miss theirs when all misses together are least.
        violated: Vec<(String, f64, f64)>,
    },
    /// A cable whose law does not reach a tension.
    #[error("cable \"{cable}\" cannot carry {tension:.6} N at the length {length:.6} m with any rest length")]
    NoRestLength {
        /// Name of the cable.
        cable: String,
        /// The tension \[N\].
        tension: f64,
        /// Its length \[m\].
        length: f64,
    },
    /// Rest lengths as unknowns of a cable whose law is not linear.
    #[error(
        "the tension of cable \"{cable}\" is not linear in its rest length (no stiffness, or a user's law); ask for force densities instead"
    )]
    NotLinear {
        /// Name of the cable.
        cable: String,
    },
    /// A cable that does not exist.
    #[error("there is no cable {cable}: the structure has {cables}")]
    NoSuchCable {
        /// Its index.
        cable: usize,
        /// Number of cables.
        cables: usize,
    },
    /// A cable in two ties, or tied and given.
    #[error("cable {cable} is bound twice: tied in two groups, or tied and given")]
    TwiceBound {
        /// Its index.
        cable: usize,
    },
    /// Values of the wrong number.
    #[error("{found} values to be close to, for {cables} cables")]
    WrongLength {
        /// Values given.
        found: usize,
        /// Number of cables.
        cables: usize,
    },
    /// A lower bound above the upper.
    #[error("no tension lies between {low} N and {high} N")]
    EmptyBounds {
        /// Lower bound \[N\].
        low: f64,
        /// Upper bound \[N\].
        high: f64,
    },
}

fn list(violated: &[(String, f64, f64)]) -> String {
    let one = |(cable, tension, bound): &(String, f64, f64)| {
        format!("cable \"{cable}\" reaches {tension:.6} N, not {bound:.6} N")
    };
    violated.iter().map(one).collect::<Vec<_>>().join("; ")
}
