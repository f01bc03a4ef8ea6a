//! Bars that pass through poses in which constraints lose their rank.

use std::f64::consts::{FRAC_PI_2, PI};

use tg_integrate::State;
use tg_model::{Joining, MemberId, Model, ModelBuilder};

use super::axis::{Axis, Probe};
use super::scheme::Scheme;
use super::verdict::Verdict;
use crate::TaskError;

/// Steps that end so far from the singular pose, as an angle \[rad\]: by rounding, by the schemes' own error, in between.
const MISSES: [f64; 6] = [0.5e-2, 1e-3, 1e-5, 1e-8, 1e-12, 0.0];
/// Angle of the crank in a step \[rad\]; it turns with 1 rad/s.
const STEP: f64 = 1e-2;
/// Where the crank starts before the singular pose, and where it ends behind it \[rad\].
const BEFORE: f64 = 1.0;
const BEHIND: f64 = 0.5;

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    let every = |ask: fn(Scheme, f64) -> Verdict| {
        MISSES.into_iter().flat_map(move |miss| {
            Scheme::ALL.map(|scheme| {
                Probe::new(format!("{miss:.0e}, {}", scheme.name()), move |_| ask(scheme, miss))
            })
        })
    };
    vec![
        Axis {
            title: "Parallelogram through its change point: angle from it where a step ends, rad",
            setup: "Crank and rocker of 1 m, coupler and ground of 2 m, no gravity: the crank turns with 1 rad/s, and the coupler \
                    does not turn, through the pose where all lie on a line and another branch begins. 1.5 s in steps of \
                    0.01 s; distance of the coupler's ends from that. The limit: the scheme's, and rounding by δ², at most 1e-3 m.",
            probes: every(parallelogram).collect(),
            cause: "In the pose itself the constraints do not determine the velocities. Branches are as far apart as the pose is away, so that \
                    nearer than 1e-7, some √ε, rounding would choose one: such a pose is refused. Schemes of second order miss it by \
                    the error of their phase and go on; those of high order meet it, and error control creeps up to it. \
                    Another step, or the symplectic scheme, passes.",
        },
        Axis {
            title: "Slider through its crank's pivot: angle from it where a step ends, rad",
            setup: "Crank and rod of 1 m, the rod's other end on a rail through the crank's pivot, no gravity: where the slider \
                    passes the pivot it might as well stay. Against the crank's angle from its energy by quadrature.",
            probes: every(slider).collect(),
            cause: "",
        },
        Axis {
            title: "Bars in one line",
            setup: "A chain on a hinge turns as one, without gravity, 1 rad/s for 2 s in steps of 0.01 s; distance of its end \
                    from the circle, per length.",
            probes: [2, 8, 32]
                .into_iter()
                .flat_map(|n| {
                    [Scheme::Symplectic, Scheme::Leapfrog, Scheme::GeneralizedAlpha, Scheme::ALL[8]].map(
                        |scheme| {
                            Probe::new(format!("{n} bars, {}", scheme.name()), move |_| chain(scheme, n))
                        },
                    )
                })
                .collect(),
            cause: "",
        },
        Axis {
            title: "Start in a singular pose",
            setup: "Each linkage as it lies on one line, built there; a chain of two bars between anchors as far apart as it \
                    is long.",
            probes: vec![
                Probe::new("parallelogram", |_| Verdict::of(four_bar(0.0).map(|_| f64::NAN), 0.0)),
                Probe::new("slider at the pivot", |_| {
                    Verdict::of(slider_crank(FRAC_PI_2).map(|_| f64::NAN), 0.0)
                }),
                Probe::new("straight chain", |_| Verdict::of(stretched().map(|_| f64::NAN), 0.0)),
            ],
            cause: "",
        },
    ]
}

/// Angle at the start, so that a step of the exact motion ends `miss` before the singular pose at `pose`.
fn start(pose: f64, miss: f64) -> f64 {
    pose - BEFORE - miss
}

