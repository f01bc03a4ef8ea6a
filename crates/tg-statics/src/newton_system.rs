//! The saddle-point system of one Newton step on the static equations (31), with a gauge and, for continuation, a
//! parameter p as one more unknown. All structures of one pattern share it.
//!
//! ```text
//! [K + σI   -F_p   -Aᵀ  -Gᵀ] [δq]   [r]      r = F + Aᵀλ
//! [t_qᵀ      t_p    0    0 ] [δp] = [0]      arclength row, with a parameter only: steps stay in the guess's plane
//! [A         0      0    0 ] [δλ]   [-Φ]
//! [G         0      0    0 ] [· ]   [0]      held coordinates
//! ```
//! K is augmented by ϱAᵀA (and ϱGᵀG), which changes nothing on A δq = -Φ once its right-hand side is augmented too.

use tg_model::{At, Layout, Mechanics};
use tg_sparse::{SaddlePattern, SaddleSystem, SparseError};
use tg_tangent::{Augmentation, TangentError};

const STIFFNESS: usize = 0;
const HESSIAN: usize = 1;
const AUGMENTATION: usize = 2;
const DIAGONAL: usize = 3;
const BORDER: usize = 4;

/// Residuals, scaled: forces by the largest force, constraints by member size.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Residual {
    pub(crate) force: f64,
    pub(crate) constraint: f64,
    /// Sum of squares of both.
    pub(crate) merit: f64,
    /// Where the largest residual force is, among the free coordinates.
    pub(crate) worst: usize,
}

/// The border of a system with a parameter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Border<'a> {
    /// F_p over the free coordinates.
    pub(crate) force_rate: &'a [f64],
    /// t over the free coordinates, then over p.
    pub(crate) row: &'a [f64],
}

pub(crate) struct NewtonSystem {
    layout: Layout,
    system: SaddleSystem,
    augmentation: Augmentation,
    held: Vec<usize>,
    parameter: bool,
    rest: Vec<f64>,
    force: Vec<f64>,
    stiffness: Vec<f64>,
    hessian: Vec<f64>,
    jacobian: Vec<f64>,
    augmented: Vec<f64>,
    diagonal: Vec<f64>,
    border: Vec<f64>,
    phi: Vec<f64>,
    /// r over the free coordinates.
    residual: Vec<f64>,
    /// Right-hand side, then the step: δq, δp if any, δλ, gauge.
    step: Vec<f64>,
}

impl NewtonSystem {
    pub(crate) fn new(
        mechanics: &dyn Mechanics,
        held: Vec<usize>,
        parameter: bool,
    ) -> Result<Self, TangentError> {
        let layout = Layout::new(mechanics);
        let augmentation = Augmentation::new(mechanics);
        let n = layout.unknowns();
        let inside = |pattern: &[(usize, usize)]| -> Vec<_> {
            pattern.iter().map(|&(r, c)| layout.unknown(r).zip(layout.unknown(c))).collect()
        };
        let hessian: Vec<_> = mechanics.constraint_hessian().iter().map(|e| (e.row, e.col)).collect();
        let mut border = Vec::new();
        if parameter {
            border.extend((0..n).map(|k| Some((k, n))));
            border.extend((0..=n).map(|k| Some((n, k))));
        }
        let groups = [
            inside(mechanics.stiffness_pattern()),
            inside(&hessian),
            inside(&augmentation.pattern),
            (0..n).map(|k| Some((k, k))).collect(),
            border,
        ];
        let groups: Vec<&[_]> = groups.iter().map(Vec::as_slice).collect();
        let m = mechanics.sizes().constraints;
        let rows = mechanics.jacobian_pattern().iter().map(|&(row, i)| layout.unknown(i).map(|k| (row, k)));
        let gauge = held.iter().enumerate().map(|(g, &k)| Some((m + g, k)));
        let jacobian: Vec<_> = rows.chain(gauge).collect();
        let pattern = SaddlePattern::new(n + usize::from(parameter), m + held.len(), &groups, &jacobian)
            .map_err(|source| named(&layout, mechanics, source))?;
        let sizes = mechanics.sizes();
        Ok(Self {
            step: vec![0.0; pattern.size()],
            system: SaddleSystem::new(pattern),
            rest: vec![0.0; sizes.coordinates],
            force: vec![0.0; sizes.coordinates],
            stiffness: vec![0.0; mechanics.stiffness_pattern().len()],
            hessian: vec![0.0; hessian.len()],
            jacobian: vec![0.0; mechanics.jacobian_pattern().len() + held.len()],
            augmented: Vec::new(),
            diagonal: vec![0.0; n],
            border: vec![0.0; if parameter { 2 * n + 1 } else { 0 }],
            phi: vec![0.0; m],
            residual: vec![0.0; n],
            layout,
            augmentation,
            held,
            parameter,
        })
    }

