//! The same structure with other rest lengths: a parameter homotopy from one generic complex instance follows only as many
//! paths as there are solutions.

use tg_homotopy::{Complex64, GenericInstance, ParameterSolver, PathOptions, SolveOptions, Start, solve};
use tg_model::{Model, Tensioned};

use crate::equilibria::{EquilibriaOptions, judge, parameters, prepare};
use crate::error::EquilibriaError;
use crate::report::EquilibriaReport;
use crate::stationarity::Stationarity;

/// A family of planar structures with its generic solutions; the rest lengths of the cables that have one may change,
/// loads and geometry stay.
pub struct Family<'m> {
    model: &'m Model<2>,
    form: Stationarity,
    instance: GenericInstance,
    paths: PathOptions,
}

impl<'m> Family<'m> {
    /// Solves a generic complex member of the family of `u` from scratch.
    ///
    /// # Errors
    /// As [`crate::all_equilibria`].
    pub fn new(model: &'m Model<2>, u: &[f64], options: &EquilibriaOptions) -> Result<Self, EquilibriaError> {
        let form = prepare(model, u)?;
        // Rest lengths turned into the complex plane by angles that no real problem has.
        let generic: Vec<Complex64> = form
            .springs
            .iter()
            .enumerate()
            .map(|(s, &cable)| Complex64::from_polar(u[cable], 0.7 + 1.1 * s as f64))
            .collect();
        let solve_options = SolveOptions {
            start: Start::Best(form.groupings.clone()),
            seed: options.seed,
            max_paths: options.max_paths,
            paths: options.paths.clone(),
        };
        let solved = solve(&form.system, &generic, &solve_options)?;
        let instance = GenericInstance { parameters: generic, solutions: solved.solutions() };
        Ok(Self { model, form, instance, paths: options.paths.clone() })
    }

    /// The structure.
    pub fn model(&self) -> &'m Model<2> {
        self.model
    }

    /// Number of generic solutions: the paths of a query.
    pub fn generic_count(&self) -> usize {
        self.instance.solutions.len()
    }

    /// All equilibria at other rest lengths.
    ///
    /// # Errors
    /// A rest length that is zero where the family's is not, or the other way round; other loads than the family's are not
    /// looked at.
    pub fn query(&self, u: &[f64]) -> Result<EquilibriaReport, EquilibriaError> {
        for (cable, &value) in u.iter().enumerate().take(self.model.cable_count()) {
            let has_rest = self.form.springs.contains(&cable);
            if has_rest == (value == 0.0) {
                return Err(EquilibriaError::OtherFamily {
                    cable: Tensioned::cable_name(self.model, cable),
                    value,
                });
            }
        }
        let target = parameters(&self.form, u);
        let solver =
            ParameterSolver::new(&self.form.system, self.instance.clone(), None, self.paths.clone())?;
        let solved = solver.query(&target)?;
        judge(self.model, u, &self.form, &target, &solved)
    }
}
