//! The lowest eigenpairs of large structures, with a proof that none is missing.
//!
//! The signs of the pivots at a shift count the eigenvalues below it (Sylvester): negative, zero and positive ones before
//! the search, and after it those that it must have found ([`crate::search`]).

use tg_model::Mechanics;

use crate::configuration::Configuration;
use crate::error::TangentError;
use crate::lanczos::dot;
use crate::search::Search;
use crate::shift_invert::ShiftInvert;
use crate::spectrum::{Counts, EigenOptions, EigenPair, Method, Metric, Spectrum, sign};
use crate::tangent::Tangent;

/// Rounding of K in an eigenvalue, per largest eigenvalue.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Products with `W⁻¹K` that estimate the largest |ν|; it is a scale only.
const POWER_STEPS: u32 = 8;
/// The first distance of the shift from zero, in units of the zero limit.
const FIRST_SHIFT: f64 = 4.0;

pub(crate) fn lowest(
    mechanics: &dyn Mechanics,
    at: &Configuration,
    options: &EigenOptions,
) -> Result<Spectrum, TangentError> {
    let tangent = Tangent::new(mechanics, at);
    let freedom = tangent.unknowns().saturating_sub(mechanics.sizes().constraints);
    let wanted = options.count.min(freedom);
    let mut inverse = ShiftInvert::new(mechanics, at, options.metric)?;
    let largest = largest_eigenvalue(&tangent, &mut inverse)?;
    let zero_limit = options.zero * largest;
    let up_to_zero = inverse.count_below(zero_limit, 0.1 * zero_limit)?;
    let below_zero =
        if up_to_zero == 0 { 0 } else { inverse.count_below(-zero_limit, 0.1 * zero_limit)?.min(up_to_zero) };
    let counts =
        Counts { negative: below_zero, zero: up_to_zero - below_zero, positive: freedom - up_to_zero };
    let mut spectrum = Spectrum { pairs: Vec::new(), counts, zero_limit, largest, method: Method::Sparse };
    if wanted == 0 {
        return Ok(spectrum);
    }
    if up_to_zero > 0 {
        let shift = shift_below_all(&mut inverse, &counts, zero_limit, largest)?;
        inverse.factor_shifted(shift)?;
    }
    let metric = (options.metric == Metric::Mass).then_some(&tangent.mass);
    let size = tangent.unknowns();
    let mut search = Search { inverse, metric, size, freedom, zero_limit, largest };
    for (value, vector) in search.run(wanted)? {
        spectrum.pairs.push(eigen_pair(&tangent, value, vector, &spectrum));
    }
    Ok(spectrum)
}

/// A shift below all eigenvalues where some are not positive, about as far from zero as the first that is not zero:
/// convergence depends on the ratio of distances from the shift, and vectors next to zero modes that are blown up by more
/// lose their digits. Bisection for the power of four.
fn shift_below_all(
    inverse: &mut ShiftInvert<'_>,
    counts: &Counts,
    zero_limit: f64,
    largest: f64,
) -> Result<f64, TangentError> {
    let distance = |power: i32| FIRST_SHIFT * zero_limit * 4.0_f64.powi(power);
    let (mut low, mut high) = (-1, 0);
    while distance(high) < 2.0 * largest {
        high += 1;
    }
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        let distance = distance(middle);
        let beyond = match counts.negative {
            0 => inverse.count_below(distance, 0.1 * distance)? > counts.zero,
            _ => inverse.count_below(-distance, 0.1 * distance)? == 0,
        };
        if beyond {
            high = middle;
        } else {
            low = middle;
        }
    }
    Ok(if counts.negative == 0 { -distance(high) / 4.0 } else { -distance(high) })
}

/// ν of a pair by its Rayleigh quotient, which rounding in θ does not reach.
fn eigen_pair(tangent: &Tangent<'_>, value: f64, vector: Vec<f64>, spectrum: &Spectrum) -> EigenPair {
    let mut kx = vec![0.0; vector.len()];
    tangent.stiffness.add_product(1.0, &vector, &mut kx);
    let value = if value.abs() > spectrum.zero_limit { dot(&vector, &kx) } else { value };
    EigenPair {
        value,
        accuracy: ROUNDING * spectrum.largest,
        sign: sign(value, spectrum.zero_limit),
        shape: tangent.full(&vector),
    }
}

/// The largest |ν| to within a factor of two or so, by the power method on the null space of A.
fn largest_eigenvalue(tangent: &Tangent<'_>, inverse: &mut ShiftInvert<'_>) -> Result<f64, TangentError> {
    inverse.factor_metric()?;
    let n = tangent.unknowns();
    let mut x: Vec<f64> = (0..n).map(|k| (1.0 + k as f64).sin()).collect();
    let mut kx = vec![0.0; n];
    let mut largest = 0.0;
    for _ in 0..POWER_STEPS {
        kx.fill(0.0);
        tangent.stiffness.add_product(1.0, &x, &mut kx);
        let before = dot(&x, &x).sqrt();
        inverse.solve(&kx, &mut x)?;
        let after = dot(&x, &x).sqrt();
        if after == 0.0 || before == 0.0 {
            return Ok(largest);
        }
        largest = after / before;
        x.iter_mut().for_each(|x| *x /= after);
    }
    Ok(largest)
}
