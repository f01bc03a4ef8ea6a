//! Why a simulation cannot start, or a step fails: when, where, and what may mend it.

use tg_model::ProjectionError;
use tg_sparse::SparseError;
use thiserror::Error;

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
    /// An explicit scheme lets the motion grow without bound.
    #[error(
        "the motion has grown to {size:.1e} at the {worst}{}: the step is too long for an explicit scheme; take a smaller step, error control, or the symplectic scheme",
        at_cables(cables)
    )]
    Unbounded {
        /// Largest coordinate or velocity \[m or m/s\].
        size: f64,
        /// The coordinate.
        worst: String,
        /// Cables at that coordinate.
        cables: Vec<String>,
    },
    /// A support jumps under something that has mass or constraints.
    #[error(
        "the support of the {coordinate} moves by {distance:.3e} m within the step, though it rests at both ends: what is joined to it would be thrown the farther the shorter the step; let it move in a ramp that several steps resolve"
    )]
    SupportJumps {
        /// The prescribed coordinate.
        coordinate: String,
        /// How far it moves \[m\].
        distance: f64,
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
    /// The error control asks for a substep that time cannot resolve.
    #[error(
        "at t = {at} s the tolerance asks for substeps of {substep:.1e} s, because of the {worst}{}; loosen the tolerance, make signals smooth there, or take the symplectic scheme",
        at_cables(cables)
    )]
    StepTooSmall {
        /// Time of the substep \[s\].
        at: f64,
        /// The substep \[s\].
        substep: f64,
        /// The coordinate with the largest error.
        worst: String,
        /// Cables at that coordinate.
        cables: Vec<String>,
    },
    /// An explicit scheme does not come forward.
    #[error(
        "after {substeps} substeps the step has come to t = {at} s, the next would be of {substep:.1e} s: the structure is too stiff for an explicit scheme; take the symplectic scheme, loosen the tolerance, or allow more substeps"
    )]
    TooManySubsteps {
        /// Time reached \[s\].
        at: f64,
        /// Substeps made.
        substeps: u32,
        /// The next substep \[s\].
        substep: f64,
    },
}

fn at_cables(cables: &[String]) -> String {
    if cables.is_empty() { String::new() } else { format!(" (cables there: {})", cables.join(", ")) }
}