    pub(crate) fn unknowns(&self) -> usize {
        self.layout.unknowns()
    }

    pub(crate) fn gauged(&self) -> usize {
        self.held.len()
    }

    /// Systems that needed the pivoting factorisation so far.
    pub(crate) fn fallbacks(&self) -> u64 {
        self.system.counts().fallbacks
    }

    /// Evaluates r and Φ; forces are scaled by `force_scale`.
    pub(crate) fn evaluate(
        &mut self,
        mechanics: &dyn Mechanics,
        q: &[f64],
        u: &[f64],
        lambda: &[f64],
        force_scale: f64,
    ) -> Residual {
        mechanics.force(At { q, v: &self.rest, u, taut: None }, &mut self.force);
        let entries = mechanics.jacobian_pattern().len();
        mechanics.jacobian(q, &mut self.jacobian[..entries]);
        for (r, &i) in self.residual.iter_mut().zip(mechanics.free()) {
            *r = self.force[i];
        }
        for (&(row, i), a) in mechanics.jacobian_pattern().iter().zip(&self.jacobian) {
            if let Some(k) = self.layout.unknown(i) {
                self.residual[k] += a * lambda[row];
            }
        }
        mechanics.constraints(q, &mut self.phi);
        let mut found = Residual::default();
        for (k, r) in self.residual.iter().enumerate() {
            let r = r.abs() / force_scale;
            found.merit += r * r;
            if r > found.force || r.is_nan() {
                (found.force, found.worst) = (r, k);
            }
        }
        for (phi, scale) in self.phi.iter().zip(mechanics.constraint_scales()) {
            let phi = phi.abs() / scale;
            found.merit += phi * phi;
            found.constraint = if phi > found.constraint || phi.is_nan() { phi } else { found.constraint };
        }
        found
    }

    /// Factors the matrix at the place of the last [`NewtonSystem::evaluate`].
    pub(crate) fn factor(
        &mut self,
        mechanics: &dyn Mechanics,
        q: &[f64],
        u: &[f64],
        lambda: &[f64],
        shift: f64,
        border: Option<Border<'_>>,
    ) -> Result<(), TangentError> {
        mechanics.stiffness(At { q, v: &self.rest, u, taut: None }, &mut self.stiffness);
        for (value, e) in self.hessian.iter_mut().zip(mechanics.constraint_hessian()) {
            *value = -lambda[e.constraint] * e.value;
        }
        let rho = self.scale();
        let entries = mechanics.jacobian_pattern().len();
        self.augmentation.values(mechanics, &self.jacobian[..entries], rho, &mut self.augmented);
        self.jacobian[entries..].fill(1.0);
        self.diagonal.fill(shift);
        self.held.iter().for_each(|&k| self.diagonal[k] += rho);
        self.system.clear_leading();
        self.system.add_leading(STIFFNESS, 1.0, &self.stiffness);
        self.system.add_leading(HESSIAN, 1.0, &self.hessian);
        self.system.add_leading(AUGMENTATION, 1.0, &self.augmented);
        self.system.add_leading(DIAGONAL, 1.0, &self.diagonal);
        if let Some(Border { force_rate, row }) = border {
            for (value, f) in
                self.border.iter_mut().zip(force_rate.iter().map(|f| -f).chain(row.iter().copied()))
            {
                *value = f;
            }
            self.system.add_leading(BORDER, 1.0, &self.border);
        }
        self.system.set_jacobian(&self.jacobian, &self.jacobian);
        self.system.factor().map_err(|source| named(&self.layout, mechanics, source))
    }

