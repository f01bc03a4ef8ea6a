//! All equilibria by homotopy from the natural-coordinate model, against the interval search.

use tg_equilibria::{EquilibriaOptions, EquilibriaReport, Family, Sweep, all_equilibria};

use super::{EXACT, Expected, SEARCH, nearest, sweep};
use crate::error::CaseError;
use crate::mechanism::{Case, FORCE, Mechanism, Parameters, Series};
use crate::row::Rows;

/// Mechanisms drawn at random beside the paper's.
const SEEDS: std::ops::Range<u64> = 0..10;
/// Steps of the sweep of L01.
const SAMPLES: u32 = 200;

/// Difference of an angle that rounding explains \[°\]: beside a cone, condition numbers reach 4e13, and the two models
/// round their coefficients differently.
const ANGLE: f64 = 1e-8;

const CERTIFIED: &str = "Krawczyk test, outward rounding";
const ACCOUNTED: &str = "every path is accounted for";

/// Finite complex solutions of a mechanism whose numbers are not special, by how many springs have a free length.
fn generic_count(parameters: &Parameters) -> usize {
    [6, 20, 62][parameters.rest.iter().filter(|&&rest| rest != 0.0).count()]
}

pub(super) fn rows(rows: &mut Rows, case: Case, expected: &Expected) -> Result<(), CaseError> {
    let parameters = Parameters::paper(case);
    let mechanism = Mechanism::new(&parameters)?;
    let (model, u) = (&mechanism.model, mechanism.model.inputs_at(0.0));
    let options = EquilibriaOptions::default();
    let report = all_equilibria(model, &u, &options)?;
    let name = format!("{}, homotopy", case.name());
    let finite = generic_count(&parameters);
    rows.exact(format!("{name}: certified complex solutions"), (report.certified, finite), EXACT);
    rows.exact(format!("{name}: paths that failed"), (report.failed, 0), ACCOUNTED);
    let unproved = report.rejected + report.undecided;
    rows.exact(format!("{name}: solutions without proof"), (unproved, 0), CERTIFIED);
    let radius = format!("{name}: largest certified radius");
    rows.below(radius, "1", report.largest_radius, CERTIFIED, 1e-10);
    let again = Family::new(model, &u, &options)?.query(&u)?;
    let what = format!("{name}: from a generic instance instead of a start system");
    rows.exact(what, (again.certified, report.certified), "two homotopies");

    let comparison = Comparison::new(&mechanism, &report, expected);
    for (what, count) in
        ["real solutions", "physical equilibria", "stable ones"].iter().zip(comparison.counts)
    {
        rows.exact(format!("{name}: {what}"), count, SEARCH);
    }
    rows.below(format!("{name}: largest difference of an angle"), "°", comparison.angle, SEARCH, ANGLE);
    rows.below(format!("{name}: largest difference of an energy"), "J", comparison.energy, SEARCH, 1e-10);
    Ok(())
}

/// What the homotopy and the search found on one mechanism.
#[derive(Clone, Copy, Debug)]
pub struct Comparison {
    /// Real, physical and stable solutions of both.
    pub counts: [(usize, usize); 3],
    /// Largest difference of an angle, of physical solutions or not \[°\].
    pub angle: f64,
    /// Largest difference of an energy of physical ones \[J\].
    pub energy: f64,
    /// As many certified solutions as such a mechanism has, and none in doubt.
    pub complete: bool,
}

impl Comparison {
    /// Solves a mechanism and compares.
    ///
    /// # Errors
    /// The mechanism cannot be built or solved.
    pub fn of(parameters: &Parameters, expected: &Expected) -> Result<Self, CaseError> {
        let mechanism = Mechanism::new(parameters)?;
        let u = mechanism.model.inputs_at(0.0);
        let report = all_equilibria(&mechanism.model, &u, &EquilibriaOptions::default())?;
        Ok(Self::new(&mechanism, &report, expected))
    }

