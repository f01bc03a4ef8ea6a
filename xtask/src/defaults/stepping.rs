//! What the remedies in [`NewtonOptions`] and [`Tolerances`] cost and give, on the planar tower.

use comfy_table::Table;
use tg_cases::error::CaseError;
use tg_cases::simulate;
use tg_cases::tower::{Choices, Setup, Tower};
use tg_integrate::{
    EmbeddedPair, NewtonOptions, Run, RungeKutta, State, StepReport, Summary, Symplectic, Tolerances,
};
use tg_model::CableLaw;

use super::plain;

/// One table per setting.
pub(super) fn tables() -> Result<Vec<(&'static str, Table)>, CaseError> {
    Ok(vec![
        (
            "Steps without a solution: tower, slacking, η = 1 N s/m, h = 2e-3, 2 s; largest distance of triangle 3 from the run at h/64",
            remedies()?,
        ),
        (
            "Most iterations: the same, and with five times the step, by the iterations after which a step is divided",
            most_iterations()?,
        ),
        (
            "Tolerance of the explicit pairs: tower UN and US, 1 s in two calls; distance of triangle 3 from the run at 1e-12",
            explicit()?,
        ),
        ("Absolute tolerance: the same by its share of the relative one, 1e-6", absolute()?),
    ])
}

/// The tower with damped slacking cables.
fn damped() -> Result<Tower, CaseError> {
    let law = CableLaw::slacking(100.0).with_damping(1.0);
    Tower::new(&Choices { law, ..Choices::paper(Setup::Us) })
}

fn most_iterations() -> Result<Table, CaseError> {
    let tower = damped()?;
    let mut table = plain([
        "step [s]",
        "most iterations",
        "steps divided",
        "forced",
        "iterations per step",
        "most in a step",
    ]);
    for h in [2e-3, 1e-2] {
        for max_iterations in [4, 6, 8, 10, 20, 40] {
            let options = NewtonOptions { max_iterations, ..NewtonOptions::default() };
            let row = match path(&tower, h, 1, options) {
                Ok((_, summary, most)) => [
                    summary.divided.to_string(),
                    summary.forced.to_string(),
                    format!("{:.3}", summary.iterations as f64 / summary.steps as f64),
                    most.to_string(),
                ],
                Err(_) => ["–".into(), "–".into(), "–".into(), "a step fails".into()],
            };
            table.add_row([vec![h.to_string(), max_iterations.to_string()], row.into()].concat());
        }
    }
    Ok(table)
}

fn remedies() -> Result<Table, CaseError> {
    let tower = damped()?;
    let (h, fine) = (2e-3, 64);
    let (best, _, _) = path(&tower, h / f64::from(fine), fine, NewtonOptions::default())?;
    let mut table = plain([
        "freeze after",
        "halvings",
        "steps divided",
        "forced",
        "iterations per step",
        "most in a step",
        "distance [m]",
    ]);
    for (freeze_after, halvings) in [(6, 0), (6, 1), (6, 2), (6, 3), (6, 5), (6, 8), (3, 5), (10, 5)] {
        let options = NewtonOptions { freeze_after, halvings, ..NewtonOptions::default() };
        let (points, summary, most) = path(&tower, h, 1, options)?;
        table.add_row([
            freeze_after.to_string(),
            halvings.to_string(),
            summary.divided.to_string(),
            summary.forced.to_string(),
            format!("{:.3}", summary.iterations as f64 / summary.steps as f64),
            most.to_string(),
            format!("{:.2e}", simulate::distance(&points, &best)),
        ]);
    }
    Ok(table)
}

/// Where the tower's third triangle is after 1 s in two calls.
fn end(tower: &Tower, pair: EmbeddedPair, tolerances: Tolerances) -> Result<([f64; 2], Summary), CaseError> {
    let mut stepper = RungeKutta::new(&tower.model, pair, tolerances)?;
    let mut state = simulate::start(&tower.model, &mut stepper)?;
    let summary = Run::new(0.5, 1.0).go(&mut stepper, &mut state)?;
    Ok((tower.centre3.eval(&state.q).into(), summary))
}

/// Rows of both towers and pairs: words for the tolerances, evaluations, refusals, switches and the distance.
fn pairs<const N: usize>(tolerances: [(String, Tolerances); N]) -> Result<Table, CaseError> {
    let mut table =
        plain(["setup", "pair", "tolerance", "evaluations", "refused", "switches", "distance [m]"]);
    for setup in [Setup::Un, Setup::Us] {
        let tower = Tower::new(&Choices::paper(setup))?;
        let (best, _) = end(&tower, EmbeddedPair::DormandPrince8, Tolerances::relative(1e-12))?;
        for pair in [EmbeddedPair::DormandPrince5, EmbeddedPair::DormandPrince8] {
            for (words, tolerances) in &tolerances {
                let (found, summary) = end(&tower, pair, *tolerances)?;
                table.add_row([
                    format!("{setup:?}"),
                    format!("{pair:?}"),
                    words.clone(),
                    summary.iterations.to_string(),
                    summary.rejected.to_string(),
                    summary.frozen.to_string(),
                    format!("{:.1e}", simulate::distance(&[found], &[best])),
                ]);
            }
        }
    }
    Ok(table)
}

fn explicit() -> Result<Table, CaseError> {
    let tolerances = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10];
    pairs(tolerances.map(|tolerance| (format!("{tolerance:.0e}"), Tolerances::relative(tolerance))))
}

fn absolute() -> Result<Table, CaseError> {
    pairs([1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6].map(|share| {
        let default = Tolerances::default();
        (format!("{share:.0e}"), Tolerances { absolute: share * default.relative, ..default })
    }))
}

/// Triangle 3's mass centre at every `stride`-th step to 2 s, totals, and the most iterations of a step.
fn path(
    tower: &Tower,
    h: f64,
    stride: u32,
    options: NewtonOptions,
) -> Result<(Vec<[f64; 2]>, Summary, u32), CaseError> {
    let mut stepper = Symplectic::new(&tower.model, options)?;
    let mut state = simulate::start(&tower.model, &mut stepper)?;
    let (mut points, mut step, mut most) = (Vec::new(), 0, 0);
    let mut watch = |state: &State, report: &StepReport| {
        most = most.max(report.iterations);
        if step % stride == 0 {
            points.push(tower.centre3.eval(&state.q).into());
        }
        step += 1;
    };
    let summary = Run::new(h, 2.0).observe(&mut watch).go(&mut stepper, &mut state)?;
    Ok((points, summary, most))
}
