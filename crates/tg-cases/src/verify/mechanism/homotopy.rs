//! All equilibria by homotopy from the natural-coordinate model, against the interval search.

use tg_equilibria::{EquilibriaOptions, EquilibriaReport, all_equilibria};

use super::{EXACT, Expected, SEARCH, nearest};
use crate::error::CaseError;
use crate::mechanism::{Case, FORCE, Mechanism, Parameters, Series};

use crate::row::Rows;

/// Mechanisms drawn at random beside the paper's.
const SEEDS: std::ops::Range<u64> = 0..10;
const GENERIC: usize = 62;

pub(super) fn rows(rows: &mut Rows, case: Case, expected: &Expected) -> Result<(), CaseError> {
    let (mechanism, report) = solve(&Parameters::paper(case))?;
    let name = format!("{}, homotopy", case.name());
    let finite = match case {
        Case::One => 6,
        Case::Two => 20,
        Case::Three => GENERIC,
    };
    rows.exact(format!("{name}: certified complex solutions"), (report.certified, finite), EXACT);
    rows.exact(format!("{name}: paths that failed"), (report.failed, 0), "every path is accounted for");
    rows.exact(
        format!("{name}: solutions without proof"),
        (report.rejected + report.undecided, 0),
        "certification",
    );
    rows.below(
        format!("{name}: largest certified radius"),
        "1",
        report.largest_radius,
        "certification",
        1e-10,
    );
    rows.exact(format!("{name}: real solutions"), (report.equilibria.len(), expected.all().count()), SEARCH);
    rows.exact(
        format!("{name}: physical equilibria"),
        (report.physical().count(), expected.equilibria.len()),
        SEARCH,
    );
    rows.exact(format!("{name}: stable ones"), (report.stable().count(), expected.stable()), SEARCH);
    let (angle, energy) = largest_differences(&mechanism, &report, expected);
    rows.below(format!("{name}: largest difference of an angle"), "°", angle, SEARCH, 1e-10);
    rows.below(format!("{name}: largest difference of an energy"), "J", energy, SEARCH, 1e-10);
    Ok(())
}

/// Mechanisms that nobody has chosen, and two modules in series under load.
pub(super) fn beyond(rows: &mut Rows) -> Result<(), CaseError> {
    let (mut generic, mut same) = (0, 0);
    for seed in SEEDS {
        let parameters = Parameters::random(seed);
        let (_, report) = solve(&parameters)?;
        let expected = Expected::of(&parameters)?;
        generic += usize::from(report.certified == GENERIC && report.is_complete());
        let counts = (report.equilibria.len(), report.physical().count(), report.stable().count());
        same += usize::from(counts == (expected.all().count(), expected.equilibria.len(), expected.stable()));
    }
    let drawn = SEEDS.count();
    rows.exact("random mechanisms: all solutions certified, as many as generic", (generic, drawn), EXACT);
    rows.exact("random mechanisms: real, physical and stable ones as searched", (same, drawn), SEARCH);

    let series = Series::new(&Parameters::paper(Case::One), FORCE)?;
    let report = all_equilibria(&series.model, &series.model.inputs_at(0.0), &EquilibriaOptions::default())?;
    rows.exact(
        "two modules in series under load: certified complex solutions",
        (report.certified, 52),
        EXACT,
    );
    rows.exact(
        "two modules in series under load: paths that failed",
        (report.failed, 0),
        "every path is accounted for",
    );
    Ok(())
}

fn solve(parameters: &Parameters) -> Result<(Mechanism, EquilibriaReport), CaseError> {
    let mechanism = Mechanism::new(parameters)?;
    let u = mechanism.model.inputs_at(0.0);
    let report = all_equilibria(&mechanism.model, &u, &EquilibriaOptions::default())?;
    Ok((mechanism, report))
}

/// Of physical equilibria from those that the search found: an angle \[°\], an energy \[J\].
fn largest_differences(mechanism: &Mechanism, report: &EquilibriaReport, expected: &Expected) -> (f64, f64) {
    let mut worst = (0.0_f64, 0.0_f64);
    for found in report.physical() {
        let angles = mechanism.angles(&found.configuration.q).map(f64::to_degrees);
        let Some((known, distance)) = nearest(&expected.equilibria, angles) else {
            return (f64::NAN, f64::NAN);
        };
        worst = (worst.0.max(distance), worst.1.max((known.energy - found.energy).abs()));
    }
    worst
}
