//! Linear and convex quadratic programmes, solved by Clarabel (interior points).

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use thiserror::Error;

/// Why a programme has no solution.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ProgramError {
    /// No point satisfies all bounds.
    #[error("the bounds contradict each other")]
    Infeasible,
    /// The objective has no lower bound.
    #[error("the objective has no lower bound; bound the tensions")]
    Unbounded,
    /// The solver gave up.
    #[error(
        "the interior-point solver stopped with {status}; scale the bounds to the tensions that the structure carries"
    )]
    Solver {
        /// Its status.
        status: String,
    },
}

/// Minimise `½ Σ w_k (x_k - target_k)² + cᵀx` subject to rows `aᵀx ≤ b` and `aᵀx = b`, all of one unit; sparse throughout.
///
/// Clarabel's tolerances are absolute. It is therefore given z, `x_k = d_k s z_k`: with columns scaled by d to a largest entry of
/// one, and s the largest number in b and the targets, z is of order one in whatever units x and b are.
#[derive(Clone, Debug)]
pub(crate) struct Program {
    weight: Vec<f64>,
    cost: Vec<f64>,
    entries: Vec<(usize, usize, f64)>,
    bounds: Vec<f64>,
    equal_entries: Vec<(usize, usize, f64)>,
    equal_values: Vec<f64>,
}

impl Program {
    pub(crate) fn new(variables: usize) -> Self {
        Self {
            weight: vec![0.0; variables],
            cost: vec![0.0; variables],
            entries: Vec::new(),
            bounds: Vec::new(),
            equal_entries: Vec::new(),
            equal_values: Vec::new(),
        }
    }

    /// Adds `c x_k` to the objective.
    pub(crate) fn cost(&mut self, k: usize, c: f64) {
        self.cost[k] += c;
    }

    /// Adds `½ (x_k - target)²` to the objective.
    pub(crate) fn near(&mut self, k: usize, target: f64) {
        self.weight[k] += 1.0;
        self.cost[k] -= target;
    }

    /// Adds `aᵀx ≤ bound`, unless the bound is infinite.
    pub(crate) fn at_most(&mut self, row: &[(usize, f64)], bound: f64) {
        if bound == f64::INFINITY {
            return;
        }
        let at = self.bounds.len();
        self.entries.extend(row.iter().map(|&(k, a)| (at, k, a)));
        self.bounds.push(bound);
    }

    pub(crate) fn at_least(&mut self, row: &[(usize, f64)], bound: f64) {
        let negative: Vec<_> = row.iter().map(|&(k, a)| (k, -a)).collect();
        self.at_most(&negative, -bound);
    }

    pub(crate) fn between(&mut self, row: &[(usize, f64)], low: f64, high: f64) {
        self.at_least(row, low);
        self.at_most(row, high);
    }

    /// Adds `aᵀx = value`.
    pub(crate) fn equal(&mut self, row: &[(usize, f64)], value: f64) {
        let at = self.equal_values.len();
        self.equal_entries.extend(row.iter().map(|&(k, a)| (at, k, a)));
        self.equal_values.push(value);
    }

    pub(crate) fn solve(&self) -> Result<Vec<f64>, ProgramError> {
        let n = self.weight.len();
        let Scales { columns, size, objective } = self.scales();
        let diagonal: Vec<usize> = (0..n).collect();
        // Per s d and the objective's unit.
        let weight: Vec<f64> =
            (0..n).map(|k| self.weight[k] * (columns[k] * size).powi(2) / objective).collect();
        let cost: Vec<f64> = (0..n).map(|k| self.cost[k] * columns[k] * size / objective).collect();
        let quadratic = CscMatrix::new_from_triplets(n, n, diagonal.clone(), diagonal, weight);
        let (equations, bounds) = (self.equal_values.len(), self.bounds.len());
        let scaled = |&(row, k, a): &(usize, usize, f64)| (row, k, a * columns[k]);
        let equal = self.equal_entries.iter().map(scaled);
        let below = self.entries.iter().map(scaled).map(|(row, k, a)| (equations + row, k, a));
        let entries = || equal.clone().chain(below.clone());
        let rows = entries().map(|e| e.0).collect();
        let places = entries().map(|e| e.1).collect();
        let values = entries().map(|e| e.2).collect();
        let matrix = CscMatrix::new_from_triplets(equations + bounds, n, rows, places, values);
        let right: Vec<f64> = self.equal_values.iter().chain(&self.bounds).map(|b| b / size).collect();
        let mut cones = vec![SupportedConeT::NonnegativeConeT(bounds)];
        if equations > 0 {
            cones.insert(0, SupportedConeT::ZeroConeT(equations));
        }
        let solver = |status: String| ProgramError::Solver { status };
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .build()
            .map_err(|error| solver(error.to_string()))?;
        let mut program = DefaultSolver::new(&quadratic, &cost, &matrix, &right, &cones, settings)
            .map_err(|error| solver(error.to_string()))?;
        program.solve();
        match program.solution.status {
            SolverStatus::Solved | SolverStatus::AlmostSolved => {
                let z = program.solution.x.iter().zip(&columns);
                Ok(z.map(|(z, column)| z * column * size).collect())
            }
            SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => {
                Err(ProgramError::Infeasible)
            }
            SolverStatus::DualInfeasible | SolverStatus::AlmostDualInfeasible => Err(ProgramError::Unbounded),
            other => Err(solver(other.to_string())),
        }
    }

    fn scales(&self) -> Scales {
        let n = self.weight.len();
        let mut largest = vec![0.0_f64; n];
        for &(_, k, a) in self.entries.iter().chain(&self.equal_entries) {
            largest[k] = largest[k].max(a.abs());
        }
        // A variable without a row is held by its weight alone.
        let columns: Vec<f64> = largest.iter().map(|&a| if a > 0.0 { 1.0 / a } else { 1.0 }).collect();
        let targets =
            (0..n).filter(|&k| self.weight[k] > 0.0).map(|k| self.cost[k] / self.weight[k] / columns[k]);
        let numbers = self.bounds.iter().chain(&self.equal_values).copied().chain(targets);
        let size = or_one(numbers.fold(0.0, |size, b| size.max(b.abs())));
        let quadratic = (0..n).map(|k| self.weight[k] * (columns[k] * size).powi(2));
        let linear =
            (0..n).filter(|&k| self.weight[k] == 0.0).map(|k| self.cost[k].abs() * columns[k] * size);
        Scales { objective: or_one(quadratic.chain(linear).fold(0.0, f64::max)), columns, size }
    }
}

/// Units of a programme's numbers.
struct Scales {
    /// d, one for each variable.
    columns: Vec<f64>,
    /// s.
    size: f64,
    objective: f64,
}

fn or_one(size: f64) -> f64 {
    if size > 0.0 { size } else { 1.0 }
}
