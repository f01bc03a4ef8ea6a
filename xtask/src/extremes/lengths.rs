//! Lengths, and distances from the origin.

use std::f64::consts::TAU;

use tg_integrate::{EmbeddedPair, NewtonOptions, RungeKutta, Symplectic, Tolerances};
use tg_modal::{ModeOptions, modes};
use tg_model::{CableLaw, Joining, Model, ModelBuilder};
use tg_statics::{Forward, ForwardOptions, Verdict as Stability, stability};

use super::axis::{Axis, Probe};
use super::chain::worst_along;
use super::verdict::Verdict;
use crate::TaskError;

const AMPLITUDE: f64 = 1e-3;

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    let lengths = [1e-12, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9, 1e12];
    let places = [1.0, 1e2, 1e4, 1e6, 1e8, 1e9, 1e10, 1e12, 1e16];
    vec![
        Axis {
            title: "Length of a structure, m",
            setup: "A bar of 1 kg and this length, hinged at its foot, upright, between two two-way cables of its length and 100 N/m, is \
                    pushed by 1e-3 rad; neither mass nor stiffness fits the scale. Three periods by the default scheme in steps of \
                    a hundredth of a period; the tip's distance from the linear oscillation, per amplitude. The limit is the \
                    phase error of the midpoint rule.",
            probes: probes(&lengths, |l| Verdict::of(symplectic(l, 0.0), 0.02)),
            cause: "",
        },
        Axis {
            title: "Length of a structure, m: under error control",
            setup: "The same by the explicit pair of order 8 with a tolerance of 1e-9; the limit is the square of the amplitude.",
            probes: probes(&lengths, |l| Verdict::of(controlled(l, 0.0), 1e-5)),
            cause: "",
        },
        Axis {
            title: "Length of a structure, m: statics and modes",
            setup: "The same settles from the pushed place, is stable, and its only frequency is √(6κ/m)/2π. The larger of the tip's \
                    distance from the upright, per length, and the frequency's error, per itself.",
            probes: probes(&lengths, |l| Verdict::of(settled(l, 0.0), 1e-9)),
            cause: "",
        },
        Axis {
            title: "Distance from the origin, m: time stepping",
            setup: "The bar of 1 m stands so far away; the limit grows by the rounding of coordinates, per amplitude.",
            probes: probes(&places, |x| {
                Verdict::of(symplectic(1.0, x), 0.02 + 8.0 * f64::EPSILON * x / AMPLITUDE)
            }),
            cause: "",
        },
        Axis {
            title: "Distance from the origin, m: under error control",
            setup: "As above by the explicit pair of order 8 with a tolerance of 1e-9.",
            probes: probes(&places, |x| {
                Verdict::of(controlled(1.0, x), 1e-5 + 8.0 * f64::EPSILON * x / AMPLITUDE)
            }),
            cause: "",
        },
        Axis {
            title: "Distance from the origin, m: statics and modes",
            setup: "As above; the limit grows by the rounding of coordinates.",
            probes: probes(&places, |x| Verdict::of(settled(1.0, x), 1e-9 + 8.0 * f64::EPSILON * x)),
            cause: "",
        },
    ]
}

fn probes(values: &[f64], ask: fn(f64) -> Verdict) -> Vec<Probe> {
    values.iter().map(|&x| Probe::new(format!("{x:.0e}"), move |_| ask(x))).collect()
}

/// The bar, pushed, its foot at x = y = `place`; and its full coordinates' index of the tip's x.
fn upright(length: f64, place: f64) -> Result<(Model<2>, usize), TaskError> {
    let at = |x: f64, y: f64| [place + x * length, place + y * length];
    let mut b = ModelBuilder::<2>::new();
    let foot = b.anchor("foot", at(0.0, 0.0))?;
    let bar = b.bar("bar", 1.0, at(0.0, 0.0), at(AMPLITUDE.sin(), AMPLITUDE.cos()))?;
    b.joint("hinge", &[foot.into(), bar.node(0)], Joining::Share)?;
    for (name, x) in [("left", -1.0), ("right", 1.0)] {
        let peg = b.anchor(name, at(x, 1.0))?;
        b.cable(name, peg, bar.node(1), CableLaw::linear(100.0), length)?;
    }
    let model = b.build()?;
    let tip = 2 * model.member_node_ids(bar)[1];
    Ok((model, tip))
}

/// ω of two springs κ at the tip of a bar of m on a hinge: 2κl²/(ml²/3).
fn omega() -> f64 {
    600.0_f64.sqrt()
}

fn symplectic(length: f64, place: f64) -> Result<f64, TaskError> {
    let (model, tip) = upright(length, place)?;
    oscillation(&model, tip, (length, place), &mut Symplectic::new(&model, NewtonOptions::default())?, 100.0)
}

fn controlled(length: f64, place: f64) -> Result<f64, TaskError> {
    let (model, tip) = upright(length, place)?;
    let tolerances = Tolerances { most_substeps: 5_000, ..Tolerances::relative(1e-9) };
    let mut stepper = RungeKutta::new(&model, EmbeddedPair::DormandPrince8, tolerances)?;
    oscillation(&model, tip, (length, place), &mut stepper, 10.0)
}

fn oscillation(
    model: &Model<2>,
    tip: usize,
    (length, place): (f64, f64),
    stepper: &mut dyn tg_integrate::Stepper,
    steps: f64,
) -> Result<f64, TaskError> {
    let (omega, period) = (omega(), TAU / omega());
    worst_along(stepper, &model.initial_coordinates(), (period / steps, 3.0 * period), |t, q| {
        (q[tip] - place) / (AMPLITUDE * length) - (omega * t).cos()
    })
}

fn settled(length: f64, place: f64) -> Result<f64, TaskError> {
    let (model, tip) = upright(length, place)?;
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let found = Forward::new(&model, ForwardOptions::default()).solve(&q, &u)?.configuration;
    let off = (found.q[tip] - place).abs() / length;
    let stable = stability(&model, &found, 1)?.verdict == Stability::Stable;
    let frequency = modes(&model, &found, &ModeOptions::all())?.frequencies().next().unwrap_or(f64::NAN);
    let apart = (frequency * TAU / omega() - 1.0).abs();
    Ok(if stable { off.max(apart) } else { f64::NAN })
}
