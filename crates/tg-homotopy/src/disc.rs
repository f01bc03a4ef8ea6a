//! Circular complex intervals: discs with a double-double midpoint and outward-rounded radius.
//!
//! ```text
//! ⟨a, r⟩ + ⟨b, s⟩ = ⟨a + b, r + s + ε⟩
//! ⟨a, r⟩ · ⟨b, s⟩ = ⟨a b, |a| s + |b| r + r s + ε⟩            Gargantini & Henrici (Numer. Math. 18, 1971)
//! ```
//!
//! ε bounds the rounding of the midpoint: 8u² |a + b| and 32u² |a| |b| + η, u = 2⁻⁵³ (`dd` gives 3u² and 5u² for real
//! sums and products; a complex product adds two products per part, (5 + 3)u² · √2 and the second-order terms stay below
//! 32u²). η = 10⁻²⁸⁰ covers underflow in the error-free product. Radii are rounded up with `next_up` after every operation.

use std::ops::{Add, Mul, Neg, Sub};

use num_complex::Complex64;

use crate::complex_dd::ComplexDd;
use crate::scalar::Scalar;

/// u² for u = 2⁻⁵³, exactly representable.
const U2: f64 = f64::EPSILON * f64::EPSILON / 4.0;
/// Absolute error allowed for underflow.
const ETA: f64 = 1e-280;

/// a + b rounded up.
#[inline(always)]
pub(crate) fn add_up(a: f64, b: f64) -> f64 {
    (a + b).next_up()
}

/// a b rounded up, for non-negative numbers.
#[inline(always)]
pub(crate) fn mul_up(a: f64, b: f64) -> f64 {
    (a * b).next_up()
}

/// An upper bound of |z|.
#[inline(always)]
pub(crate) fn modulus_up(z: ComplexDd) -> f64 {
    // |lo| is at most half an ulp of hi.
    let re = z.re.hi().abs().next_up();
    let im = z.im.hi().abs().next_up();
    add_up(mul_up(re, re), mul_up(im, im)).sqrt().next_up()
}

/// A lower bound of |z|.
pub(crate) fn modulus_down(z: ComplexDd) -> f64 {
    let re = z.re.hi().abs().next_down().max(0.0);
    let im = z.im.hi().abs().next_down().max(0.0);
    let square = ((re * re).next_down().max(0.0) + (im * im).next_down().max(0.0)).next_down().max(0.0);
    square.sqrt().next_down().max(0.0)
}

/// All complex numbers within `radius` of `mid`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Midpoint.
    pub mid: ComplexDd,
    /// Radius, ≥ 0.
    pub radius: f64,
}

impl Disc {
    /// The disc of all numbers within `radius` of `mid`.
    pub fn new(mid: ComplexDd, radius: f64) -> Self {
        Self { mid, radius }
    }

    /// The single number `mid`.
    pub fn exact(mid: ComplexDd) -> Self {
        Self { mid, radius: 0.0 }
    }

    /// An upper bound of the modulus of its members.
    pub fn magnitude(self) -> f64 {
        add_up(modulus_up(self.mid), self.radius)
    }

    /// Whether the two discs have no number in common, for certain.
    pub fn is_disjoint(self, other: Self) -> bool {
        let distance = Self::exact(self.mid) - Self::exact(other.mid);
        let lower = (modulus_down(distance.mid) - distance.radius).next_down();
        lower > add_up(self.radius, other.radius)
    }

    /// Whether this disc lies in the interior of the other, for certain.
    pub fn is_interior_to(self, other: Self) -> bool {
        let distance = Self::exact(self.mid) - Self::exact(other.mid);
        add_up(add_up(modulus_up(distance.mid), distance.radius), self.radius) < other.radius
    }

    /// The mirror image in the real axis.
    pub fn conj(self) -> Self {
        Self { mid: self.mid.conj(), radius: self.radius }
    }
}

impl Add for Disc {
    type Output = Self;
    #[inline]
    fn add(self, b: Self) -> Self {
        let mid = self.mid + b.mid;
        let rounding = mul_up(8.0 * U2, modulus_up(mid));
        Self { mid, radius: add_up(add_up(self.radius, b.radius), rounding) }
    }
}

impl Neg for Disc {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { mid: -self.mid, radius: self.radius }
    }
}

impl Sub for Disc {
    type Output = Self;
    #[inline]
    fn sub(self, b: Self) -> Self {
        self + (-b)
    }
}

impl Mul for Disc {
    type Output = Self;
    #[inline]
    fn mul(self, b: Self) -> Self {
        let mid = self.mid * b.mid;
        let (ma, mb) = (modulus_up(self.mid), modulus_up(b.mid));
        let cross = add_up(mul_up(ma, b.radius), mul_up(add_up(mb, b.radius), self.radius));
        let rounding = add_up(mul_up(32.0 * U2, mul_up(ma, mb)), ETA);
        Self { mid, radius: add_up(cross, rounding) }
    }
}

impl Scalar for Disc {
    fn zero() -> Self {
        Self::exact(ComplexDd::zero())
    }
    fn one() -> Self {
        Self::exact(ComplexDd::one())
    }
    fn from_c64(z: Complex64) -> Self {
        Self::exact(z.into())
    }
    fn times(self, factor: f64) -> Self {
        self * Self::from_c64(Complex64::new(factor, 0.0))
    }
}
