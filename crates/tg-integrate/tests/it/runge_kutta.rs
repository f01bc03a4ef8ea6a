//! Explicit Runge–Kutta schemes on smooth scenes: order, error control, projection, checkpoints, refusals.

use crate::support::tower::{self, tower};
use crate::support::{
    at_end, constraint_rate, corners, distance, example1, explicit, fixed, order, pendulum, run, start,
    symplectic,
};
use tg_integrate::{
    EmbeddedPair, NewtonOptions, Run, RungeKutta, StartError, State, StepFailure, Stepper, Symplectic,
    Tolerances,
};
use tg_model::{Model, ModelBuilder, Signal};

const PAIRS: [EmbeddedPair; 2] = [EmbeddedPair::DormandPrince5, EmbeddedPair::DormandPrince8];

fn bits(state: &State) -> Vec<u64> {
    let numbers = [&[state.t, state.t_rest], &state.q[..], &state.v, &state.lambda, &state.memory];
    numbers.concat().into_iter().map(f64::to_bits).collect()
}

/// Orders from each three of `runs` successive halvings of a fixed step.
fn orders(model: &Model<2>, pair: EmbeddedPair, h: f64, end: f64, runs: i32) -> Vec<f64> {
    let q = |k: i32| {
        let mut stepper = fixed(model, pair);
        at_end(model, &mut stepper, h / f64::from(1 << k), end).q
    };
    let runs: Vec<_> = (0..runs).map(q).collect();
    runs.windows(3).map(|w| order([&w[0], &w[1], &w[2]])).collect()
}

#[test]
fn pairs_have_their_orders() {
    let (pendulum, tower) = (example1().model, tower(tower::UN).model);
    let [five, eight] = PAIRS;
    for (name, orders, expected) in [
        ("example 1, 5", orders(&pendulum, five, 2e-3, 0.4, 4), 5.0),
        ("tower, 5", orders(&tower, five, 4e-3, 0.2, 4), 5.0),
        ("example 1, 8", orders(&pendulum, eight, 4e-3, 0.4, 3), 8.0),
        ("tower, 8", orders(&tower, eight, 1.6e-2, 0.4, 3), 8.0),
    ] {
        println!("{name}: {orders:?}");
        assert!(orders.iter().all(|order| (order - expected).abs() < 1.0), "{name}: {orders:?}");
    }
}

/// A rod whose pivot moves along a sine in both directions, with a sum and a user's function among the signals.
fn shaken_rod() -> Model<2> {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -9.81]).unwrap();
    let rod = b.bar("rod", 1.0, [0.0, 0.0], [0.2, -0.2]).unwrap();
    b.support("pivot.x", rod.node(0), 0, Signal::sine(0.05, 2.0)).unwrap();
    let heave = Signal::user(|t: f64| (0.03 * (1.0 - (18.0 * t).cos()), 0.54 * (18.0 * t).sin()));
    b.support("pivot.y", rod.node(0), 1, Signal::Sum(vec![Signal::sine(0.01, 1.0), heave])).unwrap();
    b.build().unwrap()
}

/// Prescribed accelerations enter the index-1 equations: without them the order would be none at all.
#[test]
fn moving_supports_keep_the_order() {
    let model = shaken_rod();
    let [five, eight] = PAIRS;
    let five = orders(&model, five, 4e-3, 0.8, 4);
    let eight = orders(&model, eight, 1.6e-2, 0.8, 3);
    println!("{five:?} {eight:?}");
    assert!(five.iter().all(|order| (order - 5.0).abs() < 0.6), "{five:?}");
    assert!((eight[0] - 8.0).abs() < 0.8, "{eight:?}");
    let exact = at_end(&model, &mut symplectic(&model), 2e-4, 0.8);
    let found = at_end(&model, &mut explicit(&model, PAIRS[1], 1e-10), 0.1, 0.8);
    assert!(distance(&exact.q, &found.q) < 1e-5, "the same motion as by the symplectic scheme");
}

