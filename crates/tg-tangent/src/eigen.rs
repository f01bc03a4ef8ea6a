//! The lowest eigenpairs of a tangent on the motions that the constraints allow, and how many are negative, zero and
//! positive.
//!
//! ```text
//! K x - Aᵀ y = ν W x,   A x = 0          (44) with W = M: ν = ω²
//! ```

use faer::Mat;
use tg_model::Mechanics;

use crate::certified;
use crate::configuration::Configuration;
use crate::dense;
use crate::error::TangentError;
use crate::reduced::Reduced;
use crate::spectrum::{Counts, EigenOptions, EigenPair, Method, Metric, Sign, Spectrum, sign};
use crate::tangent::Tangent;

/// Free coordinates up to which [`Method::Automatic`] reduces to dense matrices. Both are equally fast near 100
/// (docs/accuracy-and-speed.md, "Dense or sparse eigenpairs"); up to here the dense method takes less than three times as long,
/// and has no shifts at which factors may not tell the inertia.
const DENSE_LIMIT: usize = 220;

/// The lowest eigenpairs at a configuration.
///
/// # Errors
/// No factorisation, a metric that is singular on the null space of A, or no convergence.
pub fn lowest(
    mechanics: &dyn Mechanics,
    at: &Configuration,
    options: &EigenOptions,
) -> Result<Spectrum, TangentError> {
    let small = mechanics.free().len() <= DENSE_LIMIT;
    match options.method {
        Method::Sparse => certified::lowest(mechanics, at, options),
        Method::Automatic if !small => certified::lowest(mechanics, at, options),
        Method::Automatic | Method::Dense => by_reduction(mechanics, at, options),
    }
}

fn by_reduction(
    mechanics: &dyn Mechanics,
    at: &Configuration,
    options: &EigenOptions,
) -> Result<Spectrum, TangentError> {
    let tangent = Tangent::new(mechanics, at);
    let reduced = Reduced::new(&tangent)?;
    let basis = &reduced.null_space.basis;
    let (values, shapes) = match options.metric {
        Metric::Coordinates => dense::symmetric_eigen(&reduced.stiffness)?,
        Metric::Mass => match dense::generalized_eigen(&reduced.stiffness, &reduced.mass)? {
            Some(pairs) => pairs,
            None => return Err(massless(&tangent, &reduced)?),
        },
    };
    let largest = values.iter().fold(0.0_f64, |a, v| a.max(v.abs()));
    let shapes = basis * shapes;
    let accuracy = (64.0 * f64::EPSILON * largest).max(cancelled(&tangent, &shapes));
    let zero_limit = (options.zero * largest).max(accuracy);
    let pairs = (0..options.count.min(values.len())).map(|k| {
        let shape: Vec<f64> = shapes.col(k).iter().copied().collect();
        EigenPair {
            value: values[k],
            accuracy,
            sign: sign(values[k], zero_limit),
            shape: tangent.full(&shape),
        }
    });
    let count = |wanted| values.iter().filter(|&&v| sign(v, zero_limit) == wanted).count();
    Ok(Spectrum {
        pairs: pairs.collect(),
        counts: Counts {
            negative: count(Sign::Negative),
            zero: count(Sign::Zero),
            positive: count(Sign::Positive),
        },
        zero_limit,
        largest,
        method: Method::Dense,
    })
}

/// Rounding that cancellation leaves in a quotient xᵀ K x, where stiffness and multipliers balance: with one degree of
/// freedom at its critical load no other eigenvalue says what zero means.
fn cancelled(tangent: &Tangent<'_>, shapes: &Mat<f64>) -> f64 {
    let terms = |k: usize| {
        let entries = tangent.stiffness.iter();
        entries.map(|(r, c, value)| (value * shapes[(r, k)] * shapes[(c, k)]).abs()).sum::<f64>()
    };
    4.0 * f64::EPSILON * (0..shapes.ncols()).map(terms).fold(0.0, f64::max)
}

/// Names the coordinate that moves most in the motion without mass.
fn massless(tangent: &Tangent<'_>, reduced: &Reduced) -> Result<TangentError, TangentError> {
    let (_, vectors) = dense::symmetric_eigen(&reduced.mass)?;
    let motion = &reduced.null_space.basis * vectors.col(0);
    let largest = (0..motion.nrows()).max_by(|&a, &b| motion[a].abs().total_cmp(&motion[b].abs()));
    let mechanics = tangent.mechanics();
    let culprit = largest.map_or_else(String::new, |k| mechanics.coordinate_name(mechanics.free()[k]));
    Ok(TangentError::MasslessMotion { culprit })
}
