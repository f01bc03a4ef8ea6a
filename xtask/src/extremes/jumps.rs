//! Supports that jump in position or velocity.

use tg_integrate::State;
use tg_model::{CableLaw, Joining, ModelBuilder, Signal, SignalError};

use super::axis::{Axis, Probe};
use super::scheme::Scheme;
use super::verdict::Verdict;
use crate::TaskError;

/// The jump \[m\], its time \[s\], in the middle of a step, the step and the end.
const JUMP: f64 = 0.1;
const AT: f64 = 0.100_5;
const STEP: f64 = 1e-3;
const END: f64 = 1.0;

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    const DURATIONS: [f64; 5] = [0.1, 1e-2, 1e-3, 1e-6, 1e-12];
    let elastic = DURATIONS.into_iter().map(Some).chain([None]).flat_map(|duration| {
        Scheme::ALL.map(|scheme| {
            Probe::new(format!("{}, {}", words(duration), scheme.name()), move |_| {
                on_a_spring(scheme, duration)
            })
        })
    });
    let velocity = [1e-3, 1.0, 10.0].into_iter().flat_map(|speed| {
        Scheme::ALL.map(|scheme| {
            Probe::new(format!("{speed} m/s, {}", scheme.name()), move |_| kicked(scheme, speed))
        })
    });
    let hinged = [Some(0.1), Some(1e-2), Some(1e-4), Some(1e-6), None].into_iter().flat_map(|duration| {
        Scheme::ALL.map(|scheme| {
            Probe::new(format!("{}, {}", words(duration), scheme.name()), move |_| {
                on_a_hinge(scheme, duration)
            })
        })
    });
    vec![
        Axis {
            title: "Ground that jumps under a spring: duration of the ramp, s",
            setup: "A particle of 1 kg on a two-way spring of 100 N/m whose other end moves by 0.1 m, as a ramp or as a user's \
                    signal that jumps, between the ends of steps of 1 ms; distance from the closed form over 1 s. The limit: \
                    the scheme's order, and a force missed by a step, 10 N/kg · h · t; under error control 100 times the \
                    tolerance.",
            probes: elastic.collect(),
            cause: "",
        },
        Axis {
            title: "Ground that jumps in velocity under a hinge",
            setup: "A bar of 1 m on a hinge that begins to move across it, by a ramp, within a step of 1 ms, without gravity: its \
                    centre gets a quarter of the velocity, it turns with 3v/2 s; distance of its tip from that. The limit: \
                    the scheme's order and vh; under error control 100 times the tolerance.",
            probes: velocity.collect(),
            cause: "",
        },
        Axis {
            title: "Ground that jumps in position under a hinge: duration of the ramp, s",
            setup: "The same hinge moves by 0.1 m: the bar turns by 0.15 rad and then with 1.7e-3/τ rad/s, τ being the duration of \
                    the ramp, without bound as it becomes a jump, which must be refused, in fixed steps also a ramp within a step.",
            probes: hinged.collect(),
            cause: "A cable only feels another length, but a joint passes on the impulse, whose direction turns with the bar within the jump: \
                    what is left of it has no limit. Let the hinge move in a ramp that several steps resolve.",
        },
        Axis {
            title: "Jumps as ramps and tables",
            setup: "What a signal refuses.",
            probes: vec![
                Probe::new("ramp of no duration", |_| refused(Signal::ramp(0.0, JUMP, 0.0).check())),
                Probe::new("table with two equal times", |_| {
                    refused(Signal::table(vec![0.0, AT, AT], vec![0.0, 0.0, JUMP]).map(drop))
                }),
            ],
            cause: "",
        },
    ]
}

fn refused(answer: Result<(), SignalError>) -> Verdict {
    Verdict::of(answer.map(|()| f64::NAN), 0.0)
}

fn words(duration: Option<f64>) -> String {
    duration.map_or("a jump".into(), |duration| format!("{duration:.0e}"))
}

/// A ramp, or a user's function that jumps and says it had no velocity.
fn signal(duration: Option<f64>) -> Signal {
    match duration {
        Some(duration) => Signal::Ramp { from: 0.0, to: JUMP, start: AT, duration },
        None => Signal::user(|t| (if t < AT { 0.0 } else { JUMP }, 0.0)),
    }
}

