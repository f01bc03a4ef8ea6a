//! Small oscillations about the upright tower without gravity: K φ = ω² M φ, φᵀ M φ = 1, with K = -∂Q/∂θ.

use std::array::from_fn;

use nalgebra::{SMatrix, SVector};

use super::mechanics::Mechanics;
use super::{ANGLES, CABLES, Tower, TowerState};
use crate::reference::ReferenceError;
use crate::reference::linkage::Rotations;

/// Square matrix over the angles.
pub type Square = SMatrix<f64, ANGLES, ANGLES>;

/// One mode of the upright tower.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// ω² \[1/s²\].
    pub omega_squared: f64,
    /// φ over the five angles, φᵀ M φ = 1 \[kg^-½ m^-1\].
    pub shape: [f64; ANGLES],
}

impl Tower {
    /// K of the upright tower at rest \[N m\], by central differences of sixth order. The tower is meant without gravity,
    /// which would not let it stand still.
    pub fn stiffness(&self) -> Square {
        let mechanics = Mechanics::new(self);
        let force = |b: usize, d: f64| {
            let mut s = TowerState::default();
            s.theta[b] = d;
            SVector::from(mechanics.force(0.0, &s, &Rotations::new(&s.theta), &[true; CABLES]))
        };
        let d = 5e-3;
        let column = |b: usize| {
            let odd = |k: f64| force(b, k * d) - force(b, -k * d);
            (odd(1.0) * 45.0 - odd(2.0) * 9.0 + odd(3.0)) / (-60.0 * d)
        };
        Square::from_columns(&from_fn::<_, ANGLES, _>(column))
    }

    /// The five modes, ω² ascending.
    ///
    /// # Errors
    /// The mass matrix is not positive definite.
    pub fn modes(&self) -> Result<[Mode; ANGLES], ReferenceError> {
        let upright = Rotations::new(&[0.0; ANGLES]);
        let mass = Square::from(Mechanics::new(self).mass_matrix(&upright)).transpose();
        let l = mass.cholesky().ok_or(ReferenceError::MassMatrix)?.l();
        let inverse = l.try_inverse().ok_or(ReferenceError::MassMatrix)?;
        let k = self.stiffness();
        let eigen = (inverse * ((k + k.transpose()) * 0.5) * inverse.transpose()).symmetric_eigen();
        let shapes = inverse.transpose() * eigen.eigenvectors;
        let mut modes: [Mode; ANGLES] =
            from_fn(|j| Mode { omega_squared: eigen.eigenvalues[j], shape: from_fn(|i| shapes[(i, j)]) });
        modes.sort_by(|a, b| a.omega_squared.total_cmp(&b.omega_squared));
        Ok(modes)
    }
}
