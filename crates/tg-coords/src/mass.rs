//! Mass, mass centre and second moment of mass of a member, in its local frame.
//!
//! ```text
//! J = ∫ρ (r̄ - r̄_g)(r̄ - r̄_g)ᵀ dΩ                                     (A.4), (A.6)
//! J = ½ tr(I) I_3 - I    in space (I: inertia matrix, A.5)
//! I_z = tr J             in the plane
//! ```
//!
//! J is positive semidefinite; in space that is the triangle inequality of the moments of inertia.
//! Unlike in the paper the local frame need be neither central nor principal.

use nalgebra::{DMatrix, SMatrix, SVector};

use crate::pose::{check_orthonormal, direction};
use crate::{CoordsError, ROUNDING_TOLERANCE};

/// Mass properties of a member in its local frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties<const D: usize> {
    mass: f64,
    centre: SVector<f64, D>,
    second_moment: SMatrix<f64, D, D>,
}

impl<const D: usize> MassProperties<D> {
    /// Mass \[kg\], mass centre \[m\] and second moment J about it \[kg m²\] (A.4, A.6).
    ///
    /// # Errors
    /// Non-finite numbers, a mass that is not positive, a J that is not symmetric or has a negative
    /// eigenvalue.
    pub fn from_second_moment(
        mass: f64,
        centre: SVector<f64, D>,
        second_moment: SMatrix<f64, D, D>,
    ) -> Result<Self, CoordsError> {
        check_mass(mass)?;
        let second_moment = symmetric(&second_moment, "second moment of mass")?;
        let (eigenvalues, size) = eigenvalues(&second_moment);
        if eigenvalues[0] < -ROUNDING_TOLERANCE * size {
            return Err(CoordsError::NegativeSecondMoment { eigenvalue: eigenvalues[0] });
        }
        Self::unchecked(mass, centre, second_moment)
    }

    /// Uniform thin rod between two points \[m\]: J = m L²/12 along its axis.
    ///
    /// # Errors
    /// Non-finite numbers, a mass that is not positive.
    pub fn thin_rod(mass: f64, from: SVector<f64, D>, to: SVector<f64, D>) -> Result<Self, CoordsError> {
        check_mass(mass)?;
        let along = to - from;
        Self::unchecked(mass, from + along / 2.0, along * along.transpose() * (mass / 12.0))
    }

    /// Thin rod of any distribution: `inertia` \[kg m²\] is its moment about a transverse axis
    /// through the mass centre, `axis` its direction (any length).
    ///
    /// # Errors
    /// Non-finite numbers, an axis of zero length, a mass that is not positive, a negative inertia.
    pub fn rod(
        mass: f64,
        centre: SVector<f64, D>,
        axis: SVector<f64, D>,
        inertia: f64,
    ) -> Result<Self, CoordsError> {
        check_mass(mass)?;
        let axis = direction(&axis, "axis of the rod")?;
        if inertia < 0.0 {
            return Err(CoordsError::NegativeSecondMoment { eigenvalue: inertia });
        }
        Self::unchecked(mass, centre, axis * axis.transpose() * inertia)
    }

    /// All mass in one point \[m\].
    ///
    /// # Errors
    /// Non-finite numbers, a mass that is not positive.
    pub fn point(mass: f64, at: SVector<f64, D>) -> Result<Self, CoordsError> {
        check_mass(mass)?;
        Self::unchecked(mass, at, SMatrix::zeros())
    }

    /// No mass, for statics; the centre \[m\] is the reference point of [`Member::pose`](crate::Member::pose).
    ///
    /// # Errors
    /// A centre that is not finite.
    pub fn massless(centre: SVector<f64, D>) -> Result<Self, CoordsError> {
        Self::unchecked(0.0, centre, SMatrix::zeros())
    }

    /// Tests that the numbers are finite and nothing else.
    fn unchecked(
        mass: f64,
        centre: SVector<f64, D>,
        second_moment: SMatrix<f64, D, D>,
    ) -> Result<Self, CoordsError> {
        if !centre.iter().all(|x| x.is_finite()) {
            return Err(CoordsError::NotFinite { what: "mass centre" });
        }
        if !second_moment.iter().all(|x| x.is_finite()) {
            return Err(CoordsError::NotFinite { what: "second moment of mass" });
        }
        Ok(Self { mass, centre, second_moment })
    }

    /// m \[kg\].
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Mass centre r̄_g, local \[m\].
    pub fn centre(&self) -> SVector<f64, D> {
        self.centre
    }

    /// Second moment J about the mass centre, local axes \[kg m²\].
    pub fn second_moment(&self) -> SMatrix<f64, D, D> {
        self.second_moment
    }
}

impl MassProperties<2> {
    /// Body in the plane from its polar moment I_z about the mass centre \[kg m²\].
    ///
    /// Only tr J = I_z enters a rigid motion, so J is split evenly: diag(I_z/2, I_z/2).
    ///
    /// # Errors
    /// Non-finite numbers, a mass that is not positive, a negative moment.
    pub fn from_polar_moment(
        mass: f64,
        centre: SVector<f64, 2>,
        polar_moment: f64,
    ) -> Result<Self, CoordsError> {
        Self::from_second_moment(mass, centre, SMatrix::identity() * (polar_moment / 2.0))
    }

    /// I_z = tr J about the mass centre \[kg m²\].
    pub fn polar_moment(&self) -> f64 {
        self.second_moment.trace()
    }
}