/// The response of the oscillator to a ramp is the mean of those to the jumps within it.
fn on_a_spring(scheme: Scheme, duration: Option<f64>) -> Verdict {
    const OMEGA: f64 = 10.0;
    let exact = |t: f64| {
        let since = t - AT;
        match duration {
            _ if since < 0.0 => 0.0,
            None => JUMP * (1.0 - (OMEGA * since).cos()),
            Some(duration) => {
                let part = since.min(duration);
                // ∫ (1 - cos ω(t - s)) ds, the difference of sines as a product.
                let sines = 2.0 * (OMEGA * (since - 0.5 * part)).cos() * (0.5 * OMEGA * part).sin();
                JUMP * (part / duration - sines / (OMEGA * duration))
            }
        }
    };
    let run = || -> Result<_, TaskError> {
        let mut b = ModelBuilder::<2>::new();
        let ground = b.anchor("ground", [0.0, 0.0])?;
        b.shake("jump", ground, signal(duration))?;
        let stone = b.particle("stone", 1.0, [1.0, 0.0])?;
        b.cable("spring", ground, stone.node(0), CableLaw::linear(OMEGA * OMEGA), 1.0)?;
        let model = b.build()?;
        let x = 2 * model.member_node_ids(stone)[0];
        let off = |state: &State| (state.q[x] - 1.0 - exact(state.t)).abs();
        scheme.follow(&model, &model.velocities_at_rest(), (STEP, END), off)
    };
    let limit = match scheme {
        Scheme::Controlled(_, tolerance) => 100.0 * tolerance,
        _ => scheme.bound(OMEGA, (STEP, END)) + OMEGA * OMEGA * JUMP * STEP * END,
    };
    Verdict::of_motion(run(), limit)
}

/// The tip of the bar against `exact`, its hinge moving as `offset` says.
fn hinged(scheme: Scheme, offset: Signal, exact: impl Fn(f64) -> [f64; 2], limit: f64) -> Verdict {
    let run = || -> Result<_, TaskError> {
        let mut b = ModelBuilder::<2>::new();
        let ground = b.anchor("ground", [0.0, 0.0])?;
        let bar = b.bar("bar", 1.0, [0.0, 0.0], [0.0, 1.0])?;
        b.joint("hinge", &[ground.into(), bar.node(0)], Joining::Share)?;
        b.shake("jump", ground, offset)?;
        let model = b.build()?;
        let tip = model.form(bar.node(1))?;
        let off = |state: &State| {
            let (tip, exact) = (tip.eval(&state.q), exact(state.t));
            (tip.x - exact[0]).hypot(tip.y - exact[1])
        };
        scheme.follow(&model, &model.velocities_at_rest(), (STEP, END), off)
    };
    Verdict::of_motion(run(), limit)
}

fn kicked(scheme: Scheme, speed: f64) -> Verdict {
    let exact = |t: f64| {
        let since = (t - AT).max(0.0);
        let angle = 1.5 * speed * since;
        [speed * since - angle.sin(), angle.cos()]
    };
    // Until long after the end.
    let offset = Signal::Ramp { from: 0.0, to: 10.0 * speed, start: AT, duration: 10.0 };
    let limit = match scheme {
        Scheme::Controlled(_, tolerance) => 100.0 * tolerance * (1.0 + speed),
        _ => scheme.bound(1.5 * speed, (STEP, END)) + speed * STEP,
    };
    hinged(scheme, offset, exact, limit)
}

/// After both kicks: turned by 3d/2, and ω = 3d/2τ (1 - cos 3d/2).
fn on_a_hinge(scheme: Scheme, duration: Option<f64>) -> Verdict {
    let exact = |t: f64| {
        let Some(duration) = duration else { return [f64::NAN; 2] };
        let since = t - AT;
        if since < 0.0 {
            return [0.0, 1.0];
        }
        let turned = 1.5 * JUMP;
        let rate = turned / duration;
        let moved = (since / duration).min(1.0);
        let angle = turned * moved + rate * (1.0 - turned.cos()) * (since - duration).max(0.0);
        [JUMP * moved - angle.sin(), angle.cos()]
    };
    let speed = JUMP / duration.unwrap_or(STEP);
    // Behind the ramp it turns with 1.7e-3/τ.
    let rate = 1.5 * speed * (1.0 - (1.5 * JUMP).cos()).max(duration.unwrap_or(0.0));
    let limit = match scheme {
        Scheme::Controlled(..) => 10.0 * scheme.bound(rate, (STEP, END)),
        _ => scheme.bound(1.5 * speed, (STEP, END)) + (speed * STEP).min(0.05),
    };
    hinged(scheme, signal(duration), exact, limit)
}
