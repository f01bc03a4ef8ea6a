//! Singular values of at most three D-vectors, by one-sided Jacobi rotations.
//!
//! ```text
//! A = [a_1 … a_k] = U diag(σ) Vᵀ,   σ_1 ≥ … ≥ σ_k ≥ 0
//! ```
//!
//! Written here because nalgebra's decompositions need type bounds that a generic `const D` cannot
//! state without spreading through every signature, and because its 3 × 3 case goes through AᵀA.
//! Nothing is allocated, and small singular values keep their relative accuracy.

use nalgebra::SVector;

use crate::coord_type::MAX_SPAN;

/// Columns beyond `count` are zero.
pub(crate) struct Svd<const D: usize> {
    /// Column j of U; zero where σ_j = 0.
    pub(crate) left: [SVector<f64, D>; MAX_SPAN],
    /// σ_j, descending.
    pub(crate) values: [f64; MAX_SPAN],
    /// Column j of V.
    pub(crate) right: [[f64; MAX_SPAN]; MAX_SPAN],
    /// k, the number of columns.
    pub(crate) count: usize,
}

impl<const D: usize> Svd<D> {
    /// Decomposes the first `count` columns; they must be finite.
    pub(crate) fn new(columns: &[SVector<f64, D>; MAX_SPAN], count: usize) -> Self {
        // Scaling keeps the squares below from overflow and underflow.
        let size = columns[..count].iter().map(SVector::amax).fold(0.0, f64::max);
        let unit = if size > 0.0 { size } else { 1.0 };
        let mut a = *columns;
        let mut v = [[0.0; MAX_SPAN]; MAX_SPAN];
        for j in 0..count {
            a[j] /= unit;
            v[j][j] = 1.0;
        }
        // Convergence is quadratic: five or six sweeps; the bound only guards against a rounding cycle.
        for _ in 0..40 {
            let mut rotated = false;
            for p in 0..count {
                for q in p + 1..count {
                    let (alpha, beta) = (a[p].norm_squared(), a[q].norm_squared());
                    let gamma = a[p].dot(&a[q]);
                    if gamma.abs() <= f64::EPSILON * (alpha * beta).sqrt() {
                        continue;
                    }
                    rotated = true;
                    let zeta = (beta - alpha) / (2.0 * gamma);
                    let t = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
                    let c = 1.0 / t.hypot(1.0);
                    let s = c * t;
                    (a[p], a[q]) = (a[p] * c - a[q] * s, a[p] * s + a[q] * c);
                    for k in 0..count {
                        (v[p][k], v[q][k]) = (v[p][k] * c - v[q][k] * s, v[p][k] * s + v[q][k] * c);
                    }
                }
            }
            if !rotated {
                break;
            }
        }
        let mut order = [0, 1, 2];
        order[..count].sort_by(|&i, &j| a[j].norm().total_cmp(&a[i].norm()));
        let mut svd = Self {
            left: [SVector::zeros(); MAX_SPAN],
            values: [0.0; MAX_SPAN],
            right: [[0.0; MAX_SPAN]; MAX_SPAN],
            count,
        };
        for (to, &from) in order[..count].iter().enumerate() {
            let sigma = a[from].norm();
            svd.values[to] = sigma * unit;
            svd.right[to] = v[from];
            if sigma > 0.0 {
                svd.left[to] = a[from] / sigma;
            }
        }
        svd
    }

    /// Condition number σ_1/σ_k: 1 for no columns, infinite for dependent ones.
    pub(crate) fn condition(&self) -> f64 {
        match self.count {
            0 => 1.0,
            k if self.values[k - 1] > 0.0 => self.values[0] / self.values[k - 1],
            _ => f64::INFINITY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    /// Against nalgebra's bidiagonal SVD, and by putting the product together again.
    #[test]
    fn singular_values_and_product_agree_with_a_dense_svd() {
        let cases = [
            [[1.0, 2.0, 3.0], [0.5, -1.0, 2.0], [4.0, 0.1, -0.7]],
            [[1.0, 0.0, 0.0], [1.0, 1e-7, 0.0], [1.0, 0.0, 1e-3]],
            [[1e-200, 0.0, 2e-200], [0.0, 3e-200, 0.0], [1e-200, 0.0, 0.0]],
            [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        ];
        for case in cases {
            for count in 1..=3 {
                let columns = case.map(SVector::<f64, 3>::from);
                let svd = Svd::new(&columns, count);
                let dense = DMatrix::from_fn(3, count, |i, j| columns[j][i]);
                let expected = dense.clone().svd(false, false).singular_values;
                for j in 0..count {
                    assert!((svd.values[j] - expected[j]).abs() <= 1e-14 * expected[0]);
                    for k in 0..count {
                        let unit = f64::from(u8::from(j == k));
                        assert!((svd.left[j].dot(&svd.left[k]) - unit).abs() < 1e-8);
                        let v: f64 = (0..count).map(|i| svd.right[j][i] * svd.right[k][i]).sum();
                        assert!((v - unit).abs() < 1e-14);
                    }
                    for i in 0..3 {
                        let product: f64 =
                            (0..count).map(|k| svd.left[k][i] * svd.values[k] * svd.right[k][j]).sum();
                        assert!((product - dense[(i, j)]).abs() <= 1e-14 * expected[0]);
                    }
                }
            }
        }
    }

    #[test]
    fn small_singular_values_keep_their_digits() {
        // [[1, 1], [0, δ]]: σ_1 σ_2 = δ exactly, σ_1² + σ_2² = 2 + δ².
        let delta = 1e-12;
        let columns = [[1.0, 0.0], [1.0, delta], [0.0, 0.0]].map(SVector::<f64, 2>::from);
        let svd = Svd::new(&columns, 2);
        assert!((svd.values[1] / (delta / 2.0_f64.sqrt()) - 1.0).abs() < 1e-4);
        assert!((svd.condition() / (2.0 / delta) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn dependent_columns_have_an_infinite_or_huge_condition() {
        let columns = [[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [0.0, 0.0, 1.0]].map(SVector::<f64, 3>::from);
        assert!(Svd::new(&columns, 3).condition() > 1e15);
        assert_eq!(Svd::new(&[SVector::<f64, 3>::zeros(); 3], 1).condition(), f64::INFINITY);
        assert_eq!(Svd::new(&[SVector::<f64, 3>::zeros(); 3], 0).condition(), 1.0);
    }
}
