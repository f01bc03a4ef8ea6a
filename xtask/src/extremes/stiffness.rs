//! Stiffness of cables.

use tg_integrate::{NewtonOptions, Run, Stepper, Symplectic};
use tg_model::{CableLaw, Joining, ModelBuilder};

use super::axis::{Axis, Probe};
use super::verdict::Verdict;
use crate::TaskError;

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    vec![Axis {
        title: "Stiffness of a cable, N/m",
        setup: "A bar of 1 kg and 1 m on a hinge, held at its tip along the bar's normal by a two-way cable of 1 m, is pushed \
                by 1e-6 rad. A hundredth of a period per step, ten periods; the tip's distance from the linear oscillation, per amplitude.",
        probes: [1e-2, 1.0, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12]
            .map(|k: f64| Probe::new(format!("{k:.0e}"), move |_| Verdict::of(oscillation(k), 0.05)))
            .into(),
        cause: "",
    }]
}

/// Angle against φ₀ cos ωt, ω² = κ l² / (m l²/3) with the moment of inertia of a bar about its end.
fn oscillation(stiffness: f64) -> Result<f64, TaskError> {
    const AMPLITUDE: f64 = 1e-6;
    let mut b = ModelBuilder::<2>::new();
    let pivot = b.anchor("pivot", [0.0, 0.0])?;
    let peg = b.anchor("peg", [1.0, 1.0])?;
    let bar = b.bar("bar", 1.0, [0.0, 0.0], [AMPLITUDE.cos(), AMPLITUDE.sin()])?;
    b.joint("hinge", &[pivot.into(), bar.node(0)], Joining::Share)?;
    b.cable("cable", peg, bar.node(1), CableLaw::linear(stiffness), 1.0)?;
    let model = b.build()?;
    let tip = model.form(bar.node(1))?;
    let omega = (3.0 * stiffness).sqrt();
    let period = std::f64::consts::TAU / omega;
    let mut stepper = Symplectic::new(&model, NewtonOptions::default())?;
    let mut state = stepper.start(0.0, &model.initial_coordinates(), &model.velocities_at_rest())?;
    let mut worst = 0.0_f64;
    let mut watch = |state: &tg_integrate::State, _: &_| {
        let off = tip.eval(&state.q).y / AMPLITUDE - (omega * state.t).cos();
        worst = if off.is_nan() { f64::NAN } else { worst.max(off.abs()) };
    };
    Run::new(period / 100.0, 10.0 * period).observe(&mut watch).go(&mut stepper, &mut state)?;
    Ok(worst)
}
