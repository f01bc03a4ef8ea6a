//! Zero and near-zero prestress: mechanisms.

use std::f64::consts::TAU;

use tg_integrate::{EmbeddedPair, NewtonOptions, RungeKutta, Symplectic, Tolerances};
use tg_modal::{ModeOptions, modes};
use tg_model::{CableLaw, Model, ModelBuilder};
use tg_statics::{
    Configuration, PrestressStability, SelfStress, Verdict as Stability, prestress_stability, stability,
};
use tg_tangent::Method;

use super::axis::{Axis, Probe};
use super::chain::worst_along;
use super::verdict::Verdict;
use crate::TaskError;

/// κ \[N/m\] of two cables of 1 m in line; 1 kg between them.
const STIFFNESS: f64 = 1e3;

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    let tensions = [1e2, 1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 0.0];
    vec![
        Axis {
            title: "Prestress of a mechanism, N: modes and stability",
            setup: "A mass of 1 kg between two cables of 1 m and 1000 N/m in line, which carry this tension T: across them ω² = 2T/(ml). \
                    ω² per itself, dense and sparse, and the verdict: stable, neutral at zero. The limit: the modes' own accuracy, \
                    and T as rest lengths round it.",
            probes: tensions.map(|t| Probe::new(format!("{t:.0e}"), move |_| vibrating(t))).into(),
            cause: "Tensions below 1e-12 of κ l are rounding of the lengths; so small an ω² counts as zero, and the verdict is neutral.",
        },
        Axis {
            title: "Prestress of a mechanism, N: time stepping",
            setup: "The mass oscillates across with 1e-6 m: by the explicit pair of order 8 with a tolerance of 1e-9, three periods of the \
                    linear oscillation; the distance per amplitude. The limit grows with the cubic stiffness κ A²/l² per T.",
            probes: tensions[..5]
                .iter()
                .copied()
                .map(|t| {
                    Probe::new(format!("{t:.0e}"), move |_| {
                        Verdict::of(swinging(t), 1e-3 + 10.0 * STIFFNESS * 1e-12 / t + 1e-12 / t)
                    })
                })
                .collect(),
            cause: "",
        },
        Axis {
            title: "Amplitude of a mechanism without prestress, m",
            setup: "The same cables at their rest lengths: a cubic spring, whose period is 7.4163 l √(m/κ)/A. One period in 500 steps by the \
                    default scheme; distance from the start, per amplitude. The limit is the phase error of the scheme, A² and \
                    the rounding of lengths against the strain A²/2.",
            probes: [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7]
                .map(|a: f64| {
                    let limit = 1e-3 + a * a + (64.0 * f64::EPSILON / (a * a)).powi(2);
                    Probe::new(format!("{a:.0e}"), move |_| Verdict::of(cubic(a), limit))
                })
                .into(),
            cause: "",
        },
        Axis {
            title: "Offset of a mechanism's joint, m",
            setup: "The mass stands off the line by so much, at zero tension: no state of self-stress and no mechanism, while on the line there is \
                    one of each, which prestress stiffens. Counts by singular values down to 1e-9 of the largest.",
            probes: [1e-1, 1e-3, 1e-6, 1e-8, 1e-10, 1e-12, 0.0]
                .map(|d| Probe::new(format!("{d:.0e}"), move |_| Verdict::of(counted(d), 0.0)))
                .into(),
            cause: "",
        },
    ]
}

/// The mass `off` the line of its cables.
fn string(tension: f64, off: f64) -> Result<Model<2>, TaskError> {
    let mut b = ModelBuilder::<2>::new();
    let mass = b.particle("mass", 1.0, [0.0, off])?;
    for (name, x) in [("left", -1.0_f64), ("right", 1.0)] {
        let peg = b.anchor(name, [x, 0.0])?;
        let rest = 1.0 - tension / STIFFNESS;
        b.cable(name, peg, mass.node(0), CableLaw::linear(STIFFNESS), rest)?;
    }
    Ok(b.build()?)
}

/// T as rounding of the rest lengths leaves it.
fn rounded(tension: f64) -> f64 {
    STIFFNESS * (1.0 - (1.0 - tension / STIFFNESS))
}

fn vibrating(tension: f64) -> Verdict {
    let ask = || -> Result<(f64, f64), TaskError> {
        let model = string(tension, 0.0)?;
        let at = Configuration::at(&model, &model.initial_coordinates(), &model.inputs_at(0.0))?;
        let exact = 2.0 * rounded(tension);
        let (mut worst, mut limit) = (0.0_f64, 1e-12_f64);
        for method in [Method::Dense, Method::Sparse] {
            let found = modes(&model, &at, &ModeOptions { method, ..ModeOptions::all() })?;
            let lowest = &found.list[0];
            let size = exact.max(lowest.accuracy);
            worst = worst.max((lowest.omega_squared - exact).abs() / size);
            limit = limit.max(lowest.accuracy / size);
            let verdict = stability(&model, &at, 1)?.verdict;
            let expected = if exact > found.zero_limit { Stability::Stable } else { Stability::Neutral };
            if verdict != expected {
                worst = f64::NAN;
            }
        }
        Ok((worst, limit))
    };
    match ask() {
        Ok((error, limit)) => Verdict::judge(error, limit),
        Err(error) => Verdict::Refused(error.to_string()),
    }
}

fn swinging(tension: f64) -> Result<f64, TaskError> {
    const AMPLITUDE: f64 = 1e-6;
    let model = string(tension, 0.0)?;
    let omega = (2.0 * rounded(tension)).sqrt();
    let mut q = model.initial_coordinates();
    q[1] = AMPLITUDE;
    let period = TAU / omega;
    let mut stepper = RungeKutta::new(&model, EmbeddedPair::DormandPrince8, Tolerances::relative(1e-9))?;
    let course = |t: f64, q: &[f64]| q[1] / AMPLITUDE - (omega * t).cos();
    worst_along(&mut stepper, &q, (period / 20.0, 3.0 * period), course)
}

fn cubic(amplitude: f64) -> Result<f64, TaskError> {
    let model = string(0.0, 0.0)?;
    let mut q = model.initial_coordinates();
    q[1] = amplitude;
    // m ẍ = -κ x³/l²: 4 K(1/√2) l √(m/κ)/A, the strain in both cables.
    let period = 7.416_298_709_205_487 / (amplitude * STIFFNESS.sqrt());
    let mut stepper = Symplectic::new(&model, NewtonOptions::default())?;
    let mut last = 0.0;
    worst_along(&mut stepper, &q, (period / 500.0, period), |_, q| {
        last = q[1];
        0.0
    })?;
    // At the turning point time counts only to second order; a quarter of a period off shows as one.
    Ok((last / amplitude - 1.0).abs())
}

fn counted(off: f64) -> Result<f64, TaskError> {
    let model = string(0.0, off)?;
    let at = Configuration::at(&model, &model.initial_coordinates(), &model.inputs_at(0.0))?;
    let found = SelfStress::new(&model, &at)?;
    let counts = (found.states.len(), found.mechanisms.len());
    // The singular values are √2 cos a and √2 sin a of the cables' angle a.
    let straight = off.atan().tan() <= 1e-9;
    let stiffened = matches!(prestress_stability(&model, &at, &found)?, PrestressStability::Stable { .. });
    let expected = if straight { counts == (1, 1) && stiffened } else { counts == (0, 0) };
    Ok(if expected { 0.0 } else { f64::NAN })
}
