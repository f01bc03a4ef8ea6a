//! Dynamic relaxation with kinetic damping (Barnes): the fallback for far starts and slack structures.
//!
//! ```text
//! [D -Aᵀ] [v']   [D v + F]           q ← q + v', projected onto Φ = 0;   D ≥ ½ Σ_j |K_ij| keeps unit steps stable
//! [A   0 ] [· ] = [0      ]
//! ```
//! A fictitious motion with fictitious masses D. Whenever its kinetic energy has passed a peak, the structure is stopped:
//! the energy falls from stop to stop until the motion dies out at a minimum.

use tg_model::{At, Layout, Tensioned};
use tg_sparse::SaddleSystem;
use tg_tangent::TangentError;

/// Steps after which masses are renewed.
const RENEW: u32 = 50;
/// Smallest fictitious mass per largest: a coordinate without cables must not fly off.
const LIGHTEST: f64 = 1e-2;
/// Corrections of the positions per step.
const CORRECTIONS: u32 = 2;

pub(crate) struct Relaxation<'s> {
    structure: &'s dyn Tensioned,
    layout: Layout,
    system: SaddleSystem,
    masses: Vec<f64>,
    v: Vec<f64>,
    energy: f64,
    pub(crate) steps: u32,
    pub(crate) stops: u32,
}

impl<'s> Relaxation<'s> {
    pub(crate) fn new(structure: &'s dyn Tensioned) -> Result<Self, TangentError> {
        let mechanics = structure.mechanics();
        let layout = Layout::new(mechanics);
        let diagonal: Vec<_> = mechanics.free().iter().map(|&i| (i, i)).collect();
        let pattern = layout.saddle(mechanics, &[&diagonal]).map_err(|source| {
            TangentError::sparse("preparing dynamic relaxation", &layout, mechanics, source)
        })?;
        let n = layout.unknowns();
        Ok(Self {
            structure,
            system: SaddleSystem::new(pattern),
            masses: vec![1.0; n],
            v: vec![0.0; n],
            energy: 0.0,
            steps: 0,
            stops: 0,
            layout,
        })
    }

    /// Runs until the residual force is below `target` of the largest force, after at least `stops` stops in all, or for at
    /// most `most` steps; whether it got there.
    pub(crate) fn run(
        &mut self,
        q: &mut [f64],
        u: &[f64],
        target: f64,
        stops: u32,
        most: u32,
    ) -> Result<bool, TangentError> {
        let mechanics = self.structure.mechanics();
        let n = self.layout.unknowns();
        let rest = vec![0.0; q.len()];
        let mut force = rest.clone();
        let mut jacobian = vec![0.0; mechanics.jacobian_pattern().len()];
        let mut phi = vec![0.0; mechanics.sizes().constraints];
        let mut x = vec![0.0; self.system.pattern().size()];
        self.v.fill(0.0);
        self.energy = 0.0;
        for step in 0..most {
            if step % RENEW == 0 {
                self.renew(q, u);
            }
            self.steps += 1;
            let at = At { q, v: &rest, u, taut: None };
            mechanics.force(at, &mut force);
            let scale = mechanics.force_scale(at).max(f64::MIN_POSITIVE);
            self.factor(q, &mut jacobian)?;
            for (k, &i) in mechanics.free().iter().enumerate() {
                x[k] = self.masses[k] * self.v[k] + force[i];
            }
            x[n..].fill(0.0);
            self.solve(&mut x)?;
            // D (v' - v) is the force that no constraint balances.
            let change = (0..n).map(|k| self.masses[k] * (x[k] - self.v[k]).abs());
            let unbalanced = change.fold(0.0_f64, f64::max);
            self.v.copy_from_slice(&x[..n]);
            let energy: f64 = self.v.iter().zip(&self.masses).map(|(v, m)| m * v * v).sum();
            if energy < self.energy {
                // Stopped at the peak; at rest the unbalanced force is the residual.
                self.v.fill(0.0);
                self.energy = 0.0;
                self.stops += 1;
                continue;
            }
            if self.energy == 0.0 && unbalanced <= target * scale && self.stops >= stops {
                return Ok(true);
            }
            self.energy = energy;
            mechanics.free().iter().zip(&self.v).for_each(|(&i, v)| q[i] += v);
            for _ in 0..CORRECTIONS {
                self.factor(q, &mut jacobian)?;
                mechanics.constraints(q, &mut phi);
                x[..n].fill(0.0);
                x[n..].iter_mut().zip(&phi).for_each(|(x, phi)| *x = -phi);
                self.solve(&mut x)?;
                mechanics.free().iter().zip(&x).for_each(|(&i, d)| q[i] += d);
            }
        }
        Ok(false)
    }

    /// Fictitious masses from the rows of K, every cable taken as taut.
    fn renew(&mut self, q: &[f64], u: &[f64]) {
        let mechanics = self.structure.mechanics();
        let rest = vec![0.0; q.len()];
        let taut = vec![true; mechanics.sizes().switches];
        let mut stiffness = vec![0.0; mechanics.stiffness_pattern().len()];
        mechanics.stiffness(At { q, v: &rest, u, taut: Some(&taut) }, &mut stiffness);
        self.masses.fill(0.0);
        for (&(r, c), k) in mechanics.stiffness_pattern().iter().zip(&stiffness) {
            if let (Some(r), Some(_)) = (self.layout.unknown(r), self.layout.unknown(c)) {
                self.masses[r] += k.abs();
            }
        }
        let heaviest = self.masses.iter().fold(0.0_f64, |a, &m| a.max(m)).max(f64::MIN_POSITIVE);
        self.masses.iter_mut().for_each(|m| *m = m.max(LIGHTEST * heaviest));
        self.system.clear_leading();
        self.system.add_leading(0, 1.0, &self.masses);
    }

    fn factor(&mut self, q: &[f64], jacobian: &mut [f64]) -> Result<(), TangentError> {
        self.structure.mechanics().jacobian(q, jacobian);
        self.system.set_jacobian(jacobian, jacobian);
        let result = self.system.factor();
        self.named(result)
    }

    fn solve(&mut self, x: &mut [f64]) -> Result<(), TangentError> {
        let result = self.system.solve(x).map(drop);
        self.named(result)
    }

    fn named(&self, result: Result<(), tg_sparse::SparseError>) -> Result<(), TangentError> {
        let mechanics = self.structure.mechanics();
        result.map_err(|source| TangentError::sparse("relaxing", &self.layout, mechanics, source))
    }
}
