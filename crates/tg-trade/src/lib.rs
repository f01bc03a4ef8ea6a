//! What accuracy costs: the motion of a structure by one time stepping scheme after the other, at finer and finer steps or
//! tolerances, with true errors and processor times; and steps or tolerances chosen for an accuracy.
//!
//! ```
//! use tg_model::{Joining, ModelBuilder};
//! use tg_scene::Scheme;
//! use tg_trade::{Method, Subject, choose};
//!
//! let mut b = ModelBuilder::<2>::new();
//! b.gravity([0.0, -9.81])?;
//! let pivot = b.anchor("pivot", [0.0, 0.0])?;
//! let bar = b.bar("bar", 1.0, [0.0, 0.0], [1.0, 0.0])?;
//! b.joint("hinge", &[pivot.into(), bar.node(0)], Joining::Share)?;
//! let model = b.build()?;
//! let velocities = model.velocities_at_rest();
//! let subject = Subject::new(&model, &velocities, 2.0);
//! let choice = choose(&subject, 1e-4, &Method::fixed(Scheme::Symplectic, 1e-3))?;
//! assert!(choice.error <= 1e-4 && choice.method.step < 2.0 / 128.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Motions are compared at some hundred times ([`LOOKS`]): positions of basic points, tensions, total energy. [`Reference`] is a
//! motion so fine that its own uncertainty, which it states, is far below the errors asked for; [`Curve`] is what a scheme costs
//! and gives against it; [`choose`] needs no reference: it compares a scheme with itself.

mod choose;
mod curve;
mod error;
mod errors;
mod method;
mod motion;
mod reference;
mod richardson;
mod subject;

pub use choose::{Choice, Tried, choose};
pub use curve::{Budget, Curve, Rung, cheapest};
pub use error::{ChoiceError, TrialError};
pub use errors::{Errors, Quantity};
pub use method::Method;
pub use motion::Motion;
pub use reference::Reference;
pub use subject::{LOOKS, Subject};
