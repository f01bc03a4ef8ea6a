//! The lower end of a spectrum: what is asked for and what comes back.

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
    /// out below 1e-14; the slowest modes of a spine of a thousand vertebrae lie at 6e-12 (prisms:
    /// docs/accuracy-and-speed.md, "Zero eigenvalues").
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

pub(crate) fn sign(value: f64, zero_limit: f64) -> Sign {
    if value < -zero_limit {
        Sign::Negative
    } else if value <= zero_limit {
        Sign::Zero
    } else {
        Sign::Positive
    }
}
