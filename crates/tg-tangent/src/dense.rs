//! Dense decompositions, from faer, with the project's errors.

use faer::{Mat, Side, c64};

use crate::error::TangentError;

/// X = U Σ Vᵀ.
#[derive(Clone, Debug)]
pub struct Svd {
    /// U, square.
    pub left: Mat<f64>,
    /// Singular values, descending.
    pub values: Vec<f64>,
    /// V, square.
    pub right: Mat<f64>,
}

/// Singular value decomposition with square U and V.
///
/// # Errors
/// It does not converge.
pub fn svd(x: &Mat<f64>) -> Result<Svd, TangentError> {
    let svd = x.svd().map_err(|_| TangentError::Dense { what: "singular value decomposition" })?;
    Ok(Svd {
        left: svd.U().to_owned(),
        values: svd.S().column_vector().iter().copied().collect(),
        right: svd.V().to_owned(),
    })
}

/// Singular values, descending, and V (columns in the same order): n × k and k for k = min(rows, columns = n). For tall
/// matrices, whose square U would not fit.
///
/// # Errors
/// It does not converge.
pub fn right_svd(x: &Mat<f64>) -> Result<RealEigen, TangentError> {
    let svd = x.thin_svd().map_err(|_| TangentError::Dense { what: "singular value decomposition" })?;
    Ok((svd.S().column_vector().iter().copied().collect(), svd.V().to_owned()))
}

/// Real eigenvalues, ascending, and eigenvectors (columns).
pub type RealEigen = (Vec<f64>, Mat<f64>);

/// Eigenvalues, ascending, and orthonormal eigenvectors (columns) of a symmetric matrix, whose upper and lower halves
/// are averaged.
///
/// # Errors
/// The decomposition does not converge.
pub fn symmetric_eigen(x: &Mat<f64>) -> Result<RealEigen, TangentError> {
    // faer's sizes underflow at zero.
    if x.nrows() == 0 {
        return Ok((Vec::new(), Mat::new()));
    }
    let symmetric = Mat::from_fn(x.nrows(), x.ncols(), |r, c| 0.5 * (x[(r, c)] + x[(c, r)]));
    let eigen = symmetric
        .self_adjoint_eigen(Side::Lower)
        .map_err(|_| TangentError::Dense { what: "symmetric eigendecomposition" })?;
    Ok((eigen.S().column_vector().iter().copied().collect(), eigen.U().to_owned()))
}

/// Eigenvalues and eigenvectors (columns) of a general matrix; conjugate eigenvalues are conjugate to the last bit, and
/// real ones have no imaginary part.
///
/// # Errors
/// The decomposition does not converge.
pub fn eigen(x: &Mat<f64>) -> Result<(Vec<c64>, Mat<c64>), TangentError> {
    const WHAT: TangentError = TangentError::Dense { what: "eigendecomposition" };
    if x.nrows() == 0 {
        return Ok((Vec::new(), Mat::new()));
    }
    let real = x.eigenvalues().map_err(|_| WHAT)?;
    // faer 0.24's vectors of a real matrix leave residuals up to 1e-2 where pairs repeat; those of the same matrix taken
    // as complex do not.
    let complex = Mat::from_fn(x.nrows(), x.ncols(), |r, c| c64::new(x[(r, c)], 0.0));
    let eigen = complex.eigen().map_err(|_| WHAT)?;
    let mut left: Vec<(usize, c64)> = eigen.S().column_vector().iter().copied().enumerate().collect();
    let mut columns = Vec::with_capacity(real.len());
    for value in &real {
        let distance = |k: &usize| (left[*k].1 - value).norm();
        let Some(nearest) = (0..left.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))) else {
            return Err(WHAT);
        };
        columns.push(left.swap_remove(nearest).0);
    }
    let vectors = eigen.U();
    Ok((real, Mat::from_fn(x.nrows(), x.ncols(), |r, c| vectors[(r, columns[c])])))
}

/// Eigenvalues, ascending, and W-orthonormal eigenvectors of `K x = ν W x`, K and W symmetric; `None` if W is not
/// positive definite.
///
/// # Errors
/// The decomposition does not converge.
pub fn generalized_eigen(k: &Mat<f64>, w: &Mat<f64>) -> Result<Option<RealEigen>, TangentError> {
    // Far enough from singular that the reduction keeps half of the digits.
    const DEFINITE: f64 = 1e-14;
    let Ok(cholesky) = w.llt(Side::Lower) else { return Ok(None) };
    let l = cholesky.L().to_owned();
    let pivots = (0..l.nrows()).map(|i| l[(i, i)] * l[(i, i)]);
    let (low, high) = pivots.fold((f64::INFINITY, 0.0_f64), |(low, high), p| (low.min(p), high.max(p)));
    if low <= DEFINITE * high {
        return Ok(None);
    }
    let mut half = k.to_owned();
    l.as_ref().solve_lower_triangular_in_place(half.as_mut());
    let mut reduced = half.transpose().to_owned();
    l.as_ref().solve_lower_triangular_in_place(reduced.as_mut());
    let (values, mut vectors) = symmetric_eigen(&reduced)?;
    l.transpose().solve_upper_triangular_in_place(vectors.as_mut());
    Ok(Some((values, vectors)))
}
