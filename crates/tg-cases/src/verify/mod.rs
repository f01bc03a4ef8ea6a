//! Every number of the papers' examples beside ours.
//!
//! - [`antiprism`]: both examples of the antiprism paper;
//! - [`double_pendulum`]: example 1 of the framework paper, Sec. 6.1;
//! - [`tower`]: modes and dynamics of example 2, Sec. 6.2;
//! - [`deployable`]: example 3, Sec. 6.3;
//! - [`mechanism`]: the compliant-mechanism paper, all equilibria;
//! - [`mast`]: the prism mast that other tools were measured on.

pub mod antiprism;
pub mod deployable;
pub mod double_pendulum;
pub mod mast;
pub mod mechanism;
pub mod tower;

use tg_coords::MassMatrix;

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

/// All cases in the order of the papers, then the mast.
pub const CASES: [Case; 6] = [
    Case {
        name: double_pendulum::NAME,
        title: "framework paper, Sec. 6.1: dynamics of a double pendulum",
        rows: double_pendulum::rows,
    },
    Case {
        name: tower::NAME,
        title: "framework paper, Sec. 6.2: modes and dynamics of a planar class-3 tower",
        rows: tower::rows,
    },
    Case {
        name: deployable::NAME,
        title: "framework paper, Sec. 6.3: a spatial deployable tower",
        rows: deployable::rows,
    },
    Case {
        name: antiprism::NAME,
        title: "antiprism paper: static analysis of tensegrity structures, both examples",
        rows: antiprism::rows,
    },
    Case {
        name: mechanism::NAME,
        title: "compliant-mechanism paper: all equilibria of its three cases",
        rows: mechanism::rows,
    },
    Case {
        name: mast::NAME,
        title: "prism mast: the scene that other tools were measured on",
        rows: mast::rows,
    },
];

/// Largest difference of an entry of a scalar mass matrix from its reference \[kg\]; NaN if the sizes differ.
fn mass_difference(ours: &MassMatrix, theirs: &[Vec<f64>]) -> f64 {
    if ours.len() != theirs.len() || theirs.iter().any(|row| row.len() != theirs.len()) {
        return f64::NAN;
    }
    let rows = theirs.iter().enumerate();
    rows.flat_map(|(i, row)| row.iter().enumerate().map(move |(j, m)| (ours.get(i, j) - m).abs()))
        .fold(0.0, f64::max)
}
