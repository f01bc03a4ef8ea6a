//! The shift σ from which the lowest eigenvalues are sought: below all of them, and not far.

use crate::certified::Shifted;
use crate::error::TangentError;
use crate::lanczos::{Operator, dot};
use crate::shift_invert::ShiftInvert;
use crate::spectrum::Counts;

/// Solves that tell about where the first of positive eigenvalues is.
const INVERSE_STEPS: u32 = 4;
/// The first distance of the shift from zero, in units of the zero limit.
const FIRST_SHIFT: f64 = 4.0;

/// A shift below all eigenvalues, which are positive, and not far below the first: convergence depends on the ratio of
/// distances from the shift. The inverse iteration from the factors at hand says where the first is. Leaves the factors of
/// the shift.
pub(crate) fn below_positive(
    op: &mut Shifted<'_, '_>,
    n: usize,
    zero_limit: f64,
) -> Result<f64, TangentError> {
    let mut x: Vec<f64> = (0..n).map(|k| (1.0 + k as f64).sin()).collect();
    let (mut wx, mut y) = (vec![0.0; n], vec![0.0; n]);
    op.metric(&x, &mut wx);
    let mut first = 0.0;
    for _ in 0..INVERSE_STEPS {
        op.apply(&wx, &mut y)?;
        std::mem::swap(&mut x, &mut y);
        let product = dot(&x, &wx);
        op.metric(&x, &mut wx);
        let square = dot(&x, &wx);
        // No less than the first ν - σ, and σ is nearly zero beside it.
        first = product / square;
        let norm = square.sqrt();
        x.iter_mut().chain(&mut wx).for_each(|x| *x /= norm);
    }
    let mut shift = first / 8.0;
    while shift > zero_limit {
        if matches!(op.inverse.factor_shifted(shift), Ok(Some(inertia)) if inertia.negative == 0) {
            return Ok(shift);
        }
        shift /= 4.0;
    }
    op.inverse.factor_shifted(zero_limit / 2.0)?;
    Ok(zero_limit / 2.0)
}

/// A shift below all eigenvalues, some of them zero or negative, about as far from zero as the first eigenvalue that is
/// not: vectors next to zero modes that are blown up by more lose their digits. Leaves the factors of the shift.
pub(crate) fn below_all(
    inverse: &mut ShiftInvert<'_>,
    counts: &Counts,
    zero_limit: f64,
    largest: f64,
) -> Result<f64, TangentError> {
    let mut distance = FIRST_SHIFT * zero_limit;
    while distance < 2.0 * largest {
        let slack = 0.1 * distance;
        let found = match counts.negative {
            0 => inverse.count_below(distance, slack)? > counts.zero,
            _ => inverse.count_below(-distance, slack)? == 0,
        };
        if found {
            break;
        }
        distance *= 4.0;
    }
    let shift = if counts.negative == 0 { -distance / 4.0 } else { -distance };
    inverse.factor_shifted(shift)?;
    Ok(shift)
}