    /// The Newton step from the last evaluation: δq over the free coordinates, δp if there is one, δλ.
    pub(crate) fn newton_step(&mut self, mechanics: &dyn Mechanics) -> Result<Step<'_>, TangentError> {
        let (n, m) = (self.unknowns(), self.phi.len());
        let p = usize::from(self.parameter);
        self.force.fill(0.0);
        let jacobian = &self.jacobian[..mechanics.jacobian_pattern().len()];
        self.augmentation.subtract_from(mechanics, jacobian, self.scale(), &self.phi, &mut self.force);
        for ((step, r), &i) in self.step.iter_mut().zip(&self.residual).zip(mechanics.free()) {
            *step = r + self.force[i];
        }
        if self.parameter {
            self.step[n] = 0.0;
        }
        for (rhs, phi) in self.step[n + p..].iter_mut().zip(&self.phi) {
            *rhs = -phi;
        }
        self.step[n + p + m..].fill(0.0);
        self.solve(mechanics)
    }

    /// The step for a right-hand side that is zero but for the arclength row: the tangent of a path.
    pub(crate) fn tangent_step(&mut self, mechanics: &dyn Mechanics) -> Result<Step<'_>, TangentError> {
        let n = self.unknowns();
        self.step.fill(0.0);
        self.step[n] = 1.0;
        self.solve(mechanics)
    }

    fn solve(&mut self, mechanics: &dyn Mechanics) -> Result<Step<'_>, TangentError> {
        let result = self.system.solve(&mut self.step);
        result.map_err(|source| named(&self.layout, mechanics, source))?;
        let (n, m) = (self.unknowns(), self.phi.len());
        let (q, rest) = self.step.split_at(n);
        let (p, rest) = rest.split_at(usize::from(self.parameter));
        Ok(Step { q, p: p.first().copied().unwrap_or(0.0), lambda: &rest[..m] })
    }

    /// Largest sum of the terms |K_ij q_j| of a force \[N\] where the matrix was factored: what coordinates' rounding acts on.
    pub(crate) fn force_terms(&self, mechanics: &dyn Mechanics, q: &[f64]) -> f64 {
        let mut sums = vec![0.0; q.len()];
        for (&(r, c), k) in mechanics.stiffness_pattern().iter().zip(&self.stiffness) {
            sums[r] += (k * q[c]).abs();
        }
        for (e, k) in mechanics.constraint_hessian().iter().zip(&self.hessian) {
            sums[e.row] += (k * q[e.col]).abs();
        }
        sums.into_iter().fold(0.0, f64::max)
    }

    /// ϱ: the size of the stiffness; one where all cables are slack.
    pub(crate) fn scale(&self) -> f64 {
        let largest = self.stiffness.iter().fold(0.0_f64, |a, k| a.max(k.abs()));
        if largest > 0.0 { largest } else { 1.0 }
    }
}

/// A step of the system's unknowns.
pub(crate) struct Step<'a> {
    pub(crate) q: &'a [f64],
    pub(crate) p: f64,
    pub(crate) lambda: &'a [f64],
}

fn named(layout: &Layout, mechanics: &dyn Mechanics, source: SparseError) -> TangentError {
    let culprit = match source.row() {
        Some(tg_sparse::Row::Unknown(k)) if k >= layout.unknowns() => "the parameter".into(),
        Some(tg_sparse::Row::Multiplier(j)) if j >= mechanics.sizes().constraints => "the gauge".into(),
        _ => layout.name(mechanics, &source),
    };
    TangentError::Sparse { doing: "solving for equilibrium", culprit, source }
}
