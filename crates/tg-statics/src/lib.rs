//! Statics.
#![allow(missing_docs)]
mod cable_equilibrium;
mod cutting_list;
mod forward;
mod forward_error;
mod gauge;
mod inverse;
mod inverse_error;
mod newton;
mod newton_system;
mod prestress;
mod program;
mod rank;
mod relaxation;
mod request;
mod rigid;
mod self_stress;
mod stability;

pub use cutting_list::CuttingRow;
pub use forward::{Equilibrium, Forward, ForwardOptions, ForwardReport, Seek};
pub use forward_error::ForwardError;
pub use inverse::{Answer, InverseStatics, SolutionSet};
pub use inverse_error::InverseError;
pub use prestress::{PrestressError, PrestressStability, prestress_stability};
pub use program::ProgramError;
pub use rank::Rank;
pub use request::{Given, Goal, Request, Unknown};
pub use self_stress::SelfStress;
pub use stability::{Stability, Verdict, stability, stability_with};
pub use tg_tangent::Configuration;
