//! How much each mode takes part in a motion of the supports.
//!
//! ```text
//! Γ_r = φ_rᵀ (M r)_f,   m_r = Γ_r²,   Σ_all m_r = vᵀ 𝓜⁻¹ v,   v = Nᵀ (M r)_f
//! ```

use tg_model::Mechanics;
use tg_tangent::{Configuration, Constrained};

use crate::balance::check_length;
use crate::error::ModalError;
use crate::ground::SupportMotion;
use crate::modes::Modes;
use crate::shape::{dot, mass_product};

/// The part of one mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Participation {
    /// Participation factor Γ \[kg^½\], with the sign of the shape: the modal coordinate obeys
    /// `ξ̈ + … + ω² ξ = -Γ s̈`.
    pub factor: f64,
    /// Effective modal mass Γ² \[kg\].
    pub effective_mass: f64,
    /// Part of [`ParticipationReport::total`] that this mode and those before it carry, 1 after the last of all modes;
    /// 0 where the total is zero.
    pub cumulative: f64,
}

/// The parts of all listed modes.
#[derive(Clone, Debug, PartialEq)]
pub struct ParticipationReport {
    /// One for each listed mode, in their order.
    pub list: Vec<Participation>,
    /// Effective mass of all modes together, listed or not \[kg\]; found without them.
    pub total: f64,
    /// rᵀ M r over the full coordinates \[kg\]: for a translation the mass of the structure. It exceeds the total by what
    /// moves with the supports alone.
    pub rigid_mass: f64,
}

/// Participation factors and effective masses of modes in a support motion.
///
/// # Errors
/// The motion is of another structure, or the mass matrix cannot be factored.
pub fn participation(
    mechanics: &dyn Mechanics,
    at: &Configuration,
    modes: &Modes,
    motion: &SupportMotion,
) -> Result<ParticipationReport, ModalError> {
    check_length("influence vector", &motion.influence, mechanics.sizes().coordinates)?;
    modes
        .list
        .iter()
        .try_for_each(|mode| check_length("mode shape", &mode.shape, mechanics.sizes().coordinates))?;
    let momentum = mass_product(mechanics, &motion.influence);
    let free: Vec<f64> = mechanics.free().iter().map(|&i| momentum[i]).collect();
    let response =
        Constrained::mass(mechanics, at)?.solve(&free, &vec![0.0; mechanics.sizes().constraints])?;
    let total = dot(&free, &response);
    let mut carried = 0.0;
    let list = modes.list.iter().map(|mode| {
        // Shapes are zero at prescribed coordinates.
        let factor = dot(&mode.shape, &momentum);
        let effective_mass = factor * factor;
        carried += effective_mass;
        let cumulative = if total > 0.0 { carried / total } else { 0.0 };
        Participation { factor, effective_mass, cumulative }
    });
    let list = list.collect();
    Ok(ParticipationReport { list, total, rigid_mass: dot(&motion.influence, &momentum) })
}
