//! Eigenpairs on a Krylov space that has grown to all motions: those of K itself on its basis V.
//!
//! ```text
//! VᵀK V s = ν VᵀW V s,   x = V s,   A V = 0
//! ```
//! Ritz values of the shifted inverse would lose the digits of stiff motions beside soft ones. V has gathered the rounding of
//! all orthogonalisations and is projected onto the null space of A once more.

use faer::Mat;

use crate::certified::Shifted;
use crate::dense;
use crate::error::TangentError;
use crate::lanczos::{Krylov, Operator};
use crate::spectrum::{EigenPair, sign};
use crate::tangent::Tangent;

/// The `wanted` lowest pairs, good to `accuracy`; leaves the factors of the metric.
pub(crate) fn pairs(
    tangent: &Tangent<'_>,
    krylov: &Krylov,
    op: &mut Shifted<'_, '_>,
    wanted: usize,
    (zero_limit, accuracy): (f64, f64),
) -> Result<Vec<EigenPair>, TangentError> {
    let n = tangent.unknowns();
    let (mut basis, mut weighted) = (krylov.basis().to_owned(), Mat::zeros(n, krylov.dimension()));
    let (mut x, mut wx) = (vec![0.0; n], vec![0.0; n]);
    op.inverse.factor_metric()?;
    for column in 0..krylov.dimension() {
        x.iter_mut().zip(basis.col(column).iter()).for_each(|(x, v)| *x = *v);
        op.metric(&x, &mut wx);
        op.inverse.solve(&wx, &mut x)?;
        op.metric(&x, &mut wx);
        for row in 0..n {
            (basis[(row, column)], weighted[(row, column)]) = (x[row], wx[row]);
        }
    }
    let stiffness = basis.transpose() * tangent.stiffness.times(&basis);
    let Some((values, vectors)) = dense::generalized_eigen(&stiffness, &(basis.transpose() * weighted))?
    else {
        return Err(TangentError::NotConverged { wanted, found: 0, dimension: krylov.dimension() });
    };
    let shapes = basis * vectors;
    let pair = |k: usize| EigenPair {
        value: values[k],
        accuracy,
        sign: sign(values[k], zero_limit),
        shape: tangent.full(&shapes.col(k).iter().copied().collect::<Vec<_>>()),
    };
    Ok((0..wanted).map(pair).collect())
}
