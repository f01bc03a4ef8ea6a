//! All equilibria of a structure from scratch.

use tg_homotopy::{Complex64, PathOptions, SolveOptions, Start, solve};
use tg_model::{Mechanics, Model};
use tg_statics::stability;
use tg_tangent::Configuration;

use crate::error::EquilibriaError;
use crate::judge::judge;
use crate::report::{EquilibriaReport, Origin};
use crate::stationarity::Stationarity;

/// Settings of the search.
#[derive(Clone, Debug)]
pub struct EquilibriaOptions {
    /// More paths than this are refused, with the number that would be needed. A millisecond each for a mechanism of the
    /// plane (docs/accuracy-and-speed.md, "Predictor of paths"), the default is a minute or less.
    pub max_paths: u64,
    /// Decides all random numbers.
    pub seed: u64,
    /// How paths are followed.
    pub paths: PathOptions,
}

impl Default for EquilibriaOptions {
    fn default() -> Self {
        Self { max_paths: 20_000, seed: 1, paths: PathOptions::default() }
    }
}

impl EquilibriaOptions {
    pub(crate) fn solve<const D: usize>(&self, form: &Stationarity<D>) -> SolveOptions {
        SolveOptions {
            start: Start::Best(form.groupings.clone()),
            seed: self.seed,
            max_paths: self.max_paths,
            paths: self.paths.clone(),
        }
    }
}

/// All equilibria at inputs `u` (rest lengths \[m\], then loads \[N\]) with every spring as a two-way one: complex solutions
/// counted, real ones certified and judged by energy.
///
/// # Errors
/// No polynomial form, equilibria that are not isolated, too many paths.
pub fn all_equilibria<const D: usize>(
    model: &Model<D>,
    u: &[f64],
    options: &EquilibriaOptions,
) -> Result<EquilibriaReport, EquilibriaError> {
    let form = prepare(model, u)?;
    let parameters = form.parameters_at(u);
    let solved = solve(&form.system, &parameters, &options.solve(&form))?;
    judge(model, u, &form, &parameters, (Origin::StartSystem, &solved))
}

pub(crate) fn prepare<const D: usize>(
    model: &Model<D>,
    u: &[f64],
) -> Result<Stationarity<D>, EquilibriaError> {
    let expected = model.sizes().inputs;
    if u.len() != expected {
        return Err(EquilibriaError::Inputs { found: u.len(), expected });
    }
    let start = Configuration::at(model, &model.initial_coordinates(), u)?;
    let count = stability(model, &start, 0)?.rigid_motions;
    if count > 0 {
        return Err(EquilibriaError::NotIsolated { count });
    }
    Stationarity::new(model, u)
}

impl<const D: usize> Stationarity<D> {
    /// Rest lengths, and components of forces, per unit of length.
    pub(crate) fn parameters_at(&self, u: &[f64]) -> Vec<Complex64> {
        self.inputs.iter().map(|&input| Complex64::new(u[input] / self.unknowns.unit, 0.0)).collect()
    }
}
