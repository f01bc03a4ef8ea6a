//! The antiprism paper's virtual work in its own coordinates, in millimetres and newtons.
//!
//! ```text
//! x = (a_j, b_j if the feet slide, ε_j, β_j) for struts j = 1..n
//! E_j = (a_j, b_j, 0),  r_j(l) = E_j + l (sin β_j, -sin ε_j cos β_j, cos ε_j cos β_j)                  (6) to (8)
//! V = Σ ½ k (w - w_0)² - Σ F_j·r_j(L_F) - Σ (M_εj ε_j + M_βj β_j)                                    (17), (22), (23)
//! f = -∂V/∂x = 0 in equilibrium (31);  stable where ∂²V/∂x∂x has no negative eigenvalue
//! ```
//! Derivatives are exact: dual and hyper-dual numbers.

#[cfg(test)]
mod tests;

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector, Vector3};
use num_dual::{Dual64, DualNum, HyperDual64};

use super::ReferenceError;

/// Part of the largest eigenvalue up to which one counts as zero: the plane's rigid motions come out below 1e-13.
const ZERO: f64 = 1e-12;
const MOST_ITERATIONS: usize = 100;

/// A number with or without derivatives.
trait Number: DualNum<Primitive = f64> + Copy {}

impl<T: DualNum<Primitive = f64> + Copy> Number for T {}

/// A structure with its loads.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Length L_s of the struts \[mm\].
    pub length: f64,
    /// Stiffness \[N/mm\] and free length \[mm\] of top, bottom and lateral ties.
    pub ties: [(f64, f64); 3],
    /// Places (a_j, b_j) of the feet \[mm\], if they are fixed; else they slide.
    pub feet: Option<Vec<[f64; 2]>>,
    /// Force on each strut \[N\] and its distance L_F from the foot \[mm\].
    pub forces: Vec<([f64; 3], f64)>,
    /// M_ε and M_β on each strut \[N mm\].
    pub moments: Vec<[f64; 2]>,
}

impl Model {
    /// Number of struts n.
    pub fn struts(&self) -> usize {
        self.moments.len()
    }

    /// Number of coordinates: 4n, or 2n with fixed feet.
    pub fn coordinates(&self) -> usize {
        self.struts() * if self.feet.is_some() { 2 } else { 4 }
    }

    /// The coordinates x at which the struts have these ends (foot, top) \[mm\].
    pub fn at(&self, ends: &[[Vector3<f64>; 2]]) -> Vec<f64> {
        let of = |[foot, top]: &[Vector3<f64>; 2]| {
            let u = top - foot;
            let angles = [(-u.y).atan2(u.z), u.x.atan2(u.y.hypot(u.z))];
            match self.feet {
                Some(_) => angles.to_vec(),
                None => vec![foot.x, foot.y, angles[0], angles[1]],
            }
        };
        ends.iter().flat_map(of).collect()
    }

    /// Ends (foot, top) of the struts \[mm\].
    pub fn ends(&self, x: &[f64]) -> Vec<[Vector3<f64>; 2]> {
        (0..self.struts()).map(|j| [self.point(x, j, 0.0), self.point(x, j, self.length)]).collect()
    }

    /// V \[N mm\].
    pub fn potential(&self, x: &[f64]) -> f64 {
        self.energy(x)
    }

    /// ∂V/∂x \[N or N mm\].
    pub fn gradient(&self, x: &[f64]) -> DVector<f64> {
        self.slope(x, false)
    }

    /// ∂²V/∂x∂x.
    pub fn hessian(&self, x: &[f64]) -> DMatrix<f64> {
        self.curvature(x, false)
    }

    fn slope(&self, x: &[f64], symmetric: bool) -> DVector<f64> {
        DVector::from_fn(x.len(), |a, _| {
            let x: Vec<Dual64> =
                x.iter().enumerate().map(|(k, &x)| Dual64::new(x, f64::from(u8::from(k == a)))).collect();
            self.value(&x, symmetric).eps
        })
    }

    fn curvature(&self, x: &[f64], symmetric: bool) -> DMatrix<f64> {
        DMatrix::from_fn(x.len(), x.len(), |a, b| {
            let number = |(k, &x): (usize, &f64)| {
                let mut number = HyperDual64::from_re(x);
                number.eps1 = f64::from(u8::from(k == a));
                number.eps2 = f64::from(u8::from(k == b));
                number
            };
            let x: Vec<HyperDual64> = x.iter().enumerate().map(number).collect();
            self.value(&x, symmetric).eps1eps2
        })
    }

    /// Numbers of negative and of zero eigenvalues of the Hessian.
    pub fn signs(&self, x: &[f64]) -> (usize, usize) {
        let values = self.hessian(x).symmetric_eigenvalues();
        let zero = ZERO * values.amax();
        (values.iter().filter(|&&v| v < -zero).count(), values.iter().filter(|&&v| v.abs() <= zero).count())
    }

