//! What the settings of a homotopy's paths cost and give, on mechanisms drawn at random.

use std::time::Instant;

use comfy_table::Table;
use tg_cases::mechanism::{Mechanism, Parameters};
use tg_equilibria::{EquilibriaOptions, all_equilibria};
use tg_homotopy::PathOptions;

use super::plain;
use crate::TaskError;

/// Mechanisms.
const SEEDS: std::ops::Range<u64> = 0..20;

/// A setting: heading and words, how it is set, and values, of which one is the default.
type Setting = (&'static str, fn(&mut PathOptions, f64), &'static [f64]);

/// First the tracker's, then the endgame's.
const SETTINGS: [Setting; 18] = [
    (
        "Predictor of paths: all equilibria of twenty random mechanisms, by the predictor's tolerance",
        |paths, x| paths.tracker.predictor_tolerance = x,
        &[1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7],
    ),
    (
        "Corrector of paths: the same by the corrector's tolerance",
        |paths, x| paths.tracker.corrector_tolerance = x,
        &[1e-5, 1e-7, 1e-9, 1e-11],
    ),
    (
        "Corrections on paths: the same by the Newton steps before a step is halved",
        |paths, x| paths.tracker.corrections = x as usize,
        &[1.0, 2.0, 3.0, 5.0],
    ),
    (
        "First step on paths: the same by the first step in t",
        |paths, x| paths.tracker.first_step = x,
        &[2e-3, 0.02, 0.1],
    ),
    (
        "Longest step on paths: the same by the longest step in t",
        |paths, x| paths.tracker.largest_step = x,
        &[0.05, 0.2, 0.5],
    ),
    (
        "Shortest step on paths: the same by the shortest step, relative to t, before a path is given up",
        |paths, x| paths.tracker.smallest_step = x,
        &[1e-2, 1e-3, 1e-4, 1e-10],
    ),
    (
        "Steps of a path: the same by the most that it may take",
        |paths, x| paths.tracker.steps = x as usize,
        &[50.0, 100.0, 200.0, 20_000.0],
    ),
    (
        "Double-double on paths: the same by the growth from which double-double is used",
        |paths, x| paths.tracker.double_limit = x,
        &[1e3, 1e5, 1e7, 1e9, 1e11],
    ),
    (
        "Start of the endgame: the same by the t from which on patches stay fixed",
        |paths, x| paths.endgame.start = x,
        &[0.01, 0.1, 0.3],
    ),
    (
        "First turn of the endgame: the same by its radius",
        |paths, x| paths.endgame.first_radius = x,
        &[1e-2, 1e-4, 1e-6],
    ),
    (
        "Samples of a turn: the same by their number",
        |paths, x| paths.endgame.samples = x as usize,
        &[4.0, 8.0, 16.0],
    ),
    (
        "Turns of the endgame: the same by the largest winding number that is tried",
        |paths, x| paths.endgame.largest_winding = x as usize,
        &[1.0, 2.0, 4.0, 16.0],
    ),
    (
        "Closure of a turn: the same by the distance within which a path is back",
        |paths, x| paths.endgame.closure = x,
        &[1e-1, 1e-3, 1e-5],
    ),
    (
        "Agreement of the endgame: the same by the distance of two estimates that are accepted",
        |paths, x| paths.endgame.tolerance = x,
        &[1e-5, 1e-7, 1e-9, 1e-11],
    ),
    (
        "Smallest turn: the same by the t at which the endgame gives up",
        |paths, x| paths.endgame.smallest_radius = x,
        &[1e-6, 1e-12, 1e-26],
    ),
    (
        "Regular ends at infinity: the same by the closeness to infinity of a regular end",
        |paths, x| paths.endgame.infinity = x,
        &[1e-8, 1e-11, 1e-14],
    ),
    (
        "Ends of paths at infinity: the same by the closeness to infinity of a singular end",
        |paths, x| paths.endgame.singular_infinity = x,
        &[1e-4, 1e-7, 1e-10],
    ),
    (
        "Paths followed again: the same by how often, where one failed or met another",
        |paths, x| paths.retracks = x as u32,
        &[0.0, 1.0, 3.0],
    ),
];

/// One table per setting.
pub(super) fn tables() -> Result<Vec<(&'static str, Table)>, TaskError> {
    SETTINGS.into_iter().map(|(title, set, values)| Ok((title, table(values, set)?))).collect()
}

fn table(values: &[f64], set: impl Fn(&mut PathOptions, f64)) -> Result<Table, TaskError> {
    let mut table =
        plain(["setting", "paths", "µs per path", "certified", "followed again", "lost", "without proof"]);
    for &value in values {
        let mut options = EquilibriaOptions::default();
        set(&mut options.paths, value);
        let (mut paths, mut certified, mut again, mut lost, mut unproved) = (0, 0, 0, 0, 0);
        let start = Instant::now();
        for seed in SEEDS {
            let model = Mechanism::new(&Parameters::random(seed))?.model;
            let report = all_equilibria(&model, &model.inputs_at(0.0), &options)?;
            paths += report.paths;
            certified += report.certified;
            again += report.retracked;
            lost += report.failed;
            unproved += report.rejected + report.undecided;
        }
        table.add_row([
            if (0.1..1e3).contains(&value) || value == 0.0 {
                value.to_string()
            } else {
                format!("{value:.0e}")
            },
            paths.to_string(),
            format!("{:.0}", 1e6 * start.elapsed().as_secs_f64() / paths as f64),
            certified.to_string(),
            again.to_string(),
            lost.to_string(),
            unproved.to_string(),
        ]);
    }
    Ok(table)
}
