//! Redundant and nearly redundant constraints.

use tg_integrate::{NewtonOptions, Run, Stepper, Symplectic};
use tg_model::{BuildError, Joining, Model, ModelBuilder, Redundancies};
use tg_statics::{Configuration, SelfStress};

use super::axis::{Axis, Probe};
use super::verdict::Verdict;
use crate::TaskError;

const ARM: f64 = 1.0;
const GRAVITY: f64 = 9.81;

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    let apart = [1e-1, 1e-3, 1e-5, 1e-6, 1e-7, 3e-8, 1e-8, 1e-9, 1e-12, 1e-15, 0.0];
    let meeting = [1e-15, 1e-12, 1e-10, 1e-9, 1e-8, 1e-6, 1e-3];
    vec![
        Axis {
            title: "Nearly redundant constraints: a third arm, m too long",
            setup: "A beam of 2 m on two parallel arms of 1 m, a swing, and a third arm in its middle whose foot is off by so much, at an angle \
                    to the others: exactly parallel it is redundant, otherwise the swing is rigid. How far it moves in 1 s under its \
                    weight. The limit: rounding of the constraints per sine of the angle between them.",
            probes: apart
                .map(|d| Probe::new(format!("{d:.0e}"), move |_| Verdict::of(locked(d), 1e-12 + 1e-14 / d)))
                .into(),
            cause: "Constraints whose gradients agree to 1e-8 count as dependent.",
        },
        Axis {
            title: "Redundant constraints dropped",
            setup: "The same with parallel arms, the redundant constraint dropped: the beam's path after 1 s in steps of 1e-3 s against the \
                    same swing on two arms, and how far the dropped constraint is violated.",
            probes: vec![Probe::new("parallel", |_| Verdict::of(dropped(0.0), 1e-9))],
            cause: "",
        },
        Axis {
            title: "Redundant constraints dropped: a third arm, m too long",
            setup: "The same with the third arm's foot off by so much, dropped where it counts as dependent: in the motion it is not quite implied. \
                    `Model::dropped_violation` after 1 s, of the size of the offset.",
            probes: [1e-9, 1e-10, 1e-12]
                .map(|d| Probe::new(format!("{d:.0e}"), move |_| Verdict::of(dropped(d), 4.0 * d)))
                .into(),
            cause: "",
        },
        Axis {
            title: "Points that a joint joins, m apart",
            setup: "Two bars of 1 m whose ends are to meet; then the pendulum's mechanisms: two, and no state of self-stress.",
            probes: meeting
                .map(|d| {
                    Probe::new(format!("{d:.0e}"), move |_| Verdict::of(joined(d, Joining::Constrain), 0.0))
                })
                .into(),
            cause: "Points may be apart by 1e-9 of the structure's size.",
        },
    ]
}

/// A beam on two arms, or three; the middle one's foot moved along the arm's direction and across by `off`.
fn swing(arms: usize, off: f64, redundancies: Redundancies) -> Result<Model<2>, BuildError> {
    let mut b = ModelBuilder::<2>::new();
    b.redundancies(redundancies);
    b.gravity([0.0, -GRAVITY])?;
    let (sin, cos) = 0.3_f64.sin_cos();
    let foot = |x: f64| [x, 0.0];
    let end = |x: f64| [x + ARM * sin, -ARM * cos];
    let beam = b.bar("beam", 2.0, end(-1.0), end(1.0))?;
    for (name, x, place) in [("left", -1.0, beam.node(0)), ("right", 1.0, beam.node(1))] {
        let anchor = b.anchor(name, foot(x))?;
        let arm = b.bar(&format!("{name} arm"), 0.5, foot(x), end(x))?;
        b.joint(&format!("{name} hinge"), &[anchor.into(), arm.node(0)], Joining::Share)?;
        b.joint(&format!("{name} pin"), &[arm.node(1), place], Joining::Share)?;
    }
    if arms == 3 {
        let anchor = b.anchor("middle", foot(off))?;
        let arm = b.bar("middle arm", 1e-3, foot(off), end(0.0))?;
        b.joint("middle hinge", &[anchor.into(), arm.node(0)], Joining::Share)?;
        b.joint("middle pin", &[arm.node(1), beam.at(end(0.0))], Joining::Constrain)?;
    }
    b.build()
}

/// State after a second.
fn moved(model: &Model<2>) -> Result<Vec<f64>, TaskError> {
    let mut stepper = Symplectic::new(model, NewtonOptions::default())?;
    let mut state = stepper.start(0.0, &model.initial_coordinates(), &model.velocities_at_rest())?;
    Run::new(1e-3, 1.0).go(&mut stepper, &mut state)?;
    Ok(state.q)
}

fn locked(off: f64) -> Result<f64, TaskError> {
    let model = swing(3, off, Redundancies::Reject)?;
    let (q, start) = (moved(&model)?, model.initial_coordinates());
    Ok(q.iter().zip(&start).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max))
}

fn dropped(off: f64) -> Result<f64, TaskError> {
    let (three, two) = (swing(3, off, Redundancies::Drop)?, swing(2, 0.0, Redundancies::Reject)?);
    let (q, reference) = (moved(&three)?, moved(&two)?);
    // The third arm weighs a thousandth: it changes the path by no more.
    let apart = reference.iter().zip(&q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    Ok(if apart < 1e-3 { three.dropped_violation(&q) } else { apart })
}

fn joined(apart: f64, joining: Joining) -> Result<f64, TaskError> {
    let mut b = ModelBuilder::<2>::new();
    let first = b.bar("first", 1.0, [0.0, 0.0], [1.0, 0.0])?;
    let second = b.bar("second", 1.0, [1.0 + apart, 0.0], [1.0 + apart, 1.0])?;
    b.joint("pin", &[first.node(1), second.node(0)], joining)?;
    b.fix("foot", first.node(0))?;
    let model = b.build()?;
    let at = Configuration::at(&model, &model.initial_coordinates(), &model.inputs_at(0.0))?;
    let found = SelfStress::new(&model, &at)?;
    let expected = found.degrees_of_freedom == 2 && found.states.is_empty();
    Ok(if expected { 0.0 } else { f64::NAN })
}
