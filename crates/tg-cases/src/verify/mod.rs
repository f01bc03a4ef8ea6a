//! Every number of the papers' examples beside ours.
//!
//! - [`double_pendulum`]: example 1 of the framework paper, Sec. 6.1;
//! - [`tower`]: dynamics of example 2, Sec. 6.2.2.

pub mod double_pendulum;
pub mod tower;

use crate::error::CaseError;
use crate::row::Row;

/// A case by name.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Name as `cargo xtask verify --case` takes it.
    pub name: &'static str,
    /// What it is.
    pub title: &'static str,
    /// Computes its rows.
    pub rows: fn() -> Result<Vec<Row>, CaseError>,
}

/// All cases in the order of the papers.
pub const CASES: [Case; 2] = [
    Case {
        name: double_pendulum::NAME,
        title: "framework paper, Sec. 6.1: dynamics of a double pendulum",
        rows: double_pendulum::rows,
    },
    Case {
        name: tower::NAME,
        title: "framework paper, Sec. 6.2: dynamics of a planar class-3 tower",
        rows: tower::rows,
    },
];
