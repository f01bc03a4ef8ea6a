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
use crate::tangent::Tangent;

/// Free coordinates up to which [`Method::Automatic`] reduces to dense matrices: `cargo xtask defaults` times both.
const DENSE_LIMIT: usize = 300;

/// The matrix W that eigenvalues are relative to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Metric {
    /// The mass matrix: ν = ω² \[1/s²\].
    Mass,
    /// The identity over natural coordinates: ν \[N/m\]; needs no masses.
    Coordinates,
}

/// How eigenpairs are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Dense for small structures, sparse for large ones.
    #[default]
    Automatic,
    /// Dense matrices on a basis of the null space.
    Dense,
    /// Shift-invert block Lanczos on the saddle-point matrix, certified by its inertia.
    Sparse,
}

/// What is asked for.
#[derive(Clone, Copy, Debug)]
pub struct EigenOptions {
    /// Number of lowest eigenpairs; fewer come back from a structure with fewer degrees of freedom.
    pub count: usize,
    /// The metric W.
    pub metric: Metric,
    /// The method.
    pub method: Method,
    /// Part of the largest |ν| up to which an eigenvalue counts as zero. Rigid motions of all structures in the tests come
    /// out below 1e-14; the slowest modes of a spine of a thousand vertebrae lie at 6e-12.
    pub zero: f64,
}

impl EigenOptions {
    /// The `count` lowest eigenpairs in a metric, by the default method and zero limit.
    pub fn new(count: usize, metric: Metric) -> Self {
        Self { count, metric, method: Method::Automatic, zero: 1e-12 }
    }
}

/// Sign of an eigenvalue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Below -[`Spectrum::zero_limit`]: the energy falls along the shape.
    Negative,
    /// Zero to within the limit: a rigid motion or a mechanism without stiffness.
    Zero,
    /// Above the limit.
    Positive,
}

/// An eigenvalue with its shape.
#[derive(Clone, Debug)]
pub struct EigenPair {
    /// ν.
    pub value: f64,
    /// Size of the error that rounding of K leaves in ν, the same for all: an estimate.
    pub accuracy: f64,
    /// Its sign, zero within the limit.
    pub sign: Sign,
    /// x over the full coordinates, zero at prescribed ones, `xᵀ W x = 1`.
    pub shape: Vec<f64>,
}

/// Numbers of eigenvalues by sign, all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// Negative ones: directions in which the energy falls.
    pub negative: usize,
    /// Zero to within the limit.
    pub zero: usize,
    /// Positive ones.
    pub positive: usize,
}

/// The lower end of a tangent's spectrum.
#[derive(Clone, Debug)]
pub struct Spectrum {
    /// Lowest pairs, ascending.
    pub pairs: Vec<EigenPair>,
    /// Signs of all eigenvalues.
    pub counts: Counts,
    /// |ν| up to which an eigenvalue counts as zero: [`EigenOptions::zero`] times the largest, or the accuracy.
    pub zero_limit: f64,
    /// Largest |ν|, or an estimate of it.
    pub largest: f64,
    /// The method that was used.
    pub method: Method,
}

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

pub(crate) fn sign(value: f64, zero_limit: f64) -> Sign {
    if value < -zero_limit {
        Sign::Negative
    } else if value <= zero_limit {
        Sign::Zero
    } else {
        Sign::Positive
    }
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
