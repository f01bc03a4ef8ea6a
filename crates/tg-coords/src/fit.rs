//! Rotations that fit deformed coordinates best, and their rates.
//!
//! ```text
//! F = U Σ Vᵀ,  U, V ∈ SO(D), σ_D signed
//! R = U Vᵀ                         minimises |F - R| over SO(D)      (polar decomposition)
//! Ṙ = Ω R,  Ω = U Ω' Uᵀ,  Ω'_ij = (u_iᵀ Ḟ v_j - u_jᵀ Ḟ v_i)/(σ_i + σ_j)
//! ```
//!
//! The last line is the derivative of the second: with F = P R, P = U Σ Uᵀ, the skew part of
//! Ḟ Rᵀ = Ṗ + P Ω is ½ (P Ω + Ω P).

use nalgebra::{SMatrix, SVector};

use crate::coord_type::MAX_SPAN;
use crate::svd::Svd;

/// Below this sum of two singular values, relative to the largest, the rotation between their two
/// directions is decided by rounding.
const UNIQUE: f64 = 1e-12;

/// Decomposition of F with proper factors.
pub(crate) struct Polar<const D: usize> {
    left: [SVector<f64, D>; MAX_SPAN],
    right: [SVector<f64, D>; MAX_SPAN],
    /// σ, descending, the last signed.
    sigma: [f64; MAX_SPAN],
}

impl<const D: usize> Polar<D> {
    /// `None` if no rotation fits best: F has collapsed to a line, or is a reflection.
    pub(crate) fn new(f: &SMatrix<f64, D, D>) -> Option<Self> {
        let mut columns = [SVector::zeros(); MAX_SPAN];
        for (k, column) in columns.iter_mut().take(D).enumerate() {
            *column = f.column(k).into_owned();
        }
        let svd = Svd::new(&columns, D);
        let mut left = svd.left;
        let mut right = svd.right.map(|v| SVector::from_fn(|i, _| v[i]));
        left[D - 1] = normal(&left);
        right[D - 1] = normal(&right);
        let mut sigma = svd.values;
        sigma[D - 1] = left[D - 1].dot(&(f * right[D - 1]));
        let unique = sigma[D - 2] + sigma[D - 1] > UNIQUE * sigma[0];
        unique.then_some(Self { left, right, sigma })
    }

    /// R.
    pub(crate) fn rotation(&self) -> SMatrix<f64, D, D> {
        let mut r = SMatrix::zeros();
        for j in 0..D {
            r += self.left[j] * self.right[j].transpose();
        }
        r
    }

    /// |F − R|/√D.
    pub(crate) fn misfit(&self) -> f64 {
        let squares: f64 = self.sigma[..D].iter().map(|s| (s - 1.0).powi(2)).sum();
        (squares / D as f64).sqrt()
    }

    /// Ω for the rate Ḟ.
    pub(crate) fn spin(&self, rate: &SMatrix<f64, D, D>) -> SMatrix<f64, D, D> {
        let mut spin = SMatrix::zeros();
        for i in 0..D {
            for j in i + 1..D {
                let (ui, uj) = (&self.left[i], &self.left[j]);
                let skew = ui.dot(&(rate * self.right[j])) - uj.dot(&(rate * self.right[i]));
                let part = ui * uj.transpose() * (skew / (self.sigma[i] + self.sigma[j]));
                spin += part - part.transpose();
            }
        }
        spin
    }
}

/// Vector that completes the first D − 1 to a right-handed system.
pub(crate) fn normal<const D: usize>(v: &[SVector<f64, D>; MAX_SPAN]) -> SVector<f64, D> {
    let [a, b, _] = v;
    SVector::from_fn(|i, _| match D {
        2 => [-a[1], a[0]][i],
        _ => a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3],
    })
}

/// Rotation by the shortest arc from unit vector `from` to unit vector `to`; for opposite ones a half
/// turn about an arbitrary but fixed normal.
pub(crate) fn shortest_arc<const D: usize>(
    from: &SVector<f64, D>,
    to: &SVector<f64, D>,
) -> SMatrix<f64, D, D> {
    let cosine = from.dot(to);
    let mut side = to - from * cosine;
    let sine = side.norm();
    if sine <= 4.0 * f64::EPSILON {
        // No plane of rotation: take the coordinate axis farthest from `from`.
        side = SVector::zeros();
        side[from.iamin()] = 1.0;
    }
    side = side.normalize();
    // The first difference may be all rounding; once more makes `side` normal to working accuracy.
    side = (side - from * from.dot(&side)).normalize();
    let (c, s) = (cosine / cosine.hypot(sine), sine / cosine.hypot(sine));
    let turn = side * from.transpose();
    SMatrix::identity()
        + (from * from.transpose() + side * side.transpose()) * (c - 1.0)
        + (turn - turn.transpose()) * s
}
