//! A tensegrity structure: rigid members in natural coordinates, joints, cables, supports, loads and signals, built
//! by name, checked, and offered to the solvers as flat slices through one narrow trait, [`Mechanics`].
//!
//! ```
//! use tg_model::{CableLaw, Joining, ModelBuilder};
//!
//! let mut b = ModelBuilder::<2>::new();
//! b.gravity([0.0, -9.81])?;
//! let ground = b.anchor("ground", [0.0, 0.0])?;
//! let mast = b.bar("mast", 1.0, [0.0, 0.0], [0.0, 2.0])?;
//! b.joint("foot", &[ground.into(), mast.node(0)], Joining::Share)?;
//! for (name, x) in [("left", -1.0), ("right", 1.0)] {
//!     let peg = b.anchor(name, [x, 0.0])?;
//!     b.cable(&format!("{name} guy"), peg, mast.node(1), CableLaw::slacking(1e4), 2.2)?;
//! }
//! let model = b.build()?;
//! assert_eq!(model.report().degrees_of_freedom(), 1);
//! # Ok::<(), tg_model::BuildError>(())
//! ```
//!
//! From the equations of the framework paper (Luo, Wu, Xu) to the items:
//!
//! | equation | meaning | item |
//! |---|---|---|
//! | (16), (22) | points as linear forms over the coordinates | [`Form`], [`Model::form`] |
//! | (19) | joints by sharing or by extrinsic constraints | [`ModelBuilder::joint`], [`Joining`] |
//! | (20), (21) | prescribed and free coordinates, anchors | [`ModelBuilder::support`], [`ModelBuilder::anchor`], [`Mechanics::free`] |
//! | (25) | point forces and gravity | [`ModelBuilder::load`], [`ModelBuilder::gravity`] |
//! | (22) of the antiprism paper | moments on members and about joints' axes | [`Load`], [`MomentAxes`] |
//! | (26), (27) | cable vector, length and rate | [`Model::cable_form`], [`CableState`] |
//! | (28), (29) | generalised tension force | [`Mechanics::force`] |
//! | (30) | constitutive law with slacking | [`CableLaw`] |
//! | (36) | constant mass matrix | [`Mechanics::mass`], [`Inertia`] |
//! | (38) | the equations of motion that the solvers see | [`Mechanics`] |
//! | (B.3), (B.4) | tangents, damping term corrected | [`Mechanics::stiffness`], [`Mechanics::damping`] |
//!
//! A model is immutable and shared by threads; state and workspaces belong to the solvers. [`Projector`] makes a
//! given state consistent and says by how much it moved.

mod assemble;
mod builder;
mod cable_set;
mod cables;
mod constraints;
mod drive;
mod error;
mod evaluate;
mod form;
mod inertia;
mod inertial_system;
mod jacobian;
mod law;
mod layout;
mod load;
mod mechanics;
mod model;
mod moments;
mod nodes;
mod parts;
mod placed;
mod projector;
mod reactions;
mod redundancy;
mod report;
mod signal;
mod structure;
mod supports;
mod tension;
mod tensioned;

pub use builder::ModelBuilder;
pub use cables::CableState;
pub use constraints::ConstraintSource;
pub use error::{BuildError, PlaceError};
pub use form::Form;
pub use inertia::Inertia;
pub use inertial_system::InertialSystem;
pub use jacobian::Jacobian;
pub use law::{CableLaw, Tension, TensionLaw};
pub use layout::{Layout, Run};
pub use load::{Load, MomentAxes};
pub use mechanics::{At, Entry, Features, HessianEntry, Mechanics, Sizes};
pub use model::{Energy, Model};
pub use parts::{AnchorId, CableId, Joining, LoadId, MemberId, Place, Redundancies};
pub use projector::{Moved, ProjectionError, Projector};
pub use reactions::Reactions;
pub use report::{BuildReport, Redundancy};
pub use signal::{Signal, SignalError, SignalFn, Table};
pub use structure::{Joint, Support};
pub use tensioned::Tensioned;
