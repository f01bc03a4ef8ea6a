//! The lowest eigenpairs of large structures, with a proof that none is missing.
//!
//! The Krylov space of `(K - σW)⁻¹ W` finds eigenvalues near a shift σ that lies below all of them; the signs of the
//! pivots at a second shift, just above the last pair found, count how many there must be. Where the count is higher, the
//! space grows from new random vectors until it agrees.

use tg_model::Mechanics;

use crate::all_motions;
use crate::configuration::Configuration;
use crate::entries::Entries;
use crate::error::TangentError;
use crate::lanczos::{Krylov, Operator, RitzPair, dot};
use crate::shift;
use crate::shift_invert::ShiftInvert;
use crate::spectrum::{Counts, EigenOptions, EigenPair, Method, Metric, Spectrum, sign};
use crate::tangent::Tangent;

/// W-norm of a Ritz pair's residual, per θ, at which it has converged: eigenvalues are then good to the square of it.
const CONVERGED: f64 = 1e-9;
/// The same where rounding in the solves, ε times K's largest eigenvalue by the pair's distance from the shift, ends the
/// descent earlier: the eigenvalue still has all digits that K determines.
const STALLED: f64 = 1e-4;
/// Rounding of K in an eigenvalue, per largest eigenvalue.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Products with `W⁻¹K` that estimate the largest |ν|; it is a scale only.
const POWER_STEPS: u32 = 12;
/// Eigenvalues closer than this part of each other's size are one multiple eigenvalue.
const CLUSTER: f64 = 1e-6;

pub(crate) struct Shifted<'a, 'm> {
    pub(crate) inverse: &'a mut ShiftInvert<'m>,
    metric: Option<&'a Entries>,
}

impl Operator for Shifted<'_, '_> {
    fn apply(&mut self, wx: &[f64], y: &mut [f64]) -> Result<(), TangentError> {
        self.inverse.solve(wx, y)
    }

    fn project(&mut self, wx: &[f64], y: &mut [f64]) -> Result<(), TangentError> {
        self.inverse.project(wx, y)
    }

    fn metric(&self, x: &[f64], wx: &mut [f64]) {
        match self.metric {
            Some(mass) => {
                wx.fill(0.0);
                mass.add_product(1.0, x, wx);
            }
            None => wx.copy_from_slice(x),
        }
    }
}

pub(crate) fn lowest(
    mechanics: &dyn Mechanics,
    at: &Configuration,
    options: &EigenOptions,
) -> Result<Spectrum, TangentError> {
    let tangent = Tangent::new(mechanics, at);
    let n = tangent.unknowns();
    let freedom = n.saturating_sub(mechanics.sizes().constraints);
    let wanted = options.count.min(freedom);
    let mut inverse = ShiftInvert::new(mechanics, at, options.metric)?;
    let largest = largest_eigenvalue(&tangent, &mut inverse)?;
    let zero_limit = options.zero * largest;
    let up_to_zero = inverse.count_below(zero_limit, 0.1 * zero_limit)?;
    let below_zero = if up_to_zero == 0 { 0 } else { inverse.count_below(-zero_limit, 0.1 * zero_limit)? };
    let counts = Counts {
        negative: below_zero,
        zero: up_to_zero - below_zero.min(up_to_zero),
        positive: freedom - up_to_zero,
    };

    if wanted == 0 {
        return Ok(Spectrum { pairs: Vec::new(), counts, zero_limit, largest, method: Method::Sparse });
    }
    let metric = (options.metric == Metric::Mass).then_some(&tangent.mass);
    let shift = if up_to_zero == 0 {
        shift::below_positive(&mut Shifted { inverse: &mut inverse, metric }, n, zero_limit)?
    } else {
        shift::below_all(&mut inverse, &counts, zero_limit, largest)?
    };
    let mut krylov = Krylov::new(n, freedom);
    loop {
        let mut op = Shifted { inverse: &mut inverse, metric };
        let limit = (12 * wanted + 240).min(freedom);
        krylov.restart(&mut op)?;
        let pairs = converged(&mut krylov, &mut op, wanted, limit)?;
        if krylov.dimension() == freedom {
            let limits = (zero_limit, ROUNDING * largest);
            let pairs = all_motions::pairs(&tangent, &krylov, &mut op, wanted, limits)?;
            return Ok(Spectrum { pairs, counts, zero_limit, largest, method: Method::Sparse });
        }
        let values: Vec<f64> = pairs.iter().map(|pair| shift + 1.0 / pair.theta).collect();
        let known = Known { counts, zero_limit, largest };
        let (expected, found) = known.census(&values, wanted, &mut inverse)?;
        inverse.factor_shifted(shift)?;
        if found >= expected {
            let pairs = pairs
                .into_iter()
                .take(wanted)
                .map(|pair| eigen_pair(&tangent, pair, shift, zero_limit, largest));
            return Ok(Spectrum {
                pairs: pairs.collect(),
                counts,
                zero_limit,
                largest,
                method: Method::Sparse,
            });
        }
        if krylov.dimension() >= limit || krylov.is_full() {
            return Err(TangentError::NotConverged {
                wanted: expected,
                found,
                dimension: krylov.dimension(),
            });
        }
    }
}

