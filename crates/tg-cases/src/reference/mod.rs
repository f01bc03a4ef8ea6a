//! Independent minimal-coordinate reference models of the framework paper's examples.
//!
//! Plain rigid-body mechanics in independent coordinates, with neither multipliers nor natural coordinates: motions
//! `M(θ) θ̈ = Q(θ, θ̇, t)` of the planar examples, statics and modes of the spatial one. Nothing here uses another `tg-*`
//! crate.
//!
//! - [`antiprism`]: the antiprism paper's virtual work in ε, β and the feet's positions;
//! - [`double_pendulum`]: example 1, two angles, Lagrange's equations in closed form;
//! - [`tower`]: example 2, five angles, cables that may slacken, moving ground;
//! - [`deployable`]: example 3, twenty-four coordinates, potential and kinetic energy in dual numbers;
//! - [`mechanism`]: the compliant-mechanism paper's potential in two angles, and all its equilibria by interval search;
//! - `linkage`: positions, velocities and inertia of points carried by rotating arms (the tower's kinematics);
//! - `gauss`: one Gauss collocation step of order 16 with its interpolating polynomial;
//! - `ode`: step size control, requested output times and located events over that step.

pub mod antiprism;
pub mod deployable;
pub mod double_pendulum;
mod gauss;
mod linkage;
pub mod mechanism;
mod ode;
pub mod tower;

pub use double_pendulum::{DoublePendulum, PendulumState};
pub use tower::{Setup, SlackInterval, Tower, TowerRun, TowerState};

use std::fmt;

/// States of a reference model at requested times.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory<S> {
    /// Requested times \[s\].
    pub t: Vec<f64>,
    /// State at each time, same length as `t`.
    pub states: Vec<S>,
}

/// Why a reference solution could not be computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ReferenceError {
    /// A requested time is negative, not finite, or smaller than the one before it.
    Times {
        /// Position of the offending entry in the list of times.
        index: usize,
        /// Its value \[s\].
        value: f64,
    },
    /// The step size fell below the smallest useful one: the motion is not smooth there, or a parameter or the
    /// start is not finite or makes the mass matrix indefinite.
    StepTooSmall {
        /// Time at which the solution stopped \[s\].
        t: f64,
    },
    /// Cables switch without end at one instant.
    Chatter {
        /// Time at which the solution stopped \[s\].
        t: f64,
    },
    /// A mass matrix is not positive definite.
    MassMatrix,
    /// Newton's method found no equilibrium.
    Equilibrium {
        /// Largest generalised force left.
        residual: f64,
    },
}

impl fmt::Display for ReferenceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Times { index, value } => write!(
                f,
                "requested time number {index} is {value}: times must be finite, not negative and in ascending order"
            ),
            Self::StepTooSmall { t } => write!(
                f,
                "the step size vanished at t = {t} s: check that masses, stiffnesses and the start are finite and positive"
            ),
            Self::Chatter { t } => write!(
                f,
                "a cable switches without end at t = {t} s: start with lengths that differ from the rest lengths"
            ),
            Self::Equilibrium { residual } => write!(
                f,
                "Newton's method found no equilibrium, a generalised force of {residual:.1e} is left: start nearer"
            ),
            Self::MassMatrix => {
                write!(f, "the mass matrix is not positive definite: check that the masses are positive")
            }
        }
    }
}

impl std::error::Error for ReferenceError {}
