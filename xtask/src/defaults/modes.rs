//! What the settings of [`ModeOptions`] and [`SweepOptions`] cost and give, on a spine.

use std::error::Error;

use comfy_table::Table;
use tg_fixtures::spine;
use tg_modal::{ModeOptions, Modes, Sweep, SweepError, SweepOptions, modes, sweep};
use tg_tangent::Configuration;

use super::plain;
use crate::TaskError;

/// Vertebrae.
const COUNT: usize = 3;
/// Tensions between which modes are followed \[N\].
const TENSIONS: (f64, f64) = (1.0, 17.0);

/// One table per setting.
pub(super) fn tables() -> Result<Vec<(&'static str, Table)>, TaskError> {
    Ok(vec![
        (
            "Imbalance of an equilibrium: a spine whose rest lengths are wrong by a part, as if it stood still; how far that moves ω², \
             per largest ω²",
            imbalances()?,
        ),
        (
            "Modes against a parameter: eight modes of a spine from 1 to 17 N in eight steps; followed wrongly are those that a \
             sixteenth of the step tells otherwise",
            followed()?,
        ),
    ])
}

/// All modes of the spine as built with its rest lengths wrong by `part`, and the imbalance.
fn wrong(part: f64) -> Result<(Modes, f64), TaskError> {
    let model = spine(COUNT, 8.0, 0.0)?.model;
    let mut u = model.inputs_at(0.0);
    u.iter_mut().enumerate().for_each(|(k, rest)| *rest *= 1.0 + part * (1.0 + 1.3 * k as f64).sin());
    let at = Configuration::at(&model, &model.initial_coordinates(), &u)?;
    let (imbalance, _) = at.imbalance();
    Ok((modes(&model, &at, &ModeOptions { imbalance: f64::INFINITY, ..ModeOptions::all() })?, imbalance))
}

fn imbalances() -> Result<Table, TaskError> {
    let (exact, _) = wrong(0.0)?;
    let mut table = plain(["wrong by", "imbalance", "largest change of ω²"]);
    for part in [1e-3, 1e-5, 1e-7, 1e-9, 1e-11] {
        let (found, imbalance) = wrong(part)?;
        let pairs = found.list.iter().zip(&exact.list);
        let moved = pairs.map(|(a, b)| (a.omega_squared - b.omega_squared).abs()).fold(0.0, f64::max);
        table.add_row([
            format!("{part:.0e}"),
            format!("{imbalance:.1e}"),
            format!("{:.1e}", moved / exact.largest),
        ]);
    }
    Ok(table)
}

fn follow(steps: u32, options: &SweepOptions) -> Result<Sweep, SweepError> {
    let (from, to) = TENSIONS;
    let tensions: Vec<f64> =
        (0..=steps).map(|k| from + (to - from) * f64::from(k) / f64::from(steps)).collect();
    sweep(&tensions, options, |tension| -> Result<_, Box<dyn Error + Send + Sync>> {
        let model = spine(COUNT, tension, 0.0)?.model;
        let at = Configuration::at(&model, &model.initial_coordinates(), &model.inputs_at(0.0))?;
        Ok((Box::new(model), at))
    })
}

fn followed() -> Result<Table, TaskError> {
    let default = SweepOptions::new(8);
    let fine = follow(128, &default)?;
    let mut table = plain(["setting", "parameters", "ambiguous", "followed wrongly"]);
    let variants = [
        ("default: MAC of 0.8, 6 halvings, 8 spare, groups within 1e-6", default),
        ("MAC of 0.5", SweepOptions { least_mac: 0.5, ..default }),
        ("MAC of 0.95", SweepOptions { least_mac: 0.95, ..default }),
        ("no halvings", SweepOptions { halvings: 0, ..default }),
        ("3 halvings", SweepOptions { halvings: 3, ..default }),
        ("none spare", SweepOptions { spare: 0, ..default }),
        ("groups within 1e-12", SweepOptions { cluster: 1e-12, ..default }),
        ("groups within 1e-2", SweepOptions { cluster: 1e-2, ..default }),
    ];
    for (words, options) in variants {
        let found = follow(8, &options)?;
        let wrong = found.tracks.iter().zip(&fine.tracks).filter(|(a, b)| {
            let [a, b] = [a, b].map(|track| track.omega_squared.last().copied().unwrap_or(f64::NAN));
            (a / b - 1.0).abs() > 1e-6
        });
        table.add_row([
            words.to_string(),
            found.parameters.len().to_string(),
            found.ambiguous.len().to_string(),
            wrong.count().to_string(),
        ]);
    }
    Ok(table)
}