/// The scheme's, and what rounding makes of accelerations so near: ε/δ² for a step, but no more than a thousandth.
fn limit(scheme: Scheme, miss: f64) -> f64 {
    scheme.bound(1.0, (STEP, BEFORE + BEHIND)) + (4.0 * f64::EPSILON / (miss * miss)).min(1e-3)
}

/// Velocities of a rigid member whose nodes move as `velocity` says of their positions.
fn set<const D: usize>(
    model: &Model<D>,
    member: MemberId,
    v: &mut [f64],
    velocity: impl Fn([f64; D]) -> [f64; D],
) {
    let q = model.initial_coordinates();
    for &node in model.member_node_ids(member) {
        let at = std::array::from_fn(|i| q[D * node + i]);
        v[D * node..D * node + D].copy_from_slice(&velocity(at));
    }
}

/// Crank, coupler and rocker.
fn four_bar(angle: f64) -> Result<(Model<2>, [MemberId; 3]), TaskError> {
    let (x, y) = (angle.cos(), angle.sin());
    let mut b = ModelBuilder::<2>::new();
    let left = b.anchor("left", [0.0, 0.0])?;
    let right = b.anchor("right", [2.0, 0.0])?;
    let crank = b.bar("crank", 1.0, [0.0, 0.0], [x, y])?;
    let coupler = b.bar("coupler", 1.0, [x, y], [2.0 + x, y])?;
    let rocker = b.bar("rocker", 1.0, [2.0, 0.0], [2.0 + x, y])?;
    b.joint("left hinge", &[left.into(), crank.node(0)], Joining::Share)?;
    b.joint("right hinge", &[right.into(), rocker.node(0)], Joining::Share)?;
    b.joint("left knee", &[crank.node(1), coupler.node(0)], Joining::Share)?;
    b.joint("right knee", &[rocker.node(1), coupler.node(1)], Joining::Share)?;
    Ok((b.build()?, [crank, coupler, rocker]))
}

fn parallelogram(scheme: Scheme, miss: f64) -> Verdict {
    let first = start(PI, miss);
    let run = || -> Result<_, TaskError> {
        let (model, [crank, coupler, _]) = four_bar(first)?;
        let mut v = model.velocities_at_rest();
        // The coupler translates with the crank's end.
        set(&model, coupler, &mut v, |_| [-first.sin(), first.cos()]);
        let (left, right) = (model.form(crank.node(1))?, model.form(coupler.node(1))?);
        let off = |state: &State| {
            let angle = first + state.t;
            let (left, right) = (left.eval(&state.q), right.eval(&state.q));
            let off = (left.x - angle.cos()).hypot(left.y - angle.sin());
            off.max((right.x - 2.0 - angle.cos()).hypot(right.y - angle.sin()))
        };
        scheme.follow(&model, &v, (STEP, BEFORE + BEHIND), off)
    };
    Verdict::of_motion(run(), limit(scheme, miss))
}

/// Crank and rod, the rod's end on the x axis.
fn slider_crank(angle: f64) -> Result<(Model<2>, [MemberId; 2]), TaskError> {
    let (x, y) = (angle.cos(), angle.sin());
    let mut b = ModelBuilder::<2>::new();
    let pivot = b.anchor("pivot", [0.0, 0.0])?;
    let crank = b.bar("crank", 1.0, [0.0, 0.0], [x, y])?;
    let rod = b.bar("rod", 1.0, [x, y], [2.0 * x, 0.0])?;
    b.joint("hinge", &[pivot.into(), crank.node(0)], Joining::Share)?;
    b.joint("knee", &[crank.node(1), rod.node(0)], Joining::Share)?;
    b.support("rail", rod.node(1), 1, 0.0)?;
    Ok((b.build()?, [crank, rod]))
}