/// What inertia has told of the spectrum.
struct Known {
    counts: Counts,
    zero_limit: f64,
    largest: f64,
}

impl Known {
    /// How many eigenvalues there are up to just behind the last wanted of `values`, and how many of them are among these.
    fn census(
        &self,
        values: &[f64],
        wanted: usize,
        inverse: &mut ShiftInvert<'_>,
    ) -> Result<(usize, usize), TangentError> {
        let up_to = |limit: f64| values.iter().filter(|&&v| v <= limit).count();
        match values.get(wanted - 1) {
            None => Ok((wanted, values.len())),
            // Zeros are one multiple eigenvalue. A shift among them, closer than their rounding, has no inertia.
            Some(last) if last.abs() <= self.zero_limit => {
                Ok((self.counts.negative, up_to(-self.zero_limit)))
            }
            Some(last) => {
                let gap = (CLUSTER * last.abs()).max(4.0 * ROUNDING * self.largest);
                Ok((inverse.count_below(last + gap, 0.1 * gap)?, up_to(last + gap)))
            }
        }
    }
}

/// Grows the space until the pairs of the `wanted` largest θ have converged; those and some behind them.
fn converged(
    krylov: &mut Krylov,
    op: &mut Shifted<'_, '_>,
    wanted: usize,
    limit: usize,
) -> Result<Vec<RitzPair>, TangentError> {
    let (mut next_check, mut before) = (wanted + 4, Vec::new());
    loop {
        while krylov.dimension() < next_check && !krylov.is_full() {
            krylov.extend(op)?;
        }
        let pairs = krylov.largest(op, wanted + 4)?;
        let shares: Vec<f64> =
            pairs.iter().take(wanted).map(|pair| pair.residual / pair.theta.abs()).collect();
        let is_good = |(k, &share): (usize, &f64)| {
            share <= CONVERGED || (share <= STALLED && before.get(k).is_some_and(|b| share > 0.5 * b))
        };
        let good = shares.iter().enumerate().filter(|&pair| is_good(pair)).count();
        if good == wanted.min(pairs.len()) || krylov.is_full() {
            return Ok(pairs);
        }
        if krylov.dimension() >= limit {
            return Err(TangentError::NotConverged { wanted, found: good, dimension: krylov.dimension() });
        }
        before = shares;
        next_check = krylov.dimension() + (krylov.dimension() / 4).max(8);
    }
}

/// ν of a pair by its Rayleigh quotient, which rounding in θ does not reach.
fn eigen_pair(tangent: &Tangent<'_>, pair: RitzPair, shift: f64, zero_limit: f64, largest: f64) -> EigenPair {
    let mut kx = vec![0.0; pair.vector.len()];
    tangent.stiffness.add_product(1.0, &pair.vector, &mut kx);
    let quotient = dot(&pair.vector, &kx);
    let theta = shift + 1.0 / pair.theta;
    let value = if theta.abs() > zero_limit { quotient } else { theta };
    EigenPair {
        value,
        accuracy: ROUNDING * largest,
        sign: sign(value, zero_limit),
        shape: tangent.full(&pair.vector),
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
