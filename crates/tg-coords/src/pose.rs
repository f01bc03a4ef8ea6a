//! Where a member is and how it moves: the link between natural coordinates and a rigid motion.
//!
//! ```text
//! point   r = x + R r̄ ,    ṙ = ẋ + Ω R r̄
//! vector  u = R ū ,        u̇ = Ω R ū ,        Ṙ = Ω R,  Ω = -Ωᵀ
//! ```

use nalgebra::{Rotation3, SMatrix, SVector, Unit};

use crate::{CoordsError, ROUNDING_TOLERANCE};

/// Placement of a member's local frame.
///
/// The fields are open; [`new`](Self::new) and [`check`](Self::check) test the rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<const D: usize> {
    /// Position of the local frame's origin \[m\].
    pub position: SVector<f64, D>,
    /// Rotation R from local to global axes.
    pub rotation: SMatrix<f64, D, D>,
}

impl<const D: usize> Pose<D> {
    /// Pose with a checked rotation.
    ///
    /// # Errors
    /// See [`check`](Self::check).
    pub fn new(position: SVector<f64, D>, rotation: SMatrix<f64, D, D>) -> Result<Self, CoordsError> {
        let pose = Self { position, rotation };
        pose.check()?;
        Ok(pose)
    }

    /// The local frame as it is.
    pub fn identity() -> Self {
        Self::translation(SVector::zeros())
    }

    /// A pure shift \[m\].
    pub fn translation(position: SVector<f64, D>) -> Self {
        Self { position, rotation: SMatrix::identity() }
    }

    /// Tests that all numbers are finite and the rotation is orthonormal and right-handed.
    ///
    /// # Errors
    /// [`CoordsError::NotFinite`]; [`CoordsError::NotRotation`] if an entry of RᵀR − I exceeds
    /// [`ROUNDING_TOLERANCE`] or det R is negative.
    pub fn check(&self) -> Result<(), CoordsError> {
        if !self.position.iter().all(|x| x.is_finite()) {
            return Err(CoordsError::NotFinite { what: "position of the pose" });
        }
        let determinant = check_orthonormal(&self.rotation, "rotation of the pose")?;
        if determinant > 0.0 {
            return Ok(());
        }
        Err(CoordsError::NotRotation { what: "rotation of the pose", deviation: 0.0, determinant })
    }

    /// Position x + R r̄ of a material point \[m\].
    pub fn apply_point(&self, local: &SVector<f64, D>) -> SVector<f64, D> {
        self.position + self.rotation * local
    }

    /// Direction R ū of a vector fixed in the member.
    pub fn apply_vector(&self, local: &SVector<f64, D>) -> SVector<f64, D> {
        self.rotation * local
    }

    /// First `inner`, then `self`.
    pub fn compose(&self, inner: &Self) -> Self {
        Self { position: self.apply_point(&inner.position), rotation: self.rotation * inner.rotation }
    }
}

impl Pose<2> {
    /// Position \[m\] and angle \[rad\], counterclockwise.
    pub fn planar(x: f64, y: f64, angle: f64) -> Self {
        let (s, c) = angle.sin_cos();
        Self { position: SVector::from([x, y]), rotation: SMatrix::from([[c, s], [-s, c]]) }
    }

    /// Angle \[rad\] in (−π, π], counterclockwise.
    pub fn angle(&self) -> f64 {
        self.rotation[(1, 0)].atan2(self.rotation[(0, 0)])
    }
}

impl Pose<3> {
    /// Position \[m\] and rotation by `angle` \[rad\] about `axis` (any length), right-handed.
    ///
    /// # Errors
    /// [`CoordsError::ZeroAxis`], [`CoordsError::NotFinite`].
    pub fn from_axis_angle(
        position: SVector<f64, 3>,
        axis: SVector<f64, 3>,
        angle: f64,
    ) -> Result<Self, CoordsError> {
        let axis = direction(&axis, "axis of the rotation")?;
        let rotation = Rotation3::from_axis_angle(&Unit::new_unchecked(axis), angle);
        Self::new(position, rotation.into_inner())
    }
}

