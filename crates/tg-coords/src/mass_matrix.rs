//! The constant mass matrix, a scalar matrix over nodes ⊗ I_D.
//!
//! ```text
//! M_std = [ m    m cᵀ ] ,   c = X̄⁺ d,   E = X̄⁺ (J + m d dᵀ) X̄⁺ᵀ,   d = r̄_g - r̄_i      (18b), (A.3)
//!         [ m c    E  ]
//! M = yᵀ M_std y                                                                    (18c)
//! ```
//!
//! (A.3) is printed for r̄_g = 0; here the local frame is arbitrary.

use nalgebra::SMatrix;

use crate::basis::Basis;
use crate::{CoordType, CoordsError, MassProperties, NodeMatrix, ROUNDING_TOLERANCE};

/// Scalar mass matrix \[kg where both nodes are points\], M ⊗ I_D over coordinates (eq. 18).
pub type MassMatrix = NodeMatrix;

/// Assembles M for a mass centre already known to lie on the member.
pub(crate) fn mass_matrix<const D: usize>(
    coord_type: CoordType,
    basis: &Basis<D>,
    mass: &MassProperties<D>,
) -> Result<MassMatrix, CoordsError> {
    let m = mass.mass();
    let d = mass.centre() - basis.origin();
    let j = carried_second_moment(coord_type, basis, mass)?;
    let about_origin = j + d * d.transpose() * m;
    let rows = basis.inverse();
    let standard = NodeMatrix::from_fn(coord_type.nodes(), |a, b| match (a, b) {
        (0, 0) => m,
        (0, k) | (k, 0) => m * rows[k - 1].dot(&d),
        _ => rows[a - 1].dot(&(about_origin * rows[b - 1])),
    });
    let matrix = standard.congruence(&coord_type.conversion());
    if matrix.is_finite() { Ok(matrix) } else { Err(CoordsError::NotFinite { what: "mass matrix" }) }
}

/// J as far as the member can carry it.
fn carried_second_moment<const D: usize>(
    coord_type: CoordType,
    basis: &Basis<D>,
    mass: &MassProperties<D>,
) -> Result<SMatrix<f64, D, D>, CoordsError> {
    let j = mass.second_moment();
    let trace = j.trace();
    match coord_type.span() {
        0 if j.amax() > 0.0 => Err(CoordsError::ExtendedParticle { trace }),
        1 => {
            let u = basis.vectors()[0];
            let axis = (u / u.amax()).normalize();
            let along = axis * axis.transpose();
            if D == 2 {
                // Only I_z = tr J enters a planar motion: all of it may lie along the axis.
                return Ok(along * trace);
            }
            let axial = axis.dot(&(j * axis));
            let rest = (j - along * axial).norm();
            if rest > ROUNDING_TOLERANCE * trace {
                return Err(CoordsError::ThickBar { axial, rest });
            }
            Ok(along * axial)
        }
        _ => Ok(j),
    }
}
