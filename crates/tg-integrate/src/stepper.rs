//! What every time stepping scheme offers: a start and a step.

use tg_model::{Mechanics, ProjectionError};
use tg_sparse::SparseError;
use thiserror::Error;

use crate::state::State;

/// A time stepping scheme with its workspace. After its creation a step allocates nothing.
pub trait Stepper {
    /// The system that is stepped.
    fn mechanics(&self) -> &dyn Mechanics;

    /// A state at time `t` from full coordinates and velocities: prescribed components are set, velocities are
    /// projected onto the constraints.
    ///
    /// # Errors
    /// See [`StartError`].
    fn start(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<State, StartError>;

    /// Advances the state by `h > 0` seconds; on failure the state is unchanged.
    ///
    /// # Errors
    /// See [`StepError`].
    fn step(&mut self, state: &mut State, h: f64) -> Result<StepReport, StepError>;
}

/// Settings of the Newton iteration within a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonOptions {
    /// Scaled residual to reach: dynamic rows by their largest term, constraints by the size of their member.
    /// The default 1e-12 leaves only rounding and costs 2.0 iterations a step on the planar tower, as 1e-11 does;
    /// 1e-9 costs 1.5 and leaves 5e-11 m after 2 s (`cargo xtask defaults`).
    pub tolerance: f64,
    /// Iterations before a step is given up.
    pub max_iterations: u32,
    /// Iterations after which the active set of slacking cables is frozen.
    pub freeze_after: u32,
    /// How often a step that fails may be halved.
    pub halvings: u32,
}

impl Default for NewtonOptions {
    fn default() -> Self {
        Self { tolerance: 1e-12, max_iterations: 20, freeze_after: 6, halvings: 5 }
    }
}

impl NewtonOptions {
    /// Most halvings: more substeps than 2^20 would not end.
    const MOST_HALVINGS: u32 = 20;

    /// # Errors
    /// A tolerance that is negative or not finite, or too many halvings.
    pub(crate) fn check(&self) -> Result<(), StartError> {
        if !(self.tolerance.is_finite() && self.tolerance >= 0.0) {
            return Err(StartError::Parameter {
                name: "tolerance",
                value: self.tolerance,
                must: "be finite and not negative",
            });
        }
        if self.halvings > Self::MOST_HALVINGS {
            return Err(StartError::Parameter {
                name: "number of halvings",
                value: f64::from(self.halvings),
                must: "be at most 20",
            });
        }
        Ok(())
    }
}

/// What a step did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Newton iterations, over all substeps and failed attempts.
    pub iterations: u32,
    /// Largest scaled residual left.
    pub residual: f64,
    /// Substeps that the step was divided into; 1 normally.
    pub substeps: u32,
    /// Substeps that needed the active set frozen, and agreed with it in the end.
    pub frozen: u32,
    /// Cables held taut or slack against their law, over the substeps: where law (30) jumps a step may have no
    /// solution, and the smallest substep is accepted with the active set it was frozen at.
    pub forced: u32,
    /// Systems that the pivoting factorisation had to solve.
    pub fallbacks: u32,
}

/// Why a simulation cannot start.
#[derive(Clone, Debug, Error)]
pub enum StartError {
    /// Lengths of q and q̇ differ from the system's.
    #[error("the start has {got} {what}, the structure has {expected} coordinates")]
    Length {
        /// Which vector.
        what: &'static str,
        /// Its length.
        got: usize,
        /// Number of coordinates.
        expected: usize,
    },
    /// A coordinate or velocity is NaN or infinite.
    #[error("the start is not finite at the {0}; give finite coordinates, velocities and signals")]
    NotFinite(String),
    /// The coordinates do not satisfy the constraints.
    #[error(
        "the start violates {constraint} by {residual:.3e} (scaled); project the coordinates first (Projector::position)"
    )]
    Inconsistent {
        /// The worst constraint.
        constraint: String,
        /// Its scaled residual.
        residual: f64,
    },
    /// The velocities cannot be projected: mass is missing or constraints are redundant.
    #[error(transparent)]
    Projection(#[from] ProjectionError),
    /// A parameter of the scheme is out of range.
    #[error("the {name} is {value}; it must {must}")]
    Parameter {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The rule.
        must: &'static str,
    },
}

/// A failed step: when, how far from converged, and why.
#[derive(Clone, Debug, Error)]
#[error("the step of {h} s from t = {t} s failed: {failure}")]
pub struct StepError {
    /// Time at the start of the step \[s\].
    pub t: f64,
    /// Step \[s\].
    pub h: f64,
    /// Scaled residual at the end of the last attempt.
    pub residual: f64,
    /// Why.
    pub failure: StepFailure,
}

/// Why a step failed.
#[derive(Clone, Debug, Error)]
pub enum StepFailure {
    /// The step is not a positive finite number.
    #[error("the step must be positive and finite")]
    BadStep,
    /// The end of a run is not a number.
    #[error("the end time is {end}; give a number (infinity for a run that a condition stops)")]
    BadEnd {
        /// The end given \[s\].
        end: f64,
    },
    /// A state of another system, or of another scheme.
    #[error("the state has {got} {what}, the stepper expects {expected}; start it with this stepper")]
    ForeignState {
        /// Which vector.
        what: &'static str,
        /// Its length.
        got: usize,
        /// The length expected.
        expected: usize,
    },
    /// Newton's method does not converge even in substeps.
    #[error(
        "Newton's method left a scaled residual of {residual:.1e} after {iterations} iterations in the smallest substep, largest at the {worst}{}; a smaller step, or more damping, may mend it",
        at_cables(cables)
    )]
    NotConverged {
        /// Iterations of the last attempt.
        iterations: u32,
        /// Residual of the last attempt.
        residual: f64,
        /// The coordinate or constraint with the largest residual.
        worst: String,
        /// Cables at that coordinate.
        cables: Vec<String>,
    },
    /// A residual is NaN or infinite.
    #[error(
        "the residual is not finite at the {worst}{}; look for a signal that is not finite, or a cable of zero length",
        at_cables(cables)
    )]
    NotFinite {
        /// The coordinate or constraint.
        worst: String,
        /// Cables at that coordinate.
        cables: Vec<String>,
    },
    /// The linear system cannot be solved.
    #[error(
        "the linear system cannot be solved at the {culprit} ({source}); the structure is in a singular pose, or constraints are redundant"
    )]
    Solver {
        /// The coordinate or constraint.
        culprit: String,
        /// The solver's reason.
        source: SparseError,
    },
    /// The velocities cannot be projected.
    #[error(transparent)]
    Projection(ProjectionError),
}

fn at_cables(cables: &[String]) -> String {
    if cables.is_empty() { String::new() } else { format!(" (cables there: {})", cables.join(", ")) }
}
