//! The compliant-mechanism paper: all equilibria of its three cases and their stability.
//!
//! - `equilibria`: counts, places and energies against the values known to all printed digits;
//! - `tables`: the paper's Tables 2 to 4, which were computed with slightly other numbers than its Table 1 prints;
//! - [`agreement`]: the natural-coordinate model at every equilibrium;
//! - [`homotopy`]: all of them from the natural-coordinate model, certified;
//! - [`sweep`]: folds as L01 varies (Fig. 4).
//!
//! [`expected`] gives all equilibria of a case, proven complete by interval search, for others to compare with.

pub mod agreement;
mod equilibria;
pub mod homotopy;
pub mod sweep;
mod tables;

use crate::error::CaseError;
use crate::mechanism::{Case, Parameters};
use crate::reference::mechanism::{Cone, Equilibrium, Model};
use crate::row::{Row, Rows};

/// Name of this case.
pub const NAME: &str = "mechanism";

const EXACT: &str = "homotopy and interval search, 50 digits";
const SEARCH: &str = "interval search of the torus";

/// All rows.
///
/// # Errors
/// A model or solver fails; none does.
pub fn rows() -> Result<Vec<Row>, CaseError> {
    let mut rows = Rows::new(NAME);
    for case in Case::ALL {
        let expected = expected(case)?;
        equilibria::rows(&mut rows, case, &expected);
        tables::rows(&mut rows, case, &expected);
        agreement::rows(&mut rows, case, &expected)?;
        homotopy::rows(&mut rows, case, &expected)?;
    }
    homotopy::beyond(&mut rows)?;
    sweep::rows(&mut rows)?;
    Ok(rows.finish())
}

/// All real equilibria of a mechanism.
#[derive(Clone, Debug)]
pub struct Expected {
    /// Physical equilibria, d1 and d2 positive: γ1, γ2 \[rad\], energy \[J\] and stability of each, by γ1.
    pub equilibria: Vec<Equilibrium>,
    /// Roots of the paper's equations with a negative length, by the signs of d1 and d2.
    pub unphysical: Vec<([f64; 2], Vec<Equilibrium>)>,
    /// Where a spring has no length and the potential no derivative.
    pub cones: Vec<Cone>,
    /// Boxes that the searches left undecided: 0 if the lists are complete.
    pub undecided: usize,
}

impl Expected {
    /// All equilibria of a mechanism, physical or not.
    ///
    /// # Errors
    /// As [`Model::search`].
    pub fn of(parameters: &Parameters) -> Result<Self, CaseError> {
        let model = twin(parameters);
        let mut undecided = 0;
        let mut branches = Vec::new();
        for (signs, branch) in model.branches() {
            let found = branch.search()?;
            undecided += found.undecided.len();
            branches.push((signs, found.equilibria));
        }
        let (_, equilibria) = branches.remove(0);
        Ok(Self { equilibria, unphysical: branches, cones: model.cones(), undecided })
    }

    /// Physical equilibria and the others.
    pub fn all(&self) -> impl Iterator<Item = &Equilibrium> {
        self.equilibria.iter().chain(self.unphysical.iter().flat_map(|(_, found)| found))
    }

    /// Number of stable physical equilibria.
    pub fn stable(&self) -> usize {
        self.equilibria.iter().filter(|e| e.stable()).count()
    }
}

/// All equilibria of one of the paper's cases.
///
/// # Errors
/// As [`Expected::of`].
pub fn expected(case: Case) -> Result<Expected, CaseError> {
    Expected::of(&Parameters::paper(case))
}

/// The same mechanism in its two angles.
pub fn twin(parameters: &Parameters) -> Model {
    let Parameters { fixed, bar, five, six, stiffness, rest } = *parameters;
    Model { fixed, bar, body: [six, five], stiffness, rest }
}

/// The nearest equilibrium and the larger of its two distances in angle \[°\].
fn nearest<'a>(
    equilibria: impl IntoIterator<Item = &'a Equilibrium>,
    printed: [f64; 2],
) -> Option<(&'a Equilibrium, f64)> {
    let distance = |e: &Equilibrium| {
        let [a, b] = degrees(e, printed);
        (a - printed[0]).abs().max((b - printed[1]).abs())
    };
    equilibria.into_iter().map(|e| (e, distance(e))).min_by(|a, b| a.1.total_cmp(&b.1))
}

/// Angles with the whole turns that bring them nearest to printed ones \[°\].
fn degrees(equilibrium: &Equilibrium, printed: [f64; 2]) -> [f64; 2] {
    std::array::from_fn(|i| {
        let angle = equilibrium.angles[i].to_degrees();
        angle + 360.0 * ((printed[i] - angle) / 360.0).round()
    })
}
