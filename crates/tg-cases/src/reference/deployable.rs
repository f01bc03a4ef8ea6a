//! Example 3 (Sec. 6.3): statics and modes of the spatial deployable tower in twenty-four independent coordinates x.
//!
//! About an upright configuration, x = 0, with M and K from exact derivatives (dual and hyper-dual numbers):
//! ```text
//! V = Σ_j ½ κ_j max(l_j - μ_j, 0)² + Σ m g z          potential
//! T = Σ_tetrahedra ½ (m ċ·ċ + ω·(R I Rᵀ) ω) + Σ_bars m/6 (u·u + u·w + w·w)
//! ∂V/∂x = 0 in equilibrium;    M = ∂²T/∂ẋ∂ẋ,  K = ∂²V/∂x∂x,  K φ = (2πf)² M φ
//! ```
//! with c the mass centres, ω the angular velocities, u and w the velocities of a bar's ends. Child `figure`: the points as
//! functions of x.

mod figure;
#[cfg(test)]
mod tests;

use std::array::from_fn;
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use num_dual::{Dual64, HyperDual64};

use super::ReferenceError;
use figure::{Figure, Number};

/// Number of independent coordinates.
pub const COORDINATES: usize = 24;
/// Number of cables.
pub const CABLES: usize = 24;

/// Length b of a bar \[m\].
const BAR_LENGTH: f64 = 0.22;
/// Mass of a bar \[kg\].
const BAR: f64 = 0.08;
/// Mass of a tetrahedron \[kg\].
const TETRAHEDRON: f64 = 0.2999233976;
/// Height of its mass centre above its base \[m\].
const MASS_CENTRE: f64 = 0.1562442983 - 0.2 * FRAC_1_SQRT_2;
/// Its principal moments of inertia \[kg m²\].
const INERTIA: [f64; 3] = [7.6639282053e-4, 7.6638139752e-4, 1.2464720496e-3];
/// Acceleration of gravity \[m/s²\].
const GRAVITY: f64 = 9.81;
/// Stiffness κ of cables 1 to 9, and of 10 to 24 \[N/m\].
const KAPPA: [f64; 2] = [1000.0, 500.0];

/// Square matrix over the coordinates.
pub type Square = SMatrix<f64, COORDINATES, COORDINATES>;

/// The upright configurations of Table 5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Configuration {
    /// Folded.
    Initial,
    /// Unfolded.
    Target,
}

impl Configuration {
    /// Height of a stage of the prism and circumradius of its ring \[m\].
    fn stage(self) -> (f64, f64) {
        match self {
            Self::Initial => (0.1 * FRAC_1_SQRT_2, 0.11),
            Self::Target => (0.2 * FRAC_1_SQRT_2, 0.07),
        }
    }
}

/// The structure about an upright configuration, on resting ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model {
    configuration: Configuration,
    rest: [f64; CABLES],
}

/// Velocities that one coordinate's unit rate gives in the upright configuration.
struct Motion {
    /// Mass centres of the tetrahedra.
    centres: [Vector3<f64>; 4],
    /// Angular velocities of the tetrahedra.
    spins: [Vector3<f64>; 4],
    /// Ends of the bars.
    bars: [[Vector3<f64>; 2]; 6],
}

impl Model {
    /// The structure with the rest lengths μ of cables 1 to 24 \[m\].
    pub fn new(configuration: Configuration, rest: &[f64; CABLES]) -> Self {
        Self { configuration, rest: *rest }
    }

    /// V(x) \[J\], gravity's part zero on the ground.
    pub fn potential(&self, x: &[f64; COORDINATES]) -> f64 {
        self.energy(x)
    }

    /// ∂V/∂x at x = 0 \[N or N m\]: zero in equilibrium.
    pub fn gradient(&self) -> SVector<f64, COORDINATES> {
        SVector::from_fn(|a, _| self.energy(&along(a)).eps)
    }

