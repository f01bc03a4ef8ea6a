//! All equilibria of a small structure, each one certified and its stability decided by energy.
//!
//! The structure's polynomial form is built from the model; a homotopy ([`tg_homotopy`]) finds every complex solution; the
//! real ones are equilibria of the structure, or of it with a distance's other root.
//!
//! | question | item |
//! |---|---|
//! | all equilibria at given rest lengths and loads | [`all_equilibria`] |
//! | the same for other rest lengths and loads, quickly | [`Family`] |
//! | along one rest length or load, with the folds | [`Family::sweep`], [`Sweep`] |
//! | what was found and what supports it | [`EquilibriaReport`], [`RealEquilibrium`], [`Family::evidence`] |

mod affine;
mod coordinates;
mod equilibria;
mod error;
mod evidence;
mod family;
mod judge;
mod orbit;
mod potential;
mod report;
mod stationarity;
mod sweep;
mod turn;
mod unknowns;
mod variable;

pub use equilibria::{EquilibriaOptions, all_equilibria};
pub use error::EquilibriaError;
pub use evidence::Evidence;
pub use family::Family;
pub use report::{EquilibriaReport, Origin, RealEquilibrium};
pub use sweep::{Critical, Curve, CurvePoint, Sweep};
