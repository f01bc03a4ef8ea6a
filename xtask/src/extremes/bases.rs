//! Nearly degenerate base vectors.

use std::f64::consts::TAU;

use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_integrate::{EmbeddedPair, NewtonOptions, RungeKutta, Symplectic, Tolerances};
use tg_modal::{ModeOptions, modes};
use tg_model::{Model, ModelBuilder};
use tg_statics::Configuration;

use super::axis::{Axis, Probe};
use super::chain::worst_along;
use super::verdict::Verdict;
use crate::TaskError;

/// Distance of the mass centre from the pivot \[m\], gravity \[m/s²\], moment about the pivot \[kg m²\] of 1 kg.
const ARM: f64 = 0.5;
const GRAVITY: f64 = 9.81;
const INERTIA: f64 = 0.02 + ARM * ARM;
const AMPLITUDE: f64 = 1e-4;

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    let conditions = [1.0, 1e2, 1e4, 1e5, 1e6, 1e7, 9e7, 1e8, 1e9, 1e10, 1e12];
    let probes = |ask: fn(f64) -> Verdict| {
        conditions.map(|c| Probe::new(format!("{c:.0e}"), move |_| ask(c))).into_iter().collect()
    };
    vec![
        Axis {
            title: "Condition of base vectors: modes",
            setup: "A plate of 1 kg and 0.02 kg m² hangs from a pivot 0.5 m from its mass centre; the angle between its two base \
                    vectors shrinks. Its frequency against √(mgd/I)/2π, per itself. The limit is that of its mass matrix, ε times \
                    the square of the condition.",
            probes: probes(|c| Verdict::of(swing(c), 1e-12 + 16.0 * f64::EPSILON * c * c)),
            cause: CAUSE,
        },
        Axis {
            title: "Condition of base vectors: time stepping",
            setup: "The same plate, released at 1e-4 rad, one period in 200 steps by the default scheme. Its angle's distance from \
                    the linear oscillation, per amplitude. The limit: the phase error of the scheme, and of the frequency.",
            probes: probes(|c| Verdict::of(swinging(c, false), 2e-3 + 64.0 * f64::EPSILON * c * c)),
            cause: CAUSE,
        },
        Axis {
            title: "Condition of base vectors: under error control",
            setup: "The same by the explicit pair of order 8 with a tolerance of 1e-9.",
            probes: probes(|c| Verdict::of(swinging(c, true), 1e-4 + 64.0 * f64::EPSILON * c * c)),
            cause: CAUSE,
        },
    ]
}

const CAUSE: &str = "The mass matrix holds the inverse of the base vectors twice, and constraints hold their difference by itself only: \
                     the rounding of coordinates comes back as the cube of the condition in the balance of forces. Implicit schemes, which \
                     iterate until that balance holds, refuse first.";

/// A plate in coordinates RUV hanging from its first point, its base vectors `angle` apart, turned by an amplitude.
fn plate(condition: f64, turned: f64) -> Result<(Model<2>, tg_model::MemberId), TaskError> {
    // cond [1 cos a; 0 sin a] = cot (a/2).
    let angle = 2.0 * (1.0 / condition).atan();
    let nodes = [[0.0, 0.0], [0.0, -1.0], [angle.sin(), -angle.cos()]].map(Into::into);
    let mass = MassProperties::from_polar_moment(1.0, [0.0, -ARM].into(), 0.02)?;
    let member = Member::new(CoordType::Ruv, &nodes, mass)?;
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -GRAVITY])?;
    let plate = b.member("plate", member, Pose::planar(0.0, 0.0, turned))?;
    b.fix("pivot", plate.node(0))?;
    Ok((b.build()?, plate))
}

fn omega() -> f64 {
    (GRAVITY * ARM / INERTIA).sqrt()
}

fn swing(condition: f64) -> Result<f64, TaskError> {
    let (model, _) = plate(condition, 0.0)?;
    let at = Configuration::at(&model, &model.initial_coordinates(), &model.inputs_at(0.0))?;
    let frequency = modes(&model, &at, &ModeOptions::all())?.frequencies().next().unwrap_or(f64::NAN);
    Ok((TAU * frequency / omega() - 1.0).abs())
}

fn swinging(condition: f64, controlled: bool) -> Result<f64, TaskError> {
    let (model, _) = plate(condition, AMPLITUDE)?;
    let period = TAU / omega();
    // u, from the pivot to the mass centre's side.
    let course = |t: f64, q: &[f64]| q[2].atan2(-q[3]) / AMPLITUDE - (omega() * t).cos();
    let (q, h) = (model.initial_coordinates(), if controlled { period / 10.0 } else { period / 200.0 });
    if controlled {
        let pair = EmbeddedPair::DormandPrince8;
        let tolerances = Tolerances { most_substeps: 5_000, ..Tolerances::relative(1e-9) };
        let mut stepper = RungeKutta::new(&model, pair, tolerances)?;
        worst_along(&mut stepper, &q, (h, period), course)
    } else {
        worst_along(&mut Symplectic::new(&model, NewtonOptions::default())?, &q, (h, period), course)
    }
}