/// Velocity of a member's local frame, in global axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist<const D: usize> {
    /// Velocity ẋ of the local frame's origin \[m/s\].
    pub velocity: SVector<f64, D>,
    /// Skew spin Ω with Ṙ = Ω R \[rad/s\].
    pub spin: SMatrix<f64, D, D>,
}

impl<const D: usize> Twist<D> {
    /// At rest.
    pub fn zero() -> Self {
        Self { velocity: SVector::zeros(), spin: SMatrix::zeros() }
    }
}

impl Twist<2> {
    /// Velocity of the origin \[m/s\] and angular velocity \[rad/s\], counterclockwise.
    pub fn planar(velocity: SVector<f64, 2>, omega: f64) -> Self {
        Self { velocity, spin: SMatrix::from([[0.0, omega], [-omega, 0.0]]) }
    }

    /// Angular velocity \[rad/s\], counterclockwise.
    pub fn angular_velocity(&self) -> f64 {
        self.spin[(1, 0)]
    }
}

impl Twist<3> {
    /// Velocity of the origin \[m/s\] and angular velocity ω \[rad/s\], both in global axes.
    pub fn spatial(velocity: SVector<f64, 3>, omega: SVector<f64, 3>) -> Self {
        Self { velocity, spin: omega.cross_matrix() }
    }

    /// Angular velocity ω \[rad/s\] with Ω r = ω × r, in global axes.
    pub fn angular_velocity(&self) -> SVector<f64, 3> {
        SVector::from([self.spin[(2, 1)], self.spin[(0, 2)], self.spin[(1, 0)]])
    }
}

/// Pose that fits natural coordinates best, and how well.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseFit<const D: usize> {
    /// The best-fit pose.
    pub pose: Pose<D>,
    /// How far the coordinates are from rigid, dimensionless, zero for a rigid placement: `|F − R|/√D`
    /// (Frobenius) for a body, the root mean square of its principal strains; the relative change of
    /// length for a bar; always zero for a particle.
    pub misfit: f64,
}

/// Unit vector along `axis`.
pub(crate) fn direction<const D: usize>(
    axis: &SVector<f64, D>,
    what: &'static str,
) -> Result<SVector<f64, D>, CoordsError> {
    if !axis.iter().all(|x| x.is_finite()) {
        return Err(CoordsError::NotFinite { what });
    }
    let size = axis.amax();
    if size == 0.0 {
        return Err(CoordsError::ZeroAxis { what });
    }
    // Divided twice so that no square under- or overflows.
    Ok((axis / size).normalize())
}

/// Tests RᵀR = I and returns the sign of det R.
pub(crate) fn check_orthonormal<const D: usize>(
    matrix: &SMatrix<f64, D, D>,
    what: &'static str,
) -> Result<f64, CoordsError> {
    if !matrix.iter().all(|x| x.is_finite()) {
        return Err(CoordsError::NotFinite { what });
    }
    let deviation = (matrix.tr_mul(matrix) - SMatrix::identity()).amax();
    let determinant = determinant(matrix);
    if deviation <= ROUNDING_TOLERANCE {
        return Ok(determinant);
    }
    Err(CoordsError::NotRotation { what, deviation, determinant })
}

/// nalgebra's determinant needs a bound that generic code cannot state.
fn determinant<const D: usize>(m: &SMatrix<f64, D, D>) -> f64 {
    const { assert!(D == 2 || D == 3, "poses are of the plane or of space") };
    let mut columns = [SVector::zeros(); 3];
    for (k, column) in columns.iter_mut().take(D).enumerate() {
        *column = m.column(k).into_owned();
    }
    let last = columns[D - 1];
    crate::fit::normal(&columns).dot(&last)
}
