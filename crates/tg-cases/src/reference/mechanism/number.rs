//! What the model's formulas need of a number: a double, a dual number or an interval.

use std::ops::{Add, Div, Mul, Sub};

use num_dual::{Dual64, DualNum};

/// A number in which the derivatives of the potential can be evaluated.
pub(super) trait Number:
    Copy + From<f64> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Square root, of the part that is not negative.
    fn sqrt(self) -> Self;
    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);
    /// Square.
    fn square(self) -> Self {
        self * self
    }
    /// Of an interval, one longer by `by` at both ends; else the number itself.
    fn blurred(self, _by: f64) -> Self {
        self
    }
    /// Of an interval, what it has in common with one that holds the same number; else the number itself.
    fn sharpened(self, _other: Self) -> Self {
        self
    }
}

impl Number for f64 {
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    fn sin_cos(self) -> (Self, Self) {
        f64::sin_cos(self)
    }
}

impl Number for Dual64 {
    fn sqrt(self) -> Self {
        DualNum::sqrt(&self)
    }

    fn sin_cos(self) -> (Self, Self) {
        DualNum::sin_cos(&self)
    }
}