/// T = ½ φ̇² (1/3 + 1/12 + 1/4 + 2 sin²φ) for 1 kg and 1 m each: φ̇² = φ̇₀² J(φ₀)/J(φ).
fn slider(scheme: Scheme, miss: f64) -> Verdict {
    let first = start(FRAC_PI_2, miss);
    let inertia = |angle: f64| 2.0 / 3.0 + 2.0 * angle.sin().powi(2);
    let rate = |angle: f64| (inertia(first) / inertia(angle)).sqrt();
    let run = || -> Result<_, TaskError> {
        let (model, [crank, rod]) = slider_crank(first)?;
        let mut v = model.velocities_at_rest();
        set(&model, rod, &mut v, |[_, y]| {
            if y == 0.0 { [-2.0 * first.sin(), 0.0] } else { [-first.sin(), first.cos()] }
        });
        let (knee, slider) = (model.form(crank.node(1))?, model.form(rod.node(1))?);
        let (mut angle, mut t) = (first, 0.0);
        let off = |state: &State| {
            // Simpson's rule for the time is the classical scheme of order 4 for the angle.
            let h = (state.t - t) / 10.0;
            for _ in 0..10 {
                let k1 = rate(angle);
                let k2 = rate(angle + 0.5 * h * k1);
                let k3 = rate(angle + 0.5 * h * k2);
                angle += h / 6.0 * (k1 + 2.0 * (k2 + k3) + rate(angle + h * k3));
            }
            t = state.t;
            let (knee, slider) = (knee.eval(&state.q), slider.eval(&state.q));
            let off = (knee.x - angle.cos()).hypot(knee.y - angle.sin());
            off.max((slider.x - 2.0 * angle.cos()).hypot(slider.y))
        };
        scheme.follow(&model, &v, (STEP, BEFORE + BEHIND), off)
    };
    Verdict::of_motion(run(), limit(scheme, miss))
}

fn chain(scheme: Scheme, bars: usize) -> Verdict {
    const END: f64 = 2.0;
    let length = bars as f64;
    let run = || -> Result<_, TaskError> {
        let mut b = ModelBuilder::<2>::new();
        let mut end = b.anchor("pivot", [0.0, 0.0])?.into();
        let mut list = Vec::new();
        for k in 0..bars {
            let bar = b.bar(&format!("bar {k}"), 1.0, [k as f64, 0.0], [k as f64 + 1.0, 0.0])?;
            b.joint(&format!("hinge {k}"), &[end, bar.node(0)], Joining::Share)?;
            end = bar.node(1);
            list.push(bar);
        }
        let model = b.build()?;
        let mut v = model.velocities_at_rest();
        list.iter().for_each(|&bar| set(&model, bar, &mut v, |[x, y]| [-y, x]));
        let tip = model.form(end)?;
        let off = |state: &State| {
            let tip = tip.eval(&state.q) / length;
            (tip.x - state.t.cos()).hypot(tip.y - state.t.sin())
        };
        scheme.follow(&model, &v, (STEP, END), off)
    };
    Verdict::of_motion(run(), scheme.bound(1.0, (STEP, END)))
}

/// Two bars of 1 m between anchors 2 m apart.
fn stretched() -> Result<Model<2>, TaskError> {
    let mut b = ModelBuilder::<2>::new();
    let (left, right) = (b.anchor("left", [0.0, 0.0])?, b.anchor("right", [2.0, 0.0])?);
    let first = b.bar("first", 1.0, [0.0, 0.0], [1.0, 0.0])?;
    let second = b.bar("second", 1.0, [1.0, 0.0], [2.0, 0.0])?;
    b.joint("left hinge", &[left.into(), first.node(0)], Joining::Share)?;
    b.joint("knee", &[first.node(1), second.node(0)], Joining::Share)?;
    b.joint("right hinge", &[right.into(), second.node(1)], Joining::Share)?;
    Ok(b.build()?)
}
