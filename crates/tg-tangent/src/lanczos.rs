//! Block Lanczos for the largest eigenvalues of an operator that is symmetric in the metric W.
//!
//! ```text
//! span{X, S X, S² X, ..},   S = (K - σW)⁻¹ W on the null space of A,   S x = θ x,   ν = σ + 1/θ
//! S V = V T + V⁺ R,   T = VᵀW S V:   θ, s of T,   x = V s,   |S x - θ x| = |R s|
//! ```
//! V⁺ is the block that comes next. Each vector is orthogonalised against all before it, and T is `VᵀW S V` itself, not a
//! recurrence. Blocks catch multiple eigenvalues, which symmetric structures have; what a block misses, the count of
//! [`crate::certified`] finds missing.

use faer::Mat;

use crate::dense;
use crate::error::TangentError;

/// Vectors of a block: two cost least on the masts and spines of `cargo xtask defaults`.
const BLOCK: usize = 2;
/// Share of a vector's length below which orthogonalisation has left too few digits: what remains would be partly
/// rounding, and outside of the null space of A. A new random vector takes its place.
const LOST: f64 = 1e-4;
/// Share of a vector's length below which one orthogonalisation is not enough: it leaves ε by this share.
const ONCE: f64 = 0.1;
/// Vectors that are added up in one pass through memory.
const FUSED: usize = 4;

/// The operator S and the metric W.
pub(crate) trait Operator {
    fn size(&self) -> usize;
    fn apply(&mut self, wx: &[f64], y: &mut [f64]) -> Result<(), TangentError>;
    fn metric(&self, x: &[f64], wx: &mut [f64]);
}

/// A growing Krylov space.
pub(crate) struct Krylov {
    /// W-orthonormal vectors that the space is orthogonal to.
    locked: Vec<Vec<f64>>,
    /// V, then V⁺; W-orthonormal.
    v: Vec<Vec<f64>>,
    /// S V.
    sv: Vec<Vec<f64>>,
    /// T, lower triangle row by row.
    products: Vec<Vec<f64>>,
    /// R, columns of V from `last` on, each over V⁺.
    beyond: Vec<Vec<f64>>,
    /// First column of R that is not zero.
    last: usize,
    random: u64,
    most: usize,
    wx: Vec<f64>,
}

/// An eigenpair of T with the W-norm of its residual.
pub(crate) struct RitzPair {
    pub(crate) theta: f64,
    pub(crate) residual: f64,
    s: Vec<f64>,
}

impl Krylov {
    /// An empty space orthogonal to `locked`, in a null space of dimension `freedom`; `random` tells random vectors of
    /// several spaces apart.
    pub(crate) fn new(freedom: usize, locked: Vec<Vec<f64>>, random: u64) -> Self {
        Self {
            v: Vec::new(),
            sv: Vec::new(),
            products: Vec::new(),
            beyond: Vec::new(),
            last: 0,
            random,
            most: freedom - locked.len(),
            locked,
            wx: Vec::new(),
        }
    }

    pub(crate) fn dimension(&self) -> usize {
        self.sv.len()
    }

    pub(crate) fn is_full(&self) -> bool {
        self.sv.len() >= self.most
    }

    /// Adds random vectors to the block that comes next.
    pub(crate) fn restart(&mut self, op: &mut impl Operator) -> Result<(), TangentError> {
        for _ in 0..BLOCK {
            let x = self.random_vector(op)?;
            self.add(op, x)?;
        }
        Ok(())
    }

    /// Adds sums of vectors in the null space of A to the block that comes next.
    pub(crate) fn start(
        &mut self,
        op: &mut impl Operator,
        vectors: Vec<Vec<f64>>,
    ) -> Result<(), TangentError> {
        for first in 0..BLOCK {
            let mut sum = vec![0.0; op.size()];
            for x in vectors.iter().skip(first).step_by(BLOCK) {
                sum.iter_mut().zip(x).for_each(|(sum, x)| *sum += x);
            }
            self.add(op, sum)?;
        }
        Ok(())
    }

    /// Takes V⁺ into V and finds the next one, which is part of S V⁺.
    pub(crate) fn extend(&mut self, op: &mut impl Operator) -> Result<(), TangentError> {
        let (first, end) = (self.sv.len(), self.v.len());
        (self.last, self.beyond) = (first, Vec::new());
        for j in first..end {
            op.metric(&self.v[j], &mut self.wx);
            let mut sx = vec![0.0; op.size()];
            op.apply(&self.wx, &mut sx)?;
            self.sv.push(sx.clone());
            op.metric(&sx, &mut self.wx);
            self.products.push(self.v[..=j].iter().map(|v| dot(v, &self.wx)).collect());
            let shares = self.add(op, sx)?;
            self.beyond.push(shares.into_iter().skip(end).collect());
        }
        Ok(())
    }

