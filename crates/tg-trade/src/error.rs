//! Why a trial run says nothing, and why nothing was chosen.

use tg_integrate::{RunError, StartError};
use thiserror::Error;

/// Why a trial run has no end.
#[derive(Clone, Debug, Error)]
pub enum TrialError {
    /// It cannot start.
    #[error(transparent)]
    Start(#[from] StartError),
    /// A step failed.
    #[error(transparent)]
    Step(#[from] RunError),
    /// It was cancelled.
    #[error("cancelled")]
    Cancelled,
    /// It took more processor time than it was given.
    #[error("it took longer than {limit} s of processor time")]
    TooLong {
        /// Time given \[s\].
        limit: f64,
    },
}

/// Why no step or tolerance was chosen.
#[derive(Clone, Debug, Error)]
pub enum ChoiceError {
    /// It was cancelled.
    #[error("stopped by Ctrl-C before a step was chosen")]
    Cancelled,
    /// The accuracy is not a positive number.
    #[error("the accuracy is {0} m; it must be positive and finite")]
    Accuracy(f64),
    /// Rounding alone is more.
    #[error(
        "an error of {accuracy} m is below what rounding may leave of these positions, {rounding:.0e} m; ask for more than that"
    )]
    BelowRounding {
        /// What was asked for \[m\].
        accuracy: f64,
        /// The rounding \[m\].
        rounding: f64,
    },
    /// A trial took longer than it was given; finer ones would, too.
    #[error(transparent)]
    TooLong(TrialError),
    /// No trial came near enough.
    #[error(
        "no {tried} reaches an error of {accuracy} m{}; {mend}",
        last.as_ref().map_or_else(String::new, |why| format!(": {why}"))
    )]
    Unreached {
        /// What was tried.
        tried: String,
        /// What was asked for \[m\].
        accuracy: f64,
        /// Why the last trial failed, if it did.
        last: Option<Box<TrialError>>,
        /// What would help.
        mend: &'static str,
    },
}
