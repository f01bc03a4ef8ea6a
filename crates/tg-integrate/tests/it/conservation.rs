//! Conservation: linear and angular momentum of a floating structure exactly, energy without drift.
//!
//! The scheme keeps angular momentum because internal forces act at the midpoint, with M Δ/h parallel to Δ:
//! `L_{k+1} - L_k = Δ × M Δ/h + h q_m × F(q_m) = 0`; constraint forces act at both ends along gradients of functions
//! that rotations do not change, and so does the projection.

use crate::support::momentum::momentum;
use crate::support::prism::{self, prisms};
use crate::support::tower::{self, tower};
use crate::support::{alpha, at_end, distance, example1, start, symplectic};
use tg_coords::MassProperties;
use tg_integrate::{State, Stepper};
use tg_model::{MemberId, Model};

/// A floating prism in free fall with a kick that turns, shifts and shakes it.
fn kicked(setup: prism::Setup) -> (prism::Prisms, Vec<f64>) {
    let floating = prisms(setup);
    let q = floating.model.initial_coordinates();
    let v = (0..q.len()).map(|i| 0.3 * (2.3 * i as f64).sin() + 0.2 * (i % 3) as f64).collect();
    (floating, v)
}

fn rods(floating: &prism::Prisms) -> Vec<(MemberId, MassProperties<3>)> {
    let q = floating.model.initial_coordinates();
    let rod = |&bar: &MemberId| {
        let ends = floating.model.member_nodes(bar, &q);
        (bar, MassProperties::thin_rod(prism::BAR_MASS, ends[0], ends[1]).unwrap())
    };
    floating.bars.iter().map(rod).collect()
}

/// Largest change of P and L over two seconds at h = 1e-3, with their sizes.
fn drifts(setup: prism::Setup) -> ([f64; 2], [f64; 2]) {
    let (floating, v) = kicked(setup);
    let (model, members) = (&floating.model, rods(&floating));
    let mut stepper = symplectic(model);
    let mut state = stepper.start(0.0, &model.initial_coordinates(), &v).unwrap();
    let (p0, l0) = momentum(model, &members, &state.q, &state.v);
    let (mut dp, mut dl) = (0.0_f64, 0.0_f64);
    for _ in 0..2000 {
        stepper.step(&mut state, 1e-3).unwrap();
        let (p, l) = momentum(model, &members, &state.q, &state.v);
        (dp, dl) = (dp.max(distance(&p, &p0)), dl.max(distance(&l, &l0)));
    }
    let size = |x: [f64; 3]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
    ([dp, dl], [size(p0), size(l0)])
}

#[test]
fn floating_structure_keeps_linear_and_angular_momentum() {
    let setups = [
        ("linear", prism::FLOATING),
        ("slacking", prism::Setup { slacking: true, ..prism::FLOATING }),
        ("damped", prism::Setup { damping: 0.5, ..prism::FLOATING }),
        ("three prisms", prism::Setup { count: 3, ..prism::FLOATING }),
    ];
    for (name, setup) in setups {
        let ([dp, dl], [p, l]) = drifts(setup);
        println!("{name}: P {p:.2e} changes by {dp:.1e}, L {l:.2e} by {dl:.1e}");
        assert!(p > 0.01 && l > 1e-4, "{name} must move");
        assert!(dp < 1e-12 * p, "{name}: linear momentum changes by {dp:.1e}");
        assert!(dl < 1e-11 * l, "{name}: angular momentum changes by {dl:.1e}");
    }
}

/// In free fall the momentum is P0 + m g t; the mass is that of the bars.
#[test]
fn falling_structure_gains_its_weight() {
    let setup = prism::Setup { gravity: 9.81, ..prism::FLOATING };
    let (floating, v) = kicked(setup);
    let members = rods(&floating);
    let mut stepper = symplectic(&floating.model);
    let mut state = stepper.start(0.0, &floating.model.initial_coordinates(), &v).unwrap();
    let (p0, _) = momentum(&floating.model, &members, &state.q, &state.v);
    crate::support::run(&mut stepper, &mut state, 1e-3, 1.0);
    let (p, _) = momentum(&floating.model, &members, &state.q, &state.v);
    let expected = [p0[0], p0[1], p0[2] - 3.0 * prism::BAR_MASS * 9.81];
    assert!(distance(&p, &expected) < 1e-12, "{p:?} {expected:?}");
}

