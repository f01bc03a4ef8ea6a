//! The null space of the constraints' Jacobian: A N = 0, NᵀN = I (Sec. 4).

use faer::Mat;

use crate::dense;
use crate::error::TangentError;
use crate::tangent::Tangent;

/// Singular values below this part of the largest, rows scaled to length one, count as zero.
const RANK_TOLERANCE: f64 = 1e-10;

/// An orthonormal basis of the motions that the constraints allow.
#[derive(Clone, Debug)]
pub struct NullSpace {
    /// N, free coordinates by degrees of freedom, orthonormal columns.
    pub basis: Mat<f64>,
    /// Rank of A.
    pub rank: usize,
    /// Singular values of A with rows of length one, descending; the gap behind the rank-th tells how sure the rank is.
    pub singular_values: Vec<f64>,
}

impl NullSpace {
    /// The basis by a singular value decomposition of A.
    ///
    /// # Errors
    /// The decomposition does not converge.
    pub fn new(tangent: &Tangent<'_>) -> Result<Self, TangentError> {
        let n = tangent.unknowns();
        let mut a = tangent.jacobian.dense();
        for row in 0..a.nrows() {
            let norm = (0..n).map(|k| a[(row, k)] * a[(row, k)]).sum::<f64>().sqrt();
            if norm > 0.0 {
                (0..n).for_each(|k| a[(row, k)] /= norm);
            }
        }
        if a.nrows() == 0 {
            return Ok(Self { basis: Mat::identity(n, n), rank: 0, singular_values: Vec::new() });
        }
        let svd = dense::svd(&a)?;
        let limit = RANK_TOLERANCE * svd.values[0];
        let rank = svd.values.iter().filter(|&&s| s > limit).count();
        let basis = svd.right.subcols(rank, n - rank).to_owned();
        Ok(Self { basis, rank, singular_values: svd.values })
    }
}
