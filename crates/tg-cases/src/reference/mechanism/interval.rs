//! Interval arithmetic with outward rounding.
//!
//! The four operations and the root are correctly rounded, so one step outward encloses them. The cosine is taken as
//! right to one unit in the last place, as the usual libraries are; sin x = cos(x - π/2).

use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::{Add, Div, Mul, Sub};

use super::number::Number;

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// All numbers from `low` to `high`.
    pub(super) fn new(low: f64, high: f64) -> Self {
        Self { low, high }
    }

    fn outward(low: f64, high: f64) -> Self {
        Self { low: low.next_down(), high: high.next_up() }
    }

    /// A number between the ends, the middle but for rounding.
    pub fn middle(self) -> f64 {
        0.5 * (self.low + self.high)
    }

    /// Distance of the ends, rounded.
    pub fn width(self) -> f64 {
        self.high - self.low
    }

    pub(super) fn contains(self, x: f64) -> bool {
        (self.low..=self.high).contains(&x)
    }

    /// Whether `self` lies in `other` and touches neither end.
    pub(super) fn inside(self, other: Self) -> bool {
        other.low < self.low && self.high < other.high
    }

    /// What both have in common.
    pub(super) fn meet(self, other: Self) -> Option<Self> {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        (low <= high).then_some(Self { low, high })
    }

    /// Longer by a part of its width at both ends.
    pub(super) fn inflated(self, part: f64) -> Self {
        let by = part * self.width();
        Self { low: self.low - by, high: self.high + by }
    }

    fn cos(self) -> Self {
        if self.width() >= 2.0 * PI {
            return Self { low: -1.0, high: 1.0 };
        }
        let (a, b) = (self.low.cos(), self.high.cos());
        let (mut low, mut high) = (a.min(b).next_down().max(-1.0), a.max(b).next_up().min(1.0));
        // A multiple of π that rounding puts on the wrong side of an end changes the cosine by less than a step.
        let (mut turn, last) = ((self.low / PI).ceil(), self.high / PI);
        while turn <= last {
            if turn % 2.0 == 0.0 {
                high = 1.0
            } else {
                low = -1.0
            }
            turn += 1.0;
        }
        Self { low, high }
    }
}

impl From<f64> for Interval {
    fn from(x: f64) -> Self {
        Self { low: x, high: x }
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::outward(self.low + other.low, self.high + other.high)
    }
}

impl Sub for Interval {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::outward(self.low - other.high, self.high - other.low)
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let products =
            [self.low * other.low, self.low * other.high, self.high * other.low, self.high * other.high];
        let low = products.into_iter().fold(f64::INFINITY, f64::min);
        let high = products.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Self::outward(low, high)
    }
}

impl Div for Interval {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        if other.contains(0.0) {
            return Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
        }
        self * Self::outward(1.0 / other.high, 1.0 / other.low)
    }
}

impl Number for Interval {
    fn sqrt(self) -> Self {
        let low = if self.low <= 0.0 { 0.0 } else { self.low.sqrt().next_down() };
        Self { low, high: self.high.max(0.0).sqrt().next_up() }
    }

    fn sin_cos(self) -> (Self, Self) {
        let quarter = Self { low: FRAC_PI_2, high: FRAC_PI_2.next_up() };
        ((self - quarter).cos(), self.cos())
    }
    /// {x² : x in self}, never negative.
    fn square(self) -> Self {
        let (a, b) = (self.low * self.low, self.high * self.high);
        let low = if self.contains(0.0) { 0.0 } else { a.min(b).next_down() };
        Self { low, high: a.max(b).next_up() }
    }

    fn blurred(self, by: f64) -> Self {
        Self::outward(self.low - by, self.high + by)
    }

    fn sharpened(self, other: Self) -> Self {
        self.meet(other).unwrap_or(self)
    }
}
