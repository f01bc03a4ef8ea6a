//! Cables that go slack and taut very often.

use tg_integrate::State;
use tg_model::{CableLaw, ModelBuilder};

use super::axis::{Axis, Probe};
use super::scheme::Scheme;
use super::verdict::Verdict;
use crate::TaskError;

/// Play of the particle to either side \[m\] and its speed \[m/s\].
const PLAY: f64 = 0.1;
const SPEED: f64 = 1.0;

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    // Finer steps for more of them, so that the limit stays well below the way between the cables.
    let bounces = [(10, 1e-3), (30, 4e-4), (100, 2e-4), (1000, 4e-5)].into_iter().flat_map(|(bounces, h)| {
        let few =
            |scheme: &Scheme| bounces < 1000 || matches!(scheme, Scheme::Symplectic | Scheme::Controlled(..));
        Scheme::ALL
            .into_iter()
            .filter(few)
            .map(move |scheme| {
                let probe =
                    Probe::new(format!("{bounces}, {}", scheme.name()), move |_| bounce(scheme, bounces, h));
                if bounces > 30 { probe.long() } else { probe }
            })
            .collect::<Vec<_>>()
    });
    let damped = [1e-3, 1e-1, 1.0, 10.0, 1e3, 1e5, 1e8].into_iter().flat_map(|ratio| {
        Scheme::ALL.map(|scheme| {
            let probe = Probe::new(format!("{ratio:.0e}, {}", scheme.name()), move |_| caught(scheme, ratio));
            if ratio > 1e4 && matches!(scheme, Scheme::Controlled(..)) { probe.long() } else { probe }
        })
    });
    vec![
        Axis {
            title: "Slack and taut transitions",
            setup: "A particle of 1 kg flies between two undamped cables with 0.1 m of play, ω = 100 rad/s, steps of 1 to 0.04 ms; each \
                    contact is half a sine. Distance from the closed form. The limit: each switch that a step misses \
                    changes the speed v by up to v (ωh)²/2, one way or the other, over all legs to come: (ωh)²/2 · leg · \
                    N^1.5, at most half of the play; under error control ten times the tolerance and N².",
            probes: bounces.collect(),
            cause: "",
        },
        Axis {
            title: "Damping of a cable that a particle tautens, h η/m",
            setup: "A particle of 1 kg and 1 m/s tautens a damped slacking cable of 1 N/m after 0.0123 m and hangs on it under 1 \
                    m/s². 0.2 s in steps of 1 ms; distance from the closed form: a parabola, then two exponentials. The \
                    limit is the way in two steps, under error control 100 times the tolerance.",
            probes: damped.collect(),
            cause: "Above h η/m = 2 implicit steps reverse the closing velocity instead of stopping it, which `Turning` tells as a velocity that \
                    jumps; explicit ones multiply it, until the motion has no bound. Error control follows the damper as long \
                    as its substeps last.",
        },
    ]
}

fn bounce(scheme: Scheme, bounces: u32, step: f64) -> Verdict {
    const OMEGA: f64 = 100.0;
    // From the middle of one flight to the middle of the next.
    let (flight, contact) = (2.0 * PLAY / SPEED, std::f64::consts::PI / OMEGA);
    let leg = flight + contact;
    let exact = |t: f64| {
        let leg_number = (t / leg).floor();
        let since = t - leg_number * leg;
        let x = if since < 0.5 * flight {
            SPEED * since
        } else if since < 0.5 * flight + contact {
            PLAY + SPEED / OMEGA * (OMEGA * (since - 0.5 * flight)).sin()
        } else {
            SPEED * (leg - since)
        };
        if leg_number % 2.0 == 0.0 { x } else { -x }
    };
    let end = f64::from(bounces) * leg;
    let run = || -> Result<_, TaskError> {
        let mut b = ModelBuilder::<2>::new();
        let (left, right) = (b.anchor("left", [-1.0, 0.0])?, b.anchor("right", [1.0, 0.0])?);
        let stone = b.particle("stone", 1.0, [0.0, 0.0])?;
        for (name, anchor) in [("left cable", left), ("right cable", right)] {
            b.cable(name, anchor, stone.node(0), CableLaw::slacking(OMEGA * OMEGA), 1.0 + PLAY)?;
        }
        let model = b.build()?;
        let x = 2 * model.member_node_ids(stone)[0];
        let mut v = model.velocities_at_rest();
        v[x] = SPEED;
        let off = |state: &State| (state.q[x] - exact(state.t)).hypot(state.q[x + 1]);
        scheme.follow(&model, &v, (step, end), off)
    };
    let limit = match scheme {
        Scheme::Controlled(_, tolerance) => 10.0 * tolerance * f64::from(bounces).powi(2),
        _ => (0.5 * (OMEGA * step).powi(2) * SPEED * leg * f64::from(bounces).powf(1.5)).min(0.5 * PLAY),
    };
    Verdict::of_motion(run(), limit)
}

fn caught(scheme: Scheme, ratio: f64) -> Verdict {
    const STEP: f64 = 1e-3;
    const END: f64 = 0.2;
    const GAP: f64 = 0.0123;
    let damping = ratio / STEP;
    // Under 1 m/s² until the cable is taut.
    let taut_at = (1.0 + 2.0 * GAP).sqrt() - 1.0;
    let exact = |t: f64| {
        if t < taut_at { t + 0.5 * t * t } else { GAP + hanging(damping, 1.0 + taut_at, t - taut_at) }
    };
    let run = || -> Result<_, TaskError> {
        let mut b = ModelBuilder::<2>::new();
        b.gravity([1.0, 0.0])?;
        let wall = b.anchor("wall", [-1.0, 0.0])?;
        let stone = b.particle("stone", 1.0, [0.0, 0.0])?;
        b.cable("damper", wall, stone.node(0), CableLaw::slacking(1.0).with_damping(damping), 1.0 + GAP)?;
        let model = b.build()?;
        let x = 2 * model.member_node_ids(stone)[0];
        let mut v = model.velocities_at_rest();
        v[x] = SPEED;
        let off = |state: &State| (state.q[x] - exact(state.t)).abs();
        scheme.follow(&model, &v, (STEP, END), off)
    };
    let limit = match scheme {
        Scheme::Controlled(_, tolerance) => 100.0 * tolerance,
        _ => 2.0 * SPEED * STEP,
    };
    Verdict::of_motion(run(), limit)
}

/// s̈ + η ṡ + s = 1 from s = 0 with a speed.
fn hanging(damping: f64, speed: f64, t: f64) -> f64 {
    let half = 0.5 * damping;
    let square = half * half - 1.0;
    if square < 0.0 {
        let omega = (-square).sqrt();
        let (sin, cos) = (omega * t).sin_cos();
        1.0 - (-half * t).exp() * (cos + (half - speed) / omega * sin)
    } else {
        let fast = -half - square.sqrt();
        // The product of both roots is one.
        let slow = 1.0 / fast;
        let first = (speed + fast) / (slow - fast);
        1.0 + first * (slow * t).exp() - (1.0 + first) * (fast * t).exp()
    }
}
