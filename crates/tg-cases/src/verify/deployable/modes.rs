//! Natural frequencies of both states (Fig. 19).

use tg_modal::{ModeOptions, SupportMotion, modes, participation};
use tg_tangent::Configuration as Balance;

use super::statics::twin;
use super::{published, still};
use crate::deployable::{Configuration, Deployable};
use crate::error::CaseError;
use crate::published::EXACT;
use crate::reference::deployable as minimal;
use crate::row::Rows;

const SECTION: &str = "paper, Sec. 6.3.1";
const MODEL: &str = "24-coordinate model of this project";

pub(super) fn rows(rows: &mut Rows) -> Result<(), CaseError> {
    // Printed as 0.7184 Hz, which is 0.71846 cut off, and as 0.3270 Hz.
    for (configuration, printed) in Configuration::ALL.into_iter().zip([0.7184, 0.3270]) {
        frequencies(rows, configuration, printed)?;
    }
    Ok(())
}

fn frequencies(rows: &mut Rows, configuration: Configuration, printed: f64) -> Result<(), CaseError> {
    let name = configuration.name();
    let choices = still(configuration)?;
    let rest = std::array::from_fn(|k| choices.rest[k].constant().unwrap_or(f64::NAN));
    let structure = Deployable::new(&choices)?;
    let (q, u) = (structure.model.initial_coordinates(), structure.model.inputs_at(0.0));
    let at = Balance::at(&structure.model, &q, &u)?;
    let found = modes(&structure.model, &at, &ModeOptions::all())?;
    let ours: Vec<f64> = found.frequencies().collect();
    rows.exact(format!("{name}: vibrations"), (ours.len(), 24), SECTION);
    rows.near(format!("{name}: lowest frequency, as printed"), "Hz", (ours[0], printed), SECTION, 1e-4);
    for (k, (f, known)) in ours.iter().zip(&published(configuration).frequencies).enumerate() {
        rows.near(format!("{name}: frequency {}", k + 1), "Hz", (*f, *known), EXACT, 1e-9 * known);
    }
    let theirs = minimal::Model::new(twin(configuration), &rest).frequencies()?;
    let worst = ours.iter().zip(&theirs).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
    rows.below(format!("{name}: all 24 frequencies, largest relative difference"), "1", worst, MODEL, 1e-9);
    ground_motion(rows, name, &structure, &at, &found)
}

/// The structure leans with the ground: the two lowest modes carry most of the mass that moves.
fn ground_motion(
    rows: &mut Rows,
    name: &str,
    structure: &Deployable,
    at: &Balance,
    found: &tg_modal::Modes,
) -> Result<(), CaseError> {
    let motion = SupportMotion::translation(&structure.model, at, 0)?;
    let report = participation(&structure.model, at, found, &motion)?;
    let sum: f64 = report.list.iter().map(|mode| mode.effective_mass).sum();
    rows.near(
        format!("{name}, ground along x: sum of effective modal masses"),
        "kg",
        (sum, report.total),
        "completeness of the modes",
        1e-9 * report.total,
    );
    Ok(())
}
