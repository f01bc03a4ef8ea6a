//! The term that makes the leading block of a saddle-point matrix regular in statics.
//!
//! ```text
//! [K + Aᵀ P A, -Aᵀ; A, 0],   P = ϱ diag(1/|a_j|²)
//! ```
//! Cables alone leave K singular: a bar without cables has no stiffness but its constraint. On the null space of A nothing
//! changes, neither solutions nor inertia, but elimination without pivoting meets no zero where K is positive there
//! (Debreu's lemma).

use tg_model::Mechanics;

/// Pattern and values of `Aᵀ P A` for one Jacobian.
#[derive(Clone, Debug)]
pub struct Augmentation {
    /// Entries (row, column) over the full coordinates.
    pub pattern: Vec<(usize, usize)>,
    /// For each entry its constraint and the two entries of A.
    factors: Vec<(u32, u32, u32)>,
    norms: Vec<f64>,
    is_free: Vec<bool>,
}

impl Augmentation {
    /// The pattern for a system.
    pub fn new(mechanics: &dyn Mechanics) -> Self {
        let mut is_free = vec![false; mechanics.sizes().coordinates];
        mechanics.free().iter().for_each(|&i| is_free[i] = true);
        let mut rows = vec![Vec::new(); mechanics.sizes().constraints];
        for (k, &(row, i)) in mechanics.jacobian_pattern().iter().enumerate() {
            if is_free[i] {
                rows[row].push((k as u32, i));
            }
        }
        let (mut pattern, mut factors) = (Vec::new(), Vec::new());
        for (row, entries) in rows.iter().enumerate() {
            for &(a, i) in entries {
                for &(b, j) in entries {
                    pattern.push((i, j));
                    factors.push((row as u32, a, b));
                }
            }
        }
        Self { pattern, factors, norms: vec![0.0; rows.len()], is_free }
    }

    /// `out -= Aᵀ P Φ` over the full coordinates, with the norms of the last [`Augmentation::values`]: what the augmented
    /// system's right-hand side needs so that `A δq = -Φ` gives the same solution.
    pub fn subtract_from(
        &self,
        mechanics: &dyn Mechanics,
        jacobian: &[f64],
        rho: f64,
        phi: &[f64],
        out: &mut [f64],
    ) {
        for (&(row, i), a) in mechanics.jacobian_pattern().iter().zip(jacobian) {
            if self.is_free[i] {
                out[i] -= rho * a * phi[row] / self.norms[row].max(f64::MIN_POSITIVE);
            }
        }
    }

    /// Values of `Aᵀ P A` in the order of the pattern, given those of A and ϱ.
    pub fn values(&mut self, mechanics: &dyn Mechanics, jacobian: &[f64], rho: f64, values: &mut Vec<f64>) {
        self.norms.fill(0.0);
        for (&(row, i), a) in mechanics.jacobian_pattern().iter().zip(jacobian) {
            if self.is_free[i] {
                self.norms[row] += a * a;
            }
        }
        values.clear();
        values.extend(self.factors.iter().map(|&(row, a, b)| {
            rho * jacobian[a as usize] * jacobian[b as usize]
                / self.norms[row as usize].max(f64::MIN_POSITIVE)
        }));
    }
}
