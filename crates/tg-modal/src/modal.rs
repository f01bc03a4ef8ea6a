//! The structure in its undamped modes.

use tg_model::Mechanics;
use tg_tangent::faer::{Mat, c64};
use tg_tangent::{Configuration, Tangent};

use crate::balance::check_length;
use crate::error::ModalError;
use crate::modes::{ModeKind, Modes};
use crate::shape;

/// (42) in undamped modes: mass I, stiffness diagonal.
pub(crate) struct Modal {
    /// Ω², exactly zero where a mode counts as zero \[1/s²\].
    pub(crate) stiffness: Vec<f64>,
    /// Xᵀ𝓒X \[1/s\].
    pub(crate) damping: Mat<f64>,
    largest_damping: f64,
    largest_stiffness: f64,
}

impl Modal {
    pub(crate) fn new(
        mechanics: &dyn Mechanics,
        at: &Configuration,
        modes: &Modes,
    ) -> Result<Self, ModalError> {
        let coordinates = mechanics.sizes().coordinates;
        check_length("configuration", &at.q, coordinates)?;
        modes.list.iter().try_for_each(|mode| check_length("mode shape", &mode.shape, coordinates))?;
        let k = modes.list.len();
        let mut damping = Mat::zeros(k, k);
        if mechanics.features().damping {
            let tangent = Tangent::new(mechanics, at);
            let free = |shape: &[f64]| mechanics.free().iter().map(|&i| shape[i]).collect::<Vec<_>>();
            let shapes: Vec<Vec<f64>> = modes.list.iter().map(|mode| free(&mode.shape)).collect();
            for (c, x) in shapes.iter().enumerate() {
                let mut product = vec![0.0; tangent.unknowns()];
                tangent.damping.add_product(1.0, x, &mut product);
                shapes.iter().enumerate().for_each(|(r, y)| damping[(r, c)] = shape::dot(y, &product));
            }
        }
        let stiffness: Vec<f64> = modes
            .list
            .iter()
            .map(|mode| if mode.kind == ModeKind::Zero { 0.0 } else { mode.omega_squared })
            .collect();
        let largest_stiffness = stiffness.iter().fold(0.0_f64, |a, v| a.max(v.abs()));
        let largest_damping = damping.norm_l2();
        Ok(Self { stiffness, damping, largest_damping, largest_stiffness })
    }

    /// w for each mode; small for a zero mode, whose double eigenvalue it keeps from spreading.
    pub(crate) fn scales(&self, zero_limit: f64) -> Vec<f64> {
        let scale = |&stiffness: &f64| {
            let size = if stiffness == 0.0 { zero_limit } else { stiffness.abs() };
            if size > 0.0 { size.sqrt() } else { 1.0 }
        };
        self.stiffness.iter().map(scale).collect()
    }

    /// The matrix of d/dt \[w η; η̇\].
    pub(crate) fn first_order(&self, w: &[f64]) -> Mat<f64> {
        let k = w.len();
        let mut a = Mat::zeros(2 * k, 2 * k);
        for r in 0..k {
            a[(r, r + k)] = w[r];
            a[(r + k, r)] = -self.stiffness[r] / w[r];
            (0..k).for_each(|c| a[(r + k, c + k)] = -self.damping[(r, c)]);
        }
        a
    }

    /// Normwise backward error of an eigenpair of (42).
    pub(crate) fn residual(&self, s: c64, eta: &[c64]) -> f64 {
        let norm = |x: &mut dyn Iterator<Item = c64>| x.map(|x| x.norm_sqr()).sum::<f64>().sqrt();
        let k = eta.len();
        let row = |r: usize| {
            let damping: c64 = (0..k).map(|c| eta[c] * self.damping[(r, c)]).sum();
            eta[r] * (s * s + self.stiffness[r]) + s * damping
        };
        let size = s.norm_sqr() + s.norm() * self.largest_damping + self.largest_stiffness;
        let left = norm(&mut (0..k).map(row));
        if left == 0.0 && size == 0.0 { 0.0 } else { left / (size * norm(&mut eta.iter().copied())) }
    }

    /// φ over the full coordinates, φᴴ M φ = 1.
    pub(crate) fn shape(&self, modes: &Modes, eta: &[c64]) -> Vec<c64> {
        let norm = eta.iter().map(|x| x.norm_sqr()).sum::<f64>().sqrt();
        let coordinates = modes.list.first().map_or(0, |mode| mode.shape.len());
        let mut shape = vec![c64::new(0.0, 0.0); coordinates];
        for (mode, eta) in modes.list.iter().zip(eta) {
            shape.iter_mut().zip(&mode.shape).for_each(|(x, phi)| *x += eta / norm * phi);
        }
        shape::orient_complex(&mut shape);
        shape
    }
}
