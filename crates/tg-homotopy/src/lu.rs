//! Dense LU factors with scaled partial pivoting for the small matrices of a path.

use crate::scalar::Field;

/// Factors of a square matrix, row by row in one buffer; refilled at every evaluation.
#[derive(Clone, Debug)]
pub(crate) struct Lu<S> {
    n: usize,
    factors: Vec<S>,
    pivots: Vec<usize>,
    inverse_pivots: Vec<S>,
    scales: Vec<f64>,
}

impl<S: Field> Lu<S> {
    pub(crate) fn new(n: usize) -> Self {
        Self {
            n,
            factors: vec![S::zero(); n * n],
            pivots: vec![0; n],
            inverse_pivots: vec![S::zero(); n],
            scales: vec![1.0; n],
        }
    }

    /// Factorises `a` (row by row); false if a pivot is zero or not finite.
    pub(crate) fn factor(&mut self, a: &[S]) -> bool {
        let n = self.n;
        self.factors.copy_from_slice(a);
        for i in 0..n {
            let largest = crate::scalar::norm(&a[i * n..(i + 1) * n]);
            // Also true for NaN.
            if !(largest > 0.0 && largest.is_finite()) {
                return false;
            }
            self.scales[i] = 1.0 / largest;
        }
        for k in 0..n {
            let (mut row, mut best) = (k, -1.0);
            for i in k..n {
                let size = self.factors[i * n + k].size() * self.scales[i];
                if size > best {
                    (row, best) = (i, size);
                }
            }
            self.pivots[k] = row;
            if !(best > 0.0 && best.is_finite()) {
                return false;
            }
            if row != k {
                for j in 0..n {
                    self.factors.swap(k * n + j, row * n + j);
                }
                self.scales.swap(k, row);
            }
            let inverse = self.factors[k * n + k].recip();
            self.inverse_pivots[k] = inverse;
            let (upper, lower) = self.factors.split_at_mut((k + 1) * n);
            let pivot_row = &upper[k * n + k + 1..];
            for lower_row in lower.chunks_exact_mut(n) {
                if lower_row[k].size() == 0.0 {
                    continue;
                }
                let multiplier = lower_row[k] * inverse;
                lower_row[k] = multiplier;
                for (entry, &p) in lower_row[k + 1..].iter_mut().zip(pivot_row) {
                    *entry = *entry - multiplier * p;
                }
            }
        }
        true
    }

    /// b ← A⁻¹ b.
    pub(crate) fn solve(&self, b: &mut [S]) {
        let n = self.n;
        for k in 0..n {
            b.swap(k, self.pivots[k]);
        }
        for i in 1..n {
            let mut sum = b[i];
            for j in 0..i {
                sum = sum - self.factors[i * n + j] * b[j];
            }
            b[i] = sum;
        }
        for i in (0..n).rev() {
            let mut sum = b[i];
            for j in i + 1..n {
                sum = sum - self.factors[i * n + j] * b[j];
            }
            b[i] = sum * self.inverse_pivots[i];
        }
    }

    /// An estimate from below of ‖A⁻¹‖ for rows of these sizes, of the sizes of their largest entries without (Dixon 1983:
    /// ‖A⁻¹ b‖ for one vector b with entries of the rows' sizes).
    pub(crate) fn growth(&self, sizes: Option<&[f64]>, buffer: &mut [S]) -> f64 {
        let n = self.n;
        // Signs without a pattern keep b away from an invariant subspace.
        let sign = |i: usize| if (i * i + i / 2).is_multiple_of(3) { 1.0 } else { -1.0 };
        if let Some(sizes) = sizes {
            for i in 0..n {
                buffer[i] = S::one().times(sign(i) * sizes[i]);
            }
            self.solve(buffer);
            return crate::scalar::norm(buffer);
        }
        for i in 0..n {
            buffer[i] = S::one().times(sign(i) / self.scales[i]);
        }
        // Rows are already permuted: undo what `solve` will do.
        for k in (0..n).rev() {
            buffer.swap(k, self.pivots[k]);
        }
        self.solve(buffer);
        crate::scalar::norm(buffer)
    }

    /// The inverse, row by row.
    pub(crate) fn inverse(&self) -> Vec<S> {
        let n = self.n;
        let mut inverse = vec![S::zero(); n * n];
        let mut column = vec![S::zero(); n];
        for j in 0..n {
            column.fill(S::zero());
            column[j] = S::one();
            self.solve(&mut column);
            for i in 0..n {
                inverse[i * n + j] = column[i];
            }
        }
        inverse
    }
}

/// Unknowns below this, relative to the largest, count as zero: their relative change means nothing.
const NEGLIGIBLE: f64 = 1e-12;

/// Condition number κ∞ of the Jacobian `a` at `x`: unknowns in units of their moduli (of the largest one if negligible),
/// so that κ speaks of relative changes, then rows of unit largest entry.
pub(crate) fn condition<S: Field>(a: &[S], x: &[S]) -> f64 {
    let n = x.len();
    let largest = crate::scalar::norm(x);
    let unit = if largest > 0.0 { largest } else { 1.0 };
    let weights: Vec<f64> =
        x.iter().map(|z| if z.size() > NEGLIGIBLE * unit { z.size() } else { unit }).collect();
    let mut scaled = a.to_vec();
    for i in 0..n {
        let row = &mut scaled[i * n..(i + 1) * n];
        for (entry, w) in row.iter_mut().zip(&weights) {
            *entry = entry.times(*w);
        }
        let largest = crate::scalar::norm(row);
        if !(largest > 0.0 && largest.is_finite()) {
            return f64::INFINITY;
        }
        for entry in row {
            *entry = entry.times(1.0 / largest);
        }
    }
    let row_sum =
        |m: &[S]| m.chunks_exact(n).map(|r| r.iter().map(|z| z.size()).sum::<f64>()).fold(0.0, f64::max);
    let mut lu = Lu::new(n);
    if !lu.factor(&scaled) {
        return f64::INFINITY;
    }
    row_sum(&scaled) * row_sum(&lu.inverse())
}
