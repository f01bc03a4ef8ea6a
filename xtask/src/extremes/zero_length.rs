//! Cables whose ends meet or pass each other closely.

use tg_integrate::State;
use tg_model::{CableLaw, Model, ModelBuilder};

use super::axis::{Axis, Probe};
use super::scheme::{Scheme, worse};
use super::verdict::Verdict;
use crate::TaskError;

/// κ \[N/m\] of 1 kg: ω = 10 rad/s.
const STIFFNESS: f64 = 100.0;
const OMEGA: f64 = 10.0;
/// Rest length of the spring that pushes when short \[m\].
const REST: f64 = 0.25;
const STEP: f64 = 1e-3;
const END: f64 = 5.0;
/// Time of one passage \[s\].
const ONCE: f64 = 0.35;
/// What an embedded pair misses of a jump in its step, for what its estimate sees: that of Dormand and Prince at 3/10 of the
/// step, where the nodes behind weigh 0.209 too much and the estimate is 71/57600.
const UNSEEN: f64 = 170.0;

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    const DISTANCES: [f64; 6] = [1e-3, 1e-6, 1e-9, 1e-15, 1e-300, 0.0];
    let every = |ask: fn(Scheme, f64) -> Verdict| {
        DISTANCES.into_iter().flat_map(move |d| {
            Scheme::ALL
                .map(|scheme| Probe::new(format!("{d:.0e}, {}", scheme.name()), move |_| ask(scheme, d)))
        })
    };
    let laws = [("linear", CableLaw::linear(STIFFNESS)), ("slacking", CableLaw::slacking(STIFFNESS))];
    let meeting = Scheme::ALL.into_iter().flat_map(|scheme| {
        laws.clone().into_iter().flat_map(move |(name, law)| {
            [0.0, REST].map(|rest| {
                let law = law.clone();
                let at = format!("{name}, rest length {rest} m, {}", scheme.name());
                Probe::new(at, move |_| from_zero(scheme, law, rest))
            })
        })
    });
    vec![
        Axis {
            title: "Least distance of the ends of a spring of rest length zero, m",
            setup: "A particle of 1 kg on such a spring, ω = 10 rad/s, on an ellipse of half axes 1 m and this distance, 5 s in \
                    steps of 1 ms; distance from the ellipse's closed form, limit by the scheme's order.",
            probes: every(ellipse).collect(),
            cause: "",
        },
        Axis {
            title: "Least distance of the ends of a spring that pushes when short, m",
            setup: "The same with a two-way spring of 0.25 m, which turns round where its ends pass each other: the force \
                    jumps by 50 N there. Once through in 0.35 s, against the closed form of the straight passage, piecewise \
                    cosines. The limit: a jump that is missed by a step, 50 N/kg · h · t, under error control 170 times the \
                    error of a velocity that the tolerance allows, since of a jump at 3/10 of its step the pair of order 5 \
                    sees no more than 1/170; and the deflection by the distance d, 3d (1 + ln 1/d).",
            probes: every(through).collect(),
            cause: "",
        },
        Axis {
            title: "Start with the ends of a cable in one point",
            setup: "A particle starts at its cable's anchor with 1 m/s; 0.5 s in steps of 1 ms, against the closed form.",
            probes: meeting.collect(),
            cause: "At length zero the force has no direction: schemes that ask for it there refuse; those that ask within the step find it.",
        },
    ]
}

/// A particle at (1, 0) on a cable to the origin.
fn particle(law: CableLaw, rest: f64) -> Result<(Model<2>, usize), TaskError> {
    let mut b = ModelBuilder::<2>::new();
    let anchor = b.anchor("anchor", [0.0, 0.0])?;
    let stone = b.particle("stone", 1.0, [1.0, 0.0])?;
    b.cable("spring", anchor, stone.node(0), law, rest)?;
    let model = b.build()?;
    let x = 2 * model.member_node_ids(stone)[0];
    Ok((model, x))
}

