//! Time stepping of constrained mechanical systems: the modified symplectic scheme of the framework paper, compositions of
//! it, explicit Runge–Kutta schemes of high order, the generalised-α scheme beside them, and a driver with observers.
//!
//! ```
//! use tg_integrate::{NewtonOptions, Run, Stepper, Symplectic};
//! use tg_model::{Joining, ModelBuilder};
//!
//! let mut b = ModelBuilder::<2>::new();
//! b.gravity([0.0, -9.81])?;
//! let pivot = b.anchor("pivot", [0.0, 0.0])?;
//! let bar = b.bar("bar", 1.0, [0.0, 0.0], [1.0, 0.0])?;
//! b.joint("hinge", &[pivot.into(), bar.node(0)], Joining::Share)?;
//! let model = b.build()?;
//! let mut stepper = Symplectic::new(&model, NewtonOptions::default())?;
//! let mut state = stepper.start(0.0, &model.initial_coordinates(), &model.velocities_at_rest())?;
//! let summary = Run::new(1e-3, 2.0).go(&mut stepper, &mut state)?;
//! assert_eq!(summary.steps, 2000);
//! assert!(model.energy(&state.q, &state.v, &model.inputs_at(state.t)).total().abs() < 1e-4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! From the equations of the framework paper (Luo, Wu, Xu) to the items:
//!
//! | equation | meaning | item |
//! |---|---|---|
//! | (38) | the equations of motion | [`tg_model::Mechanics`] |
//! | (49), (53), (54), (55), Algorithm 1 | the modified symplectic scheme | [`Symplectic`] |
//! | | its symmetric compositions of order 4 and 6 (Suzuki; Kahan, Li) | [`Composition`] |
//! | \[38\] | generalised-α for constrained systems (Arnold, Brüls) | [`GeneralizedAlpha`] |
//! | (38) | leapfrog with exact constraints (RATTLE) | [`Leapfrog`] |
//! | (38), differentiated twice | explicit pairs of order 5(4) and 8(5,3) (Dormand, Prince) | [`RungeKutta`] |
//!
//! Which one: [`Leapfrog`] for a draft, or [`RungeKutta`] under error control, where cables are neither stiff nor hard
//! damped for the step that the motion asks for; [`Symplectic`] where they are, or where energy must not drift over very
//! many periods; [`Composition`] for the latter with few digits lost. Which error costs what time on nine scenes:
//! docs/accuracy-and-speed.md, "Schemes".
//!
//! A [`State`] is plain data and a checkpoint: serialised and read back exactly, a run continues bit for bit.

mod check;
mod composition;
mod curvature;
mod dormand_prince;
mod error;
mod error_control;
mod generalized_alpha;
mod hermite;
mod index_one;
mod kept;
mod leapfrog;
mod previous;
mod recorder;
mod run;
mod runge_kutta;
mod state;
mod stepper;
mod substep;
mod supports;
mod switching;
mod symplectic;
mod system;
mod turning;

pub use composition::{Composition, CompositionScheme};
pub use error::{StartError, StepError, StepFailure};
pub use error_control::Tolerances;
pub use generalized_alpha::GeneralizedAlpha;
pub use leapfrog::Leapfrog;
pub use recorder::Recorder;
pub use run::{Ended, Observer, Run, RunError, Summary};
pub use runge_kutta::{EmbeddedPair, RungeKutta};
pub use state::State;
pub use stepper::{NewtonOptions, StepReport, Stepper};
pub use symplectic::Symplectic;
pub use turning::Turning;
