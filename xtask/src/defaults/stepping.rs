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
            "Tolerance of the explicit pairs: tower UN and US, 1 s; distance of triangle 3 from the run at 1e-12",
            explicit()?,
        ),
    ])
}

fn remedies() -> Result<Table, CaseError> {
    let law = CableLaw::slacking(100.0).with_damping(1.0);
    let tower = Tower::new(&Choices { law, ..Choices::paper(Setup::Us) })?;
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

fn explicit() -> Result<Table, CaseError> {
    let mut table =
        plain(["setup", "pair", "tolerance", "evaluations", "refused", "switches", "distance [m]"]);
    for setup in [Setup::Un, Setup::Us] {
        let tower = Tower::new(&Choices::paper(setup))?;
        let end = |pair, tolerance| -> Result<([f64; 2], Summary), CaseError> {
            let mut stepper = RungeKutta::new(&tower.model, pair, Tolerances::relative(tolerance))?;
            let mut state = simulate::start(&tower.model, &mut stepper)?;
            let summary = Run::new(0.5, 1.0).go(&mut stepper, &mut state)?;
            Ok((tower.centre3.eval(&state.q).into(), summary))
        };
        let (best, _) = end(EmbeddedPair::DormandPrince8, 1e-12)?;
        for pair in [EmbeddedPair::DormandPrince5, EmbeddedPair::DormandPrince8] {
            for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-10] {
                let (found, summary) = end(pair, tolerance)?;
                table.add_row([
                    format!("{setup:?}"),
                    format!("{pair:?}"),
                    format!("{tolerance:.0e}"),
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
