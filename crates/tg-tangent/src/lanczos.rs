//! Block Lanczos for the largest eigenvalues of an operator that is symmetric in the metric W.
//!
//! ```text
//! span{X, S X, S² X, ..},   S = (K - σW)⁻¹ W on the null space of A,   S x = θ x,   ν = σ + 1/θ
//! ```
//! Each block is orthogonalised twice against all before it, and the images S V are kept, so that Ritz pairs and their
//! residuals come from `VᵀW S V` itself and not from a recurrence. Blocks catch multiple eigenvalues, which symmetric
//! structures have; what a block misses, the count of [`crate::certified`] finds missing.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par};

use crate::dense;
use crate::error::TangentError;

/// Vectors of a block: the highest multiplicity in the icosahedral and cubic structures is five, in most others three.
const BLOCK: usize = 4;
/// Share of a vector's length below which orthogonalisation has left too few digits: what remains would be partly
/// rounding, and outside of the null space of A. A new random vector takes its place.
const LOST: f64 = 1e-4;

/// The operator S and the metric W.
pub(crate) trait Operator {
    fn apply(&mut self, wx: &[f64], y: &mut [f64]) -> Result<(), TangentError>;
    /// y, nearest to x on the null space of A in the metric W.
    fn project(&mut self, wx: &[f64], y: &mut [f64]) -> Result<(), TangentError>;
    fn metric(&self, x: &[f64], wx: &mut [f64]);
}

/// A growing Krylov space. Its vectors stand side by side, so that products with all of them are dense ones.
pub(crate) struct Krylov {
    size: usize,
    v: Vec<f64>,
    wv: Vec<f64>,
    sv: Vec<f64>,
    /// `VᵀW S V`, row by row of the lower triangle and beyond.
    products: Vec<Vec<f64>>,
    random: u64,
    most: usize,
}

/// An eigenpair of S with the W-norm of its residual.
pub(crate) struct RitzPair {
    pub(crate) theta: f64,
    pub(crate) vector: Vec<f64>,
    pub(crate) residual: f64,
}

impl Krylov {
    /// An empty space of vectors of this size that may grow to `most` dimensions.
    pub(crate) fn new(size: usize, most: usize) -> Self {
        let (v, wv, sv) = (Vec::new(), Vec::new(), Vec::new());
        Self { size, v, wv, sv, products: Vec::new(), random: 1, most }
    }

    pub(crate) fn dimension(&self) -> usize {
        self.products.len()
    }

    pub(crate) fn is_full(&self) -> bool {
        self.dimension() >= self.most
    }

