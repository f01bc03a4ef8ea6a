//! Generalised-α: the same motion as the symplectic scheme, with dissipation.

use crate::support::tower::{self, tower};
use crate::support::{alpha, at_end, corners, distance, example1, order, pendulum, start, symplectic};
use tg_integrate::State;
use tg_model::{Model, ModelBuilder, Signal};

fn energy(model: &Model<2>, state: &State) -> f64 {
    model.energy(&state.q, &state.v, &model.inputs_at(state.t)).total()
}

/// Both schemes approach the same fine run, from their own sides.
#[test]
fn both_schemes_have_one_limit() {
    let p = example1();
    let end = |state: State| corners(&p.model, &[p.triangle], &state.q);
    let fine = end(at_end(&p.model, &mut symplectic(&p.model), 1.25e-5, 0.5));
    for h in [1e-3, 2.5e-4] {
        let a = distance(&end(at_end(&p.model, &mut alpha(&p.model, 0.7), h, 0.5)), &fine);
        let s = distance(&end(at_end(&p.model, &mut symplectic(&p.model), h, 0.5)), &fine);
        println!("h = {h}: {a:.2e} {s:.2e}");
        // Errors at 1e-3: a few 1e-4 m; a sixteenth at a quarter of the step.
        let allowed = 2e-3 * (h / 1e-3).powi(2);
        assert!(a < allowed && s < allowed, "h = {h}: {a:e} {s:e}");
    }
    let t = tower(tower::DN);
    let end = |state: State| corners(&t.model, &t.triangles, &state.q);
    let fine = end(at_end(&t.model, &mut symplectic(&t.model), 2e-5, 1.0));
    let a = distance(&end(at_end(&t.model, &mut alpha(&t.model, 0.7), 2.5e-4, 1.0)), &fine);
    let s = distance(&end(at_end(&t.model, &mut symplectic(&t.model), 2.5e-4, 1.0)), &fine);
    println!("DN: {a:.2e} {s:.2e}");
    assert!(a < 2e-5 && s < 2e-5, "{a:e} {s:e}");
}

/// Framework reference: example 1 with ρ∞ = 0.7 at h = 1e-3 loses about 4.1e-4 of |E0| each second over 500 s. The
/// motion is chaotic and the loss depends on it: 5.5e-4 over the first 20 s, 4.7e-4 over 100 s.
#[test]
fn example_1_loses_the_published_energy() {
    let model = example1().model;
    let mut stepper = alpha(&model, 0.7);
    let mut state = start(&model, &mut stepper);
    let e0 = energy(&model, &state);
    crate::support::run(&mut stepper, &mut state, 1e-3, 500.0);
    let rate = (e0 - energy(&model, &state)) / e0.abs() / 500.0;
    println!("loses {rate:.2e} of |E0| per second");
    assert!(rate > 4.1e-4 / 1.3 && rate < 4.1e-4 * 1.3, "{rate:e}");
    // The symplectic scheme does not: its error stays within 7e-3.
    let kept = at_end(&model, &mut symplectic(&model), 1e-3, 20.0);
    assert!((energy(&model, &kept) - e0).abs() < 7e-3 * e0.abs());
}

/// Smaller ρ∞ damps more.
#[test]
fn spectral_radius_sets_the_dissipation() {
    let (model, _) = pendulum(0.1, 2.0);
    let loss = |rho| {
        let e0 = energy(&model, &start(&model, &mut alpha(&model, rho)));
        e0 - energy(&model, &at_end(&model, &mut alpha(&model, rho), 1e-3, 10.0))
    };
    let losses = [0.0, 0.5, 0.7, 0.9].map(loss);
    println!("{losses:?}");
    assert!(losses.windows(2).all(|pair| pair[0] > 1.3 * pair[1]), "{losses:?}");
    assert!(losses[3] > 0.0);
}

/// A pendulum whose pivot is shaken and whose supports therefore have acceleration.
#[test]
fn moving_supports_keep_second_order() {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -9.81]).unwrap();
    let rod = b.bar("rod", 1.0, [0.0, 0.0], [0.2, -0.2]).unwrap();
    b.support("pivot.x", rod.node(0), 0, Signal::sine(0.05, 2.0)).unwrap();
    let heave = Signal::Sine { amplitude: 0.03, frequency: 3.0, phase: 1.0 };
    // Offsets count from the initial position.
    let from_zero = Signal::Sum(vec![Signal::Constant(-heave.at(0.0).0), heave]);
    b.support("pivot.y", rod.node(0), 1, from_zero).unwrap();
    let model = b.build().unwrap();
    let tip = model.form(rod.node(1)).unwrap();
    let end = |h: f64, rho: f64| {
        let state = at_end(&model, &mut alpha(&model, rho), h, 1.0);
        [tip.eval(&state.q)[0], tip.eval(&state.q)[1]]
    };
    for rho in [0.2, 0.8] {
        let runs = [1e-3, 5e-4, 2.5e-4].map(|h| end(h, rho));
        let order = order([&runs[0], &runs[1], &runs[2]]);
        println!("{order}");
        assert!((order - 2.0).abs() < 0.05, "{order}");
    }
    let exact = at_end(&model, &mut symplectic(&model), 2e-5, 1.0);
    let exact = [tip.eval(&exact.q)[0], tip.eval(&exact.q)[1]];
    let error = distance(&end(2e-5, 0.8), &exact);
    assert!(error < 1e-7, "{error:e}");
}

/// Velocities are not projected, but the multipliers balance the forces: reaction of a rod at rest.
#[test]
fn start_solves_for_the_first_accelerations() {
    let length = 0.5;
    let (model, rod) = pendulum(length, std::f64::consts::FRAC_PI_2);
    let state = start(&model, &mut alpha(&model, 0.7));
    // A horizontal rod let go: θ̈ = 3g/2L, the tip falls with 3g/2.
    let tip = 2 * model.form(rod.node(1)).unwrap().terms()[0].0;
    let n = state.q.len();
    assert!((state.memory[tip + 1] + 1.5 * 9.81).abs() < 1e-12, "{:?}", state.memory);
    assert!(state.memory[tip].abs() < 1e-12 && state.memory[n + tip + 1] == state.memory[tip + 1]);
    // A hanging rod: the dot-product constraint u·u = L² carries the weight of the tip's half, 2 λ L = m g/2.
    let (model, _) = pendulum(length, 0.0);
    let state = start(&model, &mut alpha(&model, 0.7));
    assert!((state.lambda[0].abs() * 2.0 * length - 0.5 * 9.81).abs() < 1e-12, "{:?}", state.lambda);
}
