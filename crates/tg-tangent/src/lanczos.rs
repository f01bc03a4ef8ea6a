//! Block Lanczos for the largest eigenvalues of an operator that is symmetric in the metric W.
//!
//! ```text
//! span{X, S X, S² X, ..},   S = (K - σW)⁻¹ W on the null space of A,   S x = θ x,   ν = σ + 1/θ
//! ```
//! Each block is orthogonalised twice against all before it, and the images S V are kept, so that Ritz pairs and their
//! residuals come from `VᵀW S V` itself and not from a recurrence. Blocks catch multiple eigenvalues, which symmetric
//! structures have; what a block misses, the count of [`crate::certified`] finds missing.

use faer::Mat;

use crate::dense;
use crate::error::TangentError;

/// Vectors of a block: the highest multiplicity in the icosahedral and cubic structures is five, in most others three.
const BLOCK: usize = 4;
/// Share of a vector's length below which orthogonalisation has left too few digits: what remains would be partly
/// rounding, and outside of the null space of A. A new random vector takes its place.
const LOST: f64 = 1e-4;

/// The operator S and the metric W.
pub(crate) trait Operator {
    fn size(&self) -> usize;
    fn apply(&mut self, wx: &[f64], y: &mut [f64]) -> Result<(), TangentError>;
    fn metric(&self, x: &[f64], wx: &mut [f64]);
}

/// A growing Krylov space.
pub(crate) struct Krylov {
    v: Vec<Vec<f64>>,
    wv: Vec<Vec<f64>>,
    sv: Vec<Vec<f64>>,
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
    /// An empty space that may grow to `most` dimensions.
    pub(crate) fn new(most: usize) -> Self {
        Self { v: Vec::new(), wv: Vec::new(), sv: Vec::new(), products: Vec::new(), random: 1, most }
    }

    pub(crate) fn dimension(&self) -> usize {
        self.v.len()
    }

    pub(crate) fn is_full(&self) -> bool {
        self.v.len() >= self.most
    }

    /// Adds a block that starts from random vectors.
    pub(crate) fn restart(&mut self, op: &mut impl Operator) -> Result<(), TangentError> {
        let mut candidates = Vec::new();
        for _ in 0..BLOCK {
            candidates.push(self.random_vector(op)?);
        }
        self.add(op, candidates)
    }

    /// Adds the block `S V_last`.
    pub(crate) fn extend(&mut self, op: &mut impl Operator) -> Result<(), TangentError> {
        let last = self.sv.len().saturating_sub(BLOCK);
        let candidates = self.sv[last..].to_vec();
        self.add(op, candidates)
    }

    fn add(&mut self, op: &mut impl Operator, candidates: Vec<Vec<f64>>) -> Result<(), TangentError> {
        let mut wx = vec![0.0; op.size()];
        for mut x in candidates {
            if self.is_full() {
                break;
            }
            let mut norm = self.orthogonalise(op, &mut x, &mut wx);
            if norm.is_none() {
                x = self.random_vector(op)?;
                norm = self.orthogonalise(op, &mut x, &mut wx);
            }
            // Nothing is left outside of the space: it is the whole null space.
            let Some(norm) = norm else {
                self.most = self.v.len();
                break;
            };
            x.iter_mut().chain(&mut wx).for_each(|x| *x /= norm);
            let mut sx = vec![0.0; op.size()];
            op.apply(&wx, &mut sx)?;
            self.v.push(x);
            self.wv.push(wx.clone());
            self.products.push(self.wv.iter().map(|wv| dot(wv, &sx)).collect());
            self.sv.push(sx);
        }
        Ok(())
    }

    /// Takes the space out of x, twice; the W-norm of what is left, or none if that is rounding. `wx` becomes W x.
    fn orthogonalise(&self, op: &impl Operator, x: &mut [f64], wx: &mut [f64]) -> Option<f64> {
        op.metric(x, wx);
        let before = dot(x, wx).max(0.0).sqrt();
        for _ in 0..2 {
            for (v, wv) in self.v.iter().zip(&self.wv) {
                let share = dot(wv, x);
                x.iter_mut().zip(v).for_each(|(x, v)| *x -= share * v);
            }
        }
        op.metric(x, wx);
        let norm = dot(x, wx).max(0.0).sqrt();
        (norm > LOST * before).then_some(norm)
    }

    /// `S` times a random vector, which lies in the null space of A.
    fn random_vector(&mut self, op: &mut impl Operator) -> Result<Vec<f64>, TangentError> {
        let mut wx = vec![0.0; op.size()];
        let start: Vec<f64> = (0..op.size()).map(|_| self.next_random()).collect();
        op.metric(&start, &mut wx);
        let mut x = start;
        op.apply(&wx, &mut x)?;
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
        let k = self.v.len();
        let t = Mat::from_fn(k, k, |r, c| self.products[r.max(c)][r.min(c)]);
        let (values, vectors) = dense::symmetric_eigen(&t)?;
        let mut residual = vec![0.0; op.size()];
        let mut weighted = vec![0.0; op.size()];
        let mut pairs = Vec::new();
        for column in (0..k).rev().take(count) {
            let theta = values[column];
            let mut vector = vec![0.0; op.size()];
            residual.fill(0.0);
            for (row, (v, sv)) in self.v.iter().zip(&self.sv).enumerate() {
                let s = vectors[(row, column)];
                for ((x, r), (v, sv)) in vector.iter_mut().zip(&mut residual).zip(v.iter().zip(sv)) {
                    *x += s * sv;
                    *r += s * (sv - theta * v);
                }
            }
            op.metric(&residual, &mut weighted);
            let residual = dot(&residual, &weighted).max(0.0).sqrt();
            op.metric(&vector, &mut weighted);
            let norm = dot(&vector, &weighted).max(0.0).sqrt();
            vector.iter_mut().for_each(|x| *x /= norm);
            pairs.push(RitzPair { theta, vector, residual });
        }
        Ok(pairs)
    }
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
