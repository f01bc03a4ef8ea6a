//! Factors of `[K - σW, -Aᵀ; A, 0]`, K augmented: its solves and its inertia.

use tg_model::{At, Layout, Mechanics};
use tg_sparse::{Inertia, SaddleSystem};

use crate::augmentation::Augmentation;
use crate::configuration::Configuration;
use crate::error::TangentError;
use crate::spectrum::Metric;

const STIFFNESS: usize = 0;
const HESSIAN: usize = 1;
const METRIC: usize = 2;
const AUGMENTATION: usize = 3;

/// The shifted saddle-point system of a tangent.
pub(crate) struct ShiftInvert<'m> {
    mechanics: &'m dyn Mechanics,
    layout: Layout,
    system: SaddleSystem,
    stiffness: Vec<f64>,
    hessian: Vec<f64>,
    metric: Vec<f64>,
    augmentation: Vec<f64>,
    rhs: Vec<f64>,
    /// σ of the last [`ShiftInvert::factor_shifted`].
    shift: f64,
}

impl<'m> ShiftInvert<'m> {
    pub(crate) fn new(
        mechanics: &'m dyn Mechanics,
        at: &Configuration,
        metric: Metric,
    ) -> Result<Self, TangentError> {
        let layout = Layout::new(mechanics);
        let hessian_pattern: Vec<_> = mechanics.constraint_hessian().iter().map(|e| (e.row, e.col)).collect();
        let (metric_pattern, metric): (Vec<_>, Vec<_>) = match metric {
            Metric::Mass => mechanics.mass().iter().map(|e| ((e.row, e.col), e.value)).unzip(),
            Metric::Coordinates => mechanics.free().iter().map(|&i| ((i, i), 1.0)).unzip(),
        };
        let mut augmentation = Augmentation::new(mechanics);
        let groups =
            [mechanics.stiffness_pattern(), &hessian_pattern, &metric_pattern, &augmentation.pattern];
        let pattern = layout.saddle(mechanics, &groups).map_err(|source| {
            TangentError::sparse("analysing the tangent's pattern", &layout, mechanics, source)
        })?;
        let mut system = SaddleSystem::new(pattern);
        let rest = vec![0.0; at.q.len()];
        let mut stiffness = vec![0.0; mechanics.stiffness_pattern().len()];
        mechanics.stiffness(At { q: &at.q, v: &rest, u: &at.u, taut: None }, &mut stiffness);
        let mut jacobian = vec![0.0; mechanics.jacobian_pattern().len()];
        mechanics.jacobian(&at.q, &mut jacobian);
        system.set_jacobian(&jacobian, &jacobian);
        let rho = stiffness.iter().fold(0.0_f64, |a, k| a.max(k.abs())).max(f64::MIN_POSITIVE);
        let mut augmented = Vec::new();
        augmentation.values(mechanics, &jacobian, rho, &mut augmented);
        Ok(Self {
            hessian: mechanics
                .constraint_hessian()
                .iter()
                .map(|e| -at.lambda[e.constraint] * e.value)
                .collect(),
            rhs: vec![0.0; system.pattern().size()],
            shift: 0.0,
            mechanics,
            layout,
            system,
            stiffness,
            metric,
            augmentation: augmented,
        })
    }

    /// Factors with K replaced by nothing: `[W, -Aᵀ; A, 0]`.
    pub(crate) fn factor_metric(&mut self) -> Result<(), TangentError> {
        self.system.clear_leading();
        self.system.add_leading(METRIC, 1.0, &self.metric);
        self.factor()
    }

    /// Factors at the shift σ; the inertia of K - σW on the null space of A, if the factors tell.
    pub(crate) fn factor_shifted(&mut self, shift: f64) -> Result<Option<Inertia>, TangentError> {
        self.shift = shift;
        self.system.clear_leading();
        self.system.add_leading(STIFFNESS, 1.0, &self.stiffness);
        self.system.add_leading(HESSIAN, 1.0, &self.hessian);
        self.system.add_leading(METRIC, -shift, &self.metric);
        self.system.add_leading(AUGMENTATION, 1.0, &self.augmentation);
        self.factor()?;
        Ok(self.system.inertia())
    }

    fn factor(&mut self) -> Result<(), TangentError> {
        let result = self.system.factor();
        result.map_err(|source| {
            TangentError::sparse("factoring the tangent", &self.layout, self.mechanics, source)
        })
    }

    /// Number of eigenvalues below σ, or below a shift that differs from σ by at most `slack`.
    pub(crate) fn count_below(&mut self, shift: f64, slack: f64) -> Result<usize, TangentError> {
        // Where elimination without pivoting fails, it does so at isolated shifts.
        for nudge in [0.0, 0.5, -0.5, 1.0, -1.0] {
            if let Ok(Some(inertia)) = self.factor_shifted(shift + nudge * slack) {
                return Ok(inertia.negative);
            }
        }
        Err(TangentError::NoInertia { shift })
    }

    /// `x` of `[W, -Aᵀ; A, 0] [x; y] = [b; 0]`; the factors at the shift are back afterwards.
    pub(crate) fn project(&mut self, b: &[f64], x: &mut [f64]) -> Result<(), TangentError> {
        self.factor_metric()?;
        self.solve(b, x)?;
        self.factor_shifted(self.shift).map(drop)
    }

    /// `x` of `[K - σW, -Aᵀ; A, 0] [x; y] = [b; 0]`.
    pub(crate) fn solve(&mut self, b: &[f64], x: &mut [f64]) -> Result<(), TangentError> {
        self.rhs[b.len()..].fill(0.0);
        self.solve_with(b, x)
    }

    /// `x` of `[K - σW, -Aᵀ; A, 0] [x; y] = [b; g]`.
    pub(crate) fn solve_constrained(
        &mut self,
        b: &[f64],
        g: &[f64],
        x: &mut [f64],
    ) -> Result<(), TangentError> {
        self.rhs[b.len()..].copy_from_slice(g);
        self.solve_with(b, x)
    }

    fn solve_with(&mut self, b: &[f64], x: &mut [f64]) -> Result<(), TangentError> {
        let n = b.len();
        self.rhs[..n].copy_from_slice(b);
        let result = self.system.solve(&mut self.rhs);
        result.map_err(|source| {
            TangentError::sparse("solving with the tangent", &self.layout, self.mechanics, source)
        })?;
        x.copy_from_slice(&self.rhs[..n]);
        Ok(())
    }
}
