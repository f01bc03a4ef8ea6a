//! Base excitation: what a motion e·s(t) of the supports does to the structure.
//!
//! ```text
//! δq = r s + N ξ,   r_p = e,   A r = 0
//! 𝓜 ξ̈ + 𝓒 ξ̇ + 𝓚 ξ = -Nᵀ[(M r) s̈ + (C r) ṡ + (K r) s],   rows of the free coordinates
//! ```
//! The influence vector r is the displacement of the whole structure per displacement of the supports, chosen so that
//! Nᵀ(K r) vanishes: a rigid translation where all supports translate together, otherwise the quasi-static response
//! `K_ff r_f - A_fᵀ y = -K_fp e`, `A_f r_f = -A_p e`.

use tg_model::{Mechanics, Tensioned};
use tg_tangent::{Configuration, Constrained, EigenOptions, Metric, lowest};

use crate::balance::{check_index, check_length};
use crate::directional::{self, Along};
use crate::error::ModalError;

/// A motion of the supports with the displacement of the structure that follows it.
#[derive(Clone, Debug, PartialEq)]
pub struct SupportMotion {
    /// Its name.
    pub name: String,
    /// Influence vector r over the full coordinates: δq per s, dimensionless at points where s is a displacement in
    /// metres.
    pub influence: Vec<f64>,
}

impl SupportMotion {
    /// All supports translate together along an axis (0 is x) by s \[m\]; r is the rigid translation.
    ///
    /// Right where forces and constraints do not depend on where the structure is, as cables, joints, weight and constant
    /// loads do not.
    ///
    /// # Errors
    /// The axis does not exist, or `at` has another size.
    pub fn translation(
        structure: &dyn Tensioned,
        at: &Configuration,
        axis: usize,
    ) -> Result<Self, ModalError> {
        check_length("configuration", &at.q, structure.sizes().coordinates)?;
        let mut motions = structure.rigid_motions(&at.q);
        // D translations and D (D - 1)/2 rotations.
        let dimension = (1..).find(|d| d * (d + 1) / 2 >= motions.len()).unwrap_or(0);
        check_index("axis", axis, dimension.min(motions.len()))?;
        let name = format!("ground {}", ["x", "y", "z"].get(axis).unwrap_or(&"?"));
        Ok(Self { name, influence: motions.swap_remove(axis) })
    }

    /// Prescribed coordinates move by given components e per unit of s: `direction` lists (coordinate, component). Those
    /// not listed are at rest, and r is the quasi-static response.
    ///
    /// K_fp e is the derivative of the force along e by extrapolated central differences plus the exact multiplier term;
    /// A_p e is exact. Where all supports move together r is the rigid translation to 5e-14 on the small structures of the
    /// tests, to 1e-6 on one of 12 000 coordinates, whose K spans eleven orders of magnitude.
    ///
    /// # Errors
    /// A coordinate is free or does not exist, nothing moves, a motion has no stiffness, or no factorisation.
    pub fn quasi_static(
        mechanics: &dyn Mechanics,
        at: &Configuration,
        name: &str,
        direction: &[(usize, f64)],
    ) -> Result<Self, ModalError> {
        let sizes = mechanics.sizes();
        check_length("configuration", &at.q, sizes.coordinates)?;
        let mut r = vec![0.0; sizes.coordinates];
        for &(i, component) in direction {
            check_index("coordinate", i, sizes.coordinates)?;
            if mechanics.free().binary_search(&i).is_ok() {
                return Err(ModalError::NotPrescribed { coordinate: mechanics.coordinate_name(i) });
            }
            r[i] += component;
        }
        if r.iter().all(|&e| e == 0.0) {
            return Err(ModalError::NoSupportMoves { name: name.into() });
        }
        let zero = lowest(mechanics, at, &EigenOptions::new(0, Metric::Coordinates))?.counts.zero;
        if zero > 0 {
            return Err(ModalError::NoQuasiStaticResponse { name: name.into(), zero });
        }
        let what = || format!("the force by the support motion \"{name}\"");
        let mut pull = directional::force(mechanics, at, Along::Coordinates(&r), what)?;
        for entry in mechanics.constraint_hessian() {
            pull[entry.row] += at.lambda[entry.constraint] * entry.value * r[entry.col];
        }
        let mut gap = vec![0.0; sizes.constraints];
        let mut jacobian = vec![0.0; mechanics.jacobian_pattern().len()];
        mechanics.jacobian(&at.q, &mut jacobian);
        for (&(row, i), a) in mechanics.jacobian_pattern().iter().zip(&jacobian) {
            gap[row] -= a * r[i];
        }
        let pull: Vec<f64> = mechanics.free().iter().map(|&i| pull[i]).collect();
        let response = Constrained::stiffness(mechanics, at)?.solve(&pull, &gap)?;
        mechanics.free().iter().zip(response).for_each(|(&i, x)| r[i] = x);
        Ok(Self { name: name.into(), influence: r })
    }
}
