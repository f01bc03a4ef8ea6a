//! Compositions of the symplectic scheme: order, reversal, energy, checkpoints, refusals.

use crate::support::tower::{self, tower};
use crate::support::{at_end, composition, corners, distance, explicit, run, start, symplectic};
use tg_integrate::{
    Composition, CompositionScheme, EmbeddedPair, NewtonOptions, State, StepFailure, Stepper,
};

const SCHEMES: [(CompositionScheme, f64, f64); 2] =
    [(CompositionScheme::Suzuki4, 4.0, 8e-3), (CompositionScheme::KahanLi6, 6.0, 1.6e-2)];

/// Moving supports and damping in both directions of time included.
#[test]
fn compositions_have_their_orders() {
    for (name, setup) in [("undamped", tower::UN), ("damped", tower::DN)] {
        let t = tower(setup);
        let exact = at_end(&t.model, &mut explicit(&t.model, EmbeddedPair::DormandPrince8, 1e-11), 0.2, 0.2);
        let exact = corners(&t.model, &t.triangles, &exact.q);
        for (scheme, expected, h) in SCHEMES {
            let errors = [0.5, 0.25].map(|part| {
                let state = at_end(&t.model, &mut composition(&t.model, scheme), part * h, 0.2);
                distance(&corners(&t.model, &t.triangles, &state.q), &exact)
            });
            let order = (errors[0] / errors[1]).log2();
            println!("{name}, {scheme:?}: {errors:?}, order {order}");
            assert!((order - expected).abs() < 0.6, "{name}, {scheme:?}: {order}");
        }
    }
}

#[test]
fn reversed_runs_return() {
    let model = tower(tower::STILL).model;
    let q = model.initial_coordinates();
    let kick: Vec<f64> = (0..q.len()).map(|i| 0.1 * (2.3 * i as f64).sin()).collect();
    for (scheme, _, _) in SCHEMES {
        let mut stepper = composition(&model, scheme);
        let first = stepper.start(0.0, &q, &kick).unwrap();
        let mut state = first.clone();
        let steps = |stepper: &mut dyn Stepper, state: &mut State| {
            (0..50).for_each(|_| assert_eq!(stepper.step(state, 2e-3).unwrap().substeps, 1));
        };
        steps(&mut stepper, &mut state);
        let away = distance(&state.q, &first.q);
        state.v.iter_mut().for_each(|v| *v = -*v);
        steps(&mut stepper, &mut state);
        let (position, speed) = (distance(&state.q, &first.q), {
            state.v.iter_mut().for_each(|v| *v = -*v);
            distance(&state.v, &first.v)
        });
        println!("{scheme:?}: q {position:.1e}, v {speed:.1e}, was {away:.1e} away");
        assert!(away > 1e-3 && position < 1e-10 && speed < 1e-8, "{scheme:?}: {position:e} {speed:e}");
    }
}

/// The error of the energy is bounded: no larger in the second half of a run than in the first.
#[test]
fn energy_does_not_drift() {
    let model = tower(tower::STILL).model;
    let u = model.inputs_at(0.0);
    for (scheme, _, h) in SCHEMES {
        let mut stepper = composition(&model, scheme);
        let q = model.initial_coordinates();
        let kick: Vec<f64> = (0..q.len()).map(|i| 0.1 * (2.3 * i as f64).sin()).collect();
        let mut state = stepper.start(0.0, &q, &kick).unwrap();
        let energy = |state: &State| model.energy(&state.q, &state.v, &u).total();
        let first = energy(&state);
        let half = |stepper: &mut dyn Stepper, state: &mut State| {
            (0..50).fold(0.0_f64, |worst, _| {
                stepper.step(state, h).unwrap();
                worst.max((energy(state) - first).abs())
            })
        };
        let (early, late) = (half(&mut stepper, &mut state), half(&mut stepper, &mut state));
        println!("{scheme:?}: {early:.1e} J, {late:.1e} J");
        assert!(late < 2.0 * early, "{scheme:?}: {early:e} {late:e}");
    }
}

#[test]
fn a_state_read_back_continues_bit_for_bit_and_time_is_exact() {
    let model = tower(tower::UN).model;
    let make = || composition(&model, CompositionScheme::KahanLi6);
    let mut whole = start(&model, &mut make());
    run(&mut make(), &mut whole, 0.01, 0.3);
    let mut parts = start(&model, &mut make());
    for end in [0.1, 0.3] {
        parts = serde_json::from_str(&serde_json::to_string(&parts).unwrap()).unwrap();
        run(&mut make(), &mut parts, 0.01, end);
    }
    assert_eq!(parts, whole);
    assert_eq!(whole.t, 0.3);
}

/// Going back is an inner matter: from outside a step is positive, and one that fails leaves the state as it was.
#[test]
fn negative_steps_and_bad_options_are_refused() {
    let model = tower(tower::UN).model;
    let mut stepper = composition(&model, CompositionScheme::Suzuki4);
    let mut state = start(&model, &mut stepper);
    let before = state.clone();
    for h in [-1e-3, 0.0, f64::NAN] {
        assert!(matches!(stepper.step(&mut state, h).unwrap_err().failure, StepFailure::BadStep));
    }
    assert!(symplectic(&model).step(&mut state, -1e-3).is_err());
    let options = NewtonOptions { max_iterations: 0, halvings: 0, ..NewtonOptions::default() };
    let mut hasty = Composition::new(&model, CompositionScheme::Suzuki4, options).unwrap();
    assert!(hasty.step(&mut state, 1e-2).is_err());
    assert_eq!(state, before);
    let options = NewtonOptions { tolerance: f64::NAN, ..options };
    assert!(Composition::new(&model, CompositionScheme::Suzuki4, options).is_err());
}
