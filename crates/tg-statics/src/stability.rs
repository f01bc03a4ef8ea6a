//! Stability: the inertia of the reduced Hessian, its lowest eigenvalues and their shapes.
//!
//! ```text
//! 𝓚 = Nᵀ(-∂F/∂q - Σ λ_j ∂²Φ_j) N = Hessian of the potential on Φ = 0          (43)
//! ```

use tg_model::Tensioned;
use tg_tangent::{Configuration, Counts, EigenOptions, EigenPair, Metric, TangentError, lowest};

use crate::rigid::RigidMotions;

/// What the Hessian says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Positive definite but for the rigid motions without work: a strict minimum, wherever the structure stands.
    Stable,
    /// No negative eigenvalue, but zeros beyond the rigid motions: mechanisms without stiffness, or a critical point.
    Neutral,
    /// The potential falls in some direction.
    Unstable,
}

/// Stability of an equilibrium.
#[derive(Clone, Debug)]
pub struct Stability {
    /// The verdict.
    pub verdict: Verdict,
    /// Signs of all eigenvalues of the reduced Hessian.
    pub counts: Counts,
    /// Rigid motions of the whole along which no load does work: zeros that mean nothing.
    pub rigid_motions: usize,
    /// Lowest eigenvalues \[N/m\] in the metric of natural coordinates, with shapes over the full coordinates.
    pub lowest: Vec<EigenPair>,
    /// |ν| up to which an eigenvalue counts as zero \[N/m\].
    pub zero_limit: f64,
}

/// Stability of a configuration, with its `count` lowest eigenvalues; dense for small structures, by the inertia of the
/// sparse saddle-point matrix for large ones.
///
/// # Errors
/// No factorisation or no convergence.
pub fn stability(
    structure: &dyn Tensioned,
    at: &Configuration,
    count: usize,
) -> Result<Stability, TangentError> {
    stability_with(structure, at, &EigenOptions::new(count, Metric::Coordinates))
}

/// As [`stability`], with a method and zero limit; the metric may be that of masses.
///
/// # Errors
/// As [`stability`]; massless motions in the metric of masses.
pub fn stability_with(
    structure: &dyn Tensioned,
    at: &Configuration,
    options: &EigenOptions,
) -> Result<Stability, TangentError> {
    let spectrum = lowest(structure.mechanics(), at, options)?;
    let free = RigidMotions::free(structure, &at.q)?;
    let rigid_motions = free.without_work(structure, &at.q, &at.u)?.count();
    let verdict = match spectrum.counts {
        Counts { negative: 1.., .. } => Verdict::Unstable,
        Counts { zero, .. } if zero > rigid_motions => Verdict::Neutral,
        _ => Verdict::Stable,
    };
    Ok(Stability {
        verdict,
        counts: spectrum.counts,
        rigid_motions,
        lowest: spectrum.pairs,
        zero_limit: spectrum.zero_limit,
    })
}
