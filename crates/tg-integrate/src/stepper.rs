//! What every time stepping scheme offers: a start and a step.

use tg_model::Mechanics;

use crate::error::{StartError, StepError};
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
    /// The default 1e-12 leaves only rounding. A looser one saves few iterations, most of which are with kept factors, and what
    /// it leaves does not fall with h (docs/accuracy-and-speed.md, "Newton tolerance").
    pub tolerance: f64,
    /// Iterations before an attempt at a step is given up: twice what a step that converges needs (docs/accuracy-and-speed.md,
    /// "Most iterations").
    pub max_iterations: u32,
    /// Iterations after which the symplectic scheme freezes the active set of slacking cables. From 3 to 10 the results
    /// are the same (docs/accuracy-and-speed.md, "Steps without a solution").
    pub freeze_after: u32,
    /// How often the symplectic scheme may halve a step that fails. On the tower with damped slacking cables one suffices
    /// (docs/accuracy-and-speed.md, "Steps without a solution"); the others are in reserve.
    pub halvings: u32,
    /// Whether the symplectic scheme keeps factors of the Newton matrix over iterations and steps. Without, each iteration
    /// has its own, as Algorithm 1 of the framework paper is printed (docs/accuracy-and-speed.md, "Kept factors").
    pub keep_factors: bool,
}

impl Default for NewtonOptions {
    fn default() -> Self {
        Self { tolerance: 1e-12, max_iterations: 20, freeze_after: 6, halvings: 5, keep_factors: true }
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
    /// Newton iterations, over all substeps and failed attempts; evaluations of the accelerations in explicit schemes.
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
    /// Substeps that the explicit schemes made again: for their error, or to end at a switch of a cable.
    pub rejected: u32,
}
