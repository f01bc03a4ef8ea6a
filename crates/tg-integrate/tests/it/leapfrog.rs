//! The leapfrog scheme: order, energy, reversal, supports in motion, damping.

use crate::support::prism::{self, prisms};
use crate::support::tower::{self, tower};
use crate::support::{at_end, distance, example1, explicit, position, run, start, symplectic};
use tg_fixtures::mast;
use tg_integrate::{EmbeddedPair, Leapfrog, NewtonOptions, Run, State, StepReport, Stepper};
use tg_model::{Mechanics, Model};

fn leapfrog(mechanics: &dyn Mechanics) -> Leapfrog<'_> {
    Leapfrog::new(mechanics, NewtonOptions::default()).unwrap()
}

/// Errors of the end's coordinates against an explicit scheme of order eight, at a step and at its half.
fn errors<const D: usize>(model: &Model<D>, h: f64, end: f64) -> [f64; 2] {
    let exact = at_end(model, &mut explicit(model, EmbeddedPair::DormandPrince8, 1e-12), end, end);
    [h, 0.5 * h].map(|h| distance(&at_end(model, &mut leapfrog(model), h, end).q, &exact.q))
}

#[test]
fn second_order_with_supports_in_motion_and_damping() {
    let mast = mast(2).unwrap().model;
    let cases = [
        ("example 1", errors(&example1().model, 1e-3, 0.5)),
        ("UN", errors(&tower(tower::UN).model, 1e-3, 0.5)),
        ("DN", errors(&tower(tower::DN).model, 1e-3, 0.5)),
        ("mast", errors(&mast, 2e-3, 0.5)),
    ];
    for (name, [coarse, fine]) in cases {
        let order = (coarse / fine).log2();
        println!("{name}: {coarse:.2e} {fine:.2e}, order {order:.3}");
        assert!(coarse < 1e-3 && (order - 2.0).abs() < 0.1, "{name}: {coarse:e} {fine:e}");
    }
}

/// The step that other tools were measured with, against converged positions of another program.
#[test]
fn mast_of_two_stages_at_two_seconds() {
    let mast = mast(2).unwrap();
    let state = at_end(&mast.model, &mut leapfrog(&mast.model), 1e-3, 2.0);
    let top = position(&mast.model, mast.nodes[5], &state.q);
    let error = distance(&top, &[-0.03981251597, -0.07494079787, 0.30270588333]);
    assert!(error < 6e-6, "{error:e}");
}

#[test]
fn energy_oscillates_and_does_not_drift() {
    let model = example1().model;
    let energy = |state: &State| model.energy(&state.q, &state.v, &[]).total();
    let mut stepper = leapfrog(&model);
    let mut state = start(&model, &mut stepper);
    let first = energy(&state);
    let mut worst = [0.0_f64; 2];
    let mut watch = |state: &State, _: &StepReport| {
        let half = usize::from(state.t > 10.0);
        worst[half] = worst[half].max((energy(state) - first).abs());
    };
    Run::new(1e-3, 20.0).observe(&mut watch).go(&mut stepper, &mut state).unwrap();
    println!("{worst:?}");
    assert!(worst[1] < 2.0 * worst[0] && worst[0] < 1e-3, "{worst:?}");
}

#[test]
fn constraints_and_their_rates_hold() {
    let model = tower(tower::US).model;
    let mut projector = tg_model::Projector::new(&model).unwrap();
    let mut stepper = leapfrog(&model);
    let mut state = start(&model, &mut stepper);
    for _ in 0..500 {
        stepper.step(&mut state, 1e-3).unwrap();
        assert!(projector.constraint_residual(&state.q).1 < 1e-12);
        let moved = projector.velocity(&state.q, &mut state.v.clone()).unwrap();
        assert!(moved.largest < 1e-12, "{moved:?}");
    }
}

#[test]
fn reversed_runs_return() {
    let model = prisms(prism::FLOATING).model;
    let mut stepper = leapfrog(&model);
    let q = model.initial_coordinates();
    let kicked: Vec<f64> = (0..q.len()).map(|i| (i as f64 * 1.7).sin()).collect();
    let mut state = stepper.start(0.0, &q, &kicked).unwrap();
    let origin = state.q.clone();
    run(&mut stepper, &mut state, 1e-3, 0.2);
    let back: Vec<f64> = state.v.iter().map(|v| -v).collect();
    let mut state = stepper.start(0.0, &state.q, &back).unwrap();
    run(&mut stepper, &mut state, 1e-3, 0.2);
    let distance = distance(&state.q, &origin);
    assert!(distance < 1e-10, "{distance:e}");
}

/// Where forces keep their places, λ is that of the symplectic scheme.
#[test]
fn multipliers_at_rest_are_those_of_statics() {
    let model = prisms(prism::STANDING).model;
    let mut a = at_end(&model, &mut leapfrog(&model), 1e-3, 0.05);
    let b = at_end(&model, &mut symplectic(&model), 1e-3, 0.05);
    let size = b.lambda.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    a.lambda.iter_mut().zip(&b.lambda).for_each(|(a, b)| *a -= b);
    let apart = a.lambda.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    assert!(apart < 1e-2 * size, "{apart:e} of {size:e}");
}
