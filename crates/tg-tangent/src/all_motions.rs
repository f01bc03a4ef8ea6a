//! Eigenpairs on a Krylov space that has grown to all motions: those of K itself on its basis V.
//!
//! ```text
//! VᵀK V s = ν s,   x = V s,   VᵀW V = I
//! ```
//! Ritz values of the shifted inverse would lose the digits of stiff motions beside soft ones.

use crate::dense;
use crate::error::TangentError;
use crate::lanczos::Krylov;
use crate::spectrum::{EigenPair, sign};
use crate::tangent::Tangent;

/// The `wanted` lowest pairs, good to `accuracy`.
pub(crate) fn pairs(
    tangent: &Tangent<'_>,
    krylov: &Krylov,
    wanted: usize,
    (zero_limit, accuracy): (f64, f64),
) -> Result<Vec<EigenPair>, TangentError> {
    let basis = krylov.basis().to_owned();
    let (values, vectors) = dense::symmetric_eigen(&(basis.transpose() * tangent.stiffness.times(&basis)))?;
    let shapes = basis * vectors;
    let pair = |k: usize| EigenPair {
        value: values[k],
        accuracy,
        sign: sign(values[k], zero_limit),
        shape: tangent.full(&shapes.col(k).iter().copied().collect::<Vec<_>>()),
    };
    Ok((0..wanted).map(pair).collect())
}
