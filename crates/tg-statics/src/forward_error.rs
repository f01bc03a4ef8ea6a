//! Why forward statics has no answer.

use tg_tangent::{Configuration, TangentError};
use thiserror::Error;

use crate::forward_options::ForwardReport;

/// Why no equilibrium was found.
#[derive(Debug, Error)]
pub enum ForwardError {
    /// A tangent, factorisation or decomposition failed.
    #[error(transparent)]
    Tangent(#[from] TangentError),
    /// Neither Newton's method nor relaxation reached equilibrium.
    #[error(
        "no equilibrium reached at {:.1} % of the step in inputs: a residual force of {residual:.2e} of the largest force is left at the {coordinate}, and a constraint violated by {violation:.2e} of its size{}",
        100.0 * load,
        cause(*loaded_rigid_motions)
    )]
    NotReached {
        /// Residual force per largest force.
        residual: f64,
        /// Where it is largest.
        coordinate: String,
        /// Largest violation of a constraint, per its size.
        violation: f64,
        /// Part of the step in inputs at which the search stopped.
        load: f64,
        /// Rigid motions that the supports leave free and along which a load can do work.
        loaded_rigid_motions: usize,
        /// The last configuration.
        last: Box<Configuration>,
        /// What was tried.
        report: Box<ForwardReport>,
    },
}

fn cause(loaded_rigid_motions: usize) -> String {
    match loaded_rigid_motions {
        0 => "; take smaller steps, start nearer, or look whether an equilibrium exists (a limit point may lie before it)".into(),
        n => format!("; the loads push the whole structure along rigid motions that the supports leave free ({n} of them): add supports, or remove the load"),
    }
}
