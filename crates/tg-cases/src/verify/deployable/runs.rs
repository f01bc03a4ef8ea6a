//! Seismic runs from both static states (Sec. 6.3.2), and what must not matter to a run.

use std::array::from_fn;

use rayon::prelude::*;
use tg_coords::CoordType;

use super::{RESONANT, accuracy, still, top_path};
use crate::deployable::{Choices, Configuration, Deployable};
use crate::error::CaseError;
use crate::published::{SCHEME, framework};
use crate::row::Rows;
use crate::simulate::{STEP, distance, record, run};
use crate::slack::{SlackWatch, stretches};

/// Length of the paper's seismic runs (Fig. 20) \[s\].
const DURATION: f64 = 15.0;
const FIGURE: &str = "paper, Sec. 6.3.2";

pub(super) fn rows(rows: &mut Rows) -> Result<(), CaseError> {
    for configuration in Configuration::ALL {
        at_rest(rows, configuration)?;
    }
    first_steps(rows)?;
    let seismic = still(Configuration::Initial)?.on_seismic_ground(RESONANT);
    accuracy::rows(rows, "initial, ν = 0.5 Hz, 5 s", &seismic, &framework().example3.seismic)?;
    let (initial, target) = rayon::join(
        || Vibration::record(Configuration::Initial),
        || Vibration::record(Configuration::Target),
    );
    initial?.rows(rows);
    target?.rows(rows);
    invariance(rows, &seismic)
}

/// Both states are static with their rest lengths.
fn at_rest(rows: &mut Rows, configuration: Configuration) -> Result<(), CaseError> {
    let path = top_path(&still(configuration)?, STEP, 1.0)?;
    let drift = distance(&path, &vec![path[0]; path.len()]);
    let name = format!("{}, ground at rest: drift in 1 s", configuration.name());
    rows.below(name, "m", drift, "paper, Sec. 6.3.1: static", 1e-12);
    Ok(())
}

/// The first five steps of the scheme at h = 1e-3.
fn first_steps(rows: &mut Rows) -> Result<(), CaseError> {
    let structure = Deployable::new(&still(Configuration::Initial)?.on_seismic_ground(RESONANT))?;
    for (number, centre) in (7..).zip(&structure.centres) {
        let published = &framework().example3.first_steps[&number.to_string()];
        let points: Vec<[f64; 3]> =
            record(&structure.model, STEP, 5.0 * STEP, |state| centre.eval(&state.q).into())?;
        let name = format!("initial, ν = 0.5 Hz: tetrahedron {number}, largest distance in 5 steps");
        rows.below(name, "m", distance(&points[1..], &published[1..]), SCHEME, 1e-14);
    }
    Ok(())
}

/// The paths of all mass centres in a seismic run.
struct Vibration {
    name: &'static str,
    /// Displacements from the start \[m\] at each step: tetrahedra 7 to 10, x, y, z.
    displacements: Vec<[[f64; 3]; 4]>,
    /// Number of times that a cable went slack.
    slackenings: usize,
}

impl Vibration {
    fn record(configuration: Configuration) -> Result<Self, CaseError> {
        let structure = Deployable::new(&still(configuration)?.on_seismic_ground(RESONANT))?;
        let start = structure.model.initial_coordinates();
        let (mut displacements, mut watch) = (Vec::new(), SlackWatch::default());
        run(&structure.model, STEP, DURATION, |state| {
            watch.see(state.t, stretches(&structure.model, state));
            displacements.push(from_fn(|k| {
                let centre = &structure.centres[k];
                (centre.eval(&state.q) - centre.eval(&start)).into()
            }));
        })?;
        Ok(Self { name: configuration.name(), displacements, slackenings: watch.finish().len() })
    }

    /// Largest displacement of a tetrahedron along an axis in a part of the run \[m\].
    fn amplitude(&self, tetrahedron: usize, axis: usize, part: std::ops::Range<usize>) -> f64 {
        self.displacements[part].iter().map(|points| points[tetrahedron][axis].abs()).fold(0.0, f64::max)
    }

    fn rows(&self, rows: &mut Rows) {
        let (end, label) = (self.displacements.len(), format!("{}, ν = 0.5 Hz, 15 s", self.name));
        let last_third = 2 * end / 3..end;
        for (axis, d) in [("x", 0), ("z", 2)] {
            // No resonance: nowhere does the amplitude grow.
            let growth =
                |k| self.amplitude(k, d, last_third.clone()) / self.amplitude(k, d, 0..last_third.start);
            let worst = (0..4).map(growth).fold(0.0, f64::max);
            let name = format!("{label}: amplitude of {axis}, last third per earlier");
            rows.below(name, "1", worst, FIGURE, 1.0);
        }
        let worst =
            (0..4).map(|k| self.amplitude(k, 1, 0..end) / self.amplitude(k, 0, 0..end)).fold(0.0, f64::max);
        rows.below(format!("{label}: amplitude of y per that of x"), "1", worst, FIGURE, 0.1);
        rows.exact(
            format!("{label}: times a cable went slack"),
            (self.slackenings, 0),
            "expected: small vibrations",
        );
    }
}

/// The coordinate types of the tetrahedra change no path, nor does the way of joining: reversed, tetrahedron 7 has one
/// basic point only and bars 4 to 6 are joined to it by constraints.
fn invariance(rows: &mut Rows, seismic: &Choices) -> Result<(), CaseError> {
    use CoordType::{Rrrr, Rrrw, Rrvw, Ruvw};
    let variants = [
        ("the paper's types", seismic.types),
        ("all types RRRR", [Rrrr; 4]),
        ("types reversed", [Ruvw, Rrvw, Rrrw, Rrrr]),
    ];
    let path = |&(_, types): &(&str, _)| top_path(&Choices { types, ..seismic.clone() }, STEP, 5.0);
    let paths = variants.par_iter().map(path).collect::<Result<Vec<_>, _>>()?;
    for ((name, _), path) in variants.iter().zip(&paths).skip(1) {
        let name = format!("initial, ν = 0.5 Hz, 5 s, {name}: largest difference");
        rows.below(name, "m", distance(path, &paths[0]), "exact invariance", 1e-12);
    }
    Ok(())
}
