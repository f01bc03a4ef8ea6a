//! Sparse saddle-point systems of a fixed pattern.
mod elimination_tree;
mod error;
mod order;
mod pattern;
#[cfg(feature = "pivoting")]
mod pivoting;
mod rank;
mod refinement;
mod saddle;
mod slot_map;
mod static_lu;
mod symbolic;

pub use error::{EntryList, Row, SparseError};
pub use pattern::SaddlePattern;
pub use rank::{DependentRow, dependent_rows};
pub use saddle::{Counts, SaddleSystem, SolveReport};