impl MassProperties<3> {
    /// Body in space from its inertia matrix about the mass centre, local axes \[kg m²\] (A.5, with
    /// minus signs on the products of inertia).
    ///
    /// # Errors
    /// Non-finite numbers, a mass that is not positive, a matrix that is not symmetric or whose
    /// moments violate the triangle inequality.
    pub fn from_inertia_matrix(
        mass: f64,
        centre: SVector<f64, 3>,
        inertia: SMatrix<f64, 3, 3>,
    ) -> Result<Self, CoordsError> {
        check_mass(mass)?;
        let inertia = symmetric(&inertia, "inertia matrix")?;
        // The diagonal first: its message is in the user's axes.
        let diagonal = [inertia[(0, 0)], inertia[(1, 1)], inertia[(2, 2)]];
        triangle_inequality(diagonal, ["I_yy + I_zz < I_xx", "I_xx + I_zz < I_yy", "I_xx + I_yy < I_zz"])?;
        let (principal, _) = eigenvalues(&inertia);
        triangle_inequality(
            [principal[0], principal[1], principal[2]],
            ["I_2 + I_3 < I_1", "I_1 + I_3 < I_2", "I_1 + I_2 < I_3"],
        )?;
        Self::unchecked(mass, centre, second_moment_of(&inertia))
    }

    /// Body in space from its principal moments about the mass centre \[kg m²\], the local axes
    /// being principal.
    ///
    /// # Errors
    /// Non-finite numbers, a mass that is not positive, moments that violate the triangle inequality.
    pub fn from_principal_moments(
        mass: f64,
        centre: SVector<f64, 3>,
        moments: [f64; 3],
    ) -> Result<Self, CoordsError> {
        Self::from_principal_axes(mass, centre, moments, SMatrix::identity())
    }

    /// Body in space from its principal moments about the mass centre \[kg m²\]; the columns of
    /// `axes` are the principal axes in the local frame.
    ///
    /// # Errors
    /// As [`from_principal_moments`](Self::from_principal_moments), and axes that are not orthonormal.
    pub fn from_principal_axes(
        mass: f64,
        centre: SVector<f64, 3>,
        moments: [f64; 3],
        axes: SMatrix<f64, 3, 3>,
    ) -> Result<Self, CoordsError> {
        check_mass(mass)?;
        if !moments.iter().all(|x| x.is_finite()) {
            return Err(CoordsError::NotFinite { what: "moment of inertia" });
        }
        triangle_inequality(moments, ["I_y + I_z < I_x", "I_x + I_z < I_y", "I_x + I_y < I_z"])?;
        check_orthonormal(&axes, "matrix of principal axes")?;
        let principal = SMatrix::from_diagonal(&SVector::from(moments));
        Self::unchecked(mass, centre, axes * second_moment_of(&principal) * axes.transpose())
    }

    /// Inertia matrix about the mass centre, local axes: I = tr(J) I_3 − J \[kg m²\].
    pub fn inertia_matrix(&self) -> SMatrix<f64, 3, 3> {
        SMatrix::identity() * self.second_moment.trace() - self.second_moment
    }
}

/// J = ½ tr(I) I_3 − I.
fn second_moment_of(inertia: &SMatrix<f64, 3, 3>) -> SMatrix<f64, 3, 3> {
    SMatrix::identity() * (inertia.trace() / 2.0) - inertia
}

fn check_mass(mass: f64) -> Result<(), CoordsError> {
    if !mass.is_finite() {
        return Err(CoordsError::NotFinite { what: "mass" });
    }
    if mass <= 0.0 {
        return Err(CoordsError::Mass { mass });
    }
    Ok(())
}

/// Tests symmetry and returns the symmetric part.
fn symmetric<const D: usize>(
    matrix: &SMatrix<f64, D, D>,
    what: &'static str,
) -> Result<SMatrix<f64, D, D>, CoordsError> {
    if !matrix.iter().all(|x| x.is_finite()) {
        return Err(CoordsError::NotFinite { what });
    }
    let size = matrix.amax();
    let difference = (matrix - matrix.transpose()).amax();
    if difference > ROUNDING_TOLERANCE * size {
        return Err(CoordsError::NotSymmetric { what, asymmetry: difference / size });
    }
    Ok((matrix + matrix.transpose()) / 2.0)
}

/// `names[k]` says that moment k exceeds the sum of the other two.
fn triangle_inequality(moments: [f64; 3], names: [&'static str; 3]) -> Result<(), CoordsError> {
    let size = moments.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (k, violated) in names.into_iter().enumerate() {
        let others = moments[(k + 1) % 3] + moments[(k + 2) % 3];
        if others - moments[k] < -ROUNDING_TOLERANCE * size {
            return Err(CoordsError::TriangleInequality { violated, moments });
        }
    }
    Ok(())
}

/// Eigenvalues of a finite symmetric matrix, ascending, and its largest entry.
fn eigenvalues<const D: usize>(matrix: &SMatrix<f64, D, D>) -> (Vec<f64>, f64) {
    let size = matrix.amax();
    if size == 0.0 {
        return (vec![0.0; D], size);
    }
    let scaled = DMatrix::from_fn(D, D, |i, j| matrix[(i, j)] / size);
    let mut values: Vec<f64> = scaled.symmetric_eigenvalues().iter().map(|v| v * size).collect();
    values.sort_by(f64::total_cmp);
    (values, size)
}
