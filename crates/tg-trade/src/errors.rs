//! Differences of two motions, one number for each quantity that is looked at.

use std::fmt;
use std::ops::{Index, IndexMut};

use serde::Serialize;

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Quantity {
    /// Positions of the members' basic points \[m\].
    Positions,
    /// Tensions of the cables \[N\].
    Tensions,
    /// Total energy \[J\].
    Energy,
}

impl Quantity {
    /// All, the one that accuracies are asked in first.
    pub const ALL: [Self; 3] = [Self::Positions, Self::Tensions, Self::Energy];

    /// The name in tables and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Positions => "positions",
            Self::Tensions => "tensions",
            Self::Energy => "energy",
        }
    }

    /// The SI unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Positions => "m",
            Self::Tensions => "N",
            Self::Energy => "J",
        }
    }
}

/// Its name.
impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// One number for each quantity: the largest difference over all points, cables and times \[m, N, J\]; infinite where a motion
/// is not a number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Errors {
    positions: f64,
    tensions: f64,
    energy: f64,
}

impl Errors {
    /// The same number for each quantity.
    pub fn all(value: f64) -> Self {
        Self { positions: value, tensions: value, energy: value }
    }

    /// Two such numbers to one, quantity by quantity.
    #[must_use]
    pub fn zip(mut self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        for quantity in Quantity::ALL {
            self[quantity] = f(self[quantity], other[quantity]);
        }
        self
    }
}

impl Index<Quantity> for Errors {
    type Output = f64;

    fn index(&self, quantity: Quantity) -> &f64 {
        match quantity {
            Quantity::Positions => &self.positions,
            Quantity::Tensions => &self.tensions,
            Quantity::Energy => &self.energy,
        }
    }
}

impl IndexMut<Quantity> for Errors {
    fn index_mut(&mut self, quantity: Quantity) -> &mut f64 {
        match quantity {
            Quantity::Positions => &mut self.positions,
            Quantity::Tensions => &mut self.tensions,
            Quantity::Energy => &mut self.energy,
        }
    }
}
