//! Bifurcation and limit points.

use tg_model::{CableLaw, Joining, Model, ModelBuilder};
use tg_statics::{
    ContinuationOptions, EventKind, Forward, ForwardOptions, InputFamily, Seek, Verdict as Stability,
    continuation, critical_parameter, stability,
};

use super::axis::{Axis, Probe};
use super::verdict::Verdict;
use crate::TaskError;

/// κ \[N/m\] of the springs; lengths are 1 m.
const STIFFNESS: f64 = 50.0;
/// The column's critical load \[N\]: V = κ θ² - P θ²/2 for two springs.
const CRITICAL: f64 = 2.0 * STIFFNESS;
/// Height of the shallow arch \[m\].
const RISE: f64 = 0.3;

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    let distances = [1e-1, 1e-3, 1e-6, 1e-9, 1e-11, 1e-12, 1e-13, 1e-14, 0.0];
    let signed = |ask: fn(f64) -> Verdict| -> Vec<Probe> {
        let below = distances.iter().map(|d| -d);
        let above = distances.iter().rev().copied().skip(1);
        below.chain(above).map(|d| Probe::new(format!("{d:+.0e}"), move |_| ask(d))).collect()
    };
    vec![
        Axis {
            title: "Load at a bifurcation, per critical load, less one",
            setup: "An upright bar of 1 m on a hinge between two springs at its tip carries P; it stands up to P = 2κl. The stiffness κ_φ = \
                    2κl² - Pl that is left against the reduced eigenvalue of its tip, per 2κl², and the verdict.",
            probes: signed(|d| Verdict::of(upright(d), 1e-14)),
            cause: "Within rounding of the critical load the verdict is neutral.",
        },
        Axis {
            title: "Load at a bifurcation, per critical load, less one: seeking what is stable",
            setup: "The same from upright, asked for a stable equilibrium: upright below, fallen above, where the springs' moment holds \
                    that of the load. The moment that is left about the hinge, per Pl, and the verdict.",
            probes: signed(|d| Verdict::of(tilted(d), 1e-10)),
            cause: "",
        },
        Axis {
            title: "Critical load, m of the structure's imperfection",
            setup: "The bifurcation's load by `critical_parameter` and by continuation, per itself. With an imperfection there is no bifurcation: \
                    the eigenvalue does not change its sign.",
            probes: vec![
                Probe::new("0, sign of the eigenvalue", |_| Verdict::of(critical(), 1e-12)),
                Probe::new("0, continuation", |_| Verdict::of(followed(), 1e-9)),
                Probe::new("1e-3, sign of the eigenvalue", |_| Verdict::of(imperfect(), 0.0)),
            ],
            cause: "",
        },
        Axis {
            title: "Load at a limit point, per limit load, less one",
            setup: "A shallow arch of two springs of 1 m span each and 0.3 m rise, pressed at its crown: it snaps through at a load that \
                    follows from d/dy κ(l - l₀) y/l = 0. The crown's force, with springs as in the closed form, against the load, per \
                    limit load; above it only the arch turned over holds.",
            probes: signed(|d| Verdict::of(pressed(d), 1e-10)),
            cause: "",
        },
        Axis {
            title: "Limit load of the shallow arch",
            setup: "The fold that continuation finds, per limit load.",
            probes: vec![Probe::new("continuation", |_| Verdict::of(fold(), 1e-10))],
            cause: "",
        },
    ]
}

/// The column, its top pressed down with a load; its hinge at the origin.
fn column(load: f64, off: f64) -> Result<Model<2>, TaskError> {
    let mut b = ModelBuilder::<2>::new();
    let foot = b.anchor("foot", [0.0, 0.0])?;
    let bar = b.bar("bar", 1.0, [0.0, 0.0], [0.0, 1.0])?;
    b.joint("hinge", &[foot.into(), bar.node(0)], Joining::Share)?;
    for (name, x) in [("left", -1.0), ("right", 1.0)] {
        let peg = b.anchor(name, [x + off, 1.0])?;
        b.cable(name, peg, bar.node(1), CableLaw::linear(STIFFNESS), 1.0)?;
    }
    b.load("weight", bar.node(1), [0.0, -load], 1.0)?;
    Ok(b.build()?)
}

fn upright(distance: f64) -> Result<f64, TaskError> {
    let load = CRITICAL * (1.0 + distance);
    let model = column(load, 0.0)?;
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let found = Forward::new(&model, ForwardOptions::default()).solve(&q, &u)?.configuration;
    let result = stability(&model, &found, 1)?;
    // The tip moves by φ l: the eigenvalue is the stiffness of the tip.
    let left = CRITICAL - load;
    let error = (result.lowest[0].value - left).abs() / CRITICAL;
    let expected = if left.abs() <= result.zero_limit {
        Stability::Neutral
    } else if left > 0.0 {
        Stability::Stable
    } else {
        Stability::Unstable
    };
    Ok(if result.verdict == expected { error } else { f64::NAN })
}

