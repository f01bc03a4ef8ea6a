//! Stiffness of cables.

use std::f64::consts::TAU;

use tg_integrate::{
    EmbeddedPair, GeneralizedAlpha, Leapfrog, NewtonOptions, RungeKutta, Stepper, Symplectic, Tolerances,
};
use tg_modal::{ModeOptions, modes};
use tg_model::{CableLaw, Joining, Mechanics, Model, ModelBuilder};
use tg_statics::{Configuration, Forward, ForwardOptions};

use super::axis::{Axis, Probe};
use super::chain::{Chain, worst_along};
use super::verdict::Verdict;
use crate::TaskError;

const AMPLITUDE: f64 = 1e-6;
const STIFFNESSES: [f64; 8] = [1e-2, 1.0, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12];

type Scheme = for<'m> fn(&'m dyn Mechanics) -> Result<Box<dyn Stepper + 'm>, TaskError>;

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    let symplectic: Scheme = |m| Ok(Box::new(Symplectic::new(m, NewtonOptions::default())?));
    let alpha: Scheme = |m| Ok(Box::new(GeneralizedAlpha::new(m, 0.99, NewtonOptions::default())?));
    let leapfrog: Scheme = |m| Ok(Box::new(Leapfrog::new(m, NewtonOptions::default())?));
    let controlled: Scheme =
        |m| Ok(Box::new(RungeKutta::new(m, EmbeddedPair::DormandPrince8, Tolerances::relative(1e-9))?));
    let resolved = |scheme| {
        probes(move |k| {
            let period = TAU / (3.0 * k).sqrt();
            Verdict::of(oscillation(k, scheme, (period / 100.0, 10.0 * period)), 0.05)
        })
    };
    vec![
        Axis {
            title: "Stiffness of a cable, N/m",
            setup: "A bar of 1 kg and 1 m on a hinge, held at its tip along the bar's normal by a two-way cable of 1 m, is pushed \
                    by 1e-6 rad. A hundredth of a period per step, ten periods; the tip's distance from the linear oscillation, per amplitude.",
            probes: resolved(symplectic),
            cause: "",
        },
        Axis {
            title: "Stiffness of a cable, N/m: leapfrog",
            setup: "The same by leapfrog.",
            probes: resolved(leapfrog),
            cause: "",
        },
        Axis {
            title: "Stiffness of a cable, N/m: generalised-α",
            setup: "The same by the generalised-α scheme with a spectral radius of 0.99.",
            probes: resolved(alpha),
            cause: "",
        },
        Axis {
            title: "Stiffness of a cable, N/m: a tenth of a second under error control",
            setup: "The same by the explicit pair of order 8 with a tolerance of 1e-9, in ten steps however stiff the cable is. The limit is \
                    the tolerance per amplitude, some substeps long.",
            probes: probes(move |k| Verdict::of(oscillation(k, controlled, (0.01, 0.1)), 1e-2)),
            cause: "An explicit scheme resolves every period; what takes more substeps than it may is refused.",
        },
        Axis {
            title: "Stiffness of a cable, N/m: statics and modes",
            setup: "A mass of 1 kg on such a cable to a wall, pulled so that the cable stretches by a thousandth: forward statics against \
                    F/κ, and ω² against κ/m, each per itself. The limit: twelve digits of the force, of a thousandth of the length.",
            probes: probes(|k| Verdict::of(stretched(k), 1e-9)),
            cause: "",
        },
    ]
}

fn probes(ask: impl Fn(f64) -> Verdict + Copy + Send + 'static) -> Vec<Probe> {
    STIFFNESSES.map(|k| Probe::new(format!("{k:.0e}"), move |_| ask(k))).into()
}

fn bar(stiffness: f64) -> Result<(Model<2>, usize), TaskError> {
    let mut b = ModelBuilder::<2>::new();
    let pivot = b.anchor("pivot", [0.0, 0.0])?;
    let peg = b.anchor("peg", [1.0, 1.0])?;
    let bar = b.bar("bar", 1.0, [0.0, 0.0], [AMPLITUDE.cos(), AMPLITUDE.sin()])?;
    b.joint("hinge", &[pivot.into(), bar.node(0)], Joining::Share)?;
    b.cable("cable", peg, bar.node(1), CableLaw::linear(stiffness), 1.0)?;
    let model = b.build()?;
    let tip = 2 * model.member_node_ids(bar)[1] + 1;
    Ok((model, tip))
}

/// Angle against φ₀ cos ωt, ω² = κ l² / (m l²/3) with the moment of inertia of a bar about its end.
fn oscillation(stiffness: f64, scheme: Scheme, (step, end): (f64, f64)) -> Result<f64, TaskError> {
    let (model, tip) = bar(stiffness)?;
    let omega = (3.0 * stiffness).sqrt();
    let mut stepper = scheme(&model)?;
    worst_along(stepper.as_mut(), &model.initial_coordinates(), (step, end), |t, q| {
        q[tip] / AMPLITUDE - (omega * t).cos()
    })
}

fn stretched(stiffness: f64) -> Result<f64, TaskError> {
    const STRAIN: f64 = 1e-3;
    let chain = Chain::new(&[1.0], &[stiffness], STRAIN * stiffness)?;
    let (q, u) = (chain.model.initial_coordinates(), chain.model.inputs_at(0.0));
    let found = Forward::new(&chain.model, ForwardOptions::default()).solve(&q, &u)?.configuration;
    let off = ((chain.x(0, &found.q) - 1.0) / STRAIN - 1.0).abs();
    let at = Configuration::at(&chain.model, &found.q, &u)?;
    let found = modes(&chain.model, &at, &ModeOptions::all())?;
    Ok(found.list.iter().fold(off, |worst, mode| worst.max((mode.omega_squared / stiffness - 1.0).abs())))
}