    /// K = ∂²V/∂x∂x at x = 0.
    pub fn stiffness(&self) -> Square {
        Square::from_fn(|a, b| {
            let x = from_fn(|k| {
                let mut x = HyperDual64::from_re(0.0);
                x.eps1 = unit(k == a);
                x.eps2 = unit(k == b);
                x
            });
            self.energy(&x).eps1eps2
        })
    }

    /// M = ∂²T/∂ẋ∂ẋ at x = 0.
    pub fn mass_matrix(&self) -> Square {
        let upright = Figure::<f64>::new(self.configuration, &[0.0; COORDINATES]);
        let inertia = upright.bodies.map(|body| {
            body.rotation * Matrix3::from_diagonal(&Vector3::from(INERTIA)) * body.rotation.transpose()
        });
        let motions: [Motion; COORDINATES] = from_fn(|a| self.motion(a));
        Square::from_fn(|a, b| {
            let (a, b) = (&motions[a], &motions[b]);
            let body = |k: usize| {
                TETRAHEDRON * a.centres[k].dot(&b.centres[k]) + a.spins[k].dot(&(inertia[k] * b.spins[k]))
            };
            let bar = |([u, w], [p, q]): (&[Vector3<f64>; 2], &[Vector3<f64>; 2])| {
                BAR / 6.0 * (2.0 * u.dot(p) + u.dot(q) + w.dot(p) + 2.0 * w.dot(q))
            };
            (0..4).map(body).sum::<f64>() + a.bars.iter().zip(&b.bars).map(bar).sum::<f64>()
        })
    }

    /// The natural frequencies f \[Hz\], ascending; -|f| where (2πf)² is negative and the equilibrium unstable.
    ///
    /// # Errors
    /// [`ReferenceError::MassMatrix`], which the masses of this structure exclude.
    pub fn frequencies(&self) -> Result<[f64; COORDINATES], ReferenceError> {
        let cholesky = self.mass_matrix().cholesky().ok_or(ReferenceError::MassMatrix)?;
        let lower = cholesky.l();
        let half = lower.solve_lower_triangular(&self.stiffness()).ok_or(ReferenceError::MassMatrix)?;
        let reduced = lower.solve_lower_triangular(&half.transpose()).ok_or(ReferenceError::MassMatrix)?;
        let symmetric = (reduced + reduced.transpose()) * 0.5;
        let mut squares: [f64; COORDINATES] = symmetric.symmetric_eigenvalues().into();
        squares.sort_by(f64::total_cmp);
        Ok(squares.map(|square| square.abs().sqrt().copysign(square) / TAU))
    }

    fn energy<T: Number>(&self, x: &[T; COORDINATES]) -> T {
        let figure = Figure::new(self.configuration, x);
        let mut energy = T::from(0.0);
        for (k, [from, to]) in figure.cables().into_iter().enumerate() {
            let cable = to - from;
            let stretch = cable.dot(&cable).sqrt() - self.rest[k];
            if stretch.is_positive() {
                energy += stretch * stretch * (0.5 * KAPPA[usize::from(k >= 9)]);
            }
        }
        for body in &figure.bodies {
            energy += body.centre.z * (TETRAHEDRON * GRAVITY);
        }
        for [from, to] in figure.bars() {
            energy += (from.z + to.z) * (0.5 * BAR * GRAVITY);
        }
        energy
    }

    fn motion(&self, coordinate: usize) -> Motion {
        let figure = Figure::new(self.configuration, &along(coordinate));
        let rate = |v: Vector3<Dual64>| v.map(|x| x.eps);
        Motion {
            centres: figure.bodies.map(|body| rate(body.centre)),
            spins: figure.bodies.map(|body| {
                let spin = body.rotation.map(|x| x.eps) * body.rotation.map(|x| x.re).transpose();
                Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)])
            }),
            bars: figure.bars().map(|ends| ends.map(rate)),
        }
    }
}

/// The upright configuration moving along one coordinate.
fn along(coordinate: usize) -> [Dual64; COORDINATES] {
    from_fn(|k| Dual64::new(0.0, unit(k == coordinate)))
}

fn unit(on: bool) -> f64 {
    f64::from(u8::from(on))
}
