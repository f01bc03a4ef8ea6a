//! All equilibria of a small planar structure, each one certified and its stability decided by energy.
//!
//! The structure's polynomial form is built from the model; a homotopy ([`tg_homotopy`]) finds every complex solution; the
//! real ones are equilibria of the structure, or of it with a distance's other root.
//!
//! | question | item |
//! |---|---|
//! | all equilibria at given rest lengths | [`all_equilibria`] |
//! | the same for other rest lengths, quickly | [`Family`] |
//! | along one rest length, with the folds | [`Family::sweep`], [`Sweep`] |
//! | what was found and what supports it | [`EquilibriaReport`], [`RealEquilibrium`] |

mod affine;
mod equilibria;
mod error;
mod family;
mod planar;
mod report;
mod stationarity;
mod sweep;

pub use equilibria::{EquilibriaOptions, all_equilibria};
pub use error::EquilibriaError;
pub use family::Family;
pub use report::{EquilibriaReport, RealEquilibrium};
pub use sweep::{Fold, Sweep};
