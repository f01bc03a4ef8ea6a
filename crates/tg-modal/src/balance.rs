//! Whether a configuration is an equilibrium that (41) may be linearised about.

use tg_model::Mechanics;
use tg_tangent::Configuration;

use crate::error::ModalError;

/// Refuses coordinates that violate a constraint, and forces that do not balance.
pub(crate) fn check(mechanics: &dyn Mechanics, at: &Configuration, tolerance: f64) -> Result<(), ModalError> {
    let mut phi = vec![0.0; mechanics.sizes().constraints];
    mechanics.constraints(&at.q, &mut phi);
    for (j, (phi, scale)) in phi.iter().zip(mechanics.constraint_scales()).enumerate() {
        let residual = phi.abs() / scale;
        if residual > tolerance || residual.is_nan() {
            return Err(ModalError::Inconsistent {
                constraint: mechanics.constraint_name(j),
                residual,
                tolerance,
            });
        }
    }
    let (imbalance, k) = at.imbalance();
    if imbalance > tolerance || imbalance.is_nan() {
        let coordinate = mechanics.coordinate_name(mechanics.free()[k]);
        return Err(ModalError::NotInEquilibrium { coordinate, imbalance, tolerance });
    }
    Ok(())
}

/// Refuses a vector of the wrong length.
pub(crate) fn check_length(what: &'static str, x: &[f64], expected: usize) -> Result<(), ModalError> {
    if x.len() == expected { Ok(()) } else { Err(ModalError::Length { what, got: x.len(), expected }) }
}

/// Refuses an index out of range.
pub(crate) fn check_index(what: &'static str, index: usize, count: usize) -> Result<(), ModalError> {
    if index < count { Ok(()) } else { Err(ModalError::NoSuch { what, index, count }) }
}
