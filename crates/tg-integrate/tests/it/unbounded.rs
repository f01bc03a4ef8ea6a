//! Explicit schemes where no constraint would say that a motion is none: free particles on cables.

use crate::support::{fixed, symplectic};
use tg_integrate::{EmbeddedPair, Leapfrog, NewtonOptions, Run, RunError, StepFailure, Stepper, Turning};
use tg_model::{CableLaw, Model, ModelBuilder, Signal};

/// A particle of 1 kg, 1.1 m from the anchor of its cable.
fn particle(law: CableLaw, rest: Signal) -> Model<2> {
    let mut b = ModelBuilder::<2>::new();
    let wall = b.anchor("wall", [0.0, 0.0]).unwrap();
    let stone = b.particle("stone", 1.0, [1.1, 0.0]).unwrap();
    b.cable("thread", wall, stone.node(0), law, rest).unwrap();
    b.build().unwrap()
}

fn run(model: &Model<2>, stepper: &mut dyn Stepper, h: f64, end: f64) -> Result<Turning, RunError> {
    let (q, v) = (model.initial_coordinates(), model.velocities_at_rest());
    let mut state = stepper.start(0.0, &q, &v).unwrap();
    let mut turning = Turning::default();
    Run::new(h, end).observe(&mut turning).go(stepper, &mut state).map(|_| turning)
}

fn explicit_steppers(model: &Model<2>) -> [Box<dyn Stepper + '_>; 3] {
    [
        Box::new(Leapfrog::new(model, NewtonOptions::default()).unwrap()),
        Box::new(fixed(model, EmbeddedPair::DormandPrince5)),
        Box::new(fixed(model, EmbeddedPair::DormandPrince8)),
    ]
}

/// h ω = 10: every step multiplies the motion.
#[test]
fn steps_beyond_stability_end_in_words() {
    let model = particle(CableLaw::linear(1e4), Signal::Constant(1.0));
    for mut stepper in explicit_steppers(&model) {
        let error = run(&model, stepper.as_mut(), 0.1, 100.0).unwrap_err();
        println!("{error}");
        match &error.failure.failure {
            StepFailure::Unbounded { size, worst, cables } => {
                assert!(*size > 1e14 && worst.contains("stone") && cables == &["thread"], "{error}");
            }
            other => panic!("{other}"),
        }
    }
    // The implicit scheme is stable, and its steps are told to be too long.
    let turning = run(&model, &mut symplectic(&model), 0.1, 100.0).unwrap();
    assert!(turning.angle() > 1.0, "{}", turning.angle());
}

/// A rest length that is no number is not one of a slack cable.
#[test]
fn rest_lengths_that_become_bad_are_found() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for law in
            [CableLaw::linear(10.0), CableLaw::slacking(10.0), CableLaw::slacking(10.0).with_damping(1.0)]
        {
            let rest = Signal::user(move |t| (if t < 0.05 { 1.0 } else { bad }, 0.0));
            let model = particle(law, rest);
            let mut steppers: Vec<Box<dyn Stepper + '_>> = explicit_steppers(&model).into();
            steppers.push(Box::new(symplectic(&model)));
            for mut stepper in steppers {
                let error = run(&model, stepper.as_mut(), 1e-3, 0.1).unwrap_err();
                assert!((error.failure.t - 0.05).abs() < 2e-3, "{error}");
                assert!(
                    matches!(&error.failure.failure, StepFailure::NotFinite { worst, cables }
                    if worst.contains("stone") && cables == &["thread"]),
                    "{error}"
                );
            }
        }
    }
}
