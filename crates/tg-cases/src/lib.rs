//! The papers' examples, each a small program over the layers with its own independent truth, and the table of every
//! number beside its reference.
//!
//! ```no_run
//! use tg_cases::verify::CASES;
//!
//! for case in CASES {
//!     let rows = (case.rows)()?;
//!     let hold = rows.iter().filter(|row| row.pass).count();
//!     println!("{}: {hold} of {} numbers hold", case.name, rows.len());
//! }
//! # Ok::<(), tg_cases::error::CaseError>(())
//! ```
//!
//! | part of the framework paper | item |
//! |---|---|
//! | Sec. 6.1, example 1 | [`double_pendulum`], checked by [`verify::double_pendulum`] |
//! | Sec. 6.2, example 2, dynamics | [`tower`], checked by [`verify::tower`] |
//! | Sec. 6.3, example 3 | [`deployable`], checked by [`verify::deployable`] |
//! | the antiprism paper, both examples | [`antiprism`], checked by [`verify::antiprism`] |
//! | the compliant-mechanism paper | [`mechanism`], checked by [`verify::mechanism`] |
//! | none: the prism mast of `docs/performance.md` | [`verify::mast`] |
//! | Tables 2 and 3, planar members | [`plane`] |
//! | Fig. 17, slack intervals | [`slack`] |
//!
//! [`reference`](mod@reference) holds the minimal-coordinate models, which share no code with the layers; [`published`] the reference
//! values computed elsewhere; [`simulate`] runs that several cases share.

pub mod antiprism;
pub mod deployable;
pub mod double_pendulum;
pub mod error;
pub mod mechanism;
pub mod plane;
pub mod published;
pub mod reference;
pub mod row;
pub mod simulate;
pub mod slack;
pub mod tower;
pub mod verify;

/// The README's program, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
