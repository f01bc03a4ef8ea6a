//! The Newton system of an implicit step, shared by the schemes.
//!
//! ```text
//! [H -A₀ᵀ] [δΔ]     [r]        H = a M + b (-∂F/∂q) + c (-∂F/∂q̇) - Σ ν_j ∂²Φ_j
//! [A₁  0 ] [δν] = - [Φ]
//! ```

use tg_model::{At, HessianEntry, Inertia, Jacobian, Layout, Mechanics, ProjectionError};
use tg_sparse::{SaddleSystem, SparseError};

use crate::error::StepFailure;

/// Groups of leading entries, in the order in which the pattern is made.
const MASS: usize = 0;
const STIFFNESS: usize = 1;
const DAMPING: usize = 2;
const CURVATURE: usize = 3;

/// Factors of the parts of the leading block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Factors {
    pub(crate) mass: f64,
    pub(crate) stiffness: f64,
    pub(crate) damping: f64,
}

/// Patterns, values, factors and buffers of one system.
pub(crate) struct NewtonSystem<'m> {
    pub(crate) mechanics: &'m dyn Mechanics,
    pub(crate) inertia: Inertia,
    pub(crate) layout: Layout,
    jacobian: Jacobian,
    saddle: SaddleSystem,
    mass: Vec<f64>,
    stiffness: Vec<f64>,
    damping: Vec<f64>,
    curvature: Vec<HessianEntry>,
    curvature_values: Vec<f64>,
    /// A(q_k), and A at the end of the step.
    pub(crate) upper: Vec<f64>,
    lower: Vec<f64>,
    /// Aᵀ ν over the full coordinates.
    pub(crate) constraint_force: Vec<f64>,
    /// Reciprocal sizes of the constraints.
    constraint_scales: Vec<f64>,
    /// Residual in, correction out: unknowns, then multipliers.
    pub(crate) rhs: Vec<f64>,
}

/// Where and how large the worst scaled residual is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Worst {
    pub(crate) residual: f64,
    /// Row of the system.
    pub(crate) row: usize,
}

impl<'m> NewtonSystem<'m> {
    /// `with_curvature` adds the constraints' second derivative (schemes that differentiate Aᵀλ).
    pub(crate) fn new(mechanics: &'m dyn Mechanics, with_curvature: bool) -> Result<Self, ProjectionError> {
        let sizes = mechanics.sizes();
        let layout = Layout::new(mechanics);
        let mass: Vec<_> = mechanics.mass().iter().map(|e| (e.row, e.col)).collect();
        let curvature = if with_curvature { mechanics.constraint_hessian().to_vec() } else { Vec::new() };
        let curved: Vec<_> = curvature.iter().map(|e| (e.row, e.col)).collect();
        let groups: [&[(usize, usize)]; 4] =
            [&mass, mechanics.stiffness_pattern(), mechanics.damping_pattern(), &curved];
        let pattern =
            layout.saddle(mechanics, &groups).map_err(|source| ProjectionError::solver(mechanics, source))?;
        Ok(Self {
            inertia: Inertia::new(sizes.coordinates, mechanics.mass()),
            jacobian: Jacobian::new(mechanics),
            constraint_scales: mechanics.constraint_scales().iter().map(|scale| 1.0 / scale).collect(),
            saddle: SaddleSystem::new(pattern),
            mass: mechanics.mass().iter().map(|e| e.value).collect(),
            stiffness: vec![0.0; mechanics.stiffness_pattern().len()],
            damping: vec![0.0; mechanics.damping_pattern().len()],
            curvature_values: vec![0.0; curvature.len()],
            curvature,
            upper: vec![0.0; mechanics.jacobian_pattern().len()],
            lower: vec![0.0; mechanics.jacobian_pattern().len()],
            constraint_force: vec![0.0; sizes.coordinates],
            rhs: vec![0.0; layout.unknowns() + sizes.constraints],
            layout,
            mechanics,
        })
    }

    /// Counted falls back to the pivoting factorisation so far.
    pub(crate) fn fallbacks(&self) -> u64 {
        self.saddle.counts().fallbacks
    }

    pub(crate) fn set_upper(&mut self, q: &[f64]) {
        self.mechanics.jacobian(q, &mut self.upper);
    }

    /// Aᵀ ν with the upper Jacobian.
    pub(crate) fn spread_multipliers(&mut self, nu: &[f64]) {
        self.jacobian.transposed(&self.upper, nu, &mut self.constraint_force);
    }

    /// Aᵀ ν with these values of A.
    pub(crate) fn spread(&mut self, jacobian: &[f64], nu: &[f64]) {
        self.jacobian.transposed(jacobian, nu, &mut self.constraint_force);
    }

    /// Puts Φ(q) into the lower rows of the right-hand side.
    pub(crate) fn constraint_rows(&mut self, q: &[f64]) {
        let n = self.layout.unknowns();
        self.mechanics.constraints(q, &mut self.rhs[n..]);
    }

    /// Largest scaled row of the right-hand side: dynamic rows relative to `scale`, constraints to the size of their
    /// members. NaN if any row is.
    pub(crate) fn largest(&self, scale: f64) -> f64 {
        let (dynamic, constraints) = self.rhs.split_at(self.layout.unknowns());
        let (mut largest, mut sum) = (0.0_f64, 0.0);
        for r in dynamic {
            largest = larger(largest, r.abs());
            sum += r;
        }
        let (mut violated, mut rest) = (0.0_f64, 0.0);
        for (phi, scale) in constraints.iter().zip(&self.constraint_scales) {
            violated = larger(violated, (phi * scale).abs());
            rest += phi;
        }
        // Comparisons overlook NaN, sums do not.
        if (sum + rest).is_nan() { f64::NAN } else { (largest / floor(scale)).max(violated) }
    }