    /// Adds what of x lies outside of the space as one more vector, a random one where nothing does; the shares of x in all
    /// vectors then.
    fn add(&mut self, op: &mut impl Operator, mut x: Vec<f64>) -> Result<Vec<f64>, TangentError> {
        self.wx.resize(op.size(), 0.0);
        let (mut shares, norm) = self.orthogonalise(op, &mut x);
        if self.v.len() >= self.most {
            return Ok(shares);
        }
        let norm = match norm {
            Some(norm) => {
                shares.push(norm);
                norm
            }
            None => {
                shares.push(0.0);
                x = self.random_vector(op)?;
                match self.orthogonalise(op, &mut x).1 {
                    Some(norm) => norm,
                    // Nothing is left outside of the space: it is the whole null space.
                    None => {
                        self.most = self.v.len();
                        return Ok(shares);
                    }
                }
            }
        };
        x.iter_mut().for_each(|x| *x /= norm);
        self.v.push(x);
        Ok(shares)
    }

    /// Takes the space out of x: its shares in V and V⁺, and the W-norm of what is left, none if that is rounding.
    fn orthogonalise(&mut self, op: &impl Operator, x: &mut [f64]) -> (Vec<f64>, Option<f64>) {
        let mut shares = vec![0.0; self.v.len()];
        op.metric(x, &mut self.wx);
        let before = dot(x, &self.wx).max(0.0).sqrt();
        let (mut length, mut norm) = (before, before);
        for _ in 0..3 {
            let known: Vec<f64> = self.locked.iter().map(|v| -dot(v, &self.wx)).collect();
            let part: Vec<f64> = self.v.iter().map(|v| -dot(v, &self.wx)).collect();
            add_multiples(x, &self.locked, &known);
            add_multiples(x, &self.v, &part);
            shares.iter_mut().zip(&part).for_each(|(share, part)| *share -= part);
            op.metric(x, &mut self.wx);
            norm = dot(x, &self.wx).max(0.0).sqrt();
            if norm > ONCE * length || norm <= LOST * before {
                break;
            }
            length = norm;
        }
        (shares, (norm > LOST * before).then_some(norm))
    }

    /// `S` times a random vector, which lies in the null space of A. The space is taken out of the random vector first:
    /// behind pairs near the shift, which S blows up, nothing else would be left.
    fn random_vector(&mut self, op: &mut impl Operator) -> Result<Vec<f64>, TangentError> {
        self.wx.resize(op.size(), 0.0);
        let mut x: Vec<f64> = (0..op.size()).map(|_| self.next_random()).collect();
        self.orthogonalise(op, &mut x);
        op.metric(&x, &mut self.wx);
        op.apply(&self.wx, &mut x)?;
        Ok(x)
    }

    fn next_random(&mut self) -> f64 {
        self.random =
            self.random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.random >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }

    /// All Ritz pairs, θ descending.
    pub(crate) fn pairs(&self) -> Result<Vec<RitzPair>, TangentError> {
        let k = self.products.len();
        let t = Mat::from_fn(k, k, |r, c| self.products[r.max(c)][r.min(c)]);
        let (values, vectors) = dense::symmetric_eigen(&t)?;
        let next = self.beyond.iter().map(Vec::len).max().unwrap_or(0);
        let pair = |column: usize| {
            let mut residual = vec![0.0; next];
            for (j, r) in self.beyond.iter().enumerate() {
                let s = vectors[(self.last + j, column)];
                residual.iter_mut().zip(r).for_each(|(sum, r)| *sum += s * r);
            }
            RitzPair {
                theta: values[column],
                residual: dot(&residual, &residual).sqrt(),
                s: vectors.col(column).iter().copied().collect(),
            }
        };
        Ok((0..k).rev().map(pair).collect())
    }

    /// The vector S V s of a Ritz pair, `xᵀWx = 1`. It lies in the null space of A as exactly as one solve; V s gathers the
    /// rounding of all orthogonalisations.
    pub(crate) fn vector(&self, op: &impl Operator, pair: &RitzPair) -> Vec<f64> {
        let mut x = vec![0.0; op.size()];
        add_multiples(&mut x, &self.sv, &pair.s);
        let mut wx = vec![0.0; op.size()];
        op.metric(&x, &mut wx);
        let norm = dot(&x, &wx).max(0.0).sqrt();
        x.iter_mut().for_each(|x| *x /= norm);
        x
    }
}

/// `x += Σ c_i v_i`.
fn add_multiples(x: &mut [f64], vectors: &[Vec<f64>], factors: &[f64]) {
    let (fours, few) = (vectors.chunks_exact(FUSED), factors.chunks_exact(FUSED));
    for (v, c) in fours.remainder().iter().zip(few.remainder()) {
        x.iter_mut().zip(v).for_each(|(x, v)| *x += c * v);
    }
    for (v, c) in fours.zip(few) {
        let [a, b, d, e] = [0, 1, 2, 3].map(|k| &v[k][..x.len()]);
        for i in 0..x.len() {
            x[i] += (c[0] * a[i] + c[1] * b[i]) + (c[2] * d[i] + c[3] * e[i]);
        }
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
