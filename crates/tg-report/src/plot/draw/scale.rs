//! From values to places along an axis: the values themselves, or their powers of ten.

use super::{drawable, range, widened};
use crate::plot::Axis;
use crate::ticks::{minus, ticks};

/// How an axis is divided.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    logarithmic: bool,
}

impl Scale {
    pub(super) const LINEAR: Self = Self { logarithmic: false };

    pub(super) fn of(axis: &Axis) -> Self {
        Self { logarithmic: axis.logarithmic }
    }

    pub(super) fn is_logarithmic(self) -> bool {
        self.logarithmic
    }

    /// Where a value is; not a number, or infinite, where it has no place.
    pub(super) fn place(self, value: f64) -> f64 {
        if self.logarithmic { value.log10() } else { value }
    }

    pub(super) fn has(self, value: f64) -> bool {
        drawable(value) && drawable(self.place(value))
    }

    /// The places that values take, with room at the ends.
    pub(super) fn span<'a>(self, values: impl Iterator<Item = &'a f64>, room: f64) -> [f64; 2] {
        let places: Vec<f64> = values.map(|&value| self.place(value)).collect();
        widened(range(places.iter()), room)
    }

    /// About `wanted` places with their texts: round numbers, or whole powers of ten, and twos and fives where these are few.
    pub(super) fn ticks(self, [low, high]: [f64; 2], wanted: usize) -> Vec<(f64, String)> {
        if !self.logarithmic {
            return ticks(low, high, wanted);
        }
        let (first, last) = (low.floor() as i32, high.ceil() as i32);
        let every = ((high - low) / wanted.max(1) as f64).ceil().max(1.0) as i32;
        let between: &[u8] = if high - low < 2.0 { &[1, 2, 5] } else { &[1] };
        let powers = (first..=last).filter(|power| power.rem_euclid(every) == 0);
        let values = powers.flat_map(|power| between.iter().map(move |&digit| (digit, power)));
        values
            .map(|(digit, power)| {
                (f64::from(digit).log10() + f64::from(power), minus(format!("{digit}e{power}")))
            })
            .filter(|(place, _)| (low..=high).contains(place))
            .collect()
    }
}
