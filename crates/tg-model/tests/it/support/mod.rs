//! Seeded numbers, dense algebra and finite differences that share nothing with the crate; models under test.

/// The paper's examples 1 and 2.
pub(crate) mod examples;
/// Random structures that mix everything.
pub(crate) mod mixed;

use nalgebra::{DMatrix, DVector};
use tg_model::{At, BuildError, Mechanics, Model, ModelBuilder};

/// Reproducible numbers.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self((seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x5DEE_CE66_D1CE_4E5B) | 1)
    }

    /// In -1..1.
    pub(crate) fn value(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// In `low..high`.
    pub(crate) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * 0.5 * (self.value() + 1.0)
    }

    pub(crate) fn index(&mut self, below: usize) -> usize {
        (self.within(0.0, below as f64) as usize).min(below - 1)
    }

    pub(crate) fn vector(&mut self, n: usize, size: f64) -> Vec<f64> {
        (0..n).map(|_| size * self.value()).collect()
    }

    pub(crate) fn array<const D: usize>(&mut self, size: f64) -> [f64; D] {
        std::array::from_fn(|_| size * self.value())
    }
}

/// How many random structures a test looks at: fewer in a build that checks overflow and is slow.
pub(crate) const fn seeds(all: u64) -> u64 {
    if cfg!(debug_assertions) { all.div_ceil(4) } else { all }
}

/// ∂f/∂x by the five-point central difference, exact for polynomials of degree four: row i, column j is ∂f_i/∂x_j.
pub(crate) fn derivative(x: &[f64], h: f64, f: impl Fn(&[f64]) -> Vec<f64>) -> DMatrix<f64> {
    let columns: Vec<DVector<f64>> = (0..x.len())
        .map(|j| {
            let shifted = |steps: f64| {
                let mut x = x.to_vec();
                x[j] += steps * h;
                DVector::from_vec(f(&x))
            };
            ((shifted(1.0) - shifted(-1.0)) * 8.0 - (shifted(2.0) - shifted(-2.0))) / (12.0 * h)
        })
        .collect();
    DMatrix::from_columns(&columns)
}

/// Dense matrix of summed entries.
pub(crate) fn scatter(rows: usize, cols: usize, pattern: &[(usize, usize)], values: &[f64]) -> DMatrix<f64> {
    assert_eq!(pattern.len(), values.len());
    let mut dense = DMatrix::zeros(rows, cols);
    for (&(i, j), value) in pattern.iter().zip(values) {
        dense[(i, j)] += value;
    }
    dense
}

pub(crate) fn force(m: &dyn Mechanics, at: At<'_>) -> Vec<f64> {
    let mut f = vec![f64::NAN; m.sizes().coordinates];
    m.force(at, &mut f);
    f
}

pub(crate) fn stiffness(m: &dyn Mechanics, at: At<'_>) -> DMatrix<f64> {
    let mut values = vec![f64::NAN; m.stiffness_pattern().len()];
    m.stiffness(at, &mut values);
    let n = m.sizes().coordinates;
    scatter(n, n, m.stiffness_pattern(), &values)
}

pub(crate) fn damping(m: &dyn Mechanics, at: At<'_>) -> DMatrix<f64> {
    let mut values = vec![f64::NAN; m.damping_pattern().len()];
    m.damping(at, &mut values);
    let n = m.sizes().coordinates;
    scatter(n, n, m.damping_pattern(), &values)
}

pub(crate) fn constraints(m: &dyn Mechanics, q: &[f64]) -> Vec<f64> {
    let mut phi = vec![f64::NAN; m.sizes().constraints];
    m.constraints(q, &mut phi);
    phi
}

pub(crate) fn jacobian(m: &dyn Mechanics, q: &[f64]) -> DMatrix<f64> {
    let mut values = vec![f64::NAN; m.jacobian_pattern().len()];
    m.jacobian(q, &mut values);
    scatter(m.sizes().constraints, q.len(), m.jacobian_pattern(), &values)
}

pub(crate) fn active_set(m: &dyn Mechanics, at: At<'_>) -> Vec<bool> {
    let mut taut = vec![false; m.sizes().switches];
    m.active_set(at, &mut taut);
    taut
}

pub(crate) fn mass(m: &dyn Mechanics) -> DMatrix<f64> {
    let n = m.sizes().coordinates;
    let mut dense = DMatrix::zeros(n, n);
    for e in m.mass() {
        assert_eq!(dense[(e.row, e.col)], 0.0, "entry ({}, {}) repeats", e.row, e.col);
        dense[(e.row, e.col)] = e.value;
    }
    dense
}

/// Largest scaled |Φ|.
pub(crate) fn violation(m: &dyn Mechanics, q: &[f64]) -> f64 {
    let scaled = constraints(m, q).into_iter().zip(m.constraint_scales()).map(|(phi, s)| (phi / s).abs());
    scaled.fold(0.0, |worst, x| if x <= worst { worst } else { x })
}

/// Rows and columns out of a matrix.
pub(crate) fn select(matrix: &DMatrix<f64>, rows: &[usize], cols: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), cols.len(), |i, j| matrix[(rows[i], cols[j])])
}

pub(crate) fn pick(x: &[f64], of: &[usize]) -> DVector<f64> {
    DVector::from_iterator(of.len(), of.iter().map(|&i| x[i]))
}

pub(crate) fn all(n: usize) -> Vec<usize> {
    (0..n).collect()
}

/// Asserts that two matrices agree to `tolerance` times their size (at least one).
#[track_caller]
pub(crate) fn assert_close(found: &DMatrix<f64>, expected: &DMatrix<f64>, tolerance: f64, what: &str) {
    assert_eq!(found.shape(), expected.shape(), "{what}");
    let size = expected.amax().max(1.0);
    for ((i, j), difference) in
        (found - expected).iter().enumerate().map(|(k, d)| ((k % found.nrows(), k / found.nrows()), d))
    {
        assert!(
            difference.abs() <= tolerance * size,
            "{what}: entry ({i}, {j}) is {} instead of {} (size {size})",
            found[(i, j)],
            expected[(i, j)]
        );
    }
}

/// Builds what `parts` adds to an empty builder.
pub(crate) fn build<const D: usize>(
    parts: impl FnOnce(&mut ModelBuilder<D>) -> Result<(), BuildError>,
) -> Result<Model<D>, BuildError> {
    let mut b = ModelBuilder::new();
    parts(&mut b)?;
    b.build()
}
