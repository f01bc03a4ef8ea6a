//! Scale invariance: the same structure written down in other units of length, mass and time (in millimetres, kilometres or
//! nanometres, heavier, faster) gives the same dimensionless results. An absolute tolerance or length somewhere in the
//! library would show here.

mod equilibria;
mod statics;
mod stepping;
mod structures;

use std::error::Error;

/// Units that a structure's dimensionless description is multiplied by: all numbers that enter and leave the library.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Units {
    /// \[m\]
    pub(crate) length: f64,
    /// \[kg\]
    pub(crate) mass: f64,
    /// \[s\]
    pub(crate) time: f64,
}

/// Where every number stands as it is described.
const METRES: Units = Units { length: 1.0, mass: 1.0, time: 1.0 };

/// Similar structures: in millimetres and kilometres, from nanometres to thousands of kilometres, with masses and times that
/// fit or do not.
const OTHERS: [Units; 7] = [
    Units { length: 1e-3, mass: 1.0, time: 1.0 },
    Units { length: 1e3, mass: 1.0, time: 1.0 },
    Units { length: 1.0, mass: 1e-8, time: 1e2 },
    Units { length: 1.0, mass: 1e8, time: 1e-3 },
    Units { length: 1e-9, mass: 1e-24, time: 1e-7 },
    Units { length: 1e6, mass: 1e15, time: 1e3 },
    Units { length: 1e3, mass: 1e-6, time: 1e-5 },
];

/// Difference of dimensionless results, per the largest of them.
const SAME: f64 = 1e-9;

type Outcome<T> = Result<T, Box<dyn Error>>;

impl Units {
    pub(crate) fn acceleration(self) -> f64 {
        self.length / (self.time * self.time)
    }

    pub(crate) fn force(self) -> f64 {
        self.mass * self.acceleration()
    }

    pub(crate) fn stiffness(self) -> f64 {
        self.mass / (self.time * self.time)
    }

    pub(crate) fn damping(self) -> f64 {
        self.mass / self.time
    }

    pub(crate) fn energy(self) -> f64 {
        self.force() * self.length
    }

    /// A vector of lengths.
    pub(crate) fn place<const D: usize>(self, x: [f64; D]) -> [f64; D] {
        x.map(|x| x * self.length)
    }
}

/// Numbers per their unit.
pub(crate) fn per(unit: f64, numbers: impl IntoIterator<Item = f64>) -> Vec<f64> {
    numbers.into_iter().map(|x| x / unit).collect()
}

/// Asserts that lists of dimensionless numbers, each list of one size, are the same in all units.
#[track_caller]
fn assert_similar(name: &str, results: impl Fn(Units) -> Outcome<Vec<Vec<f64>>>) {
    let reference = results(METRES).unwrap();
    assert!(reference.iter().flatten().all(|x| x.is_finite()), "{name}");
    let mut failed = Vec::new();
    for units in OTHERS {
        match results(units) {
            Ok(found) if difference(&found, &reference) < SAME => {}
            Ok(found) => failed.push(format!("{units:?}: {:.1e}", difference(&found, &reference))),
            Err(error) => failed.push(format!("{units:?}: {error}")),
        }
    }
    assert!(failed.is_empty(), "{name}: {failed:#?}");
}

/// Largest difference of a list per its largest number; infinite where lists differ in length.
fn difference(ours: &[Vec<f64>], theirs: &[Vec<f64>]) -> f64 {
    let lengths = |lists: &[Vec<f64>]| lists.iter().map(Vec::len).collect::<Vec<_>>();
    if lengths(ours) != lengths(theirs) {
        return f64::INFINITY;
    }
    let of_list = |(ours, theirs): (&Vec<f64>, &Vec<f64>)| {
        let size = theirs.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        let apart = ours.iter().zip(theirs).map(|(a, b)| (a - b).abs());
        let largest = apart.fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a });
        if largest == 0.0 { 0.0 } else { largest / size }
    };
    ours.iter().zip(theirs).map(of_list).fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a })
}
