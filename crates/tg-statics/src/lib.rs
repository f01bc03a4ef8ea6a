//! Statics of structures with cables: which rest lengths hold a shape, what it stores and carries, where it settles, when
//! it gives way.
//!
//! ```text
//! F(q, u) + A(q)ᵀ λ = 0,   Φ(q) = 0                                               (31)
//! ```
//!
//! | equation | question | item |
//! |---|---|---|
//! | (31) | does this configuration balance, and who carries what? | [`EquilibriumReport`], [`Configuration`] |
//! | Newton's laws, member by member | the same without multipliers: every member alone | [`FreeBodyReport`] |
//! | null spaces of B and Bᵀ | self-stress states, mechanisms, rigid motions | [`SelfStress`] |
//! | product forces | can prestress stiffen the mechanisms? | [`prestress_stability`] |
//! | (32) to (35) | which force densities or rest lengths hold it? | [`InverseStatics`], [`Request`] |
//! | (31) from a start | where does it settle? | [`Forward`] |
//! | (31) along a parameter | folds, bifurcations, slack cables on the way | [`continuation`], [`Family`] |
//! | (43) | is it stable? | [`stability`] |
//! | (43) = 0 | at which parameter does it lose stability? | [`critical_parameter`] |
//!
//! All of it is written against [`Tensioned`](tg_model::Tensioned), the waist with cables; only [`EquilibriumReport`] wants
//! a [`Model`](tg_model::Model), whose members it names. Inverse statics and self-stress work on a dense null space and
//! suit structures up to some thousand coordinates; forward statics, continuation and stability are sparse.
//!
//! ```
//! use tg_model::{CableLaw, ModelBuilder};
//! use tg_statics::{Forward, ForwardOptions, InverseStatics, Request, Unknown, Verdict, stability};
//!
//! // A lamp of 2 kg between two walls: which wires hold it there, both at least 5 N?
//! let mut b = ModelBuilder::<2>::new();
//! b.gravity([0.0, -9.81])?;
//! let lamp = b.particle("lamp", 2.0, [1.0, 2.0])?;
//! for (name, x) in [("left", 0.0), ("right", 3.0)] {
//!     let hook = b.anchor(name, [x, 3.0])?;
//!     b.cable(&format!("{name} wire"), hook, lamp.node(0), CableLaw::slacking(1e4), 1.5)?;
//! }
//! let model = b.build()?;
//! let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
//! let answer = InverseStatics::new(&model, &q, &u)?.solve(&Request::new(Unknown::RestLength).tension_between(5.0, 100.0))?;
//! println!("{}", answer.cutting_list()[0]);
//!
//! // With those rest lengths it comes back from anywhere near, and stays.
//! let found = Forward::new(&model, ForwardOptions::default()).solve(&[1.2, 1.7, 0.0, 3.0, 3.0, 3.0], &answer.inputs(&u))?;
//! assert!(found.configuration.q.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-12));
//! assert_eq!(stability(&model, &found.configuration, 1)?.verdict, Verdict::Stable);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod branch;
mod cable_equilibrium;
mod choice;
mod continuation;
mod continuation_error;
mod continuation_options;
mod critical;
mod cutting_list;
mod events;
mod family;
mod forward;
mod forward_error;
mod forward_options;
mod free_body;
mod gauge;
mod inverse;
mod inverse_error;
mod inverse_sparse;
mod newton;
mod newton_system;
mod path;
mod prestress;
mod program;
mod rank;
mod relaxation;
mod report;
mod request;
mod rigid;
mod root;
mod self_stress;
mod size;
mod solution;
mod sparse_equilibrium;
mod stability;

pub use branch::{Branch, BranchEnd, BranchPoint, Event, EventKind};
pub use continuation::continuation;
pub use continuation_error::ContinuationError;
pub use continuation_options::ContinuationOptions;
pub use critical::{Critical, CriticalError, critical_parameter};
pub use cutting_list::CuttingRow;
pub use family::{Family, InputFamily, Instance, StiffnessFamily};
pub use forward::{Equilibrium, Forward};
pub use forward_error::ForwardError;
pub use forward_options::{ForwardOptions, ForwardReport, Seek};
pub use free_body::{Action, FreeBody, FreeBodyError, FreeBodyReport, Line, Source, Wrench};
pub use inverse::InverseStatics;
pub use inverse_error::InverseError;
pub use prestress::{PrestressError, PrestressStability, prestress_stability};
pub use program::ProgramError;
pub use rank::Rank;
pub use report::{EquilibriumReport, JointReaction, MemberForces, NodeForce};
pub use request::{Given, Goal, Request, Unknown};
pub use self_stress::SelfStress;
pub use solution::{Answer, SolutionSet};
pub use stability::{Stability, Verdict, stability, stability_with};
pub use tg_tangent::Configuration;
