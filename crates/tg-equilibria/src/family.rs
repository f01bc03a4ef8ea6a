//! The same structure with other rest lengths and loads: a parameter homotopy from one generic complex instance follows
//! only as many paths as there are solutions.

use tg_homotopy::{Complex64, GenericInstance, ParameterSolver, PathOptions, PolynomialSystem, solve};
use tg_model::{Mechanics, Model};

use crate::equilibria::{EquilibriaOptions, prepare};
use crate::error::EquilibriaError;
use crate::judge::judge;
use crate::report::{EquilibriaReport, Origin};
use crate::stationarity::Stationarity;

/// A family of structures with its generic solutions. Inputs other than zero may change: rest lengths and loads; what is
/// zero stays zero, for it makes a family of its own with fewer solutions. Geometry and stiffness stay.
pub struct Family<'m, const D: usize> {
    model: &'m Model<D>,
    form: Stationarity<D>,
    instance: GenericInstance,
    paths: PathOptions,
}

impl<'m, const D: usize> Family<'m, D> {
    /// Solves a generic complex member of the family of `u` from scratch.
    ///
    /// # Errors
    /// As [`crate::all_equilibria`].
    pub fn new(model: &'m Model<D>, u: &[f64], options: &EquilibriaOptions) -> Result<Self, EquilibriaError> {
        let form = prepare(model, u)?;
        // Inputs turned to either side by angles that no real problem has, not far: paths to real targets stay short.
        let turned = |(k, &input): (usize, &usize)| {
            let angle = 0.44 + 0.03 * (1.0 + k as f64).sqrt();
            Complex64::from_polar(u[input], if k % 2 == 0 { angle } else { -angle })
        };
        let parameters: Vec<Complex64> = form.inputs.iter().enumerate().map(turned).collect();
        let solved = solve(&form.system, &parameters, &options.solve(&form))?;
        let instance = GenericInstance { parameters, solutions: solved.solutions() };
        Ok(Self { model, form, instance, paths: options.paths.clone() })
    }

    /// The family of `u` with an instance that [`Family::instance`] gave before, for the same structure.
    ///
    /// # Errors
    /// As [`Family::new`]; an instance with other numbers of parameters or unknowns.
    pub fn with_instance(
        model: &'m Model<D>,
        u: &[f64],
        instance: GenericInstance,
        options: &EquilibriaOptions,
    ) -> Result<Self, EquilibriaError> {
        let form = prepare(model, u)?;
        ParameterSolver::new(&form.system, instance.clone(), None, options.paths.clone())?;
        Ok(Self { model, form, instance, paths: options.paths.clone() })
    }

    /// The structure.
    pub fn model(&self) -> &'m Model<D> {
        self.model
    }

    /// The generic parameters and solutions: plain data, to be stored.
    pub fn instance(&self) -> &GenericInstance {
        &self.instance
    }

    /// Number of generic solutions: the paths of a query.
    pub fn generic_count(&self) -> usize {
        self.instance.solutions.len()
    }

    pub(crate) fn system(&self) -> &PolynomialSystem {
        &self.form.system
    }

    pub(crate) fn paths(&self) -> &PathOptions {
        &self.paths
    }

    /// All equilibria at other inputs.
    ///
    /// # Errors
    /// An input that is zero where the family's is not, or the other way round.
    pub fn query(&self, u: &[f64]) -> Result<EquilibriaReport, EquilibriaError> {
        let expected = self.model.sizes().inputs;
        if u.len() != expected {
            return Err(EquilibriaError::Inputs { found: u.len(), expected });
        }
        for (input, &value) in u.iter().enumerate() {
            if self.form.inputs.contains(&input) == (value == 0.0) && !self.form.idle.contains(&input) {
                return Err(EquilibriaError::OtherFamily { input: self.model.input_name(input), value });
            }
        }
        let target = self.form.parameters_at(u);
        let solver =
            ParameterSolver::new(&self.form.system, self.instance.clone(), None, self.paths.clone())?;
        let solved = solver.query(&target)?;
        judge(self.model, u, &self.form, &target, (Origin::Family, &solved))
    }
}
