//! The natural-coordinate model at every equilibrium of the two-angle model.

use tg_statics::{Configuration, Verdict, stability};

use super::Expected;
use crate::error::CaseError;
use crate::mechanism::{Case, Mechanism, Parameters};
use crate::row::Rows;

/// Length below which a spring turns rounding into force \[m\].
const SHORT: f64 = 0.1;
const ANGLES: &str = "two-angle model";

/// How far the natural-coordinate model is from the two-angle model at a list of equilibria.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Agreement {
    /// Largest residual force where no spring is shorter than 0.1 m \[N\].
    pub residual: f64,
    /// The same where one is, per the largest stiffness of the springs, along or across \[m\]: by how much a coordinate
    /// is off. A spring of 0.01 m under 32 N turns the rounding of a coordinate, 1e-15 m, into 3e-12 N.
    pub offset: f64,
    /// Largest difference of V per V or, where that is less, per 1 J.
    pub energy: f64,
    /// Number of equilibria that are stable in one model and not in the other.
    pub verdicts: usize,
    /// Largest difference of an angle after the way to full coordinates and back \[rad\].
    pub angles: f64,
}

/// Compares the models at all physical equilibria.
///
/// # Errors
/// A configuration has no multipliers.
pub fn agreement(parameters: &Parameters, expected: &Expected) -> Result<Agreement, CaseError> {
    let mechanism = Mechanism::new(parameters)?;
    let (model, mut worst) = (&mechanism.model, Agreement::default());
    let (u, v) = (model.inputs_at(0.0), model.velocities_at_rest());
    for e in &expected.equilibria {
        let q = mechanism.coordinates(e.angles);
        let at = Configuration::at(model, &q, &u)?;
        let residual = at.residual.iter().fold(0.0_f64, |worst, r| worst.max(r.abs()));
        let short = e.lengths[0].min(e.lengths[1]) < SHORT;
        // |f|/d across a spring, for d < L0, is less than this.
        let across = (0..2).map(|s| parameters.stiffness[s] * (1.0 + parameters.rest[s] / e.lengths[s]));
        let energy = (model.energy(&q, &v, &u).potential() - e.energy).abs() / e.energy.max(1.0);
        let back = mechanism.angles(&q);
        let angles = (0..2).map(|i| crate::reference::mechanism::wrapped(back[i] - e.angles[i]).abs());
        let stable = stability(model, &at, 1)?.verdict == Verdict::Stable;
        worst = Agreement {
            residual: if short { worst.residual } else { worst.residual.max(residual) },
            offset: if short {
                worst.offset.max(residual / across.fold(0.0, f64::max))
            } else {
                worst.offset
            },
            energy: worst.energy.max(energy),
            verdicts: worst.verdicts + usize::from(stable != e.stable()),
            angles: angles.fold(worst.angles, f64::max),
        };
    }
    Ok(worst)
}

pub(super) fn rows(rows: &mut Rows, case: Case, expected: &Expected) -> Result<(), CaseError> {
    let name = case.name();
    let found = agreement(&Parameters::paper(case), expected)?;
    let what = format!("{name}: largest residual force, springs longer than {SHORT} m");
    rows.below(what, "N", found.residual, ANGLES, 1e-12);
    if found.offset > 0.0 {
        let what = format!("{name}: largest residual force per stiffness, shorter springs");
        rows.below(what, "m", found.offset, ANGLES, 1e-14);
    }
    rows.below(format!("{name}: largest relative difference of V"), "1", found.energy, ANGLES, 1e-12);
    rows.exact(format!("{name}: verdicts that differ"), (found.verdicts, 0), ANGLES);
    rows.below(format!("{name}: largest difference of an angle"), "rad", found.angles, ANGLES, 1e-15);
    Ok(())
}
