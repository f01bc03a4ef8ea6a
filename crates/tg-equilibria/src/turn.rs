//! How a member's points and base vectors turn, as affine functions of its rotation's variables.
//!
//! ```text
//! plane             z b, z̄ b̄                                            isotropic coordinates
//! about an axis a   a (a·b) + ½ (z + z̄) b⊥ + ½ i (z̄ - z) a × b           b⊥ = b - a (a·b)
//! bar               d (b·d⁰)                                             d⁰ its direction at first
//! body              (e₀² - v·v) b + 2 v (v·b) + 2 e₀ v × b               e = (e₀, v)
//! ```

use nalgebra::{SVector, Vector3};
use tg_homotopy::Complex64;

use crate::affine::Form;
use crate::variable::{PAIRS, Rotation};

const I: Complex64 = Complex64::new(0.0, 1.0);

/// A member's rotation with what it needs of the initial configuration.
pub(crate) enum Turn<const D: usize> {
    /// The supports hold all points and vectors of it.
    None,
    /// In the plane.
    Plane { z: usize },
    /// In space about a fixed axis, a unit vector.
    Axis { z: usize, axis: Vector3<f64> },
    /// A bar in space.
    Bar { first: usize, direction: SVector<f64, D> },
    /// A body in space.
    Body { first: usize },
}

impl<const D: usize> Turn<D> {
    /// The rotation's variables.
    pub(crate) fn rotation(&self) -> Option<Rotation> {
        match *self {
            Self::None => None,
            Self::Plane { z } | Self::Axis { z, .. } => Some(Rotation::Angle(z)),
            Self::Bar { first, .. } => Some(Rotation::Direction(first)),
            Self::Body { first } => Some(Rotation::Quaternion(first)),
        }
    }

    /// The D sides of a vector that was `arm` at first.
    pub(crate) fn turned(&self, arm: &SVector<f64, D>) -> Vec<Form> {
        match *self {
            Self::None => sides(arm).into_iter().map(Form::constant).collect(),
            Self::Plane { z } => {
                let arm = sides(arm);
                let side = |k: usize| Form { constant: 0.0.into(), terms: vec![(z + k, arm[k])] };
                vec![side(0), side(1)]
            }
            Self::Axis { z, axis } => {
                let arm = Vector3::new(arm[0], arm[1], arm[2]);
                let along = axis * axis.dot(&arm);
                let (across, turned) = (arm - along, axis.cross(&arm));
                let side = |k: usize| {
                    let (cos, sin) = (across[k] * 0.5, I * (turned[k] * 0.5));
                    Form { constant: along[k].into(), terms: vec![(z, cos - sin), (z + 1, cos + sin)] }
                };
                (0..3).map(side).collect()
            }
            Self::Bar { first, ref direction } => {
                let length = arm.dot(direction);
                let side = |k: usize| Form { constant: 0.0.into(), terms: vec![(first + k, length.into())] };
                (0..D).map(side).collect()
            }
            Self::Body { first } => {
                let arm = Vector3::new(arm[0], arm[1], arm[2]);
                let columns: Vec<Vector3<f64>> = PAIRS.iter().map(|&pair| product(pair, &arm)).collect();
                let side = |k: usize| {
                    let terms = columns.iter().enumerate().map(|(at, column)| (first + at, column[k].into()));
                    Form { constant: 0.0.into(), terms: terms.filter(|(_, c)| *c != I * 0.0).collect() }
                };
                (0..3).map(side).collect()
            }
        }
    }
}

/// The coefficient of e_a e_b in R(e) b.
fn product((a, b): (usize, usize), arm: &Vector3<f64>) -> Vector3<f64> {
    let unit = |k: usize| Vector3::from_fn(|r, _| if r + 1 == k { 1.0 } else { 0.0 });
    match (a, b) {
        (0, 0) => *arm,
        (0, b) => 2.0 * unit(b).cross(arm),
        (a, b) if a == b => 2.0 * unit(a) * unit(a).dot(arm) - arm,
        (a, b) => 2.0 * (unit(a) * unit(b).dot(arm) + unit(b) * unit(a).dot(arm)),
    }
}

/// A vector in the coordinates that the polynomials use: x + i y and x - i y in the plane, x, y, z in space.
pub(crate) fn sides<const D: usize>(x: &SVector<f64, D>) -> Vec<Complex64> {
    match D {
        2 => vec![Complex64::new(x[0], x[1]), Complex64::new(x[0], -x[1])],
        _ => x.iter().map(|&x| x.into()).collect(),
    }
}

/// The Cartesian coordinate `axis` as a combination of sides: (side, coefficient).
pub(crate) fn cartesian<const D: usize>(axis: usize) -> Vec<(usize, Complex64)> {
    match (D, axis) {
        (2, 0) => vec![(0, 0.5.into()), (1, 0.5.into())],
        (2, _) => vec![(0, -I * 0.5), (1, I * 0.5)],
        _ => vec![(axis, 1.0.into())],
    }
}
