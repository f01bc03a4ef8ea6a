//! A configuration with the multipliers that balance it best.
//!
//! ```text
//! [I -Aᵀ] [r]   [F]
//! [A  0 ] [λ] = [0]:   r = F + Aᵀ λ,   λ = -(A Aᵀ)⁻¹ A F          (31a), below (32)
//! ```
//! r is what no constraint force balances: the residual force.

use tg_model::{At, Layout, Mechanics};
use tg_sparse::SaddleSystem;

use crate::error::TangentError;

/// Coordinates, inputs and multipliers of a structure at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// Full coordinates q.
    pub q: Vec<f64>,
    /// Inputs u: rest lengths \[m\], then the components of loads \[N, N m\].
    pub u: Vec<f64>,
    /// Multipliers λ.
    pub lambda: Vec<f64>,
    /// Residual force r = F + Aᵀ λ on each free coordinate \[N\], zero in equilibrium.
    pub residual: Vec<f64>,
    /// Size of the largest single force \[N\], what r is held against.
    pub force_scale: f64,
}

impl Configuration {
    /// The configuration at full coordinates `q` and inputs `u`, with the multipliers that leave the least residual
    /// force. The constraints are not checked.
    ///
    /// # Errors
    /// Slices of the wrong length, numbers that are not finite, or A has dependent rows.
    pub fn at(mechanics: &dyn Mechanics, q: &[f64], u: &[f64]) -> Result<Self, TangentError> {
        let sizes = mechanics.sizes();
        for (what, found, expected) in
            [("coordinates", q.len(), sizes.coordinates), ("inputs", u.len(), sizes.inputs)]
        {
            if found != expected {
                return Err(TangentError::Length { what, found, expected });
            }
        }
        let rest = vec![0.0; sizes.coordinates];
        let at = At { q, v: &rest, u, taut: None };
        let mut force = rest.clone();
        mechanics.force(at, &mut force);
        for (what, values) in [("the coordinate", q), ("the force", &force)] {
            if let Some(i) = values.iter().position(|x| !x.is_finite()) {
                return Err(TangentError::NotFinite { what, culprit: mechanics.coordinate_name(i) });
            }
        }
        let force: Vec<f64> = mechanics.free().iter().map(|&i| force[i]).collect();
        let (lambda, residual) = balance(mechanics, q, &force)?;
        let force_scale = mechanics.force_scale(at);
        Ok(Self { q: q.to_vec(), u: u.to_vec(), lambda, residual, force_scale })
    }

    /// Largest residual force per largest force, and the place of it among the free coordinates: zero in equilibrium.
    /// Zero too where no force acts at all.
    pub fn imbalance(&self) -> (f64, usize) {
        let worst = |best: (f64, usize), (k, r): (usize, &f64)| {
            if r.abs() <= best.0 || best.0.is_nan() { best } else { (r.abs(), k) }
        };
        let (largest, k) = self.residual.iter().enumerate().fold((0.0, 0), worst);
        (if largest == 0.0 { 0.0 } else { largest / self.force_scale }, k)
    }
}

/// The multipliers λ that balance forces on the free coordinates best, and the residual force F + Aᵀλ.
///
/// # Errors
/// A has dependent rows, or is not finite.
pub fn balance(
    mechanics: &dyn Mechanics,
    q: &[f64],
    force: &[f64],
) -> Result<(Vec<f64>, Vec<f64>), TangentError> {
    let layout = Layout::new(mechanics);
    let named = |source| {
        TangentError::sparse("finding the multipliers of a configuration", &layout, mechanics, source)
    };
    let diagonal: Vec<_> = mechanics.free().iter().map(|&i| (i, i)).collect();
    let mut system = SaddleSystem::new(layout.saddle(mechanics, &[&diagonal]).map_err(named)?);
    let mut jacobian = vec![0.0; mechanics.jacobian_pattern().len()];
    mechanics.jacobian(q, &mut jacobian);
    system.add_leading(0, 1.0, &vec![1.0; diagonal.len()]);
    system.set_jacobian(&jacobian, &jacobian);
    system.factor().map_err(named)?;
    let mut x = force.to_vec();
    x.resize(system.pattern().size(), 0.0);
    system.solve(&mut x).map_err(named)?;
    let lambda = x.split_off(layout.unknowns());
    Ok((lambda, x))
}
