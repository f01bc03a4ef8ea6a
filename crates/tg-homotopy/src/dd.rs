//! Double-double numbers: an unevaluated sum hi + lo of two doubles with |lo| ≤ ulp(hi)/2, about 32 digits.
//!
//! ```text
//! two_sum(a, b) = (s, e)    s + e = a + b exactly                 Knuth
//! two_prod(a, b) = (p, e)   p + e = a b exactly                   Dekker 1971, or one fused multiply-add
//! (x + y)(1 + δ), |δ| ≤ 3u² + 13u³                                 AccurateDWPlusDW
//! (x y)(1 + δ),   |δ| ≤ 5u²                                        DWTimesDW1
//! ```
//!
//! with u = 2⁻⁵³; bounds by Joldes, Muller, Popescu (ACM TOMS 44, 2017) and Muller, Rideau (ACM TOMS 48, 2022), in the
//! absence of overflow and underflow. The discs of the certificate rest on them.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A double-double number.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dd {
    hi: f64,
    lo: f64,
}

/// s + e = a + b exactly.
#[inline(always)]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let bb = s - a;
    (s, (a - (s - bb)) + (b - bb))
}

/// As [`two_sum`], for |a| ≥ |b| or a = 0.
#[inline(always)]
fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// a = high + low, each of at most 26 bits.
#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    let t = 134_217_729.0 * a; // 2²⁷ + 1
    let high = t - (t - a);
    (high, a - high)
}

/// p + e = a b exactly.
#[inline(always)]
fn two_prod(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    // Without the instruction `mul_add` is a library call, slower than Dekker's splitting.
    if cfg!(target_feature = "fma") {
        return (p, a.mul_add(b, -p));
    }
    let (ah, al) = split(a);
    let (bh, bl) = split(b);
    (p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)
}

impl Dd {
    /// Zero.
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };
    /// One.
    pub const ONE: Self = Self { hi: 1.0, lo: 0.0 };

    /// The leading double: the number rounded to nearest.
    #[inline(always)]
    pub fn hi(self) -> f64 {
        self.hi
    }

    /// What is left beyond the leading double.
    #[inline(always)]
    pub fn lo(self) -> f64 {
        self.lo
    }

    /// Half of the number, exact.
    #[inline(always)]
    pub fn half(self) -> Self {
        Self { hi: 0.5 * self.hi, lo: 0.5 * self.lo }
    }

    /// Product with a double.
    #[inline(always)]
    pub fn times(self, b: f64) -> Self {
        let (p, e) = two_prod(self.hi, b);
        let (hi, lo) = quick_two_sum(p, e + self.lo * b);
        Self { hi, lo }
    }

    /// Square root of a non-negative number: one Newton step from the double.
    pub fn sqrt(self) -> Self {
        let root = self.hi.sqrt();
        if root == 0.0 {
            return Self::ZERO;
        }
        let rest = self - Self::from(root) * Self::from(root);
        Self::from(root) + Self::from(rest.hi / (2.0 * root))
    }
}

impl From<f64> for Dd {
    #[inline(always)]
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl Add for Dd {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        let (s, e) = two_sum(self.hi, b.hi);
        let (t, f) = two_sum(self.lo, b.lo);
        let (v, w) = quick_two_sum(s, e + t);
        let (hi, lo) = quick_two_sum(v, f + w);
        Self { hi, lo }
    }
}

impl Neg for Dd {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for Dd {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        self + (-b)
    }
}

impl Mul for Dd {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        let (p, e) = two_prod(self.hi, b.hi);
        let (hi, lo) = quick_two_sum(p, e + (self.hi * b.lo + self.lo * b.hi));
        Self { hi, lo }
    }
}

impl Div for Dd {
    type Output = Self;
    #[inline]
    fn div(self, b: Self) -> Self {
        let q1 = self.hi / b.hi;
        let r = self - b.times(q1);
        let q2 = r.hi / b.hi;
        let r = r - b.times(q2);
        let q3 = r.hi / b.hi;
        let (hi, lo) = quick_two_sum(q1, q2);
        Self { hi, lo } + Self::from(q3)
    }
}
