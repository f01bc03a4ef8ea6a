//! What the settings of a homotopy's paths cost and give, on mechanisms drawn at random.

use std::time::Instant;

use comfy_table::Table;
use tg_cases::mechanism::{Mechanism, Parameters};
use tg_equilibria::{EquilibriaOptions, all_equilibria};

use super::plain;
use crate::TaskError;

/// Mechanisms.
const SEEDS: std::ops::Range<u64> = 0..20;

/// One table per setting.
pub(super) fn tables() -> Result<Vec<(&'static str, Table)>, TaskError> {
    let predictor = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7];
    let corrector = [1e-5, 1e-7, 1e-9, 1e-11];
    let double = [1e3, 1e5, 1e7, 1e9, 1e11];
    let infinity = [1e-4, 1e-7, 1e-10];
    Ok(vec![
        (
            "Predictor of paths: all equilibria of twenty random mechanisms, by the predictor's tolerance",
            table(&predictor, |options, x| options.paths.tracker.predictor_tolerance = x)?,
        ),
        (
            "Corrector of paths: the same by the corrector's tolerance",
            table(&corrector, |options, x| options.paths.tracker.corrector_tolerance = x)?,
        ),
        (
            "Double-double on paths: the same by the growth from which double-double is used",
            table(&double, |options, x| options.paths.tracker.double_limit = x)?,
        ),
        (
            "Ends of paths at infinity: the same by the closeness to infinity of a singular end",
            table(&infinity, |options, x| options.paths.endgame.singular_infinity = x)?,
        ),
    ])
}

fn table(values: &[f64], set: impl Fn(&mut EquilibriaOptions, f64)) -> Result<Table, TaskError> {
    let mut table = plain(["setting", "time [ms]", "certified", "followed again", "lost", "without proof"]);
    for &value in values {
        let mut options = EquilibriaOptions::default();
        set(&mut options, value);
        let (mut certified, mut again, mut lost, mut unproved) = (0, 0, 0, 0);
        let start = Instant::now();
        for seed in SEEDS {
            let model = Mechanism::new(&Parameters::random(seed))?.model;
            let report = all_equilibria(&model, &model.inputs_at(0.0), &options)?;
            certified += report.certified;
            again += report.retracked;
            lost += report.failed;
            unproved += report.rejected + report.undecided;
        }
        table.add_row([
            format!("{value:.0e}"),
            format!("{:.0}", 1e3 * start.elapsed().as_secs_f64()),
            certified.to_string(),
            again.to_string(),
            lost.to_string(),
            unproved.to_string(),
        ]);
    }
    Ok(table)
}