    fn new(mechanism: &Mechanism, report: &EquilibriaReport, expected: &Expected) -> Self {
        let (mut angle, mut energy) = (0.0_f64, 0.0_f64);
        for found in &report.equilibria {
            let angles = mechanism.angles(&found.configuration.q).map(f64::to_degrees);
            let Some((known, distance)) = nearest(expected.all(), angles) else { continue };
            angle = angle.max(distance);
            if found.physical {
                energy = energy.max((known.energy - found.energy).abs());
            }
        }
        Self {
            counts: [
                (report.equilibria.len(), expected.all().count()),
                (report.physical().count(), expected.equilibria.len()),
                (report.stable().count(), expected.stable()),
            ],
            angle,
            energy,
            complete: report.accounts_for_all() && report.certified == generic_count(&mechanism.parameters),
        }
    }

    /// Whether both found the same.
    pub fn agrees(&self) -> bool {
        self.complete && self.counts.iter().all(|(a, b)| a == b) && self.angle < ANGLE && self.energy < 1e-10
    }
}

/// Mechanisms that nobody has chosen, two modules in series under load, and the sweep of L01.
pub(super) fn beyond(rows: &mut Rows) -> Result<(), CaseError> {
    let mut same = 0;
    for seed in SEEDS {
        let parameters = Parameters::random(seed);
        let comparison = Comparison::of(&parameters, &Expected::of(&parameters)?)?;
        same += usize::from(comparison.agrees());
    }
    let what = "random mechanisms: certified solutions as many as generic, real ones as searched";
    rows.exact(what, (same, SEEDS.count()), SEARCH);

    let series = Series::new(&Parameters::paper(Case::One), FORCE)?;
    let report = all_equilibria(&series.model, &series.model.inputs_at(0.0), &EquilibriaOptions::default())?;
    let name = "two modules in series under load";
    rows.exact(format!("{name}: certified complex solutions"), (report.certified, 52), EXACT);
    rows.exact(format!("{name}: paths that failed"), (report.failed, 0), ACCOUNTED);
    // On a torus they add up to nothing.
    let odd = report.physical().filter(|e| e.negative.is_some_and(|n| n % 2 == 1)).count();
    let even = (report.physical().count() - odd, odd);
    rows.exact(format!("{name}: even indices as many as odd ones"), even, "Poincaré and Hopf");
    folds(rows)
}

/// All equilibria for L01 up to 20 m with L02 = 0 (Fig. 4), certified.
///
/// # Errors
/// The mechanism cannot be built or solved.
pub fn certified_sweep() -> Result<Sweep, CaseError> {
    let mechanism = Mechanism::new(&Parameters::paper(Case::Two))?;
    let u = mechanism.model.inputs_at(0.0);
    let family = Family::new(&mechanism.model, &u, &EquilibriaOptions::default())?;
    let step = sweep::MOST / f64::from(SAMPLES);
    let values: Vec<f64> = (1..=SAMPLES).map(|k| step * f64::from(k)).collect();
    Ok(family.sweep(&u, 0, &values)?)
}

fn folds(rows: &mut Rows) -> Result<(), CaseError> {
    let found = certified_sweep()?;
    let known: Vec<f64> =
        sweep::paper()?.folds.iter().map(|fold| fold.rest).filter(|&rest| rest > 0.0).collect();
    rows.exact("sweep, homotopy: folds with d1 > 0", (found.folds.len(), known.len()), SEARCH);
    let apart = found.folds.iter().zip(&known).map(|(a, b)| (a.value - b).abs()).fold(0.0, f64::max);
    rows.below(
        "sweep, homotopy: largest difference of a fold",
        "m",
        apart,
        "extended system, two angles",
        1e-10,
    );
    let incomplete = found.samples.iter().filter(|(_, report)| !report.accounts_for_all()).count();
    rows.exact("sweep, homotopy: samples in doubt", (incomplete, 0), CERTIFIED);
    Ok(())
}
