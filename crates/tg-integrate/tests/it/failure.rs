//! A step that fails: the state is that before, the data are kept, and the message says when, where and why.

use crate::support::{alpha, example1, run, start, symplectic};
use tg_integrate::{NewtonOptions, Recorder, Run, StepFailure, Stepper, Symplectic};
use tg_model::{CableLaw, Joining, Model, ModelBuilder, Signal};

/// Two bars as a chain; its end is moved, and a cable with a driven rest length ties the joint.
fn chain(end: Signal, rest: Signal) -> Model<2> {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -9.81]).unwrap();
    let left = b.bar("left bar", 1.0, [0.0, 0.0], [0.3, -0.4]).unwrap();
    let right = b.bar("right bar", 1.0, [0.3, -0.4], [0.6, 0.0]).unwrap();
    let eye = b.anchor("eye", [0.3, -1.0]).unwrap();
    b.fix("foot", left.node(0)).unwrap();
    b.shake("hand", right.node(1), end).unwrap();
    b.joint("knee", &[left.node(1), right.node(0)], Joining::Share).unwrap();
    b.cable("tie", left.node(1), eye, CableLaw::linear(50.0), rest).unwrap();
    b.build().unwrap()
}

#[test]
fn signal_that_becomes_nan_stops_the_run_and_keeps_the_data() {
    let broken = Signal::user(|t| if t > 0.5 { (f64::NAN, f64::NAN) } else { (0.6, 0.0) });
    let model = chain(Signal::Constant(0.0), broken);
    let mut steppers: [Box<dyn Stepper + '_>; 2] =
        [Box::new(symplectic(&model)), Box::new(alpha(&model, 0.7))];
    for stepper in &mut steppers {
        let mut state = start(&model, stepper.as_mut());
        let mut last = state.clone();
        let mut watch = |state: &tg_integrate::State, _: &tg_integrate::StepReport| last = state.clone();
        let mut recorder = Recorder::every(1).channel("t", |state| state.t);
        let error = Run::new(1e-3, 1.0)
            .observe(&mut recorder)
            .observe(&mut watch)
            .go(stepper.as_mut(), &mut state)
            .unwrap_err();
        println!("{error}");
        assert_eq!(error.summary.steps, 500);
        assert!((error.failure.t - 0.5).abs() < 1e-12 && error.failure.h == 1e-3);
        assert!(error.failure.residual.is_nan());
        match &error.failure.failure {
            StepFailure::NotFinite { worst, cables } => {
                assert!(worst.contains("left bar") || worst.contains("right bar"), "{worst}");
                assert_eq!(cables, &["tie"]);
            }
            other => panic!("{other}"),
        }
        let text = error.to_string();
        assert!(text.contains("500 steps") && text.contains("tie") && text.contains("0.5"), "{text}");
        assert_eq!(state, last, "the state is that of the last accepted step");
        assert_eq!(recorder.times().len(), 501);
    }
}

#[test]
fn support_signal_that_becomes_nan_is_found_too() {
    let broken = Signal::user(|t| if t > 0.25 { (f64::NAN, 0.0) } else { (0.0, 0.0) });
    let model = chain(broken, Signal::Constant(0.6));
    let mut stepper = symplectic(&model);
    let mut state = start(&model, &mut stepper);
    let error = Run::new(1e-3, 1.0).go(&mut stepper, &mut state).unwrap_err();
    assert!((error.failure.t - 0.25).abs() < 1e-12);
    assert!(matches!(error.failure.failure, StepFailure::NotFinite { .. }), "{error}");
    assert!(state.q.iter().all(|q| q.is_finite()));
}

/// The end is pulled beyond the chain's reach, 1 m, which it passes at t = 0.4 s: no configuration is left.
#[test]
fn pulled_beyond_its_reach_a_chain_fails_at_its_rigidity() {
    let pull = Signal::user(|t| (t, 1.0));
    let model = chain(pull, Signal::Constant(0.6));
    let mut steppers: [Box<dyn Stepper + '_>; 2] =
        [Box::new(symplectic(&model)), Box::new(alpha(&model, 0.7))];
    for stepper in &mut steppers {
        let mut state = start(&model, stepper.as_mut());
        let error = Run::new(1e-3, 1.0).go(stepper.as_mut(), &mut state).unwrap_err();
        println!("{error}");
        assert!((0.39..0.41).contains(&error.failure.t), "{error}");
        assert_eq!(state.t, error.failure.t);
        let text = error.to_string();
        assert!(text.contains("bar\"") || text.contains("structure"), "{text}");
        assert!(error.failure.residual > 1e-12);
    }
}

#[test]
fn absurd_step_fails_and_leaves_the_state() {
    let model = example1().model;
    let mut steppers: [Box<dyn Stepper + '_>; 3] = [
        Box::new(symplectic(&model)),
        Box::new(symplectic(&model).carrying_momentum()),
        Box::new(alpha(&model, 0.7)),
    ];
    for stepper in &mut steppers {
        let mut state = start(&model, stepper.as_mut());
        run(stepper.as_mut(), &mut state, 1e-3, 0.1);
        let before = state.clone();
        let error = stepper.step(&mut state, 1e3).unwrap_err();
        println!("{error}");
        assert_eq!(state, before);
        assert_eq!((error.t, error.h), (before.t, 1e3));
        match &error.failure {
            StepFailure::NotConverged { iterations, residual, worst, .. } => {
                assert!(*iterations > 0 && *residual > 1e-12 && *residual == error.residual);
                assert!(worst.contains("bar 1") || worst.contains("triangle 2"), "{worst}");
            }
            StepFailure::Solver { culprit, .. } => assert!(!culprit.is_empty()),
            other => panic!("{other}"),
        }
        // The stepper is not spoilt by the failure.
        stepper.step(&mut state, 1e-3).unwrap();
    }
}

/// A particle at the anchor of its cable: the direction of the force does not exist.
#[test]
fn cable_of_zero_length_is_named() {
    let mut b = ModelBuilder::<2>::new();
    let wall = b.anchor("wall", [0.0, 0.0]).unwrap();
    let stone = b.particle("stone", 1.0, [1.0, 0.0]).unwrap();
    b.cable("rubber", wall, stone.node(0), CableLaw::linear(10.0), 0.5).unwrap();
    let model = b.build().unwrap();
    let zeros = vec![0.0; model.initial_coordinates().len()];
    let mut stepper = symplectic(&model);
    let mut state = stepper.start(0.0, &zeros, &zeros).unwrap();
    let before = state.clone();
    let error = stepper.step(&mut state, 1e-3).unwrap_err();
    println!("{error}");
    assert!(matches!(&error.failure, StepFailure::NotFinite { worst, cables }
        if worst.contains("stone") && cables == &["rubber"]));
    assert_eq!(state, before);
}

/// The midpoint of a whole step lies exactly on the anchor, those of the halves do not: the remedy passes the crossing.
#[test]
fn crossing_zero_length_in_mid_step_is_passed_in_two_halves() {
    let mut b = ModelBuilder::<2>::new();
    let wall = b.anchor("wall", [0.0, 0.0]).unwrap();
    let h = 1.0 / 1024.0;
    let stone = b.particle("stone", 1.0, [2.5 * h, 0.0]).unwrap();
    b.support("rail", stone.node(0), 1, 0.0).unwrap();
    b.cable("thread", wall, stone.node(0), CableLaw::linear(1e-300), 1.0).unwrap();
    let model = b.build().unwrap();
    let x = 2 * model.form(stone.node(0)).unwrap().terms()[0].0;
    let mut v = model.velocities_at_rest();
    v[x] = -1.0;
    let mut stepper = symplectic(&model);
    let mut state = stepper.start(0.0, &model.initial_coordinates(), &v).unwrap();
    let substeps: Vec<u32> = (0..4).map(|_| stepper.step(&mut state, h).unwrap().substeps).collect();
    assert_eq!(substeps, [1, 1, 2, 1]);
    assert!((state.q[x] + 1.5 * h).abs() < 1e-18);
}

/// With too few iterations every step fails: the message says what to do.
#[test]
fn too_few_iterations_are_told() {
    let model = example1().model;
    let options = NewtonOptions { max_iterations: 1, halvings: 0, ..NewtonOptions::default() };
    let mut stepper = Symplectic::new(&model, options).unwrap();
    let mut state = start(&model, &mut stepper);
    let error = stepper.step(&mut state, 5e-3).unwrap_err();
    println!("{error}");
    assert!(matches!(error.failure, StepFailure::NotConverged { iterations: 1, .. }));
    assert!(error.to_string().contains("smaller step"));
}
