//! Linearised dynamics of tensegrity structures about an equilibrium (Sec. 5.2 of the framework paper): natural and damped
//! modes, base excitation, state matrices for control, frequencies against a parameter.
//!
//! ```text
//! M δq̈ + C δq̇ + K δq - Aᵀ δλ = 0,   A δq = 0,   K = -∂F/∂q - ∂(Aᵀλ)/∂q         (41)
//! 𝓜 ξ̈ + 𝓒 ξ̇ + 𝓚 ξ = 0,   δq = N ξ,   A N = 0                                  (42), (43)
//! (𝓚 - ω² 𝓜) ξ = 0                                                             (44)
//! ```
//! The term of the multipliers λ in K is what makes a hinged bar under its weight a pendulum.
//!
//! ```
//! use tg_modal::{ModeKind, ModeOptions, modes};
//! use tg_model::{Joining, ModelBuilder};
//! use tg_tangent::Configuration;
//!
//! let mut b = ModelBuilder::<2>::new();
//! b.gravity([0.0, -9.81])?;
//! let pivot = b.anchor("pivot", [0.0, 0.0])?;
//! let bar = b.bar("bar", 1.0, [0.0, 0.0], [0.0, -1.0])?;
//! b.joint("hinge", &[pivot.into(), bar.node(0)], Joining::Share)?;
//! let model = b.build()?;
//! let at = Configuration::at(&model, &model.initial_coordinates(), &model.inputs_at(0.0))?;
//! let found = modes(&model, &at, &ModeOptions::all())?;
//! let omega_squared = 1.5 * 9.81; // 3 g / 2 L of a thin rod
//! assert!((found.list[0].omega_squared / omega_squared - 1.0).abs() < 1e-13);
//! assert!(matches!(found.list[0].kind, ModeKind::Vibration { .. }));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | equation | meaning | item |
//! |---|---|---|
//! | (40), (41) | the equilibrium and its tangent | [`tg_tangent::Configuration`], [`tg_tangent::Tangent`] |
//! | (44), (45) | natural frequencies, mode shapes in natural coordinates | [`modes`], [`Mode`] |
//! | (45) as motions of members | twists | [`member_twists`] |
//! | (42) | damped modes | [`damped`], [`DampedMode`] |
//! | (42) under moving supports | influence vector, participation, effective mass | [`SupportMotion`], [`participation`] |
//! | (42) with inputs | state matrices | [`state_space`], [`StateSpace`], [`Input`], [`Output`] |
//! | Fig. 14 | frequencies against a parameter | [`sweep`], [`Sweep`] |
//!
//! ω² is never square-rooted where it is not positive: [`ModeKind`] says what a mode does.

mod assignment;
mod balance;
mod channels;
mod damped;
mod derivative;
mod directional;
mod error;
mod ground;
mod modal;
mod modes;
mod participation;
mod shape;
mod state_space;
mod sweep;
mod tracking;

pub use channels::{Input, Output, point_weights};
pub use damped::{DampedKind, DampedMode, damped};
pub use error::ModalError;
pub use ground::SupportMotion;
pub use modes::{Mode, ModeKind, ModeOptions, Modes, modes};
pub use participation::{Participation, ParticipationReport, participation};
pub use shape::member_twists;
pub use state_space::{StateSpace, state_space};
pub use sweep::{Sweep, SweepError, SweepOptions, Track, sweep};
