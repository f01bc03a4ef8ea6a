//! Thousands of members.

use std::f64::consts::PI;

use tg_fixtures::{MastScene, mast, spine};
use tg_integrate::{Leapfrog, NewtonOptions, Run, Stepper, Symplectic};
use tg_modal::{ModeOptions, modes};
use tg_statics::{
    Configuration, EquilibriumReport, Forward, ForwardOptions, Verdict as Stability, stability,
};

use super::axis::{Axis, Probe};
use super::chain::{Chain, worst_along};
use super::verdict::Verdict;
use crate::TaskError;

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    let stages = [4, 32, 128, 512, 1024, 2048];
    let masses = [8, 64, 512, 2048, 8192];
    vec![
        Axis {
            title: "Thousands of members: equilibrium of a mast",
            setup: "The guyed mast of N stages, 3 bars and 12 cables each, settles under its weight; all reactions of the ground against \
                    that weight and zero, per largest force of a cable, and it is stable. The limit: the forces' tolerance times their number.",
            probes: probes(&stages, 200, |n| Verdict::of(standing(n), 1e-10 * n as f64)),
            cause: "",
        },
        Axis {
            title: "Thousands of members: modes of a chain",
            setup: "N masses on a line between two walls: the ten lowest ω² against 4κ/m sin²(kπ/2(N+1)), per accuracy that the modes state.",
            probes: probes(&masses, 2048, |n| Verdict::of(chain_modes(n), 1.0)),
            cause: "",
        },
        Axis {
            title: "Thousands of members: time stepping of a chain",
            setup: "The same released from its lowest shape, a quarter of whose period in 50 steps by the default scheme; distance from the \
                    closed form, per amplitude.",
            probes: probes(&masses, 2048, |n| Verdict::of(chain_swings(n), 1e-3)),
            cause: "",
        },
        Axis {
            title: "Thousands of members: a spine at rest",
            setup: "A spine of N bodies held by prestressed cables, in equilibrium as built: how far it moves in 50 steps of 1e-4 s, per its \
                    height, by the default scheme and by leapfrog.",
            probes: probes(&[4, 32, 256, 1024], 300, |n| Verdict::of(resting(n), 1e-12)),
            cause: "",
        },
    ]
}

fn probes(counts: &[usize], quick: usize, ask: fn(usize) -> Verdict) -> Vec<Probe> {
    let probe = |&n: &usize| {
        let probe = Probe::new(format!("N = {n}"), move |_| ask(n));
        if n > quick { probe.long() } else { probe }
    };
    counts.iter().map(probe).collect()
}

fn standing(stages: usize) -> Result<f64, TaskError> {
    let model = mast(stages)?.model;
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let found = Forward::new(&model, ForwardOptions::default()).solve(&q, &u)?.configuration;
    let report = EquilibriumReport::new(&model, &found.q, &u)?;
    let mut sum = [0.0, 0.0, -MastScene::BAR_MASS * 3.0 * stages as f64 * MastScene::GRAVITY];
    for support in &report.supports {
        (0..3).for_each(|axis| sum[axis] += support.force[axis]);
    }
    let largest = report.cables.iter().map(|(_, cable)| cable.tension.abs()).fold(0.0, f64::max);
    let stable = stability(&model, &found, 1)?.verdict == Stability::Stable;
    Ok(if stable { sum.iter().fold(0.0_f64, |a, s| a.max(s.abs())) / largest } else { f64::NAN })
}

fn omega_squared(k: usize, masses: usize) -> f64 {
    4.0 * (0.5 * PI * k as f64 / (masses as f64 + 1.0)).sin().powi(2)
}

fn chain(masses: usize) -> Result<Chain, TaskError> {
    Ok(Chain::new(&vec![1.0; masses], &vec![1.0; masses + 1], 0.0)?)
}

fn chain_modes(masses: usize) -> Result<f64, TaskError> {
    let chain = chain(masses)?;
    let (q, u) = (chain.model.initial_coordinates(), chain.model.inputs_at(0.0));
    let at = Configuration::at(&chain.model, &q, &u)?;
    let found = modes(&chain.model, &at, &ModeOptions::new(10.min(masses)))?;
    let off = found.list.iter().enumerate().map(|(k, mode)| {
        let exact = omega_squared(k + 1, masses);
        // An accuracy may not be an excuse: half of the digits at least.
        let accuracy = mode.accuracy.min(1e-8 * exact.max(mode.accuracy));
        (mode.omega_squared - exact).abs() / accuracy
    });
    Ok(off.fold(0.0, |a: f64, b| if b.is_nan() { b } else { a.max(b) }))
}

fn chain_swings(masses: usize) -> Result<f64, TaskError> {
    const AMPLITUDE: f64 = 0.1;
    let chain = chain(masses)?;
    let omega = omega_squared(1, masses).sqrt();
    let shape: Vec<f64> =
        (1..=masses).map(|k| AMPLITUDE * (PI * k as f64 / (masses as f64 + 1.0)).sin()).collect();
    let quarter = 0.5 * PI / omega;
    let mut stepper = Symplectic::new(&chain.model, NewtonOptions::default())?;
    let middle = masses / 2;
    worst_along(&mut stepper, &chain.displaced(&shape), (quarter / 50.0, quarter), |t, q| {
        let at = chain.x(middle, q) - (middle as f64 + 1.0);
        (at - shape[middle] * (omega * t).cos()) / AMPLITUDE
    })
}

fn resting(bodies: usize) -> Result<f64, TaskError> {
    let model = spine(bodies, 8.0, 0.0)?.model;
    let q = model.initial_coordinates();
    let height = q.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
    let mut worst = 0.0_f64;
    let mut symplectic = Symplectic::new(&model, NewtonOptions::default())?;
    let mut leapfrog = Leapfrog::new(&model, NewtonOptions::default())?;
    for stepper in [&mut symplectic as &mut dyn Stepper, &mut leapfrog] {
        let mut state = stepper.start(0.0, &q, &model.velocities_at_rest())?;
        Run::new(1e-4, 5e-3).go(stepper, &mut state)?;
        let off = state.q.iter().zip(&q).map(|(a, b)| (a - b).abs());
        worst = off.fold(worst, |a, b| if b.is_nan() { b } else { a.max(b) });
    }
    Ok(worst / height)
}
