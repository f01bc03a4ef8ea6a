//! Forces with moments, and lines.
//!
//! ```text
//! $ = (f, m),   m' = m + (r - r') × f                    about r' instead of r
//! line through r₁ and r₂: (d, r₁ × d),  d = (r₂ - r₁)/|r₂ - r₁|      antiprism paper (42) to (44)
//! ```

use std::iter::Sum;
use std::ops::{Add, Mul};

use nalgebra::{SMatrix, SVector, Vector3};

use super::in_space;

/// A force and a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<const D: usize> {
    /// Force \[N\].
    pub force: SVector<f64, D>,
    /// Moment \[N m\] about the point that the context names; in the plane only its z component differs from zero.
    pub moment: Vector3<f64>,
}

impl<const D: usize> Wrench<D> {
    /// A force through the point that moments refer to.
    pub fn force(force: SVector<f64, D>) -> Self {
        Self { force, moment: Vector3::zeros() }
    }

    /// A pure moment.
    pub fn moment(moment: Vector3<f64>) -> Self {
        Self { force: SVector::zeros(), moment }
    }

    /// The same about another point.
    #[must_use]
    pub fn moved(&self, from: &SVector<f64, D>, to: &SVector<f64, D>) -> Self {
        let lever = in_space(&(from - to));
        Self { force: self.force, moment: self.moment + lever.cross(&in_space(&self.force)) }
    }
}

impl Wrench<3> {
    /// The same in another frame with the same origin; `axes` holds the frame's axes as columns.
    #[must_use]
    pub fn in_axes(&self, axes: &SMatrix<f64, 3, 3>) -> Self {
        Self { force: axes.tr_mul(&self.force), moment: axes.tr_mul(&self.moment) }
    }
}

impl<const D: usize> Default for Wrench<D> {
    fn default() -> Self {
        Self { force: SVector::zeros(), moment: Vector3::zeros() }
    }
}

impl<const D: usize> Add for Wrench<D> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { force: self.force + other.force, moment: self.moment + other.moment }
    }
}

impl<const D: usize> Mul<f64> for Wrench<D> {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { force: self.force * factor, moment: self.moment * factor }
    }
}

impl<const D: usize> Sum for Wrench<D> {
    fn sum<I: Iterator<Item = Self>>(iter: I) -> Self {
        iter.fold(Self::default(), Add::add)
    }
}

/// Unit Plücker coordinates of a directed line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line<const D: usize> {
    /// Unit direction.
    pub direction: SVector<f64, D>,
    /// Moment of the direction about the origin of space \[m\].
    pub moment: Vector3<f64>,
}

impl<const D: usize> Line<D> {
    /// The line from one point to another \[m\]; not finite where they coincide.
    pub fn through(from: &SVector<f64, D>, to: &SVector<f64, D>) -> Self {
        let direction = (to - from) / (to - from).norm();
        Self { direction, moment: in_space(from).cross(&in_space(&direction)) }
    }

    /// The wrench, about the origin of space, of a force along the line.
    pub fn times(&self, force: f64) -> Wrench<D> {
        Wrench { force: self.direction * force, moment: self.moment * force }
    }
}