/// Example 2, UN: mass centre of triangle 3 (framework reference values, minimal-coordinate, high-precision model), to
/// all of its digits.
#[test]
fn error_follows_the_tolerance() {
    let t = tower(tower::UN);
    let centre = t.model.form(t.triangles[0].mass_centre()).unwrap();
    for pair in PAIRS {
        let errors = [1e-4, 1e-6, 1e-8, 1e-10].map(|tolerance| {
            let state = at_end(&t.model, &mut explicit(&t.model, pair, tolerance), 0.4, 0.8);
            let centre = centre.eval(&state.q);
            distance(&[centre[0], centre[1]], &[0.02450121681862, 0.1116166889514])
        });
        println!("{pair:?}: {errors:?}");
        for (error, tolerance) in errors.iter().zip([1e-4, 1e-6, 1e-8, 1e-10]) {
            assert!(*error < 0.1 * tolerance, "{pair:?} at {tolerance:e}: {error:e}");
        }
    }
}

#[test]
fn undamped_tower_keeps_its_energy_within_the_tolerance() {
    let model = tower(tower::STILL).model;
    let u = model.inputs_at(0.0);
    let energy = |state: &State| model.energy(&state.q, &state.v, &u).total();
    for (tolerance, allowed) in [(1e-6, 1e-7), (1e-9, 1e-10)] {
        let mut stepper = explicit(&model, EmbeddedPair::DormandPrince8, tolerance);
        let kick: Vec<f64> = (0..64).map(|i| 0.1 * (2.3 * i as f64).sin()).collect();
        let q = model.initial_coordinates();
        let mut state = stepper.start(0.0, &q, &kick[..q.len()]).unwrap();
        let first = energy(&state);
        run(&mut stepper, &mut state, 0.25, 0.5);
        let kinetic = model.energy(&state.q, &state.v, &u).kinetic;
        let change = (energy(&state) - first).abs();
        println!("{tolerance:e}: {change:.1e} J of {kinetic:.1e} J");
        assert!(kinetic > 1e-5 && change < allowed, "{change:e}");
    }
}

/// Positions, velocities, and multipliers belong to the time of the state.
#[test]
fn states_are_consistent() {
    let model = tower(tower::UN).model;
    for pair in PAIRS {
        let mut stepper = fixed(&model, pair);
        let mut state = start(&model, &mut stepper);
        for _ in 0..50 {
            let report = stepper.step(&mut state, 8e-3).unwrap();
            assert!(report.residual < 1e-13 && report.substeps == 1 && report.rejected == 0, "{report:?}");
            assert!(constraint_rate(&model, &state) < 1e-13);
        }
    }
    // A hanging rod: the dot-product constraint u·u = L² carries the weight of the tip's half, 2 λ L = m g/2.
    let (model, _) = pendulum(0.5, 0.0);
    let state = at_end(&model, &mut explicit(&model, PAIRS[0], 1e-6), 0.1, 0.3);
    assert!((state.lambda[0].abs() - 0.5 * 9.81).abs() < 1e-10, "{:?}", state.lambda);
}

/// A long step and many short ones agree; the number of evaluations is the tolerance's affair, not the step's.
#[test]
fn steps_are_divided_as_the_tolerance_asks() {
    let model = example1().model;
    let mut stepper = explicit(&model, PAIRS[1], 1e-8);
    let (mut long, mut short) = (start(&model, &mut stepper), start(&model, &mut stepper));
    let one = stepper.step(&mut long, 0.5).unwrap();
    let many = run(&mut stepper, &mut short, 0.05, 0.5);
    println!("{one:?} {many:?}");
    assert!(one.substeps > 5 && many.iterations < 2 * u64::from(one.iterations));
    assert!(distance(&long.q, &short.q) < 1e-8);
    assert_eq!(long.t, 0.5);
}

#[test]
fn a_state_read_back_continues_bit_for_bit() {
    for setup in [tower::UN, tower::US] {
        let model = tower(setup).model;
        let make = || explicit(&model, PAIRS[0], 1e-6);
        let mut whole = start(&model, &mut make());
        run(&mut make(), &mut whole, 0.02, 0.4);
        let mut parts = start(&model, &mut make());
        for end in [0.1, 0.28, 0.4] {
            let text = serde_json::to_string(&parts).unwrap();
            parts = serde_json::from_str(&text).unwrap();
            run(&mut make(), &mut parts, 0.02, end);
        }
        assert_eq!(bits(&parts), bits(&whole));
    }
}

