//! Very many steps.

use tg_integrate::{Run, State, StepReport};
use tg_model::{CableLaw, Joining, Mechanics as _, Model, ModelBuilder};

use super::axis::{Axis, Probe};
use super::scheme::{Scheme, worse};
use super::verdict::Verdict;
use crate::TaskError;

/// Step \[s\] of a pendulum of ω = 3.8 rad/s and a guy of 100 N/m.
const STEP: f64 = 1e-3;

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    let probes = |ask: fn(Scheme, u32) -> Verdict| {
        [100_000, 1_000_000, 10_000_000].into_iter().flat_map(move |steps| {
            [Scheme::Symplectic, Scheme::Leapfrog].map(|scheme| {
                let probe = Probe::new(format!("{steps:e}, {}", scheme.name()), move |_| ask(scheme, steps));
                if steps > 100_000 { probe.long() } else { probe }
            })
        })
    };
    vec![
        Axis {
            title: "Steps: energy",
            setup: "A bar of 1 m on a hinge, with a guy, swings in steps of 1 ms. The energy's distance from that of the start, per \
                    5 J; what both schemes leave of it, (hω)²/4 with ω = 20 rad/s, must not grow: the limit is that and \
                    4ε √steps steps for rounding.",
            probes: probes(energy).collect(),
            cause: "",
        },
        Axis {
            title: "Steps: drift of constraints",
            setup: "The same; the largest |Φ| against the tolerance of Newton's iteration, 1e-12, twice, however many the steps.",
            probes: probes(drift).collect(),
            cause: "",
        },
        Axis {
            title: "Steps: memory",
            setup: "The same; growth of the process's own memory after a hundredth of the steps, in pages of 4 kB, less than 64, \
                    whatever else runs.",
            probes: probes(memory).collect(),
            cause: "",
        },
    ]
}

fn swing() -> Result<Model<2>, TaskError> {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -9.81])?;
    let pivot = b.anchor("pivot", [0.0, 0.0])?;
    let peg = b.anchor("peg", [2.0, 0.0])?;
    let bar = b.bar("bar", 1.0, [0.0, 0.0], [0.0, -1.0])?;
    b.joint("hinge", &[pivot.into(), bar.node(0)], Joining::Share)?;
    b.cable("guy", peg, bar.node(1), CableLaw::linear(100.0), 1.9)?;
    Ok(b.build()?)
}

/// Runs and looks at every state.
fn look(scheme: Scheme, steps: u32, mut look: impl FnMut(&Model<2>, &State)) -> Result<(), TaskError> {
    let model = swing()?;
    let mut stepper = scheme.stepper(&model)?;
    let mut state = stepper.start(0.0, &model.initial_coordinates(), &model.velocities_at_rest())?;
    let mut watch = |state: &State, _: &StepReport| look(&model, state);
    Run::new(STEP, STEP * f64::from(steps)).observe(&mut watch).go(stepper.as_mut(), &mut state)?;
    Ok(())
}

fn energy(scheme: Scheme, steps: u32) -> Verdict {
    let (mut first, mut worst) = (None, 0.0);
    let done = look(scheme, steps, |model, state| {
        let now = model.energy(&state.q, &state.v, &model.inputs_at(state.t)).total();
        worst = worse((now - *first.get_or_insert(now)).abs() / 5.0, worst);
    });
    let scheme_leaves = (STEP * 20.0_f64).powi(2) / 4.0;
    let rounding = 4.0 * f64::EPSILON * f64::from(steps).powf(1.5);
    Verdict::of(done.map(|()| worst), scheme_leaves + rounding)
}

fn drift(scheme: Scheme, steps: u32) -> Verdict {
    let (mut worst, mut phi) = (0.0, Vec::new());
    let done = look(scheme, steps, |model, state| {
        phi.resize(model.sizes().constraints, 0.0);
        model.constraints(&state.q, &mut phi);
        worst = phi.iter().fold(worst, |worst, phi| worse(phi.abs(), worst));
    });
    Verdict::of(done.map(|()| worst), 2e-12)
}

fn memory(scheme: Scheme, steps: u32) -> Verdict {
    let (mut seen, mut early, mut last) = (0, Ok(0.0), Ok(0.0));
    let done = look(scheme, steps, |_, _| {
        seen += 1;
        if seen == steps / 100 {
            early = own_pages();
        } else if seen == steps {
            last = own_pages();
        }
    });
    let grown = done.and_then(|()| Ok((last? - early?).max(0.0)));
    Verdict::of(grown, 64.0)
}

/// Pages that the process has written to, counted page by page: those of `statm` are some dozens late, and code that is read
/// from the disk is among them.
fn own_pages() -> Result<f64, TaskError> {
    let memory = std::fs::read_to_string("/proc/self/smaps_rollup")?;
    let own = memory.lines().find_map(|line| line.strip_prefix("Anonymous:")?.strip_suffix("kB"));
    Ok(own.ok_or("no anonymous memory in /proc/self/smaps_rollup")?.trim().parse::<f64>()? / 4.0)
}
