//! The numbers a polynomial system is evaluated with: doubles, double-doubles, discs.

use std::fmt::Debug;
use std::ops::{Add, Mul, Neg, Sub};

use num_complex::Complex64;

use crate::complex_dd::ComplexDd;
use crate::dd::Dd;

/// A ring of complex numbers, enough to evaluate polynomials.
pub trait Scalar:
    Copy + Debug + Send + Sync + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// Zero.
    fn zero() -> Self;
    /// One.
    fn one() -> Self;
    /// The number itself, exactly.
    fn from_c64(z: Complex64) -> Self;
    /// Product with a double.
    fn times(self, factor: f64) -> Self;
}

/// A [`Scalar`] with division and modulus, enough to solve linear systems.
pub trait Field: Scalar {
    /// Relative rounding error of one operation, a little above it.
    const EPSILON: f64;
    /// 1/z.
    fn recip(self) -> Self;
    /// |re| + |im|, the modulus within a factor √2; what pivots and norms use.
    fn size(self) -> f64;
    /// Rounded to doubles.
    fn to_c64(self) -> Complex64;
    /// Rounded from double-doubles.
    fn from_dd(z: ComplexDd) -> Self;
    /// The number in double-doubles.
    fn to_dd(self) -> ComplexDd;
}

impl Scalar for Complex64 {
    #[inline(always)]
    fn zero() -> Self {
        Self::new(0.0, 0.0)
    }
    #[inline(always)]
    fn one() -> Self {
        Self::new(1.0, 0.0)
    }
    #[inline(always)]
    fn from_c64(z: Complex64) -> Self {
        z
    }
    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        Self::new(self.re * factor, self.im * factor)
    }
}

impl Field for Complex64 {
    const EPSILON: f64 = 2.3e-16;
    #[inline(always)]
    fn recip(self) -> Self {
        self.inv()
    }
    #[inline(always)]
    fn size(self) -> f64 {
        self.re.abs() + self.im.abs()
    }
    #[inline(always)]
    fn to_c64(self) -> Complex64 {
        self
    }
    #[inline(always)]
    fn from_dd(z: ComplexDd) -> Self {
        z.to_c64()
    }
    #[inline(always)]
    fn to_dd(self) -> ComplexDd {
        self.into()
    }
}

impl Scalar for ComplexDd {
    #[inline(always)]
    fn zero() -> Self {
        Self::new(Dd::ZERO, Dd::ZERO)
    }
    #[inline(always)]
    fn one() -> Self {
        Self::new(Dd::ONE, Dd::ZERO)
    }
    #[inline(always)]
    fn from_c64(z: Complex64) -> Self {
        z.into()
    }
    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        Self::new(self.re.times(factor), self.im.times(factor))
    }
}

impl Field for ComplexDd {
    const EPSILON: f64 = 1e-31;
    #[inline]
    fn recip(self) -> Self {
        let square = self.re * self.re + self.im * self.im;
        let inverse = Dd::ONE / square;
        Self::new(self.re * inverse, -(self.im * inverse))
    }
    #[inline(always)]
    fn size(self) -> f64 {
        self.re.hi().abs() + self.im.hi().abs()
    }
    #[inline(always)]
    fn to_c64(self) -> Complex64 {
        ComplexDd::to_c64(self)
    }
    #[inline(always)]
    fn from_dd(z: ComplexDd) -> Self {
        z
    }
    #[inline(always)]
    fn to_dd(self) -> ComplexDd {
        self
    }
}

/// Largest [`Field::size`] of a vector.
#[inline]
pub(crate) fn norm<S: Field>(v: &[S]) -> f64 {
    // `f64::max` would hide a NaN.
    v.iter().fold(0.0, |m, z| {
        let s = z.size();
        if s > m || s.is_nan() { s } else { m }
    })
}
