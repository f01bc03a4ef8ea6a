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
            "Newton's method and relaxation: the same with the default settings: at most 60 iterations, and relaxation where they do not suffice; a distance that is left is another equilibrium",
            far()?,
        ),
        (
            "Longest step of continuation: planar tower, α = β from 0.95 to 0.8, where stability is lost once",
            steps(&[0.01, 0.02, 0.05, 0.1, 0.2, 0.5], |options, x| options.longest = x)?,
        ),
        (
            "First step of continuation: the same by the first step",
            steps(&[0.002, 0.02, 0.05], |options, x| options.step = x)?,
        ),
        (
            "Shortest step of continuation: the same by the step at which the branch is given up",
            steps(&[1e-2, 1e-4, 1e-6, 1e-9], |options, x| options.shortest = x)?,
        ),
        (
            "Tolerance of continuation: the same by the residual force of a point",
            steps(&[1e-5, 1e-8, 1e-11, 1e-13], |options, x| options.tolerance = x)?,
        ),
    ])
}

/// The deployable tower in equilibrium, and its coordinates perturbed by up to a distance.
fn perturbed(distance: f64) -> Result<(Deployable, Vec<f64>), CaseError> {
    let rest = rest_lengths(Configuration::Initial)?;
    let structure = Deployable::new(&deployable::Choices::still(Configuration::Initial, &rest))?;
    let mut far = structure.model.initial_coordinates();
    let free = structure.model.free();
    free.iter().enumerate().for_each(|(k, &i)| far[i] += distance * (1.0 + 1.3 * k as f64).sin());
    Ok((structure, far))
}

/// Largest difference of coordinates.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn tolerances() -> Result<Table, CaseError> {
    let mut table =
        plain(["perturbed by [m]", "tolerance", "iterations", "residual left", "distance left [m]"]);
    for by in [1e-4, 5e-3, 2e-2] {
        let (structure, far) = perturbed(by)?;
        let (q, u) = (structure.model.initial_coordinates(), structure.model.inputs_at(0.0));
        for tolerance in [1e-6, 1e-9, 1e-12, 1e-14] {
            let options = ForwardOptions { tolerance, ..ForwardOptions::default() };
            let found = Forward::new(&structure.model, options).solve(&far, &u)?;
            table.add_row([
                format!("{by:.0e}"),
                format!("{tolerance:.0e}"),
                found.report.iterations.to_string(),
                format!("{:.1e}", found.report.residual),
                format!("{:.1e}", distance(&found.configuration.q, &q)),
            ]);
        }
    }
    Ok(table)
}

fn far() -> Result<Table, CaseError> {
    let mut table =
        plain(["perturbed by [m]", "relaxation", "iterations", "steps of relaxation", "distance left [m]"]);
    for by in [2e-2, 5e-2, 0.1, 0.2] {
        let (structure, far) = perturbed(by)?;
        let (q, u) = (structure.model.initial_coordinates(), structure.model.inputs_at(0.0));
        for relax in [false, true] {
            let options = ForwardOptions { relax, ..ForwardOptions::default() };
            let [iterations, steps, left] = match Forward::new(&structure.model, options).solve(&far, &u) {
                Ok(found) => [
                    found.report.iterations.to_string(),
                    found.report.relaxation_steps.to_string(),
                    format!("{:.1e}", distance(&found.configuration.q, &q)),
                ],
                Err(_) => ["–".into(), "–".into(), "not found".into()],
            };
            let relax = if relax { "yes" } else { "no" };
            table.add_row([format!("{by}"), relax.into(), iterations, steps, left]);
        }
    }
    Ok(table)
}

fn steps(values: &[f64], set: impl Fn(&mut ContinuationOptions, f64)) -> Result<Table, CaseError> {
    let tower = Tower::new(&Choices::modal(0.9))?;
    let family = InputFamily::new(&tower.model, &[0.0; 12], &initial_lengths());
    let q = tower.model.initial_coordinates();
    let mut table = plain(["setting", "points", "events", "error of the critical ratio"]);
    for &value in values {
        let mut options = ContinuationOptions::default();
        set(&mut options, value);
        let setting = if value < 5e-4 { format!("{value:.0e}") } else { value.to_string() };
        let row = match continuation(&family, &q, (0.95, 0.8), &options) {
            Ok(branch) => {
                let error =
                    branch.events.first().map_or(f64::NAN, |event| (event.parameter - CRITICAL).abs());
                [branch.points.len().to_string(), branch.events.len().to_string(), format!("{error:.1e}")]
            }
            Err(_) => ["–".into(), "–".into(), "lost".into()],
        };
        table.add_row([vec![setting], row.into()].concat());
    }
    Ok(table)
}
