//! The affine frame of a member in its local frame.
//!
//! ```text
//! X̄ = [ū v̄ w̄], [ū v̄] or [ū]                                        (A.1)
//! c = X̄⁺ (r̄ - r̄_i)                                                  (A.2)
//! F = [u v w] X̄⁺ ,   r = r_i + F (r̄ - r̄_i)          deformation gradient of any coordinates
//! ```

use nalgebra::{SMatrix, SVector};

use crate::coord_type::{MAX_NODES, MAX_SPAN};
use crate::svd::Svd;
use crate::{CoordType, CoordsError, ROUNDING_TOLERANCE, Weights};

/// Largest accepted condition number of X̄ (eq. A.1), about ε^(-1/2).
///
/// The mass matrix (A.3) contains X̄⁺ twice, so its relative error grows as cond(X̄)² ε and reaches
/// one here: beyond it the mass matrix has no correct digit in its worst direction. Base vectors
/// of body size that point in clearly different directions give 1 to 100.
pub const CONDITION_LIMIT: f64 = 1e8;

/// X̄ and its pseudoinverse.
#[derive(Clone, Debug)]
pub(crate) struct Basis<const D: usize> {
    coord_type: CoordType,
    /// r̄_i.
    origin: SVector<f64, D>,
    /// ū, v̄, w̄; the first `span`.
    vectors: [SVector<f64, D>; MAX_SPAN],
    /// Rows of X̄⁺.
    inverse: [SVector<f64, D>; MAX_SPAN],
    condition: f64,
}

impl<const D: usize> Basis<D> {
    /// From nodes already counted and finite.
    pub(crate) fn new(coord_type: CoordType, nodes: &[SVector<f64, D>]) -> Result<Self, CoordsError> {
        let span = coord_type.span();
        let mut vectors = [SVector::zeros(); MAX_SPAN];
        for (k, vector) in vectors.iter_mut().take(span).enumerate() {
            *vector = coord_type.base_vector(nodes, k);
        }
        let svd = Svd::new(&vectors, span);
        let condition = svd.condition();
        if condition.is_nan() || condition > CONDITION_LIMIT {
            return Err(CoordsError::DegenerateBasis { coord_type, condition, limit: CONDITION_LIMIT });
        }
        let mut inverse = [SVector::zeros(); MAX_SPAN];
        for (k, row) in inverse.iter_mut().take(span).enumerate() {
            for j in 0..span {
                *row += svd.left[j] * (svd.right[j][k] / svd.values[j]);
            }
        }
        Ok(Self { coord_type, origin: nodes[0], vectors, inverse, condition })
    }

    pub(crate) fn condition(&self) -> f64 {
        self.condition
    }

    pub(crate) fn origin(&self) -> &SVector<f64, D> {
        &self.origin
    }

    /// ū, v̄, w̄ as far as they exist.
    pub(crate) fn vectors(&self) -> &[SVector<f64, D>] {
        &self.vectors[..self.coord_type.span()]
    }

    /// Rows of X̄⁺.
    pub(crate) fn inverse(&self) -> &[SVector<f64, D>] {
        &self.inverse[..self.coord_type.span()]
    }

    /// Weights of a material point: `[1, cᵀ] y`.
    pub(crate) fn point(&self, local: &SVector<f64, D>, what: &'static str) -> Result<Weights, CoordsError> {
        let rounding = 16.0 * f64::EPSILON * local.amax().max(self.origin.amax());
        let c = self.coefficients(&(local - self.origin), &self.origin, rounding, what)?;
        Ok(self.weights(1.0, c))
    }

    /// Weights of a vector fixed in the member: `[0, cᵀ] y`.
    pub(crate) fn vector(&self, local: &SVector<f64, D>, what: &'static str) -> Result<Weights, CoordsError> {
        let c = self.coefficients(local, &SVector::zeros(), 0.0, what)?;
        Ok(self.weights(0.0, c))
    }

    /// c of (A.2) for an offset from `base`; an error if the span does not contain the offset.
    fn coefficients(
        &self,
        offset: &SVector<f64, D>,
        base: &SVector<f64, D>,
        rounding: f64,
        what: &'static str,
    ) -> Result<[f64; MAX_SPAN], CoordsError> {
        if !offset.iter().all(|x| x.is_finite()) {
            return Err(CoordsError::NotFinite { what });
        }
        let c: [f64; MAX_SPAN] = core::array::from_fn(|k| self.inverse[k].dot(offset));
        let span = self.coord_type.span();
        if span < D {
            let inside = self.vectors[0] * c[0];
            let distance = (offset - inside).norm();
            if span == 0 && distance > rounding {
                return Err(CoordsError::OffParticle { what, distance });
            }
            let length = self.vectors[0].norm().max(offset.norm());
            if span == 1 && distance > ROUNDING_TOLERANCE * length + rounding {
                return Err(CoordsError::OffAxis {
                    what,
                    distance,
                    nearest: (base + inside).iter().copied().collect(),
                });
            }
        }
        Ok(c)
    }

    fn weights(&self, first: f64, c: [f64; MAX_SPAN]) -> Weights {
        let standard: [f64; MAX_NODES] = [first, c[0], c[1], c[2]];
        Weights::from_slice(&standard[..self.coord_type.nodes()]).times(&self.coord_type.conversion())
    }

    /// F of the base vectors of `nodes`.
    pub(crate) fn deformation(&self, nodes: &[SVector<f64, D>]) -> SMatrix<f64, D, D> {
        let mut f = SMatrix::zeros();
        for (k, row) in self.inverse().iter().enumerate() {
            f += self.coord_type.base_vector(nodes, k) * row.transpose();
        }
        f
    }
}
