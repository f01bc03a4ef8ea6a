//! Bad input gives typed errors that name the culprit.

use crate::support::tower::{self, tower};
use crate::support::{alpha, composition, example1, explicit, start, symplectic};
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_integrate::{
    CompositionScheme, EmbeddedPair, Ended, GeneralizedAlpha, NewtonOptions, Run, StartError, State,
    StepFailure, Stepper, Symplectic,
};
use tg_model::{Model, ModelBuilder, Signal};

fn steppers(model: &Model<2>) -> [Box<dyn Stepper + '_>; 4] {
    [
        Box::new(symplectic(model)),
        Box::new(alpha(model, 0.7)),
        Box::new(explicit(model, EmbeddedPair::DormandPrince5, 1e-6)),
        Box::new(composition(model, CompositionScheme::Suzuki4)),
    ]
}

const BAD_STEPS: [f64; 5] = [0.0, -1e-3, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

#[test]
fn bad_steps_are_refused() {
    let model = example1().model;
    for mut stepper in steppers(&model) {
        let mut state = start(&model, stepper.as_mut());
        let before = state.clone();
        for h in BAD_STEPS {
            let error = stepper.step(&mut state, h).unwrap_err();
            assert!(matches!(error.failure, StepFailure::BadStep), "{h}: {error}");
            let error = Run::new(h, 1.0).go(stepper.as_mut(), &mut state).unwrap_err();
            assert!(matches!(error.failure.failure, StepFailure::BadStep), "{h}: {error}");
            assert!(error.to_string().contains("positive and finite"));
            // Also where there is nothing to do.
            assert!(Run::new(h, -1.0).go(stepper.as_mut(), &mut state).is_err());
        }
        assert_eq!(state, before);
    }
}

#[test]
fn end_that_is_not_a_number_is_refused_and_an_end_in_the_past_makes_no_step() {
    let model = example1().model;
    let mut stepper = symplectic(&model);
    let mut state = start(&model, &mut stepper);
    let error = Run::new(1e-3, f64::NAN).go(&mut stepper, &mut state).unwrap_err();
    assert!(matches!(error.failure.failure, StepFailure::BadEnd { end } if end.is_nan()), "{error}");
    let summary = Run::new(1e-3, -1.0).go(&mut stepper, &mut state).unwrap();
    assert_eq!((summary.steps, summary.ended), (0, Ended::AtEnd));
}

#[test]
fn wrong_lengths_are_named() {
    let model = example1().model;
    let (q, v) = (model.initial_coordinates(), model.velocities_at_rest());
    for mut stepper in steppers(&model) {
        let error = stepper.start(0.0, &q[1..], &v).unwrap_err();
        assert!(matches!(error, StartError::Length { what: "coordinates", got, expected }
            if got + 1 == q.len() && expected == q.len()));
        let error = stepper.start(0.0, &q, &[]).unwrap_err();
        assert!(matches!(error, StartError::Length { what: "velocities", got: 0, .. }));
        assert!(error.to_string().contains("0 velocities"), "{error}");
    }
}

/// A checkpoint of another model or another scheme.
#[test]
fn foreign_states_are_refused() {
    let (model, other) = (example1().model, tower(tower::UN).model);
    let foreign = [
        start(&other, &mut symplectic(&other)),
        start(&model, &mut alpha(&model, 0.7)),
        start(&model, &mut symplectic(&model).carrying_momentum()),
        State::default(),
    ];
    for mut state in foreign {
        let before = state.clone();
        let error = symplectic(&model).step(&mut state, 1e-3).unwrap_err();
        println!("{error}");
        assert!(matches!(error.failure, StepFailure::ForeignState { .. }), "{error}");
        assert_eq!(state, before);
    }
    let mut state = start(&model, &mut symplectic(&model));
    let error = alpha(&model, 0.7).step(&mut state, 1e-3).unwrap_err();
    assert!(matches!(error.failure, StepFailure::ForeignState { what: "numbers in memory", .. }));
}

#[test]
fn starts_that_are_not_finite_are_named() {
    let p = example1();
    let (q, v) = (p.model.initial_coordinates(), p.model.velocities_at_rest());
    let tip = 2 * p.model.form(p.triangle.node(1)).unwrap().terms()[0].0;
    for mut stepper in steppers(&p.model) {
        for bad in [f64::NAN, f64::INFINITY] {
            let (mut bad_q, mut bad_v) = (q.clone(), v.clone());
            (bad_q[tip], bad_v[tip + 1]) = (bad, bad);
            for (q, v, axis) in [(&bad_q, &v, "x"), (&q, &bad_v, "y")] {
                let error = stepper.start(0.0, q, v).unwrap_err();
                assert!(
                    matches!(&error, StartError::NotFinite(name)
                    if name.contains("triangle 2") && name.starts_with(axis)),
                    "{error}"
                );
            }
        }
        let error = stepper.start(f64::NAN, &q, &v).unwrap_err();
        assert!(matches!(error, StartError::Parameter { name: "start time", .. }), "{error}");
    }
}

/// Finite numbers whose squares overflow.
#[test]
fn huge_coordinates_are_an_error() {
    let model = example1().model;
    let q: Vec<f64> = (0..model.initial_coordinates().len()).map(|i| [1e200, -2e200, 3e200][i % 3]).collect();
    for mut stepper in steppers(&model) {
        let error = stepper.start(0.0, &q, &model.velocities_at_rest()).unwrap_err();
        assert!(matches!(error, StartError::Inconsistent { .. }), "{error}");
    }
}

#[test]
fn signal_that_is_not_finite_at_the_start_is_named() {
    let mut b = ModelBuilder::<2>::new();
    let bar = b.bar("bar", 1.0, [0.0, 0.0], [1.0, 0.0]).unwrap();
    b.fix("pivot", bar.node(0)).unwrap();
    let signal = Signal::user(|t| if t < 1.0 { (0.0, 0.0) } else { (f64::NAN, 0.0) });
    b.support("guide", bar.node(1), 1, signal).unwrap();
    let model = b.build().unwrap();
    let error =
        symplectic(&model).start(2.0, &model.initial_coordinates(), &model.velocities_at_rest()).unwrap_err();
    assert!(matches!(&error, StartError::NotFinite(name) if name.contains("bar")), "{error}");
}

#[test]
fn start_that_is_not_assembled_is_named() {
    let p = example1();
    let mut q = p.model.initial_coordinates();
    let end = 2 * p.model.form(p.bar.node(1)).unwrap().terms()[0].0;
    q[end] += 1e-4;
    for mut stepper in steppers(&p.model) {
        let error = stepper.start(0.0, &q, &p.model.velocities_at_rest()).unwrap_err();
        println!("{error}");
        assert!(
            matches!(&error, StartError::Inconsistent { constraint, residual }
            if constraint.contains("bar 1") && *residual > 1e-4),
            "{error}"
        );
        assert!(error.to_string().contains("Projector::position"));
    }
}

/// Statics needs no masses, motion does.
#[test]
fn massless_member_is_named() {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -9.81]).unwrap();
    let ghost = MassProperties::massless([0.5, 0.0].into()).unwrap();
    let ghost = Member::new(CoordType::Rr, &[[0.0, 0.0], [1.0, 0.0]].map(Into::into), ghost).unwrap();
    let ghost = b.member("ghost", ghost, Pose::identity()).unwrap();
    b.fix("pivot", ghost.node(0)).unwrap();
    let model = b.build().unwrap();
    for mut stepper in steppers(&model) {
        let error =
            stepper.start(0.0, &model.initial_coordinates(), &model.velocities_at_rest()).unwrap_err();
        println!("{error}");
        assert!(matches!(error, StartError::Projection(_)), "{error}");
        assert!(error.to_string().contains("ghost") && error.to_string().contains("mass"), "{error}");
    }
}