    /// The row that [`NewtonSystem::largest`] speaks of.
    #[cold]
    pub(crate) fn worst(&self, scale: f64) -> Worst {
        let n = self.layout.unknowns();
        let mut worst = Worst { residual: 0.0, row: 0 };
        for (row, r) in self.rhs.iter().enumerate() {
            let scaled = if row < n { r / floor(scale) } else { r * self.constraint_scales[row - n] };
            worst = worst.or(scaled.abs(), row);
        }
        worst
    }

    /// Factors the matrix at a state and replaces the right-hand side r by the solution of `K x = r`.
    /// `lower_q` is where A₁ is taken; `nu` weighs the curvature if the system has it.
    pub(crate) fn solve(
        &mut self,
        at: At<'_>,
        factors: Factors,
        lower_q: &[f64],
        nu: &[f64],
    ) -> Result<(), SparseError> {
        self.factor(at, factors, lower_q, nu)?;
        self.solve_checked()
    }

    /// As [`NewtonSystem::apply`] right after a factorisation, with a check of the linear residual.
    pub(crate) fn solve_checked(&mut self) -> Result<(), SparseError> {
        self.saddle.solve(&mut self.rhs).map(drop)
    }

    /// Replaces the right-hand side r by K⁻¹ r with the factors of the last [`NewtonSystem::factor`], whatever has changed
    /// since.
    pub(crate) fn apply(&mut self) -> Result<(), SparseError> {
        self.saddle.apply(&mut self.rhs)
    }

    /// Factors the matrix at a state; see [`NewtonSystem::solve`].
    pub(crate) fn factor(
        &mut self,
        at: At<'_>,
        factors: Factors,
        lower_q: &[f64],
        nu: &[f64],
    ) -> Result<(), SparseError> {
        self.mechanics.jacobian(lower_q, &mut self.lower);
        self.saddle.clear_leading();
        self.saddle.add_leading(MASS, factors.mass, &self.mass);
        self.mechanics.stiffness(at, &mut self.stiffness);
        self.saddle.add_leading(STIFFNESS, factors.stiffness, &self.stiffness);
        if !self.damping.is_empty() {
            self.mechanics.damping(at, &mut self.damping);
            self.saddle.add_leading(DAMPING, factors.damping, &self.damping);
        }
        if !self.curvature.is_empty() {
            for (value, entry) in self.curvature_values.iter_mut().zip(&self.curvature) {
                *value = -nu[entry.constraint] * entry.value;
            }
            self.saddle.add_leading(CURVATURE, 1.0, &self.curvature_values);
        }
        self.saddle.set_jacobian(&self.upper, &self.lower);
        self.saddle.factor()
    }

    /// Words for a row: its name, and the cables there.
    pub(crate) fn words(&self, row: usize) -> (String, Vec<String>) {
        let n = self.layout.unknowns();
        if row < n {
            let coordinate = self.mechanics.free()[row];
            (self.mechanics.coordinate_name(coordinate), self.mechanics.cables_at(coordinate))
        } else {
            (self.mechanics.constraint_name(row - n), Vec::new())
        }
    }

    /// A failed iteration in words.
    pub(crate) fn failure(&self, failure: Failure, iterations: u32, worst: Worst) -> StepFailure {
        failure.explain(self.mechanics, self.words(worst.row), iterations, worst.residual)
    }
}

impl Failure {
    /// In words, with the worst row's name and cables.
    pub(crate) fn explain(
        self,
        mechanics: &dyn Mechanics,
        (worst, cables): (String, Vec<String>),
        iterations: u32,
        residual: f64,
    ) -> StepFailure {
        match self {
            Self::NotConverged => StepFailure::NotConverged { iterations, residual, worst, cables },
            Self::NotFinite => StepFailure::NotFinite { worst, cables },
            Self::Solver(source) => {
                StepFailure::Solver { culprit: Layout::new(mechanics).name(mechanics, &source), source }
            }
            Self::Projection(error) => StepFailure::Projection(error),
            Self::Told(failure) => failure,
            Self::SupportJumps { coordinate, distance } => {
                StepFailure::SupportJumps { coordinate: mechanics.coordinate_name(coordinate), distance }
            }
        }
    }
}

impl Worst {
    /// The larger of this and another row's residual; NaN counts as largest.
    fn or(self, residual: f64, row: usize) -> Self {
        if residual <= self.residual || self.residual.is_nan() { self } else { Self { residual, row } }
    }
}

/// The larger number, in one instruction; `f64::max` also looks for NaN.
#[inline(always)]
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// A scale that may be divided by.
fn floor(scale: f64) -> f64 {
    scale.max(f64::MIN_POSITIVE)
}

/// Why an iteration failed, before it is put into words.
#[derive(Debug)]
pub(crate) enum Failure {
    NotConverged,
    NotFinite,
    Solver(SparseError),
    Projection(ProjectionError),
    SupportJumps {
        coordinate: usize,
        distance: f64,
    },
    /// In words already.
    Told(StepFailure),
}
