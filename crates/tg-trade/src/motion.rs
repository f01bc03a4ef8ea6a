//! What is looked at of a motion, and how far two motions are apart.

use tg_integrate::Summary;

use crate::errors::{Errors, Quantity};

/// Positions, tensions and energies at the times at which motions are compared, and what they cost.
#[derive(Clone, Debug, Default)]
pub struct Motion {
    /// Times \[s\].
    pub times: Vec<f64>,
    /// Coordinates of all basic points at each time \[m\].
    pub positions: Vec<f64>,
    /// Tensions of all cables at each time \[N\].
    pub tensions: Vec<f64>,
    /// Total energy at each time \[J\].
    pub energy: Vec<f64>,
    /// Coordinates of a point: the dimension.
    pub(crate) dimension: usize,
    /// Processor time of this thread \[s\], without the looks.
    pub seconds: f64,
    /// Totals of the run.
    pub summary: Summary,
}

/// Part of the time between two looks by which rounding may shift a look.
const SAME_TIME: f64 = 1e-3;

impl Motion {
    /// Largest differences of two motions; infinite where they were not looked at at the same times, or are not numbers.
    pub fn distance(&self, other: &Self) -> Errors {
        let alike = self.times.len() == other.times.len() && self.positions.len() == other.positions.len();
        let between = self.times.get(1).copied().unwrap_or(f64::INFINITY) * SAME_TIME;
        let same = |(a, b): (&f64, &f64)| (a - b).abs() <= between;
        if !(alike && self.times.iter().zip(&other.times).all(same)) {
            return Errors::all(f64::INFINITY);
        }
        let mut errors = Errors::all(0.0);
        errors[Quantity::Positions] = largest(&self.positions, &other.positions, self.dimension);
        errors[Quantity::Tensions] = largest(&self.tensions, &other.tensions, 1);
        errors[Quantity::Energy] = largest(&self.energy, &other.energy, 1);
        errors
    }

    /// How much each quantity varies: the largest displacement of a point from its start, the largest tension, and the largest
    /// energy against the one at the start.
    pub fn size(&self) -> Errors {
        let at_each = |values: &[f64]| {
            let one = values.len() / self.times.len().max(1);
            values[..one].repeat(self.times.len())
        };
        let mut size = Errors::all(0.0);
        size[Quantity::Positions] = largest(&self.positions, &at_each(&self.positions), self.dimension);
        size[Quantity::Tensions] =
            self.tensions.iter().fold(0.0, |largest, tension| largest.max(tension.abs()));
        size[Quantity::Energy] = self.energy.iter().fold(0.0, |largest, energy| largest.max(energy.abs()));
        size
    }

    /// This motion and `factor` times its difference from a coarser one, added: extrapolation.
    pub(crate) fn extrapolate(&self, coarser: &Self, factor: f64) -> Self {
        let mut motion = self.clone();
        let pairs = [
            (&mut motion.positions, &coarser.positions),
            (&mut motion.tensions, &coarser.tensions),
            (&mut motion.energy, &coarser.energy),
        ];
        for (fine, coarse) in pairs {
            fine.iter_mut().zip(coarse).for_each(|(fine, coarse)| *fine += factor * (*fine - coarse));
        }
        motion
    }
}

/// Largest length of the difference of vectors of `len` numbers; infinite where one is not a number.
fn largest(a: &[f64], b: &[f64], len: usize) -> f64 {
    let pieces = a.chunks_exact(len.max(1)).zip(b.chunks_exact(len.max(1)));
    pieces.fold(0.0, |largest: f64, (a, b)| {
        let squares = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b));
        let apart = squares.sum::<f64>().sqrt();
        // `max` would pass over what is not a number.
        if apart.is_nan() { f64::INFINITY } else { largest.max(apart) }
    })
}
