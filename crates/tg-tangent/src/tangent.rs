//! Tangent matrices over the free coordinates.
//!
//! ```text
//! K = -∂F/∂q - Σ_j λ_j ∂²Φ_j/∂q²,   C = -∂F/∂q̇,   A = ∂Φ/∂q,   M           (41)
//! ```

use tg_model::{At, Layout, Mechanics};

use crate::configuration::Configuration;
use crate::entries::Entries;

/// The tangent of a structure at a configuration, sparse.
#[derive(Clone)]
pub struct Tangent<'m> {
    mechanics: &'m dyn Mechanics,
    /// K \[N/m\], symmetric where forces have a potential.
    pub stiffness: Entries,
    /// C \[N s/m\], empty without damping.
    pub damping: Entries,
    /// M \[kg\].
    pub mass: Entries,
    /// A, constraints by free coordinates.
    pub jacobian: Entries,
}

impl<'m> Tangent<'m> {
    /// Evaluates the tangent; slack cables contribute nothing.
    pub fn new(mechanics: &'m dyn Mechanics, at: &Configuration) -> Self {
        let layout = Layout::new(mechanics);
        let (n, sizes) = (layout.unknowns(), mechanics.sizes());
        let rest = vec![0.0; sizes.coordinates];
        let place = At { q: &at.q, v: &rest, u: &at.u, taut: None };
        let square = |pattern: &[(usize, usize)], values: &[f64]| -> Vec<_> {
            let places = pattern.iter().map(|&(r, c)| (layout.unknown(r), layout.unknown(c)));
            places.zip(values).map(|((r, c), &value)| (r, c, value)).collect()
        };
        let mut values = vec![0.0; mechanics.stiffness_pattern().len()];
        mechanics.stiffness(place, &mut values);
        let mut stiffness = square(mechanics.stiffness_pattern(), &values);
        stiffness.extend(
            mechanics
                .constraint_hessian()
                .iter()
                .map(|e| (layout.unknown(e.row), layout.unknown(e.col), -at.lambda[e.constraint] * e.value)),
        );
        values.resize(mechanics.damping_pattern().len(), 0.0);
        mechanics.damping(place, &mut values);
        let damping = square(mechanics.damping_pattern(), &values);
        let mass = mechanics.mass().iter().map(|e| (layout.unknown(e.row), layout.unknown(e.col), e.value));
        let mut values = vec![0.0; mechanics.jacobian_pattern().len()];
        mechanics.jacobian(&at.q, &mut values);
        let jacobian = mechanics
            .jacobian_pattern()
            .iter()
            .zip(values)
            .map(|(&(j, i), a)| (Some(j), layout.unknown(i), a));
        Self {
            mechanics,
            stiffness: Entries::new(n, n, stiffness),
            damping: Entries::new(n, n, damping),
            mass: Entries::new(n, n, mass),
            jacobian: Entries::new(sizes.constraints, n, jacobian),
        }
    }

    /// The system that this is the tangent of.
    pub fn mechanics(&self) -> &'m dyn Mechanics {
        self.mechanics
    }

    /// Number of free coordinates.
    pub fn unknowns(&self) -> usize {
        self.mechanics.free().len()
    }

    /// A vector over the free coordinates as one over all, zero at the prescribed ones.
    pub fn full(&self, free: &[f64]) -> Vec<f64> {
        let mut full = vec![0.0; self.mechanics.sizes().coordinates];
        for (&i, x) in self.mechanics.free().iter().zip(free) {
            full[i] = *x;
        }
        full
    }
}
