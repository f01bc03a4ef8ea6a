//! Choosing in a set of solutions: the nearest point, or a programme where tensions are bounded.

use crate::inverse_error::InverseError;
use crate::program::{Program, ProgramError};
use crate::request::{Goal, Request};

/// Tension beyond a bound, per largest tension, that the programmes' accuracy explains.
const BOUND_ACCURACY: f64 = 1e-7;

/// f = slope · x + offset, cable by cable.
pub(crate) struct Affine {
    pub(crate) slope: Vec<f64>,
    pub(crate) offset: Vec<f64>,
}

/// Coefficients of variables, and a constant.
pub(crate) type Row = (Vec<(usize, f64)>, f64);

/// Tensions as functions of variables w: coordinates in the null space, or the unknowns themselves under equations.
pub(crate) struct TensionRows {
    /// For each cable the coefficients of w and the constant.
    pub(crate) rows: Vec<Row>,
    /// Number of variables w.
    pub(crate) free: usize,
    /// The w nearest to the goal.
    pub(crate) nearest: Vec<f64>,
    /// Number of variables behind w that only the equations know.
    pub(crate) multipliers: usize,
    /// Equations aᵀ(w, multipliers) = b, as (a, b).
    pub(crate) equations: Vec<Row>,
}

impl TensionRows {
    fn row(&self, cable: usize) -> (&[(usize, f64)], f64) {
        let (row, offset) = &self.rows[cable];
        (row, *offset)
    }

    pub(crate) fn tension(&self, cable: usize, w: &[f64]) -> f64 {
        let (row, offset) = self.row(cable);
        offset + row.iter().map(|&(k, a)| a * w[k]).sum::<f64>()
    }

    /// A programme of w, the multipliers and `more` variables, under the equations.
    fn program(&self, more: usize) -> Program {
        let mut program = Program::new(self.free + self.multipliers + more);
        self.equations.iter().for_each(|(row, value)| program.equal(row, *value));
        program
    }

    /// Variables w of the solution that a request with bounds chooses, and the multipliers.
    pub(crate) fn bounded(
        &self,
        cables: &[usize],
        request: &Request,
        name: &dyn Fn(usize) -> String,
    ) -> Result<Vec<f64>, InverseError> {
        let mut program = self.program(0);
        match request.goal {
            Goal::LeastTotalTension => {
                let row = |&cable: &usize| self.row(cable).0;
                cables.iter().flat_map(row).for_each(|&(k, a)| program.cost(k, a));
            }
            _ => {
                self.nearest.iter().enumerate().for_each(|(k, &target)| program.near(k, target));
            }
        }
        for &cable in cables {
            let ((row, offset), (low, high)) = (self.row(cable), request.bounds_of(cable));
            program.between(row, low - offset, high - offset);
        }
        let found = if self.free == 0 { Ok(Vec::new()) } else { program.solve() };
        match found {
            Ok(w) if self.violations(cables, &w, request).is_empty() => Ok(w),
            Ok(_) | Err(ProgramError::Infeasible) => self.least_violation(cables, request, name),
            Err(error) => Err(error.into()),
        }
    }

    /// Tensions beyond their bounds: (cable, tension, bound).
    fn violations(&self, cables: &[usize], w: &[f64], request: &Request) -> Vec<(usize, f64, f64)> {
        let tensions: Vec<_> = cables.iter().map(|&c| (c, self.tension(c, w))).collect();
        let slack = BOUND_ACCURACY * tensions.iter().fold(0.0_f64, |a, (_, f)| a.max(f.abs()));
        let violation = |(c, f): (usize, f64)| match request.bounds_of(c) {
            (low, _) if f < low - slack => Some((c, f, low)),
            (_, high) if f > high + slack => Some((c, f, high)),
            _ => None,
        };
        tensions.into_iter().filter_map(violation).collect()
    }

    /// The smallest sum of violations tells which bounds cannot be met together.
    fn least_violation(
        &self,
        cables: &[usize],
        request: &Request,
        name: &dyn Fn(usize) -> String,
    ) -> Result<Vec<f64>, InverseError> {
        let free = self.free + self.multipliers;
        let mut program = self.program(cables.len());
        for (s, &cable) in cables.iter().enumerate() {
            let ((row, offset), (low, high)) = (self.row(cable), request.bounds_of(cable));
            let with = |violation: f64| [row, &[(free + s, violation)]].concat();
            program.cost(free + s, 1.0);
            program.at_least(&[(free + s, 1.0)], 0.0);
            program.at_least(&with(1.0), low - offset);
            program.at_most(&with(-1.0), high - offset);
        }
        let x = program.solve()?;
        let violated = self.violations(cables, &x[..free], request);
        if violated.is_empty() {
            return Ok(x[..free].to_vec());
        }
        let named = |&(c, f, bound): &(usize, f64, f64)| (name(c), f, bound);
        Err(InverseError::Infeasible { violated: violated.iter().map(named).collect() })
    }
}