    /// The space's vectors as columns.
    pub(crate) fn basis(&self) -> MatRef<'_, f64> {
        columns(&self.v, self.size)
    }

    /// Adds a block that starts from random vectors.
    pub(crate) fn restart(&mut self, op: &mut impl Operator) -> Result<(), TangentError> {
        let mut candidates = Vec::with_capacity(BLOCK * self.size);
        for _ in 0..BLOCK {
            candidates.extend(self.random_vector(op, true)?);
        }
        self.add(op, candidates)
    }

    /// Adds the block `S V_last`.
    pub(crate) fn extend(&mut self, op: &mut impl Operator) -> Result<(), TangentError> {
        let last = self.sv.len().saturating_sub(BLOCK * self.size);
        let candidates = self.sv[last..].to_vec();
        self.add(op, candidates)
    }

    fn add(&mut self, op: &mut impl Operator, mut candidates: Vec<f64>) -> Result<(), TangentError> {
        let mut wx = vec![0.0; self.size];
        let before: Vec<f64> = candidates.chunks(self.size).map(|x| norm(op, x, &mut wx)).collect();
        let known = self.dimension();
        self.take_out(0, &mut candidates);
        for (x, before) in candidates.chunks_mut(self.size).zip(before) {
            if self.is_full() {
                break;
            }
            // What the block's own vectors before have in common with it.
            self.take_out(known, x);
            let mut left = norm(op, x, &mut wx);
            if left <= LOST * before {
                left = self.anew(op, x, &mut wx)?;
                // Nothing is left outside of the space: it is the whole null space.
                if left == 0.0 {
                    self.most = self.dimension();
                    break;
                }
            }
            x.iter_mut().chain(&mut wx).for_each(|x| *x /= left);
            let mut sx = vec![0.0; self.size];
            op.apply(&wx, &mut sx)?;
            self.v.extend_from_slice(x);
            self.wv.extend_from_slice(&wx);
            self.products.push(transposed_product(&self.wv, &sx, self.size));
            self.sv.extend(sx);
        }
        Ok(())
    }

    /// A random vector in x without what the space has, and its length; zero where the space leaves nothing. S of one is nearly
    /// all in the space where stiff motions follow soft ones that are known; then it is projected without S.
    fn anew(&mut self, op: &mut impl Operator, x: &mut [f64], wx: &mut [f64]) -> Result<f64, TangentError> {
        for through_s in [true, false] {
            x.copy_from_slice(&self.random_vector(op, through_s)?);
            let before = norm(op, x, wx);
            self.take_out(0, x);
            let left = norm(op, x, wx);
            if left > LOST * before {
                return Ok(left);
            }
        }
        Ok(0.0)
    }

    /// Takes the space's vectors from `first` on out of x, of one or more columns, twice.
    fn take_out(&self, first: usize, x: &mut [f64]) {
        let (v, wv) = (&self.v[first * self.size..], &self.wv[first * self.size..]);
        // Nothing to take out, and no sizes to multiply.
        if v.is_empty() {
            return;
        }
        for _ in 0..2 {
            let shares = transposed_product(wv, x, self.size);
            let shares = columns(&shares, v.len() / self.size);
            matmul(columns_mut(x, self.size), Accum::Add, columns(v, self.size), shares, -1.0, Par::Seq);
        }
    }

    /// `S` times a random vector, or its projection: both lie in the null space of A.
    fn random_vector(&mut self, op: &mut impl Operator, through_s: bool) -> Result<Vec<f64>, TangentError> {
        let mut wx = vec![0.0; self.size];
        let start: Vec<f64> = (0..self.size).map(|_| self.next_random()).collect();
        op.metric(&start, &mut wx);
        let mut x = start;
        if through_s {
            op.apply(&wx, &mut x)?;
        } else {
            // About √w z: light motions have the same share as heavy ones.
            wx.iter_mut().zip(&x).for_each(|(wx, z)| *wx = (*wx * z).abs().sqrt().copysign(*z));
            op.project(&wx, &mut x)?;
        }
        Ok(x)
    }

    fn next_random(&mut self) -> f64 {
        self.random =
            self.random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.random >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }

    /// Ritz pairs with the `count` largest θ, descending. Their vectors are S V s, which lies in the null space of A as
    /// exactly as one solve; V s gathers the rounding of all orthogonalisations.
    pub(crate) fn largest(&self, op: &impl Operator, count: usize) -> Result<Vec<RitzPair>, TangentError> {
        let k = self.dimension();
        let t = Mat::from_fn(k, k, |r, c| self.products[r.max(c)][r.min(c)]);
        let (values, vectors) = dense::symmetric_eigen(&t)?;
        let count = count.min(k);
        let theta = |column: usize| values[k - 1 - column];
        let s = Mat::from_fn(k, count, |row, column| vectors[(row, k - 1 - column)]);
        let scaled = Mat::from_fn(k, count, |row, column| theta(column) * s[(row, column)]);
        let (mut x, mut residual) = (vec![0.0; self.size * count], vec![0.0; self.size * count]);
        matmul(
            columns_mut(&mut x, self.size),
            Accum::Replace,
            columns(&self.sv, self.size),
            s.as_ref(),
            1.0,
            Par::Seq,
        );
        residual.copy_from_slice(&x);
        matmul(
            columns_mut(&mut residual, self.size),
            Accum::Add,
            columns(&self.v, self.size),
            scaled.as_ref(),
            -1.0,
            Par::Seq,
        );
        let mut weighted = vec![0.0; self.size];
        let pairs = x.chunks(self.size).zip(residual.chunks(self.size)).enumerate();
        let pair = |(column, (x, residual)): (usize, (&[f64], &[f64]))| {
            let residual = norm(op, residual, &mut weighted);
            let length = norm(op, x, &mut weighted);
            let vector = x.iter().map(|x| x / length).collect();
            RitzPair { theta: theta(column), vector, residual }
        };
        Ok(pairs.map(pair).collect())
    }
}

/// Vectors of this size side by side.
fn columns(vectors: &[f64], size: usize) -> MatRef<'_, f64> {
    let count = vectors.len().checked_div(size).unwrap_or(0);
    MatRef::from_column_major_slice(vectors, size, count)
}

fn columns_mut(vectors: &mut [f64], size: usize) -> MatMut<'_, f64> {
    let count = vectors.len().checked_div(size).unwrap_or(0);
    MatMut::from_column_major_slice_mut(vectors, size, count)
}

/// `AᵀB`, column by column, of columns of this size.
fn transposed_product(a: &[f64], b: &[f64], size: usize) -> Vec<f64> {
    let (a, b) = (columns(a, size), columns(b, size));
    let mut product = vec![0.0; a.ncols() * b.ncols()];
    matmul(columns_mut(&mut product, a.ncols()), Accum::Replace, a.transpose(), b, 1.0, Par::Seq);
    product
}

/// W-norm of x; `wx` becomes W x.
fn norm(op: &impl Operator, x: &[f64], wx: &mut [f64]) -> f64 {
    op.metric(x, wx);
    dot(x, wx).max(0.0).sqrt()
}

/// Scalar product in eight partial sums, so that the additions do not wait for each other.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a8, a_end) = a.as_chunks::<8>();
    let (b8, b_end) = b.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for (a, b) in a8.iter().zip(b8) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    let end: f64 = a_end.iter().zip(b_end).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + end
}
