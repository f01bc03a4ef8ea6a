//! Linear systems with the stiffness or the mass matrix under the constraints.

use tg_model::Mechanics;

use crate::configuration::Configuration;
use crate::error::TangentError;
use crate::shift_invert::ShiftInvert;
use crate::spectrum::Metric;

/// Factors of `[X, -Aᵀ; A, 0]` at a configuration, sparse, X = K of (41) or X = M.
///
/// ```text
/// X x - Aᵀ y = b,   A x = g
/// ```
/// With g = 0 the solution is `x = N (Nᵀ X N)⁻¹ Nᵀ b`.
pub struct Constrained<'m> {
    factors: ShiftInvert<'m>,
    constraints: usize,
}

impl<'m> Constrained<'m> {
    /// X = K, the tangent stiffness with the multiplier term. Regular where no motion that the constraints allow is free
    /// of stiffness; ask [`crate::lowest`] for the number of zero eigenvalues before trusting a solution.
    ///
    /// # Errors
    /// No factorisation.
    pub fn stiffness(mechanics: &'m dyn Mechanics, at: &Configuration) -> Result<Self, TangentError> {
        let mut factors = ShiftInvert::new(mechanics, at, Metric::Coordinates)?;
        factors.factor_shifted(0.0)?;
        Ok(Self { factors, constraints: mechanics.sizes().constraints })
    }

    /// X = M.
    ///
    /// # Errors
    /// No factorisation.
    pub fn mass(mechanics: &'m dyn Mechanics, at: &Configuration) -> Result<Self, TangentError> {
        let mut factors = ShiftInvert::new(mechanics, at, Metric::Mass)?;
        factors.factor_metric()?;
        Ok(Self { factors, constraints: mechanics.sizes().constraints })
    }

    /// x over the free coordinates, from b over them and g over the constraints.
    ///
    /// # Errors
    /// The solution leaves a residual: the matrix is singular.
    pub fn solve(&mut self, b: &[f64], g: &[f64]) -> Result<Vec<f64>, TangentError> {
        debug_assert_eq!(g.len(), self.constraints);
        let mut x = vec![0.0; b.len()];
        self.factors.solve_constrained(b, g, &mut x)?;
        Ok(x)
    }
}
