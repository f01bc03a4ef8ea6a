//! Time reversal: the scheme is symmetric, so velocities reversed lead back to the start.

use crate::support::prism::{self, prisms};
use crate::support::tower::{self, tower};
use crate::support::{distance, example1, symplectic};
use tg_integrate::{State, Stepper};
use tg_model::Model;

/// From a kick 1000 steps, velocities reversed, 1000 steps: how far from the start in q and in -q̇; and how far it was
/// away.
fn there_and_back<const D: usize>(model: &Model<D>, stepper: &mut dyn Stepper) -> (f64, f64, f64) {
    let q = model.initial_coordinates();
    let kick: Vec<f64> = (0..q.len()).map(|i| 0.1 * (2.3 * i as f64).sin()).collect();
    let first = stepper.start(0.0, &q, &kick).unwrap();
    let mut state = first.clone();
    let steps = |stepper: &mut dyn Stepper, state: &mut State| {
        (0..1000).for_each(|_| assert_eq!(stepper.step(state, 1e-3).unwrap().substeps, 1));
    };
    steps(stepper, &mut state);
    let away = distance(&state.q, &first.q);
    state.v.iter_mut().chain(&mut state.memory).for_each(|v| *v = -*v);
    steps(stepper, &mut state);
    state.v.iter_mut().for_each(|v| *v = -*v);
    (distance(&state.q, &first.q), distance(&state.v, &first.v), away)
}

#[test]
fn reversed_runs_return() {
    let p = example1().model;
    let still = tower(tower::STILL).model;
    let slacking = tower(tower::Setup { slacking: true, ..tower::STILL }).model;
    let prism = prisms(prism::STANDING).model;
    let runs = [
        ("example 1", there_and_back(&p, &mut symplectic(&p))),
        ("example 1, momentum as printed", there_and_back(&p, &mut symplectic(&p).carrying_momentum())),
        ("tower", there_and_back(&still, &mut symplectic(&still))),
        ("tower, slacking", there_and_back(&slacking, &mut symplectic(&slacking))),
        ("prism", there_and_back(&prism, &mut symplectic(&prism))),
    ];
    for (name, (position, velocity, away)) in runs {
        println!("{name}: q {position:.1e}, v {velocity:.1e}, was {away:.1e} away");
        assert!(away > 1e-4, "{name} does not move");
        assert!(position < 1e-9, "{name}: {position:.1e}");
        assert!(velocity < 1e-7, "{name}: {velocity:.1e}");
    }
}

/// Damping is not reversible: the test above can fail.
#[test]
fn a_damped_run_does_not_return() {
    let model = tower(tower::Setup { damping: 0.1, ..tower::STILL }).model;
    let (position, _, away) = there_and_back(&model, &mut symplectic(&model));
    assert!(position > 0.01 * away);
}