#[test]
fn bad_tolerances_are_refused() {
    let model = example1().model;
    let good = Tolerances::default();
    let cases = [
        (Tolerances { relative: -1e-6, ..good }, "relative tolerance"),
        (Tolerances { relative: f64::NAN, ..good }, "relative tolerance"),
        (Tolerances { absolute: 0.0, ..good }, "absolute tolerance"),
        (Tolerances { absolute: f64::INFINITY, ..good }, "absolute tolerance"),
        (Tolerances { most_substeps: 0, ..good }, "number of substeps"),
    ];
    for (tolerances, expected) in cases {
        match RungeKutta::new(&model, PAIRS[0], tolerances) {
            Err(StartError::Parameter { name, .. }) => assert_eq!(name, expected),
            Err(other) => panic!("{other}"),
            Ok(_) => panic!("{tolerances:?} was taken"),
        }
    }
}

#[test]
fn hopeless_steps_say_why_and_leave_the_state() {
    let model = tower(tower::UN).model;
    let out_of_reach = Tolerances { relative: 0.0, absolute: 1e-300, ..Tolerances::default() };
    let few = Tolerances { most_substeps: 3, ..Tolerances::relative(1e-8) };
    for (tolerances, word) in [(out_of_reach, "loosen"), (few, "symplectic")] {
        let mut stepper = RungeKutta::new(&model, PAIRS[0], tolerances).unwrap();
        let mut state = start(&model, &mut stepper);
        let before = state.clone();
        let error = stepper.step(&mut state, 0.5).unwrap_err();
        println!("{error}");
        assert!(matches!(
            error.failure,
            StepFailure::StepTooSmall { .. } | StepFailure::TooManySubsteps { substeps: 3, .. }
        ));
        assert!(error.to_string().contains(word) && error.to_string().contains("t = "), "{error}");
        assert_eq!(state, before);
    }
}

#[test]
fn signal_that_becomes_nan_is_named() {
    let mut b = ModelBuilder::<2>::new();
    let bar = b.bar("bar", 1.0, [0.0, 0.0], [1.0, 0.0]).unwrap();
    b.fix("pivot", bar.node(0)).unwrap();
    let eye = b.anchor("eye", [1.0, 1.0]).unwrap();
    let rest = Signal::user(|t| if t > 0.5 { (f64::NAN, 0.0) } else { (0.9, 0.0) });
    b.cable("tie", bar.node(1), eye, tg_model::CableLaw::linear(50.0), rest).unwrap();
    let model = b.build().unwrap();
    for mut stepper in [explicit(&model, PAIRS[0], 1e-6), fixed(&model, PAIRS[1])] {
        let mut state = start(&model, &mut stepper);
        let error = Run::new(0.01, 1.0).go(&mut stepper, &mut state).unwrap_err();
        println!("{error}");
        assert!((state.t - 0.5).abs() < 1e-9, "{}", state.t);
        assert!(
            matches!(&error.failure.failure, StepFailure::NotFinite { worst, .. } if worst.contains("bar"))
        );
    }
}

/// At the same step the explicit scheme is far more exact than the symplectic one, for about three times its cost.
#[test]
fn fixed_steps_beat_the_symplectic_scheme_on_a_smooth_scene() {
    let t = tower(tower::DN);
    let end = |stepper: &mut dyn Stepper| {
        let state = at_end(&t.model, stepper, 4e-3, 0.4);
        corners(&t.model, &t.triangles, &state.q)
    };
    let exact = end(&mut explicit(&t.model, PAIRS[1], 1e-11));
    let five = distance(&end(&mut fixed(&t.model, PAIRS[0])), &exact);
    let two = distance(&end(&mut Symplectic::new(&t.model, NewtonOptions::default()).unwrap()), &exact);
    println!("{five:.1e} {two:.1e}");
    assert!(five < 1e-3 * two, "{five:e} {two:e}");
}

/// A fixed step so long that bars tear is an error, not a state off the constraints.
#[test]
fn fixed_step_far_too_long_is_refused() {
    let model = tower(tower::UN).model;
    for pair in PAIRS {
        let mut stepper = fixed(&model, pair);
        let mut state = start(&model, &mut stepper);
        let failed = (0..50).find_map(|_| stepper.step(&mut state, 0.2).err());
        let error = failed.unwrap();
        println!("{error}");
        assert!(matches!(
            error.failure,
            StepFailure::NotConverged { .. } | StepFailure::NotFinite { .. } | StepFailure::Solver { .. }
        ));
        assert!(state.q.iter().all(|q| q.is_finite()));
    }
}