/// The largest distance from `exact`, thrown across with `speed`.
fn thrown(
    scheme: Scheme,
    (rest, end): (f64, f64),
    speed: f64,
    exact: impl Fn(f64) -> [f64; 2],
    limit: f64,
) -> Verdict {
    let run = || -> Result<_, TaskError> {
        let (model, x) = particle(CableLaw::linear(STIFFNESS), rest)?;
        let mut v = model.velocities_at_rest();
        v[x + 1] = speed;
        let off = |state: &State| {
            let exact = exact(state.t);
            (state.q[x] - exact[0]).hypot(state.q[x + 1] - exact[1])
        };
        scheme.follow(&model, &v, (STEP, end), off)
    };
    Verdict::of_motion(run(), limit)
}

fn ellipse(scheme: Scheme, distance: f64) -> Verdict {
    let exact = |t: f64| [(OMEGA * t).cos(), distance * (OMEGA * t).sin()];
    thrown(scheme, (0.0, END), distance * OMEGA, exact, scheme.bound(OMEGA, (STEP, END)))
}

fn through(scheme: Scheme, distance: f64) -> Verdict {
    // From one side to the crossing, where |x| has fallen to zero.
    let quarter = (-REST / (1.0 - REST)).acos() / OMEGA;
    let exact = |t: f64| {
        let (half, part) = ((t / (2.0 * quarter) + 0.5).floor(), t / (2.0 * quarter) + 0.5);
        let since = (part - half - 0.5) * 2.0 * quarter;
        let side = if half % 2.0 == 0.0 { 1.0 } else { -1.0 };
        [side * (REST + (1.0 - REST) * (OMEGA * since).cos()), 0.0]
    };
    // L = r² φ̇ is kept: with the least distance d at the speed there it leaves with d v/r.
    let speed = OMEGA * ((1.0 - REST).powi(2) - REST * REST).sqrt();
    let missed = match scheme {
        // Of the root mean square of two coordinates and two velocities one may be all.
        Scheme::Controlled(_, tolerance) => UNSEEN * 2.0 * tolerance * speed * (ONCE - quarter),
        _ => 2.0 * STIFFNESS * REST * STEP * ONCE,
    };
    let deflected = if distance > 0.0 { 3.0 * distance * (1.0 - distance.ln()) } else { 0.0 };
    thrown(scheme, (REST, ONCE), distance * speed, exact, missed + deflected)
}

/// From the anchor with 1 m/s: sin ωt / ω at rest length zero; with another it flies freely, or is pushed.
fn from_zero(scheme: Scheme, law: CableLaw, rest: f64) -> Verdict {
    const SHORT: f64 = 0.5;
    let slacking = matches!(law, CableLaw::Slacking { .. });
    let exact = move |t: f64| {
        if rest == 0.0 {
            (OMEGA * t).sin() / OMEGA
        } else if slacking && t < rest {
            t
        } else if slacking {
            rest + (OMEGA * (t - rest)).sin() / OMEGA
        } else {
            rest - rest * (OMEGA * t).cos() + (OMEGA * t).sin() / OMEGA
        }
    };
    let run = || -> Result<_, TaskError> {
        let (model, x) = particle(law, rest)?;
        let mut stepper = scheme.stepper(&model)?;
        let (mut q, mut v) = (model.initial_coordinates(), model.velocities_at_rest());
        (q[x], v[x]) = (0.0, 1.0);
        let mut state = stepper.start(0.0, &q, &v)?;
        let mut worst = 0.0;
        while state.t < SHORT {
            stepper.step(&mut state, STEP)?;
            worst = worse((state.q[x] - exact(state.t)).hypot(state.q[x + 1]), worst);
        }
        Ok(worst)
    };
    let missed = if rest == 0.0 { 0.0 } else { 2.0 * STIFFNESS * REST * STEP * SHORT };
    Verdict::of(run(), missed + scheme.bound(OMEGA, (STEP, SHORT)))
}
