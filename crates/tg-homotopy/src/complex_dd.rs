//! Complex numbers whose parts are double-doubles.

use std::ops::{Add, Mul, Neg, Sub};

use num_complex::Complex64;

use crate::dd::Dd;

/// A complex number with about 32 digits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ComplexDd {
    /// Real part.
    pub re: Dd,
    /// Imaginary part.
    pub im: Dd,
}

impl ComplexDd {
    /// From its parts.
    #[inline(always)]
    pub fn new(re: Dd, im: Dd) -> Self {
        Self { re, im }
    }

    /// The complex conjugate.
    #[inline(always)]
    pub fn conj(self) -> Self {
        Self { re: self.re, im: -self.im }
    }

    /// Rounded to doubles.
    #[inline(always)]
    pub fn to_c64(self) -> Complex64 {
        Complex64::new(self.re.hi(), self.im.hi())
    }

    /// Half of the number, exact.
    #[inline(always)]
    pub fn half(self) -> Self {
        Self { re: self.re.half(), im: self.im.half() }
    }
}

impl From<Complex64> for ComplexDd {
    #[inline(always)]
    fn from(z: Complex64) -> Self {
        Self { re: Dd::from(z.re), im: Dd::from(z.im) }
    }
}

impl Add for ComplexDd {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self { re: self.re + b.re, im: self.im + b.im }
    }
}

impl Sub for ComplexDd {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self { re: self.re - b.re, im: self.im - b.im }
    }
}

impl Neg for ComplexDd {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}

impl Mul for ComplexDd {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        Self { re: self.re * b.re - self.im * b.im, im: self.re * b.im + self.im * b.re }
    }
}