#[test]
fn spectral_radius_out_of_range_is_refused() {
    let model = example1().model;
    for rho in [-0.1, 1.0, 1.5, f64::NAN, f64::INFINITY] {
        match GeneralizedAlpha::new(&model, rho, NewtonOptions::default()) {
            Err(StartError::Parameter { name: "spectral radius", value, .. }) => {
                assert_eq!(value.to_bits(), rho.to_bits());
            }
            Err(other) => panic!("{other}"),
            Ok(_) => panic!("{rho} was taken"),
        }
    }
    assert!(GeneralizedAlpha::new(&model, 0.0, NewtonOptions::default()).is_ok());
}

#[test]
fn bad_options_are_refused() {
    let model = example1().model;
    for tolerance in [f64::NAN, -1e-12, f64::INFINITY] {
        let options = NewtonOptions { tolerance, ..NewtonOptions::default() };
        assert!(matches!(Symplectic::new(&model, options), Err(StartError::Parameter { .. })), "{tolerance}");
        let alpha = GeneralizedAlpha::new(&model, 0.5, options);
        assert!(matches!(alpha, Err(StartError::Parameter { .. })), "{tolerance}");
    }
    let options = NewtonOptions { halvings: 40, ..NewtonOptions::default() };
    assert!(matches!(
        Symplectic::new(&model, options),
        Err(StartError::Parameter { name: "number of halvings", .. })
    ));
}