fn energy<const D: usize>(model: &Model<D>, state: &State) -> f64 {
    model.energy(&state.q, &state.v, &model.inputs_at(state.t)).total()
}

/// Lowest and highest energy in each of five successive spans of `span` steps.
fn bands<const D: usize>(model: &Model<D>, state: &mut State, h: f64, span: usize) -> [(f64, f64); 5] {
    let mut stepper = symplectic(model);
    [(); 5].map(|()| {
        (0..span).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), _| {
            stepper.step(state, h).unwrap();
            let e = energy(model, state);
            (low.min(e), high.max(e))
        })
    })
}

#[test]
fn energy_of_a_floating_structure_is_bounded_without_drift() {
    let (floating, v) = kicked(prism::FLOATING);
    let model = &floating.model;
    let mut state = symplectic(model).start(0.0, &model.initial_coordinates(), &v).unwrap();
    let e0 = energy(model, &state);
    let bands = bands(model, &mut state, 1e-3, 10_000);
    println!("{e0} {bands:?}");
    let widths = bands.map(|(low, high)| high - low);
    let middles = bands.map(|(low, high)| 0.5 * (low + high));
    for k in 0..5 {
        assert!(widths[k] < 2e-4 * e0, "{widths:?}");
        assert!((middles[k] - middles[0]).abs() < 0.3 * widths[0], "{middles:?} {widths:?}");
    }
}

/// Framework reference: 500 s at h = 1e-3 keep |ΔE/E0| ≤ 6.4e-3 without drift; here 50 s. The motion is chaotic: rounding
/// decides which extremes a run visits, so a tenth more is allowed for them.
#[test]
fn energy_of_example_1_is_bounded_without_drift() {
    let model = example1().model;
    let mut state = start(&model, &mut symplectic(&model));
    let e0 = energy(&model, &state);
    assert!((e0 + 0.048_181_420_326_859_5).abs() < 1e-15);
    let bands = bands(&model, &mut state, 1e-3, 10_000);
    println!("{:?}", bands.map(|(low, high)| ((low - e0) / e0, (high - e0) / e0)));
    for (low, high) in bands {
        assert!((low - e0).abs().max((high - e0).abs()) < 7e-3 * e0.abs(), "{low} {high} {e0}");
        // Every span comes back to E0, where the pendulum hangs at rest or moves slowly: nothing is lost.
        assert!((high - e0).abs() < 1e-5 * e0.abs(), "{high} {e0}");
    }
}

/// The energy error is of second order in the step.
#[test]
fn energy_error_falls_with_the_square_of_the_step() {
    let model = example1().model;
    let error = |h: f64| {
        let state = at_end(&model, &mut symplectic(&model), h, 0.5);
        (energy(&model, &state) - energy(&model, &start(&model, &mut symplectic(&model)))).abs()
    };
    let order = (error(5e-4) / error(2.5e-4)).log2();
    assert!((order - 2.0).abs() < 0.05, "{order}");
}

/// A prism in its prestressed equilibrium stays there.
#[test]
fn self_stressed_prism_rests() {
    let model = prisms(prism::FLOATING).model;
    let state = at_end(&model, &mut symplectic(&model), 1e-3, 1.0);
    assert!(distance(&state.q, &model.initial_coordinates()) < 1e-12);
}

/// The upright tower on ground at rest is in equilibrium under gravity: forces are balanced by reactions to rounding,
/// and velocities are nothing but rounding. No solve may take that for a singular matrix.
#[test]
fn tower_in_equilibrium_rests_without_remedies() {
    for setup in [tower::STILL, tower::Setup { slacking: true, damping: 0.1, ..tower::STILL }] {
        let model = tower(setup).model;
        let mut steppers: [Box<dyn Stepper + '_>; 2] =
            [Box::new(symplectic(&model)), Box::new(alpha(&model, 0.7))];
        for stepper in &mut steppers {
            let mut state = start(&model, stepper.as_mut());
            let summary = crate::support::run(stepper.as_mut(), &mut state, 1e-3, 1.0);
            assert!(distance(&state.q, &model.initial_coordinates()) < 1e-12);
            assert_eq!((summary.divided, summary.fallbacks), (0, 0), "{summary:?}");
        }
    }
}
