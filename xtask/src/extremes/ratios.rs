//! Very different stiffnesses or masses in one structure.

use std::f64::consts::TAU;

use tg_integrate::{NewtonOptions, Symplectic};
use tg_modal::{ModeOptions, modes};
use tg_statics::{Configuration, Forward, ForwardOptions};
use tg_tangent::Method;

use super::axis::{Axis, Probe};
use super::chain::{Chain, worst_along};
use super::verdict::Verdict;
use crate::TaskError;

const RATIOS: [f64; 9] = [1e-12, 1e-10, 1e-8, 1e-4, 1.0, 1e4, 1e8, 1e10, 1e12];

/// The axes of stiffness ratios.
pub(super) fn stiffness() -> Vec<Axis> {
    vec![
        Axis {
            title: "Stiffness ratio in one structure: statics",
            setup: "Two masses on a line, a cable of 1 N/m to the wall and one of so many times more between them, the far mass \
                    pulled by 0.1 N. Forward statics; the far mass's displacement against F/κ₁ + F/κ₂, per itself. The limit: \
                    a tension is known to the rounding of a length, some ε κ l of the stiffer cable.",
            probes: probes(|ratio| {
                let stiffer = ratio.max(1.0);
                Verdict::of(pulled(ratio), 1e-11 + 4.0 * f64::EPSILON * stiffer / 0.1)
            }),
            cause: "",
        },
        Axis {
            title: "Stiffness ratio in one structure: modes",
            setup: "The same two masses of 1 kg; both ω² against the roots of their quadratic, each per itself, dense and sparse. \
                    The limit: the accuracy that the modes themselves state, which is rounding of the larger ω².",
            probes: probes(|ratio| vibrating([1.0, 1.0], [1.0, ratio])),
            cause: "",
        },
        Axis {
            title: "Stiffness ratio in one structure: time stepping",
            setup: "The same masses released from the slower mode's shape, 0.1 m at most, by the default scheme in steps of a hundredth \
                    of its period, however fast the other is; three periods. Distance from the linear oscillation, per amplitude; \
                    the limit is the phase error of the midpoint rule.",
            probes: probes(|ratio| Verdict::of(swinging([1.0, 1.0], [1.0, ratio]), 0.02)),
            cause: "",
        },
    ]
}

/// The axes of mass ratios.
pub(super) fn masses() -> Vec<Axis> {
    vec![
        Axis {
            title: "Mass ratio in one structure: modes",
            setup: "Two masses on a line, 1 kg at a cable of 1 N/m to the wall, and one of so many times more at another cable; both \
                    ω² as above.",
            probes: probes(|ratio| vibrating([1.0, ratio], [1.0, 1.0])),
            cause: "",
        },
        Axis {
            title: "Mass ratio in one structure: time stepping",
            setup: "The same masses released from the slower mode's shape; as above.",
            probes: probes(|ratio| Verdict::of(swinging([1.0, ratio], [1.0, 1.0]), 0.02)),
            cause: "",
        },
    ]
}

fn probes(ask: fn(f64) -> Verdict) -> Vec<Probe> {
    RATIOS.map(|ratio| Probe::new(format!("{ratio:.0e}"), move |_| ask(ratio))).into()
}

/// ω₁² and ω₂² of two masses: roots of m₁m₂ x² - (m₁κ₂ + m₂(κ₁ + κ₂)) x + κ₁κ₂, without cancellation.
fn roots([m1, m2]: [f64; 2], [k1, k2]: [f64; 2]) -> [f64; 2] {
    let half = 0.5 * (m1 * k2 + m2 * (k1 + k2));
    // (m₁κ₂ - m₂(κ₁ + κ₂))²/4 + m₁m₂κ₂², all positive.
    let difference = 0.5 * (m1 * k2 - m2 * (k1 + k2));
    let sum = half + difference.hypot((m1 * m2).sqrt() * k2);
    [k1 * k2 / sum, sum / (m1 * m2)]
}

fn pulled(ratio: f64) -> Result<f64, TaskError> {
    let chain = Chain::new(&[1.0, 1.0], &[1.0, ratio], 0.1)?;
    let (q, u) = (chain.model.initial_coordinates(), chain.model.inputs_at(0.0));
    let found = Forward::new(&chain.model, ForwardOptions::default()).solve(&q, &u)?;
    let exact = 0.1 * (1.0 + 1.0 / ratio);
    Ok(((chain.x(1, &found.configuration.q) - 2.0) / exact - 1.0).abs())
}

fn vibrating(masses: [f64; 2], stiffness: [f64; 2]) -> Verdict {
    let ask = || -> Result<(f64, f64), TaskError> {
        let chain = Chain::new(&masses, &stiffness, 0.0)?;
        let (q, u) = (chain.model.initial_coordinates(), chain.model.inputs_at(0.0));
        let at = Configuration::at(&chain.model, &q, &u)?;
        let exact = roots(masses, stiffness);
        let (mut worst, mut limit) = (0.0_f64, 0.0_f64);
        for method in [Method::Dense, Method::Sparse] {
            let found = modes(&chain.model, &at, &ModeOptions { method, ..ModeOptions::all() })?;
            if found.list.len() != 2 {
                return Ok((f64::NAN, 0.0));
            }
            for (mode, exact) in found.list.iter().zip(exact) {
                worst = worst.max((mode.omega_squared / exact - 1.0).abs());
                limit = limit.max(mode.accuracy / exact);
            }
        }
        Ok((worst, limit))
    };
    match ask() {
        Ok((error, limit)) => Verdict::judge(error, limit),
        Err(error) => Verdict::Refused(error.to_string()),
    }
}

fn swinging(masses: [f64; 2], stiffness: [f64; 2]) -> Result<f64, TaskError> {
    const AMPLITUDE: f64 = 0.1;
    let chain = Chain::new(&masses, &stiffness, 0.0)?;
    let slow = roots(masses, stiffness)[0];
    // (κ₂ - m₂ω²) x₂ = κ₂ x₁, the larger one first; the sum of both products is positive.
    let [k1, k2] = stiffness;
    let first = k2 / (k1 + k2 - masses[0] * slow);
    let shape = if first < 1.0 { [first, 1.0] } else { [1.0, 1.0 / first] }.map(|x| AMPLITUDE * x);
    let period = TAU / slow.sqrt();
    let mut stepper = Symplectic::new(&chain.model, NewtonOptions::default())?;
    worst_along(&mut stepper, &chain.displaced(&shape), (period / 100.0, 3.0 * period), |t, q| {
        let course = (slow.sqrt() * t).cos();
        let off = |k: usize| chain.x(k, q) - (k as f64 + 1.0) - shape[k] * course;
        off(0).hypot(off(1)) / AMPLITUDE
    })
}