    /// Smallest |eigenvalue| of the Hessian that is not a rigid motion's, per the largest: zero at critical points.
    pub fn criticality(&self, x: &[f64]) -> f64 {
        let values = self.hessian(x).symmetric_eigenvalues();
        let mut sizes: Vec<f64> = values.iter().map(|v| v.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        let rigid = if self.feet.is_some() { 0 } else { 3 };
        sizes[rigid] / values.amax()
    }

    /// The equilibrium that full Newton steps reach from `start`; motions of the whole on the plane are left out.
    ///
    /// # Errors
    /// [`ReferenceError::Equilibrium`] where they do not converge.
    pub fn equilibrium(&self, start: &[f64]) -> Result<Vec<f64>, ReferenceError> {
        self.newton(start, false)
    }

    /// The equilibrium in which every strut is the one before it, turned by γ; from the radius of the feet \[mm\] and the
    /// first strut's ε and β. Where branches without the symmetry cross, this one is followed past them.
    ///
    /// # Errors
    /// As [`Model::equilibrium`].
    pub fn symmetric_equilibrium(&self, start: [f64; 3]) -> Result<Vec<f64>, ReferenceError> {
        Ok(self.spread(&self.newton(&start, true)?))
    }

    fn newton(&self, start: &[f64], symmetric: bool) -> Result<Vec<f64>, ReferenceError> {
        let mut x = DVector::from_column_slice(start);
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let gradient = self.slope(x.as_slice(), symmetric);
            let eigen = self.curvature(x.as_slice(), symmetric).symmetric_eigen();
            let zero = ZERO * eigen.eigenvalues.amax();
            let mut step = DVector::zeros(x.len());
            for (value, shape) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
                if value.abs() > zero {
                    step += shape * (shape.dot(&gradient) / value);
                }
            }
            // Quadratic convergence has ended where a tiny step does not become smaller.
            let size = step.amax();
            if size < 1e-9 && size >= 0.5 * last || size == 0.0 {
                return Ok(x.as_slice().to_vec());
            }
            x -= step;
            last = size;
        }
        Err(ReferenceError::Equilibrium { residual: self.slope(x.as_slice(), symmetric).amax() })
    }

    fn point<T: Number>(&self, x: &[T], j: usize, distance: f64) -> Vector3<T> {
        let (foot, angles) = match &self.feet {
            Some(feet) => ([T::from(feet[j][0]), T::from(feet[j][1])], [x[2 * j], x[2 * j + 1]]),
            None => ([x[4 * j], x[4 * j + 1]], [x[4 * j + 2], x[4 * j + 3]]),
        };
        let [(se, ce), (sb, cb)] = angles.map(|angle| (angle.sin(), angle.cos()));
        Vector3::new(sb * distance + foot[0], -se * cb * distance + foot[1], ce * cb * distance)
    }

    fn value<T: Number>(&self, x: &[T], symmetric: bool) -> T {
        if symmetric { self.energy(&self.spread(x)) } else { self.energy(x) }
    }

    /// x of sliding struts around the axis, from the feet's radius and the first strut's angles.
    fn spread<T: Number>(&self, symmetric: &[T]) -> Vec<T> {
        let (radius, eps, beta) = (symmetric[0], symmetric[1], symmetric[2]);
        let u = [beta.sin(), -eps.sin() * beta.cos(), eps.cos() * beta.cos()];
        let n = self.struts();
        let strut = |j: usize| {
            let (sin, cos) = (TAU * j as f64 / n as f64).sin_cos();
            let (x, y) = (u[0] * cos - u[1] * sin, u[0] * sin + u[1] * cos);
            [radius * cos, radius * sin, (-y).atan2(u[2]), x.asin()]
        };
        (0..n).flat_map(strut).collect()
    }

    fn energy<T: Number>(&self, x: &[T]) -> T {
        let n = self.struts();
        let stretch = |a: Vector3<T>, b: Vector3<T>, (k, free): (f64, f64)| {
            let d = b - a;
            let stretch = (d.x * d.x + d.y * d.y + d.z * d.z).sqrt() - free;
            stretch * stretch * (0.5 * k)
        };
        let mut energy = T::from(0.0);
        for j in 0..n {
            let (foot, top) = (self.point(x, j, 0.0), self.point(x, j, self.length));
            let next = [0.0, self.length].map(|l| self.point(x, (j + 1) % n, l));
            energy += stretch(top, next[1], self.ties[0]);
            energy += stretch(foot, next[0], self.ties[1]);
            energy += stretch(top, next[0], self.ties[2]);
            let (force, distance) = self.forces[j];
            let r = self.point(x, j, distance);
            energy -= r.x * force[0] + r.y * force[1] + r.z * force[2];
            let at = if self.feet.is_some() { 2 * j } else { 4 * j + 2 };
            energy -= x[at] * self.moments[j][0] + x[at + 1] * self.moments[j][1];
        }
        energy
    }
}
