//! Folds of the equilibria as L01 varies.
//!
//! ```text
//! ∂V(γ, L01) = 0,   ∂²V(γ, L01) v = 0,   v·v = 1          Moore and Spence's extended system
//! ```
//! Newton's method solves it from every equilibrium at closely spaced L01; the derivatives of ∂²V are exact (dual
//! numbers). That no fold is missing shows in the counts: by the exhaustive search they change by two at each fold.

use nalgebra::{SMatrix, SVector};
use num_dual::Dual64;

use super::super::ReferenceError;
use super::{Model, wrapped};

const MOST_ITERATIONS: usize = 30;
/// Longest step of Newton's method that may still come back \[m or rad\].
const FARTHEST: f64 = 1e3;
/// Distance within which two solutions are one fold \[m or rad\].
const SAME: f64 = 1e-7;

/// Two equilibria meet and vanish.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fold {
    /// L01 \[m\]; negative on the branch d1 < 0.
    pub rest: f64,
    /// γ1, γ2 \[rad\].
    pub angles: [f64; 2],
    /// Largest of ∂V \[J/rad\] and ∂²V v \[J/rad²\] that is left.
    pub residual: f64,
}

/// Folds over a range of L01.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The folds, by L01.
    pub folds: Vec<Fold>,
    /// Numbers of equilibria: before the first fold, between one and the next, and after the last.
    pub counts: Vec<usize>,
    /// Boxes that the searches left undecided.
    pub undecided: usize,
}

impl Model {
    /// Folds for L01 from `range.0` to `range.1` \[m\], started from the equilibria at `samples` of them.
    ///
    /// # Errors
    /// As [`Model::search`].
    pub fn sweep(&self, range: (f64, f64), samples: usize) -> Result<Sweep, ReferenceError> {
        let mut folds: Vec<Fold> = Vec::new();
        let mut undecided = 0;
        for k in 0..samples {
            let rest = range.0 + (range.1 - range.0) * (k as f64 + 0.5) / samples as f64;
            let found = self.with_rest(rest).search()?;
            undecided += found.undecided.len();
            for start in &found.equilibria {
                let Some(fold) = self.fold(start.angles, rest) else { continue };
                let inside = range.0 < fold.rest && fold.rest < range.1;
                if inside && !folds.iter().any(|other| same(other, &fold)) {
                    folds.push(fold);
                }
            }
        }
        folds.sort_by(|a, b| a.rest.total_cmp(&b.rest));
        let mut ends = vec![range.0];
        ends.extend(folds.iter().map(|fold| fold.rest));
        ends.push(range.1);
        let mut counts = Vec::new();
        for pair in ends.windows(2) {
            let found = self.with_rest(0.5 * (pair[0] + pair[1])).search()?;
            undecided += found.undecided.len();
            counts.push(found.equilibria.len());
        }
        Ok(Sweep { folds, counts, undecided })
    }

    /// The same with another L01 \[m\].
    #[must_use]
    pub fn with_rest(&self, rest: f64) -> Self {
        Self { rest: [rest, self.rest[1]], ..*self }
    }

    /// The fold that Newton's method reaches from these angles and L01.
    pub fn fold(&self, angles: [f64; 2], rest: f64) -> Option<Fold> {
        let lowest = self.with_rest(rest).hessian(angles).symmetric_eigen();
        let k = lowest.eigenvalues.map(f64::abs).imin();
        let v = lowest.eigenvectors.column(k);
        let mut x = SVector::<f64, 5>::from([angles[0], angles[1], rest, v[0], v[1]]);
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let (value, jacobian) = self.extended(&x);
            let step = jacobian.lu().solve(&value)?;
            if step.amax().is_nan() || step.amax() > FARTHEST {
                return None;
            }
            if step.amax() < 1e-9 && step.amax() >= 0.5 * last || step.amax() == 0.0 {
                let angles = [wrapped(x[0]), wrapped(x[1])];
                return Some(Fold { rest: x[2], angles, residual: value.amax() });
            }
            x -= step;
            last = step.amax();
        }
        None
    }

    /// The extended system and its Jacobian.
    fn extended(&self, x: &SVector<f64, 5>) -> (SVector<f64, 5>, SMatrix<f64, 5, 5>) {
        let mut value = SVector::zeros();
        let mut jacobian = SMatrix::zeros();
        for column in 0..5 {
            let d = |k: usize| Dual64::new(x[k], f64::from(u8::from(k == column)));
            let rest = [d(2), Dual64::from(self.rest[1])];
            // A free length of exactly zero would be taken for a spring that never has one.
            let model = self.with_rest(if x[2] == 0.0 { f64::MIN_POSITIVE } else { x[2] });
            let ([g1, g2], [a, b, c]) = model.derivatives([d(0), d(1)], rest);
            let v = [d(3), d(4)];
            let all = [
                g1,
                g2,
                a * v[0] + b * v[1],
                b * v[0] + c * v[1],
                v[0] * v[0] + v[1] * v[1] - Dual64::from(1.0),
            ];
            for (row, entry) in all.iter().enumerate() {
                value[row] = entry.re;
                jacobian[(row, column)] = entry.eps;
            }
        }
        (value, jacobian)
    }
}

fn same(a: &Fold, b: &Fold) -> bool {
    let apart = |i: usize| wrapped(a.angles[i] - b.angles[i]).abs();
    (a.rest - b.rest).abs().max(apart(0)).max(apart(1)) < SAME
}
