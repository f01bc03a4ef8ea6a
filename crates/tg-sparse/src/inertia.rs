//! Signs of eigenvalues from signs of pivots (Sylvester's law of inertia).
//!
//! With symmetric `H` and `A₀ = A₁ = A`, `diag(I, −I) K = [H, −Aᵀ; −A, 0]` is symmetric, its factors in the same order are
//! those of `K` with the multipliers' pivots negated, and for A of full rank
//!
//! ```text
//! inertia [H, −Aᵀ; −A, 0] = inertia (Nᵀ H N) + (m, m, 0),   A N = 0.
//! ```

use crate::pattern::SaddlePattern;

/// Numbers of eigenvalues of `H` restricted to the null space of `A`, by sign. A zero eigenvalue makes the system
/// singular and is no inertia's matter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inertia {
    /// Negative eigenvalues.
    pub negative: usize,
    /// Positive eigenvalues.
    pub positive: usize,
}

/// Inertia from reciprocal pivots in elimination order; `None` if they cannot be those of a symmetric system of full
/// rank.
pub(crate) fn from_pivots(pattern: &SaddlePattern, inverse: &[f64]) -> Option<Inertia> {
    let order = &pattern.symbolic.order;
    let is_negative =
        |(&variable, &inverse): (&u32, &f64)| (inverse < 0.0) == ((variable as usize) < pattern.n);
    let all = order.iter().zip(inverse).filter(|&pair| is_negative(pair)).count();
    let negative = all.checked_sub(pattern.m)?;
    let positive = pattern.n.checked_sub(pattern.m + negative)?;
    Some(Inertia { negative, positive })
}
