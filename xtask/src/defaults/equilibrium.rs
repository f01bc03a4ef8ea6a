//! What the settings of forward statics and continuation cost and give.

use comfy_table::Table;
use tg_cases::deployable::statics::rest_lengths;
use tg_cases::deployable::{self, Configuration, Deployable};
use tg_cases::error::CaseError;
use tg_cases::tower::{Choices, Tower, initial_lengths};
use tg_model::Mechanics;
use tg_statics::{ContinuationOptions, Forward, ForwardOptions, InputFamily, continuation};

use super::plain;

/// 1 - α of the ratio at which the planar tower loses stability.
const CRITICAL: f64 = 0.844_559_346_936_171;

/// One table per setting.
pub(super) fn tables() -> Result<Vec<(&'static str, Table)>, CaseError> {
    Ok(vec![
        (
            "Tolerance of forward statics: deployable tower, every coordinate perturbed by up to the distance",
            tolerances()?,
        ),
        (
            "Longest step of continuation: planar tower, α = β from 0.95 to 0.8, where stability is lost once",
            steps()?,
        ),
    ])
}

fn tolerances() -> Result<Table, CaseError> {
    let rest = rest_lengths(Configuration::Initial)?;
    let structure = Deployable::new(&deployable::Choices::still(Configuration::Initial, &rest))?;
    let (q, u) = (structure.model.initial_coordinates(), structure.model.inputs_at(0.0));
    let mut table =
        plain(["perturbed by [m]", "tolerance", "iterations", "residual left", "distance left [m]"]);
    for distance in [1e-4, 5e-3, 2e-2] {
        let mut far = q.clone();
        let free = structure.model.free();
        free.iter().enumerate().for_each(|(k, &i)| far[i] += distance * (1.0 + 1.3 * k as f64).sin());
        for tolerance in [1e-6, 1e-9, 1e-12, 1e-14] {
            let options = ForwardOptions { tolerance, ..ForwardOptions::default() };
            let found = Forward::new(&structure.model, options).solve(&far, &u)?;
            let pairs = found.configuration.q.iter().zip(&q);
            table.add_row([
                format!("{distance:.0e}"),
                format!("{tolerance:.0e}"),
                found.report.iterations.to_string(),
                format!("{:.1e}", found.report.residual),
                format!("{:.1e}", pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)),
            ]);
        }
    }
    Ok(table)
}

fn steps() -> Result<Table, CaseError> {
    let tower = Tower::new(&Choices::modal(0.9))?;
    let family = InputFamily::new(&tower.model, &[0.0; 12], &initial_lengths());
    let q = tower.model.initial_coordinates();
    let mut table = plain(["longest step", "points", "events", "error of the critical ratio"]);
    for longest in [0.01, 0.02, 0.05, 0.1, 0.2, 0.5] {
        let options = ContinuationOptions { longest, ..ContinuationOptions::default() };
        let branch = continuation(&family, &q, (0.95, 0.8), &options)?;
        let error = branch.events.first().map_or(f64::NAN, |event| (event.parameter - CRITICAL).abs());
        table.add_row([
            longest.to_string(),
            branch.points.len().to_string(),
            branch.events.len().to_string(),
            format!("{error:.1e}"),
        ]);
    }
    Ok(table)
}