fn tilted(distance: f64) -> Result<f64, TaskError> {
    let load = CRITICAL * (1.0 + distance);
    let model = column(load, 0.0)?;
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let options = ForwardOptions { seek: Seek::Stable, ..ForwardOptions::default() };
    let found = Forward::new(&model, options).solve(&q, &u)?.configuration;
    let [x, y] = [found.q[2], found.q[3]];
    let mut moment = load * x;
    for peg in [-1.0, 1.0] {
        let (dx, dy) = (peg - x, 1.0 - y);
        let length = dx.hypot(dy);
        let tension = STIFFNESS * (length - 1.0);
        moment += (x * dy - y * dx) * tension / length;
    }
    let verdict = stability(&model, &found, 1)?.verdict;
    // Above the critical load upright would be wrong, beyond the rounding of eigenvalues.
    let right = verdict != Stability::Unstable && (distance < 1e-9 || x.abs() > 1e-6 || y < 0.0);
    Ok(if right { moment.abs() / load } else { f64::NAN })
}

/// The column's family of loads: P is the parameter.
fn down(model: &Model<2>) -> (Vec<f64>, Vec<f64>) {
    let mut u = model.inputs_at(0.0);
    let last = u.len() - 1;
    u[last] = 0.0;
    let mut direction = vec![0.0; u.len()];
    direction[last] = -1.0;
    (u, direction)
}

fn critical() -> Result<f64, TaskError> {
    let model = column(0.0, 0.0)?;
    let (u, direction) = down(&model);
    let family = InputFamily::new(&model, &u, &direction);
    let found = critical_parameter(&family, &model.initial_coordinates(), (0.1 * CRITICAL, 1.7 * CRITICAL))?;
    Ok((found.parameter / CRITICAL - 1.0).abs())
}

fn followed() -> Result<f64, TaskError> {
    let model = column(0.0, 0.0)?;
    let (u, direction) = down(&model);
    let family = InputFamily::new(&model, &u, &direction);
    let q = model.initial_coordinates();
    let branch = continuation(&family, &q, (0.0, 2.0 * CRITICAL), &ContinuationOptions::default())?;
    let event = branch.events.iter().find(|event| event.kind == EventKind::Bifurcation);
    Ok(event.map_or(f64::NAN, |event| (event.parameter / CRITICAL - 1.0).abs()))
}

/// With pegs moved aside the path bends off, stable all along.
fn imperfect() -> Result<f64, TaskError> {
    let model = column(0.0, 1e-3)?;
    let (u, direction) = down(&model);
    let family = InputFamily::new(&model, &u, &direction);
    critical_parameter(&family, &model.initial_coordinates(), (0.1 * CRITICAL, 0.9 * CRITICAL))?;
    Ok(f64::NAN)
}

/// The arch and the coordinate of its crown.
fn arch(load: f64) -> Result<Model<2>, TaskError> {
    let mut b = ModelBuilder::<2>::new();
    let crown = b.particle("crown", 1.0, [0.0, RISE])?;
    b.support("guide", crown.node(0), 0, 0.0)?;
    for (name, x) in [("left", -1.0), ("right", 1.0)] {
        let peg = b.anchor(name, [x, 0.0])?;
        b.cable(name, peg, crown.node(0), CableLaw::linear(STIFFNESS), 1.0_f64.hypot(RISE))?;
    }
    b.load("press", crown.node(0), [0.0, -load], 1.0)?;
    Ok(b.build()?)
}

/// Load that the arch carries with its crown at y.
fn carried(y: f64) -> f64 {
    let (length, rest) = (1.0_f64.hypot(y), 1.0_f64.hypot(RISE));
    2.0 * STIFFNESS * (rest - length) * y / length
}

/// Its largest: l³ = l₀ at unit span.
fn limit_load() -> f64 {
    let length = 1.0_f64.hypot(RISE).cbrt();
    carried((length * length - 1.0).sqrt())
}

fn pressed(distance: f64) -> Result<f64, TaskError> {
    let load = limit_load() * (1.0 + distance);
    let model = arch(load)?;
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let options = ForwardOptions { seek: Seek::Stable, ..ForwardOptions::default() };
    let found = Forward::new(&model, options).solve(&q, &u)?.configuration;
    let y = found.q[1];
    // A residual of 1e-12 of the largest force κl reaches over the fold.
    let side = distance.abs() <= 1e-9 || (distance < 0.0) == (y > 0.0);
    Ok(if side { (carried(y) - load).abs() / limit_load() } else { f64::NAN })
}

fn fold() -> Result<f64, TaskError> {
    let model = arch(0.0)?;
    let (u, direction) = down(&model);
    let family = InputFamily::new(&model, &u, &direction);
    let q = model.initial_coordinates();
    let branch = continuation(&family, &q, (0.0, 2.0 * limit_load()), &ContinuationOptions::default())?;
    let event = branch.events.iter().find(|event| event.kind == EventKind::LimitPoint);
    Ok(event.map_or(f64::NAN, |event| (event.parameter / limit_load() - 1.0).abs()))
}
